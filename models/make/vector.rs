//! Three-component vectors and the few scalar functions the generator needs.
//!
//! Everything here uses only operations that IEEE 754 rounds the same way
//! everywhere (sum, product, quotient, square root), so that the models come
//! out byte for byte the same on any machine. That is why sine and cosine are
//! written out as polynomials instead of being taken from the C library.

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

/// A point or a direction; right-handed, y up, the models face +z.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vec3 {
    pub x: f64,
    pub y: f64,
    pub z: f64,
}

/// Short constructor, because the sculpting tables hold hundreds of points.
pub const fn v(x: f64, y: f64, z: f64) -> Vec3 {
    Vec3 { x, y, z }
}

impl Vec3 {
    pub const ZERO: Vec3 = v(0.0, 0.0, 0.0);

    pub fn dot(self, other: Vec3) -> f64 {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    pub fn cross(self, other: Vec3) -> Vec3 {
        v(self.y * other.z - self.z * other.y, self.z * other.x - self.x * other.z, self.x * other.y - self.y * other.x)
    }

    pub fn length(self) -> f64 {
        self.dot(self).sqrt()
    }

    /// The unit vector of the same direction; +y for a vector without one.
    pub fn normalized(self) -> Vec3 {
        let length = self.length();
        if length > 1e-300 { self / length } else { v(0.0, 1.0, 0.0) }
    }

    /// The part of `self` at right angles to the unit vector `axis`.
    pub fn without(self, axis: Vec3) -> Vec3 {
        self - axis * self.dot(axis)
    }

    pub fn lerp(self, other: Vec3, amount: f64) -> Vec3 {
        self + (other - self) * amount
    }

    pub fn max(self, other: Vec3) -> Vec3 {
        v(self.x.max(other.x), self.y.max(other.y), self.z.max(other.z))
    }
}

impl Add for Vec3 {
    type Output = Vec3;
    fn add(self, o: Vec3) -> Vec3 {
        v(self.x + o.x, self.y + o.y, self.z + o.z)
    }
}

impl AddAssign for Vec3 {
    fn add_assign(&mut self, o: Vec3) {
        *self = *self + o;
    }
}

impl Sub for Vec3 {
    type Output = Vec3;
    fn sub(self, o: Vec3) -> Vec3 {
        v(self.x - o.x, self.y - o.y, self.z - o.z)
    }
}

impl Mul<f64> for Vec3 {
    type Output = Vec3;
    fn mul(self, s: f64) -> Vec3 {
        v(self.x * s, self.y * s, self.z * s)
    }
}

impl Div<f64> for Vec3 {
    type Output = Vec3;
    fn div(self, s: f64) -> Vec3 {
        v(self.x / s, self.y / s, self.z / s)
    }
}

impl Neg for Vec3 {
    type Output = Vec3;
    fn neg(self) -> Vec3 {
        v(-self.x, -self.y, -self.z)
    }
}

/// Sine and cosine of an angle in radians, by Taylor series on [-pi, pi].
pub fn sin_cos(angle: f64) -> (f64, f64) {
    let turn = 2.0 * std::f64::consts::PI;
    let x = angle - (angle / turn).round() * turn;
    let square = x * x;
    let (mut sine, mut cosine) = (0.0, 0.0);
    // Horner's scheme from the smallest term down; 14 terms leave an error
    // below 1e-14 at the ends of the interval.
    for k in (0..14).rev() {
        let n = 2.0 * f64::from(k);
        cosine = 1.0 - square / ((n + 1.0) * (n + 2.0)) * cosine;
        sine = 1.0 - square / ((n + 2.0) * (n + 3.0)) * sine;
    }
    (sine * x, cosine)
}

/// Hermite step: 0 below `low`, 1 above `high`, smooth between.
pub fn smoothstep(low: f64, high: f64, x: f64) -> f64 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// A small seeded generator (xorshift64*), for the irregular locks of hair.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Random {
        Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    /// A number in [low, high).
    pub fn range(&mut self, low: f64, high: f64) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let bits = self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11;
        low + (high - low) * (bits as f64 / (1u64 << 53) as f64)
    }
}
