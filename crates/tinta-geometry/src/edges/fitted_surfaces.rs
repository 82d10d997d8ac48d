//! Surfaces fitted to vertices by least squares: planes, spheres, cylinders, cones and tori.
//!
//! In: points on a surface, rounded, and a first guess. Out: the surface, if it passes through all of them. Gauss
//! and Newton's steps are the same for all kinds: shifts and tilts of an axis, and two sizes.

use glam::{DVec2, DVec3};

/// The kind of a fitted surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Through `point`, perpendicular to the axis.
    Plane,
    /// Around `point`. The first size is the radius.
    Sphere,
    /// Around the axis. The first size is the radius.
    Cylinder,
    /// Around the axis. The first size is the radius beside `point`, the second the angle by which normals rise along the axis.
    Cone,
    /// Around the axis. The first size is the radius of the circle around `point` along which the tube runs, the second the tube's radius.
    Torus,
}

/// A surface through vertices of a mesh, file units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FittedSurface {
    pub kind: Kind,
    pub point: DVec3,
    /// A unit vector; a sphere's has no meaning.
    pub axis: DVec3,
    pub sizes: [f64; 2],
}

/// Largest turn that counts as flat, radians: more than a file's six digits bend a facet.
pub(super) const FLAT: f64 = 1e-3;

/// What a step changes: shifts along two axes across the surface's and along it, its tilts towards the two, two sizes.
const UNKNOWNS: usize = 7;

/// The most steps of a fit.
const STEPS: usize = 12;

/// Added to the equations' diagonal, as a share of its largest: where rounding would decide, nothing changes.
const ROUNDING: f64 = 1e-15;

impl FittedSurface {
    /// A point's place beside the axis: its distance from there, the place along it, and the direction away from it.
    pub(crate) fn profile(&self, point: DVec3) -> (DVec2, DVec3) {
        let from = point - self.point;
        let along = from.dot(self.axis);
        let across = from - self.axis * along;
        let distance = across.length();
        (DVec2::new(distance, along), if distance > 0.0 { across / distance } else { DVec3::ZERO })
    }

    /// A point's signed distance, and the surface's unit normal there.
    pub(crate) fn at(&self, point: DVec3) -> (f64, DVec3) {
        let (DVec2 { x: distance, y: along }, outwards) = self.profile(point);
        let [size, second] = self.sizes;
        match self.kind {
            Kind::Plane => (along, self.axis),
            Kind::Cylinder => (distance - size, outwards),
            Kind::Cone => {
                let (sine, cosine) = second.sin_cos();
                ((distance - size) * cosine + along * sine, outwards * cosine + self.axis * sine)
            }
            Kind::Sphere => {
                let from = point - self.point;
                (from.length() - size, from.normalize_or_zero())
            }
            Kind::Torus => {
                let around = outwards * (distance - size) + self.axis * along;
                (around.length() - second, around.normalize_or_zero())
            }
        }
    }

    /// The number of lines along a cylinder's or cone's axis, or circles around a torus's, on which points lie. On a sphere each is one.
    pub(crate) fn lines(&self, points: &[DVec3]) -> usize {
        let (_, start) = self.profile(points[0]);
        let turn = |point: &DVec3| {
            let (place, outwards) = self.profile(*point);
            match self.kind {
                Kind::Torus => place.y.atan2(place.x - self.sizes[0]),
                _ => outwards.dot(self.axis.cross(start)).atan2(outwards.dot(start)),
            }
        };
        let mut turns: Vec<f64> = points.iter().map(turn).collect();
        turns.sort_by(f64::total_cmp);
        turns.dedup_by(|next, turn| *next - *turn < FLAT);
        turns.len()
    }

    /// A point's distance, and how each unknown changes it.
    fn gradient(&self, [first, second]: [DVec3; 2], point: DVec3) -> (f64, [f64; UNKNOWNS]) {
        let (value, normal) = self.at(point);
        let (DVec2 { x: distance, y: along }, outwards) = self.profile(point);
        let from = point - self.point;
        let [a, b, c] = [first, second, self.axis].map(|axis| -normal.dot(axis));
        let [d, e] = [second, -first].map(|turn| normal.dot(from.cross(turn)));
        let (sine, cosine) = self.sizes[1].sin_cos();
        let [f, g] = match self.kind {
            Kind::Plane => [0.0, 0.0],
            Kind::Sphere | Kind::Cylinder => [-1.0, 0.0],
            Kind::Cone => [-cosine, along * cosine - (distance - self.sizes[0]) * sine],
            Kind::Torus => [-normal.dot(outwards), -1.0],
        };
        (value, [a, b, c, d, e, f, g])
    }

    /// The surface of this kind through points near it, if it comes within `tolerance` of all.
    pub(crate) fn fitted(mut self, points: &[DVec3], tolerance: f64) -> Option<Self> {
        let [mut largest, mut before] = [f64::INFINITY; 2];
        for _ in 0..STEPS {
            let axes: [DVec3; 2] = self.axis.any_orthonormal_pair().into();
            largest = 0.0;
            let changes = least_squares(points.iter().map(|point| {
                let (value, changes) = self.gradient(axes, *point);
                largest = largest.max(value.abs());
                (changes, -value)
            }));
            if largest >= before {
                break;
            }
            let [a, b, c, d, e, size, second] = changes;
            before = 0.5 * largest;
            self.point += axes[0] * a + axes[1] * b + self.axis * c;
            self.axis = (self.axis + axes[0] * d + axes[1] * e).normalize();
            self.sizes = [self.sizes[0] + size, self.sizes[1] + second];
        }
        (largest <= tolerance).then_some(self)
    }

    /// The sphere, cone and cylinder near facets with these normals and middles. The tips of a cone's normals lie on a circle around its axis.
    pub(crate) fn near(facets: &[(DVec3, DVec3)]) -> Option<[Self; 3]> {
        let [(one, from), (two, _), (three, to)] = [0, facets.len() / 2, facets.len() - 1].map(|at| facets[at]);
        let axis = (two - one).cross(three - two).try_normalize()?;
        let sine = facets.iter().map(|(normal, _)| normal.dot(axis)).sum::<f64>() / facets.len() as f64;
        // The axis is as far from both places along their directions.
        let middle = |[from, to]: [DVec3; 2], [one, other]: [DVec3; 2]| {
            let radius = (to - from).dot(other - one) / (other - one).length_squared();
            (from - one * radius, radius)
        };
        let (centre, radius) = middle([from, to], [one, three]);
        let sphere = Self { kind: Kind::Sphere, point: centre, axis, sizes: [radius.abs(), 0.0] };
        let outwards = [one, three].map(|normal| (normal - axis * normal.dot(axis)).normalize_or_zero());
        // A cone's radius shrinks along the axis.
        let along = (to - from).dot(axis);
        let beside = to - axis * along + outwards[1] * (along * sine.asin().tan());
        let (point, radius) = middle([from, beside], outwards);
        let cone = Self { kind: Kind::Cone, point, axis, sizes: [radius.abs(), sine.asin() * radius.signum()] };
        Some([sphere, cone, Self { kind: Kind::Cylinder, sizes: [radius.abs(), 0.0], ..cone }])
    }

    /// The torus with this axis through points.
    pub(crate) fn torus(&self, points: impl Iterator<Item = DVec3>) -> Self {
        let [across, along, rest] = least_squares(points.map(|point| {
            let (place, _) = self.profile(point);
            ([2.0 * place.x, 2.0 * place.y, 1.0], place.length_squared())
        }));
        let tube = (rest + across * across + along * along).sqrt();
        Self { kind: Kind::Torus, point: self.point + self.axis * along, axis: self.axis, sizes: [across, tube] }
    }
}

/// The best unknowns of linear equations. One without effect is 0.
fn least_squares<const N: usize>(equations: impl Iterator<Item = ([f64; N], f64)>) -> [f64; N] {
    let (mut matrix, mut right) = ([[0.0; N]; N], [0.0; N]);
    for (factors, value) in equations {
        for row in 0..N {
            right[row] += factors[row] * value;
            (0..N).for_each(|column| matrix[row][column] += factors[row] * factors[column]);
        }
    }
    let least = ROUNDING * (0..N).map(|at| matrix[at][at]).fold(0.0, f64::max);
    (0..N).for_each(|at| matrix[at][at] += least);
    for at in 0..N {
        for row in (0..N).filter(|row| *row != at) {
            let share = matrix[row][at] / matrix[at][at];
            (0..N).for_each(|column| matrix[row][column] -= share * matrix[at][column]);
            right[row] -= share * right[at];
        }
    }
    std::array::from_fn(|at| right[at] / matrix[at][at])
}
