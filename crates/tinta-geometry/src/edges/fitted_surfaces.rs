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

/// What a step changes: shifts along two axes across the surface's and along it, its tilts towards the two, two sizes.
const UNKNOWNS: usize = 7;

/// The most steps of a fit.
const STEPS: usize = 12;

/// Least pivot of the equations, as a share of their diagonal: below it rounding decides.
const PIVOT: f64 = 1e-13;

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

    /// A point's distance, and how each unknown changes it.
    fn gradient(&self, [first, second]: [DVec3; 2], point: DVec3) -> (f64, [f64; UNKNOWNS]) {
        let (value, normal) = self.at(point);
        let (DVec2 { x: distance, y: along }, outwards) = self.profile(point);
        let [a, b, c] = [first, second, self.axis].map(|axis| -normal.dot(axis));
        let tilt = |axis: DVec3| -c * distance * outwards.dot(axis) - along * normal.dot(axis);
        let [d, e] = [tilt(first), tilt(second)];
        let changes = match self.kind {
            Kind::Plane => [0.0, 0.0, c, d, e, 0.0, 0.0],
            Kind::Sphere => [a, b, c, 0.0, 0.0, -1.0, 0.0],
            Kind::Cylinder => [a, b, 0.0, d, e, -1.0, 0.0],
            Kind::Cone => {
                let (sine, cosine) = self.sizes[1].sin_cos();
                [a, b, 0.0, d, e, -cosine, along * cosine - (distance - self.sizes[0]) * sine]
            }
            Kind::Torus => [a, b, c, d, e, -normal.dot(outwards), -1.0],
        };
        (value, changes)
    }

    /// The surface of this kind through points near it, if it comes within `tolerance` of all.
    pub(crate) fn fitted(mut self, points: &[DVec3], tolerance: f64) -> Option<Self> {
        let mut before = f64::INFINITY;
        for _ in 0..STEPS {
            let axes: [DVec3; 2] = self.axis.any_orthonormal_pair().into();
            let mut largest = 0.0f64;
            let changes = least_squares(points.iter().map(|point| {
                let (value, changes) = self.gradient(axes, *point);
                largest = largest.max(value.abs());
                (changes, -value)
            }));
            if largest >= before {
                return (largest <= tolerance).then_some(self);
            }
            let [a, b, c, d, e, size, second] = changes?;
            before = 0.5 * largest;
            self.point += axes[0] * a + axes[1] * b + self.axis * c;
            self.axis = (self.axis + axes[0] * d + axes[1] * e).normalize();
            self.sizes = [self.sizes[0] + size, self.sizes[1] + second];
        }
        None
    }

    /// The sphere, cone and cylinder near facets with these normals and middles. The tips of a cone's normals lie on a circle around its axis.
    pub(crate) fn near(facets: &[(DVec3, DVec3)]) -> Option<[Self; 3]> {
        let [(one, from), (two, _), (three, to)] = [0, facets.len() / 2, facets.len() - 1].map(|at| facets[at]);
        let axis = (two - one).cross(three - two).try_normalize()?;
        let sine = facets.iter().map(|(normal, _)| normal.dot(axis)).sum::<f64>() / facets.len() as f64;
        let tangent = sine / (1.0 - sine * sine).max(0.0).sqrt();
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
        let beside = to - axis * along + outwards[1] * (tangent * along);
        let (point, radius) = middle([from, beside], outwards);
        let cone = Self { kind: Kind::Cone, point, axis, sizes: [radius.abs(), tangent.atan() * radius.signum()] };
        Some([sphere, cone, Self { kind: Kind::Cylinder, sizes: [radius.abs(), 0.0], ..cone }])
    }

    /// The torus with this axis through points.
    pub(crate) fn torus(&self, points: impl Iterator<Item = DVec3>) -> Option<Self> {
        let [across, along, rest] = least_squares(points.map(|point| {
            let (place, _) = self.profile(point);
            ([2.0 * place.x, 2.0 * place.y, 1.0], place.length_squared())
        }))?;
        let tube = (rest + across * across + along * along).sqrt();
        Some(Self { kind: Kind::Torus, point: self.point + self.axis * along, axis: self.axis, sizes: [across, tube] })
    }
}

/// The best unknowns of linear equations (Cholesky). Unknowns in none of them are 0.
fn least_squares<const N: usize>(equations: impl Iterator<Item = ([f64; N], f64)>) -> Option<[f64; N]> {
    let (mut matrix, mut right) = ([[0.0; N]; N], [0.0; N]);
    for (factors, value) in equations {
        for row in 0..N {
            right[row] += factors[row] * value;
            (0..=row).for_each(|column| matrix[row][column] += factors[row] * factors[column]);
        }
    }
    for row in 0..N {
        let diagonal = matrix[row][row];
        for column in 0..row {
            let sum: f64 = (0..column).map(|at| matrix[row][at] * matrix[column][at]).sum();
            matrix[row][column] = (matrix[row][column] - sum) / matrix[column][column];
        }
        let rest = diagonal - (0..row).map(|at| matrix[row][at] * matrix[row][at]).sum::<f64>();
        matrix[row][row] = match diagonal {
            0.0 => 1.0,
            _ if rest > PIVOT * diagonal => rest.sqrt(),
            _ => return None,
        };
        let sum: f64 = (0..row).map(|at| matrix[row][at] * right[at]).sum();
        right[row] = (right[row] - sum) / matrix[row][row];
    }
    for row in (0..N).rev() {
        let sum: f64 = (row + 1..N).map(|at| matrix[at][row] * right[at]).sum();
        right[row] = (right[row] - sum) / matrix[row][row];
    }
    Some(right)
}
