//! Averages textures that are finer than the pixels of a view, on the processor: all drivers, browsers and `tinta why` read the same.
//!
//! A texture's sides are halved until at most two texels come to a pixel where the view shows it largest, so nothing gets blurred.
//! Mipmaps of a driver would be finer grained, and another driver's would differ.

use crate::scene::{Object, Scene, Size};
use glam::{Vec2, Vec3};

/// The most texels of an averaged texture at a pixel, along each side, where the texture is shown largest.
const MOST_TEXELS: f32 = 2.0;

/// The most halvings of a side: one of 2048 texels becomes one texel.
const MOST_HALVINGS: u32 = 11;

/// Halves the sizes of pictures, by material, that copies of one object would show too fine on a surface of this size.
pub(super) fn average<'a>(
    sizes: &mut [Option<Size>],
    scene: &Scene,
    copies: impl Iterator<Item = &'a Object>,
    surface: Size,
) {
    let mut least = vec![Vec2::splat(f32::INFINITY); sizes.len()];
    let clip_from_view = scene.clip_from_view();
    // A unit's pixels at a distance of 1, in parallel projection at all.
    let scale = clip_from_view.y_axis.y * surface.height as f32 * 0.5;
    for object in copies {
        let arrays = scene.arrays(object);
        let clip_from_object = clip_from_view * scene.view_from_object(object, arrays.centre);
        for part in arrays.parts.iter().filter(|_| !arrays.texture_coordinates.is_empty()) {
            let Some(Some(size)) = sizes.get(part.material as usize) else { continue };
            let texels = Vec2::new(size.width as f32, size.height as f32);
            for face in arrays.indices[part.first as usize..][..part.count as usize].as_chunks::<3>().0 {
                let [a, b, c] = face.map(|index| Vec3::from_slice(&arrays.vertices[index as usize]));
                let clip = [a, b, c].map(|corner| clip_from_object * corner.extend(1.0));
                let are_beyond = |axis: usize, side: f32| clip.iter().all(|corner| corner[axis] * side > corner.w);
                if (0..2).any(|axis| are_beyond(axis, 1.0) || are_beyond(axis, -1.0)) {
                    continue;
                }
                let [p, q, r] = face.map(|index| Vec2::from(arrays.texture_coordinates[index as usize]) * texels);
                // A face without area shows nothing, and one that reaches the eye shows texels of any size.
                if let Some(rates) = rates([b - a, c - a], [q - p, r - p]) {
                    let nearest = clip.iter().map(|corner| corner.w).fold(f32::INFINITY, f32::min).max(0.0);
                    let least = &mut least[part.material as usize];
                    *least = least.min(rates * nearest / scale);
                }
            }
        }
    }
    let often = |texels: f32| (texels / MOST_TEXELS).max(1.0).log2().ceil() as u32;
    let half = |side: u32, texels: f32| (side >> often(texels).min(MOST_HALVINGS)).max(1);
    for (size, least) in sizes.iter_mut().zip(least).filter_map(|(size, least)| Some((size.as_mut()?, least))) {
        *size = Size { width: half(size.width, least.x), height: half(size.height, least.y) };
    }
}

/// How fast both texture coordinates grow at most along a triangle with these sides; `None` without area.
fn rates([u, v]: [Vec3; 2], [at_u, at_v]: [Vec2; 2]) -> Option<Vec2> {
    let area = u.cross(v).length();
    let rate = |axis: usize| (v * at_u[axis] - u * at_v[axis]).length() / area;
    (area > 0.0).then(|| Vec2::new(rate(0), rate(1)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::Picture;

    #[test]
    fn halves_are_means() {
        let grey = |values: &[u8], width: u32| Picture {
            size: Size { width, height: values.len() as u32 / width },
            pixels: values.iter().flat_map(|value| [*value, *value, *value, 255]).collect(),
        };
        let reduced =
            |width: u32, height: u32| grey(&[0, 10, 20, 30, 2, 12, 22, 32], 4).reduced(Size { width, height });
        assert_eq!(reduced(2, 1), grey(&[6, 26], 2));
        assert_eq!(reduced(4, 1), grey(&[1, 11, 21, 31], 4));
        assert_eq!(reduced(1, 2), grey(&[15, 17], 1));
    }

    #[test]
    fn gradients_are_along_the_surface() {
        // A square of side 2 that shows 8 texels across and 6 up, sheared and turned.
        let (u, v) = (Vec3::new(0.0, 2.0, 0.0), Vec3::new(0.0, 0.0, 2.0));
        let at = |texels: Vec2| texels * Vec2::new(4.0, 3.0);
        assert_eq!(rates([u, v], [at(Vec2::X * 2.0), at(Vec2::Y * 2.0)]), Some(Vec2::new(4.0, 3.0)));
        let sheared = rates([u, v + u], [at(Vec2::X * 2.0), at(Vec2::splat(2.0))]).unwrap();
        assert!(sheared.abs_diff_eq(Vec2::new(4.0, 3.0), 1e-5), "{sheared}");
        assert_eq!(rates([u, u], [Vec2::X, Vec2::X]), None);
    }
}
