//! Closed curves on a surface.

use glam::DVec3;

/// A closed curve on the surface, with a parameter from 0 to 1.
pub(super) type Curve = Box<dyn Fn(f64) -> DVec3>;

/// Halvings of a step: beyond them f64 has no places left.
pub(super) const HALVINGS: usize = 48;
