//! Where a picture's tones change, against where they change by the style's formula: the exact areas of tone without pixels.

use super::ToneBorderError;
use super::ink::mean_and_95th;
use super::reference::{Place, Reference, distance, middles, tree};
use glam::DVec2;
use rstar::RTree;
use std::collections::HashMap;
use tinta::error::Result;
use tinta::lines::{Progress, Regions, Sight, ToneRule, TonedSurface};
use tinta::picture::Picture;
use tinta::scene::Scene;
use tinta::styles::Tones;

/// Distance between points along an exact border, pixels: fine beside the hundredths that distances are stated in.
const STEP_PX: f64 = 1.0 / 32.0;

/// The exact borders between two tones of one surface.
#[derive(Debug)]
pub(super) struct ToneBorders {
    /// Points along them, each with the length that it stands for, pixels.
    samples: Vec<(DVec2, f64)>,
    nearest: RTree<Place>,
}

impl ToneBorders {
    /// Those of a style in a view.
    ///
    /// # Errors
    ///
    /// Those of [`Regions::toned`].
    pub(super) fn of(rule: &ToneRule, scene: &Scene) -> Result<Self> {
        let borders = borders(&Regions::toned(&Sight::of(scene), rule, &Progress::default())?);
        let of_border = |ends: [DVec2; 2]| {
            let points: Vec<DVec2> = middles(ends, STEP_PX).collect();
            let length = ends[0].distance(ends[1]) / points.len() as f64;
            points.into_iter().map(move |px| (px, length))
        };
        let samples: Vec<(DVec2, f64)> = borders.into_iter().flat_map(of_border).collect();
        Ok(Self { nearest: tree(samples.iter().map(|(px, _)| *px)), samples })
    }

    /// How far a picture's borders are from these; what lies within `rim_px` of a visible line is left out. `colors` has the colour
    /// in full light of the surface at each pixel, row by row from the top. `None` where either has no border.
    pub(super) fn error(
        &self,
        picture: &Picture,
        tones: &Tones,
        colors: &[Option<[f64; 3]>],
        (lines, rim_px): (&Reference, f64),
    ) -> Option<ToneBorderError> {
        let is_inside = |px: DVec2| lines.distance_px(px) > rim_px;
        let drawn: Vec<DVec2> = crossings(picture, tones, colors).into_iter().filter(|px| is_inside(*px)).collect();
        let to_exact = drawn.iter().map(|px| (distance(&self.nearest, *px), 1.0)).collect();
        let drawn = tree(drawn.iter().copied());
        let exact = self.samples.iter().filter(|(px, _)| is_inside(*px));
        let to_drawn = exact.map(|(px, length)| (distance(&drawn, *px), *length)).collect();
        Some(ToneBorderError {
            exact_to_drawn_px: mean_and_95th(to_drawn)?,
            drawn_to_exact_px: mean_and_95th(to_exact)?,
        })
    }
}

/// The sides that two areas of one material have in common.
fn borders(regions: &Regions<Option<TonedSurface>>) -> Vec<[DVec2; 2]> {
    let mut seen: HashMap<[u64; 4], TonedSurface> = HashMap::new();
    let mut borders = Vec::new();
    for region in &regions.regions {
        let Some(surface) = region.seen else { continue };
        for corners in &region.loops {
            for (from, to) in corners.iter().zip(corners.iter().cycle().skip(1)) {
                let key = |a: &DVec2, b: &DVec2| [a.x, a.y, b.x, b.y].map(f64::to_bits);
                // A neighbour has the same side the other way.
                match seen.remove(&key(to, from)) {
                    None => {
                        seen.insert(key(from, to), surface);
                    }
                    Some(TonedSurface { object, material, .. }) => {
                        if (object, material) == (surface.object, surface.material) {
                            borders.push([*from, *to]);
                        }
                    }
                }
            }
        }
    }
    borders
}

/// Where the tone changes between the middles of two pixels beside each other: where light, linear between them, is halfway from one
/// tone to the next.
fn crossings(picture: &Picture, tones: &Tones, colors: &[Option<[f64; 3]>]) -> Vec<DVec2> {
    let (width, height) = (picture.size.width as usize, picture.size.height as usize);
    let level = |index: usize| {
        let color = colors[index]?;
        let channel = (0..3).max_by(|a, b| color[*a].total_cmp(&color[*b]))?;
        let level = f64::from(picture.pixels[4 * index + channel]) / (255.0 * color[channel]);
        level.is_finite().then_some((color, level))
    };
    let mut levels = tones.levels.map(f64::from);
    levels.sort_unstable_by(f64::total_cmp);
    let halfway = levels.windows(2).map(|pair| (pair[0] + pair[1]) * 0.5);
    let halfway: Vec<f64> = halfway.collect();
    let mut crossings = Vec::new();
    for index in 0..width * height {
        let (x, y) = (index % width, index / width);
        let Some((color, here)) = level(index) else { continue };
        for (is_there, step, along) in [(x + 1 < width, 1, DVec2::X), (y + 1 < height, width, DVec2::Y)] {
            let Some((other, there)) = is_there.then(|| level(index + step)).flatten() else { continue };
            if other != color {
                continue;
            }
            let places = halfway.iter().filter(|half| (here < **half) != (there < **half));
            let middle = DVec2::new(x as f64 + 0.5, y as f64 + 0.5);
            crossings.extend(places.map(|half| middle + along * ((half - here) / (there - here))));
        }
    }
    crossings
}

#[cfg(test)]
mod tests {
    use super::*;
    use tinta::scene::Size;

    /// Grey pixels of a white surface.
    fn picture(size: Size, level: impl Fn(u32, u32) -> f64) -> (Picture, Vec<Option<[f64; 3]>>) {
        let places = (0..size.height).flat_map(|y| (0..size.width).map(move |x| (x, y)));
        let grey = |(x, y)| [(level(x, y) * 255.0).round() as u8; 4];
        let pixels = places.flat_map(grey).collect();
        (Picture { size, pixels }, vec![Some([1.0; 3]); (size.width * size.height) as usize])
    }

    #[test]
    fn a_tone_changes_between_pixels_and_in_a_mixed_pixel_where_its_share_says() {
        let tones = Tones { levels: [0.2, 0.6, 1.0], ..Tones::default() };
        let size = Size { width: 4, height: 1 };
        let (hard, colors) = picture(size, |x, _| if x < 2 { 0.2 } else { 0.6 });
        let found = crossings(&hard, &tones, &colors);
        assert!(matches!(found[..], [place] if place.distance(DVec2::new(2.0, 0.5)) < 1e-6), "{found:?}");
        // The third pixel is covered to three quarters by the brighter tone: its border is at 2.25.
        let (mixed, colors) = picture(size, |x, _| [0.2, 0.2, 0.5, 0.6][x as usize]);
        let found = crossings(&mixed, &tones, &colors);
        assert!(matches!(found[..], [place] if (place.x - 2.25).abs() < 0.1), "{found:?}");
        // From the darkest to the brightest there are two.
        let (both, colors) = picture(size, |x, _| if x < 2 { 0.2 } else { 1.0 });
        assert_eq!(crossings(&both, &tones, &colors).len(), 2);
    }

    #[test]
    fn no_tone_changes_where_the_surface_does() {
        let size = Size { width: 2, height: 1 };
        let (drawn, mut colors) = picture(size, |x, _| f64::from(x));
        colors[1] = Some([0.5; 3]);
        assert_eq!(crossings(&drawn, &Tones::default(), &colors), []);
        colors[1] = None;
        assert_eq!(crossings(&drawn, &Tones::default(), &colors), []);
    }
}
