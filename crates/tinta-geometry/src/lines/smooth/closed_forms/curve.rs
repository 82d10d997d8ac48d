//! Closed curves on a surface.

use glam::DVec3;

/// A closed curve on the surface, with a parameter from 0 to 1.
pub(super) type Curve = Box<dyn Fn(f64) -> DVec3>;

/// Bisections of a step; more exceed the precision of f64.
pub(super) const HALVINGS: usize = 48;
