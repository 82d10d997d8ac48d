//! Colours of PLY files as shares of their full strength.

use super::header::{Element, PropertyType, ScalarType};
use glam::DVec3;

/// The value of a channel's full strength: in whole numbers the largest of its type, else 1; `None` without all three channels.
pub(super) fn full_color(element: &Element) -> Option<f64> {
    let types = |names: [&str; 3]| -> Option<Vec<PropertyType>> {
        let of = |name| element.properties.iter().find(|own| own.name == name).map(|own| own.data_type);
        names.into_iter().map(of).collect()
    };
    let types = types(["red", "green", "blue"]).or_else(|| types(["diffuse_red", "diffuse_green", "diffuse_blue"]))?;
    match types.first()? {
        PropertyType::Scalar(ScalarType::UChar) => Some(f64::from(u8::MAX)),
        PropertyType::Scalar(ScalarType::UShort) => Some(f64::from(u16::MAX)),
        PropertyType::Scalar(ScalarType::Float | ScalarType::Double) => Some(1.0),
        _ => None,
    }
}

/// A colour of the file as shares of its full strength.
pub(super) fn share(color: DVec3, full: f64) -> [f32; 3] {
    let share = (color / full).clamp(DVec3::ZERO, DVec3::ONE);
    if share.is_finite() { share.as_vec3().to_array() } else { [1.0; 3] }
}
