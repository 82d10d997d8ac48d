//! The structures of GL's state that shaders may read, section 7.5 of the GLSL 1.20 specification, with the values that GL 2.1 begins with:
//! tinta's plans change none of them.

use crate::value::{Type, Value};

/// How many lights GL 2.1 has at least.
const LIGHTS: f64 = 8.0;

/// Whether this variable is a structure of GL's state, and whether it is an array.
pub(crate) fn is_array_of_structures(name: &str) -> Option<bool> {
    match name {
        "gl_DepthRange" | "gl_Fog" | "gl_LightModel" | "gl_Point" => Some(false),
        "gl_LightSource" => Some(true),
        _ => match sided(name)? {
            "Material" | "LightModelProduct" => Some(false),
            "LightProduct" => Some(true),
            _ => None,
        },
    }
}

/// The name of a structure that exists for front and back faces.
fn sided(name: &str) -> Option<&str> {
    name.strip_prefix("gl_Front").or_else(|| name.strip_prefix("gl_Back"))
}

/// Returns the value of a member of a structure, or of the structure of this number; `None` for unknown members and numbers, and where
/// drivers differ: the largest size of points, and half vectors while fixed-function lighting is off.
pub(crate) fn member(structure: &str, number: Option<f64>, member: &str) -> Option<Value> {
    let number = number.unwrap_or_default();
    if !(0.0..LIGHTS).contains(&number) {
        return None;
    }
    let float = |number: f64| Some(Value::floats(&[number]));
    let vector = |numbers: [f64; 4]| Some(Value::floats(&numbers));
    let gray = |level: f64| vector([level, level, level, 1.0]);
    // Only light 0 begins with a colour.
    let of_light = |level: f64| if number == 0.0 { gray(level) } else { gray(0.0) };
    match (sided(structure).unwrap_or(structure), member) {
        ("Material", "ambient") => gray(0.2),
        ("Material", "diffuse") => gray(0.8),
        ("Material", "emission" | "specular") => gray(0.0),
        ("Material", "shininess") => float(0.0),
        ("LightModelProduct", "sceneColor") => gray(0.04),
        ("LightProduct", "diffuse") => of_light(0.8),
        ("LightProduct", "ambient" | "specular") => gray(0.0),
        ("gl_LightSource", "diffuse" | "specular") => of_light(1.0),
        ("gl_LightSource", "ambient") => gray(0.0),
        ("gl_LightSource", "position") => vector([0.0, 0.0, 1.0, 0.0]),
        ("gl_LightSource", "spotDirection") => Some(Value::new(Type::vector(crate::Base::Float, 3), &[0.0, 0.0, -1.0])),
        ("gl_LightSource", "spotCutoff") => float(180.0),
        ("gl_LightSource", "spotCosCutoff") => float(-1.0),
        ("gl_LightSource", "constantAttenuation") => float(1.0),
        ("gl_LightSource", "spotExponent" | "linearAttenuation" | "quadraticAttenuation") => float(0.0),
        ("gl_LightModel", "ambient") => gray(0.2),
        ("gl_DepthRange", "near") => float(0.0),
        ("gl_DepthRange", "far" | "diff") => float(1.0),
        ("gl_Fog", "color") => vector([0.0; 4]),
        ("gl_Fog", "density" | "end" | "scale") => float(1.0),
        ("gl_Fog", "start") => float(0.0),
        ("gl_Point", "size" | "fadeThresholdSize" | "distanceConstantAttenuation") => float(1.0),
        ("gl_Point", "sizeMin" | "distanceLinearAttenuation" | "distanceQuadraticAttenuation") => float(0.0),
        _ => None,
    }
}
