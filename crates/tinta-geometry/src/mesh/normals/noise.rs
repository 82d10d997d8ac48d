//! Measures a surface's local noise: the part of its normals that no smooth surface explains, within regions too small to draw
//! in.
//!
//! In: small patches of a surface. Out: the noise around each, an angle. The normals in a region are fitted by a linear
//! function of place, as curvature makes them; the residual is noise. (J. Immerkær, *Fast noise variance estimation*, 1996,
//! does so for pictures.) The lower quartile of a region and its neighbours decides, because only some of them contain edges.

use super::patches::Patches;
use crate::threads::{filled, threads_for};
use glam::{DMat3, DVec3};

/// Fewest patches of a region whose noise is measured: three are used up by the fit.
const FEWEST: usize = 6;

/// Least share of the area cut finely enough to be measured. A scanner cuts everything finely; a person cuts only details
/// finely, which are no noise.
const LEAST_MEASURED: f64 = 0.5;

/// A patch's measurements.
#[derive(Debug, Clone, Copy)]
pub(super) struct Place {
    pub centre: DVec3,
    /// Of length 1.
    pub normal: DVec3,
}

/// The noise around each patch: the root of the mean square of an angle, radians; 0 where it cannot be measured. `region` is the
/// area of a region. Faces that differ by an angle of less cosine than `cos_smooth` and patches that are not `is_small` are in none.
pub(super) fn noise(
    patches: &Patches,
    places: &[Place],
    region: f64,
    cos_smooth: f64,
    is_small: impl Fn(u32) -> bool,
) -> Vec<f64> {
    let area = |patch: u32| patches.areas[patch as usize];
    let regions = Patches::new(&patches.neighbours, places.len(), area, |first, _, other, so_far| {
        let [normal, other_normal] = [first, other].map(|patch| places[patch as usize].normal);
        let is_near = so_far < region && is_small(first) && is_small(other) && normal.dot(other_normal) > cos_smooth;
        is_near.then(|| area(other))
    });
    let members = regions.members();
    let count = regions.areas.len();
    let own = filled(count, threads_for(places.len()), None, |number| {
        noise_of(members.of(number).iter().map(|member| places[*member as usize]))
    });
    let sum = |is_counted: &dyn Fn(usize) -> bool| {
        let counted = (0..count).filter(|number| is_small(members.of(*number)[0]) && is_counted(*number));
        counted.map(|number| regions.areas[number]).sum::<f64>()
    };
    if sum(&|number| own[number].is_some()) < LEAST_MEASURED * sum(&|_| true) {
        return vec![0.0; places.len()];
    }
    let around = filled(count, threads_for(places.len()), 0.0, |number| {
        let beside = regions.neighbours.of(number).iter().map(|other| *other as usize);
        let mut known: Vec<f64> = beside.chain([number]).filter_map(|number| own[number]).collect();
        known.sort_unstable_by(f64::total_cmp);
        known.get(known.len() / 4).copied().unwrap_or(0.0)
    });
    regions.of.iter().map(|region| around[*region as usize]).collect()
}

/// Returns the root mean square difference between normals and their best linear fit by place; `None` for too few.
fn noise_of(members: impl Iterator<Item = Place> + Clone) -> Option<f64> {
    let count = members.clone().count();
    if count < FEWEST {
        return None;
    }
    let centre = members.clone().map(|it| it.centre).sum::<DVec3>() / count as f64;
    let (across, up) = members.clone().map(|it| it.normal).sum::<DVec3>().try_normalize()?.any_orthonormal_pair();
    let scale = members.clone().map(|it| (it.centre - centre).length_squared()).sum::<f64>().sqrt();
    let terms = members.map(|it| {
        let away = (it.centre - centre) / scale;
        (DVec3::new(1.0, away.dot(across), away.dot(up)), it.normal)
    });
    let (mut squares, mut products) = (DMat3::ZERO, DMat3::ZERO);
    for (term, normal) in terms.clone() {
        squares += DMat3::from_cols(term * term.x, term * term.y, term * term.z);
        products += DMat3::from_cols(normal * term.x, normal * term.y, normal * term.z);
    }
    let fit = products * squares.inverse();
    let rest: f64 = terms.map(|(term, normal)| (normal - fit * term).length_squared()).sum();
    // Patches on one line have no fit.
    let noise = (rest / (count as f64 - 3.0)).sqrt();
    noise.is_finite().then_some(noise)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two numbers of a normal distribution of variance 1, as if at random.
    fn gauss(number: usize) -> [f64; 2] {
        let even = |salt: f64| ((number as f64 * 12.9898 + salt).sin() * 43758.5453).fract().abs().max(1e-12);
        let (length, turn) = ((-2.0 * even(0.0).ln()).sqrt(), even(7.7) * std::f64::consts::TAU);
        [length * turn.cos(), length * turn.sin()]
    }

    fn square(side: usize) -> impl Iterator<Item = [f64; 2]> + Clone {
        (0..side * side).map(move |n| [(n % side) as f64 / side as f64, (n / side) as f64 / side as f64])
    }

    #[test]
    fn the_noise_that_was_put_into_normals_is_measured_flat_or_bent() {
        for (noise, bend) in [(0.01, 0.0), (0.05, 0.0), (0.05, 0.5)] {
            let places = square(40).enumerate().map(|(number, [x, y])| {
                let [a, b] = gauss(number);
                let normal = DVec3::new(bend * x + noise * a, 1.0, noise * b - bend * y).normalize();
                Place { centre: DVec3::new(x, 0.0, y), normal }
            });
            // Two directions have this noise each.
            let expected = noise * 2f64.sqrt();
            let measured = noise_of(places).unwrap();
            assert!((measured / expected - 1.0).abs() < 0.15, "{measured} instead of {expected}");
        }
    }

    #[test]
    fn too_few_patches_and_those_on_one_line_say_nothing() {
        let place = |[x, y]: [f64; 2]| Place { centre: DVec3::new(x, 0.0, y), normal: DVec3::Y };
        assert_eq!(noise_of(square(2).map(place)), None);
        assert_eq!(noise_of((0..9).map(|n| place([f64::from(n), 0.0]))), None);
        assert_eq!(noise_of(square(3).map(place)), Some(0.0));
    }
}
