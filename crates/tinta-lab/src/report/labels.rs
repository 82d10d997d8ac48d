//! Places for labels beside their points, with no label over another one or a mark. Greedy: first come, first placed.

/// Pixels from the left and the top.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rectangle {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) right: f64,
    pub(super) bottom: f64,
}

impl Rectangle {
    pub(super) fn around(middle: (f64, f64), radius: f64) -> Self {
        let (x, y) = middle;
        Self { left: x - radius, top: y - radius, right: x + radius, bottom: y + radius }
    }

    pub(super) fn overlaps(&self, other: &Self) -> bool {
        self.left < other.right && other.left < self.right && self.top < other.bottom && other.top < self.bottom
    }

    fn holds(&self, other: &Self) -> bool {
        self.left <= other.left && self.top <= other.top && self.right >= other.right && self.bottom >= other.bottom
    }

    /// The point of it that is nearest.
    pub(super) fn nearest(&self, (x, y): (f64, f64)) -> (f64, f64) {
        (x.clamp(self.left, self.right), y.clamp(self.top, self.bottom))
    }
}

/// Distances tried between a point and its label, pixels; beyond the first a line leads to it.
const DISTANCES: [f64; 6] = [9.0, 18.0, 30.0, 45.0, 62.0, 84.0];

/// The best free place for a label: near, over few of the lines; `None` where all places are taken.
pub(super) fn place(
    point: (f64, f64),
    size: (f64, f64),
    bounds: &Rectangle,
    taken: &[Rectangle],
    lines: &[Rectangle],
) -> Option<Rectangle> {
    let (width, height) = size;
    let mut best: Option<(f64, Rectangle)> = None;
    for (step, distance) in DISTANCES.into_iter().enumerate() {
        // Right above first: a front falls from left to right, and that side is emptier.
        for (turn, (x, y)) in
            [(1.0, -1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 1.0), (-1.0, 0.0), (0.0, 1.0), (1.0, 1.0), (-1.0, -1.0)]
                .into_iter()
                .enumerate()
        {
            // Diagonals lie as far away as the others.
            let reach = if x != 0.0 && y != 0.0 { distance * 0.75 } else { distance };
            let left = point.0 + x * reach + (x - 1.0) / 2.0 * width;
            let top = point.1 + y * reach + (y - 1.0) / 2.0 * height;
            let place = Rectangle { left, top, right: left + width, bottom: top + height };
            if !bounds.holds(&place) || taken.iter().any(|other| other.overlaps(&place)) {
                continue;
            }
            let crossed = lines.iter().filter(|line| line.overlaps(&place)).count();
            let cost = step as f64 * 2.0 + turn as f64 * 0.1 + crossed as f64 * 3.0;
            if best.is_none_or(|(lowest, _)| cost < lowest) {
                best = Some((cost, place));
            }
        }
    }
    best.map(|(_, place)| place)
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOUNDS: Rectangle = Rectangle { left: 0.0, top: 0.0, right: 400.0, bottom: 300.0 };

    #[test]
    fn labels_of_crowded_points_do_not_cover_one_another() {
        let points: Vec<(f64, f64)> = (0..8).map(|step| (150.0 + 9.0 * f64::from(step), 120.0)).collect();
        let marks: Vec<Rectangle> = points.iter().map(|point| Rectangle::around(*point, 4.0)).collect();
        let mut taken = marks.clone();
        for point in &points {
            let label = place(*point, (80.0, 14.0), &BOUNDS, &taken, &[]).unwrap();
            assert!(BOUNDS.holds(&label) && !taken.iter().any(|other| other.overlaps(&label)));
            taken.push(label);
        }
    }

    #[test]
    fn a_label_without_room_has_no_place() {
        assert_eq!(place((200.0, 150.0), (500.0, 14.0), &BOUNDS, &[], &[]), None);
        assert_eq!(place((200.0, 150.0), (80.0, 14.0), &BOUNDS, &[BOUNDS], &[]), None);
    }
}
