//! Tensors in tangent planes: how they are fitted in a triangle and rotated into another plane.

use glam::{DVec2, DVec3};

/// The curvature of the surface at a vertex. Lengths are in file units.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Curvature {
    /// The unit normal; 0 if undefined.
    pub normal: DVec3,
    /// The principal curvatures, the one with the larger absolute value first, 1 / length; positive if convex.
    pub principal: [f64; 2],
    /// Their directions, unit vectors, right-handed with the normal. Their signs are arbitrary.
    pub directions: [DVec3; 2],
    /// The derivative C of the curvature tensor, 1 / length²: C(u, u, u), C(u, u, v), C(u, v, v) and C(v, v, v) for
    /// the directions u and v. The first is the growth of the first principal curvature along its own direction.
    pub derivative: [f64; 4],
}

/// A tangent plane with two axes, right-handed with the normal.
#[derive(Debug, Clone, Copy)]
pub(super) struct Basis {
    pub axes: [DVec3; 2],
    pub normal: DVec3,
    /// For a face, its sides in these axes: from each corner's successor to the one after that.
    pub sides: [DVec2; 3],
}

/// The axes of one plane in those of another, rotated along the shortest way.
#[derive(Debug, Clone, Copy)]
pub(super) struct Turn([DVec2; 2]);

/// Least value of 1 plus the cosine of two normals: nearly opposite normals have no shortest rotation.
const OPPOSITE: f64 = 1e-6;

impl Basis {
    /// The basis of a face; `None` without area.
    pub(super) fn of_face([a, b, c]: [DVec3; 3], areas: [f64; 3]) -> Option<Self> {
        if areas.iter().sum::<f64>() <= 0.0 {
            return None;
        }
        let normal = (b - a).cross(c - a).try_normalize()?;
        let along = (c - b).try_normalize()?;
        let axes = [along, normal.cross(along)];
        let flat = |side: DVec3| DVec2::new(side.dot(axes[0]), side.dot(axes[1]));
        Some(Self { axes, normal, sides: [c - b, a - c, b - a].map(flat) })
    }

    /// The basis for a unit normal; `None` for 0.
    pub(super) fn of_normal(normal: DVec3) -> Option<Self> {
        if normal == DVec3::ZERO {
            return None;
        }
        let first = normal.any_orthonormal_vector();
        Some(Self { axes: [first, normal.cross(first)], normal, sides: [DVec2::ZERO; 3] })
    }

    /// The basis of the principal directions; `None` without a normal.
    pub(super) fn of_curvature(at: &Curvature) -> Option<Self> {
        let is_some = at.normal != DVec3::ZERO;
        is_some.then_some(Self { axes: at.directions, normal: at.normal, sides: [DVec2::ZERO; 3] })
    }

    /// The components of a vector in the plane.
    pub(super) fn flat(&self, vector: DVec3) -> [f64; 2] {
        self.axes.map(|axis| vector.dot(axis))
    }

    /// Its axes, rotated into another plane; `None` if the planes face away from each other.
    pub(super) fn turned(&self, other: &Self) -> Option<Turn> {
        let cosine = 1.0 + self.normal.dot(other.normal);
        if cosine < OPPOSITE {
            return None;
        }
        let both = (self.normal + other.normal) / cosine;
        let turned = self.axes.map(|axis| axis - both * axis.dot(other.normal));
        Some(Turn(turned.map(|axis| DVec2::from_array(other.flat(axis)))))
    }
}

/// A symmetric tensor in a plane: for the first axis twice, for both, for the second twice.
#[derive(Debug, Clone, Copy)]
pub(super) struct Tensor(pub [f64; 3]);

impl Tensor {
    fn of(&self, a: DVec2, b: DVec2) -> f64 {
        let [p, q, r] = self.0;
        p * a.x * b.x + q * (a.x * b.y + a.y * b.x) + r * a.y * b.y
    }

    /// The tensor in the axes of another plane.
    pub(super) fn seen(&self, Turn([a, b]): Turn) -> Self {
        Self([self.of(a, a), self.of(a, b), self.of(b, b)])
    }

    /// Its eigenvalues and their directions, the one with the larger absolute value first.
    pub(super) fn principal(&self, basis: &Basis) -> ([f64; 2], [DVec3; 2]) {
        let [p, q, r] = self.0;
        // The axes turn by half the angle of (p - r, 2 q).
        let (half, radius) = (0.5 * (p - r), (0.5 * (p - r)).hypot(q));
        let (high, low) = (0.5 * (p + r) + radius, 0.5 * (p + r) - radius);
        let cosine = if radius > 0.0 { half / radius } else { 1.0 };
        let (x, y) = ((0.5 * (1.0 + cosine)).max(0.0).sqrt(), (0.5 * (1.0 - cosine)).max(0.0).sqrt());
        let of_high = basis.axes[0] * x + basis.axes[1] * y.copysign(q);
        let of_low = basis.normal.cross(of_high);
        if high.abs() >= low.abs() { ([high, low], [of_high, of_low]) } else { ([low, high], [of_low, -of_high]) }
    }
}

/// A symmetric form of three vectors in a plane: for the first axis three times, twice, once, never.
#[derive(Debug, Clone, Copy)]
pub(super) struct Derivative(pub [f64; 4]);

impl Derivative {
    fn of(&self, a: DVec2, b: DVec2, c: DVec2) -> f64 {
        let [p, q, r, s] = self.0;
        p * a.x * b.x * c.x
            + q * (a.x * b.x * c.y + a.x * b.y * c.x + a.y * b.x * c.x)
            + r * (a.x * b.y * c.y + a.y * b.x * c.y + a.y * b.y * c.x)
            + s * a.y * b.y * c.y
    }

    /// The form in the axes of another plane.
    pub(super) fn seen(&self, Turn([a, b]): Turn) -> Self {
        Self([self.of(a, a, a), self.of(a, a, b), self.of(a, b, b), self.of(b, b, b)])
    }
}

/// Fits a symmetric form to the differences of values at a triangle's corners along its sides, by least squares.
/// Values have `FROM` numbers; the form takes one more vector and has `TO`, which is one more number. Both are in the
/// triangle's axes.
///
/// Along a side (x, y), number k of the values changes by x times the form's number k plus y times the next. The
/// normal equations therefore have three diagonals, and elimination needs no pivoting. A number's weight is its count
/// in the full form, for example two for the middle one of a tensor. The result therefore does not depend on the
/// axes.
pub(super) fn of_triangle<const FROM: usize, const TO: usize>(
    sides: &[DVec2; 3],
    values: [[f64; FROM]; 3],
) -> Option<[f64; TO]> {
    let weight = |number: usize| if FROM == 3 && number == 1 { 2.0 } else { 1.0 };
    let (mut diagonal, mut beside, mut right) = ([0.0; TO], [0.0; TO], [0.0; TO]);
    for (corner, side) in sides.iter().enumerate() {
        let (from, to) = (&values[(corner + 1) % 3], &values[(corner + 2) % 3]);
        for (number, (from, to)) in from.iter().zip(to).enumerate() {
            let (x, y) = (side.x * weight(number), side.y * weight(number));
            diagonal[number] += x * side.x;
            diagonal[number + 1] += y * side.y;
            beside[number] += x * side.y;
            right[number] += x * (to - from);
            right[number + 1] += y * (to - from);
        }
    }
    for row in 1..TO {
        let share = beside[row - 1] / diagonal[row - 1];
        diagonal[row] -= share * beside[row - 1];
        right[row] -= share * right[row - 1];
    }
    let mut form = right;
    form[TO - 1] /= diagonal[TO - 1];
    for row in (0..TO - 1).rev() {
        form[row] = (right[row] - beside[row] * form[row + 1]) / diagonal[row];
    }
    form.iter().all(|number| number.is_finite()).then_some(form)
}
