//! Families of scenes of any number of triangles that have made programs for hidden lines hang, for tests and benchmarks of the
//! growth of the exact lines' time.
//!
//! Each is positions and triangles, about as many as requested, the same on every machine. The model grows; the picture and the
//! view stay, to show the cost of more of the same.

use glam::{DMat3, DVec3};
use std::f64::consts::TAU;

/// Positions and triangles.
#[derive(Debug, Clone, Default)]
pub struct Shape {
    pub positions: Vec<DVec3>,
    pub triangles: Vec<[u32; 3]>,
}

/// A family of scenes.
#[derive(Clone, Copy)]
pub struct Family {
    /// A short name for tables and plots.
    pub name: &'static str,
    /// A description of the family.
    pub what: &'static str,
    /// One of about so many triangles.
    pub make: fn(usize) -> Shape,
    /// The view.
    pub seen: FamilyView,
}

/// From where a family is seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FamilyView {
    /// The default view.
    Aslant,
    /// Along the z axis in parallel projection, where equal parts lie on one another.
    Along,
}

const fn family(name: &'static str, what: &'static str, make: fn(usize) -> Shape, seen: FamilyView) -> Family {
    Family { name, what, make, seen }
}

/// All of them.
pub const FAMILIES: [Family; 20] = [
    family("soup", "random triangles as large as the scene", soup, FamilyView::Aslant),
    family("confetti", "random triangles of a tenth of the scene", confetti, FamilyView::Aslant),
    family("coplanar", "rectangles that overlap in four planes", coplanar, FamilyView::Aslant),
    family("book", "triangles around one edge", book, FamilyView::Aslant),
    family("pages", "the same, seen along the edge", pages, FamilyView::Along),
    family("fan", "triangles around one corner, that pass through others", fan, FamilyView::Aslant),
    family("comb", "a comb of many teeth, extruded", comb, FamilyView::Aslant),
    family("honeycomb", "hexagonal cells of thin walls", honeycomb, FamilyView::Aslant),
    family("grille", "a plate with square holes", grille, FamilyView::Aslant),
    family("waffle", "sheets that all pass through one another", waffle, FamilyView::Aslant),
    family("hair", "thin triangles as long as the scene, in all directions", hair, FamilyView::Aslant),
    family("shells", "spheres inside one another", shells, FamilyView::Aslant),
    family("building", "slabs, walls and columns, flush with one another", building, FamilyView::Aslant),
    family("assembly", "plates with bolts, nuts and washers through them", assembly, FamilyView::Aslant),
    family("rail", "a row of thin squares, seen aslant", rail, FamilyView::Aslant),
    family("row", "equal fins behind one another", row, FamilyView::Along),
    family("lattice", "square bars in three directions, flush where they cross", lattice, FamilyView::Along),
    family("spokes", "bars from one axis, through one another", spokes, FamilyView::Aslant),
    family("sticks", "long bars in a heap, through one another", sticks, FamilyView::Aslant),
    family("twins", "cubes in one place but for a thousandth", twins, FamilyView::Aslant),
];

/// Numbers that are the same everywhere (Marsaglia's xorshift).
struct Numbers(u64);

impl Numbers {
    fn new() -> Self {
        Self(0x9E37_79B9_7F4A_7C15)
    }

    /// From -1 to 1.
    fn number(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    fn point(&mut self) -> DVec3 {
        DVec3::new(self.number(), self.number(), self.number())
    }
}

impl Shape {
    fn add(&mut self, position: DVec3) -> u32 {
        self.positions.push(position);
        self.positions.len() as u32 - 1
    }

    fn triangle(&mut self, corners: [DVec3; 3]) {
        let corners = corners.map(|corner| self.add(corner));
        self.triangles.push(corners);
    }

    fn quad(&mut self, corners: [DVec3; 4]) {
        let [a, b, c, d] = corners.map(|corner| self.add(corner));
        self.triangles.extend([[a, b, c], [a, c, d]]);
    }

    /// A box, wound outwards.
    fn cuboid(&mut self, low: DVec3, high: DVec3) {
        self.turned_cuboid(low, high, |corner| corner);
    }

    /// A cuboid with moved corners.
    fn turned_cuboid(&mut self, low: DVec3, high: DVec3, moved: impl FnMut(DVec3) -> DVec3) {
        let corner = |i: u32| {
            let pick = |bit: u32, low: f64, high: f64| if i >> bit & 1 == 1 { high } else { low };
            DVec3::new(pick(0, low.x, high.x), pick(1, low.y, high.y), pick(2, low.z, high.z))
        };
        let first = self.positions.len() as u32;
        self.positions.extend((0..8).map(corner).map(moved));
        let quads = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
        for quad in quads {
            let [a, b, c, d] = quad.map(|corner: u32| corner + first);
            self.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }

    /// An upright prism of so many sides.
    fn prism(&mut self, foot: DVec3, radius: f64, height: f64, sides: u32) {
        let first = self.positions.len() as u32;
        for level in [0.0, height] {
            self.positions.extend((0..sides).map(|side| {
                let angle = TAU * f64::from(side) / f64::from(sides);
                foot + DVec3::new(radius * angle.cos(), level, radius * angle.sin())
            }));
        }
        let (foot, top) = (|side: u32| first + side % sides, |side: u32| first + sides + side % sides);
        for side in 0..sides {
            self.triangles
                .extend([[foot(side), top(side), top(side + 1)], [foot(side), top(side + 1), foot(side + 1)]]);
        }
        for side in 1..sides - 1 {
            self.triangles.extend([[foot(0), foot(side), foot(side + 1)], [top(0), top(side + 1), top(side)]]);
        }
    }
}

/// The side of a square of about so many.
fn side_of(count: usize) -> usize {
    (count as f64).sqrt().round().max(1.0) as usize
}

/// Places from -1 to 1 with so many steps.
fn place(index: usize, count: usize) -> f64 {
    -1.0 + 2.0 * index as f64 / count as f64
}

fn soup(count: usize) -> Shape {
    let (mut numbers, mut shape) = (Numbers::new(), Shape::default());
    (0..count).for_each(|_| shape.triangle([(); 3].map(|()| numbers.point())));
    shape
}

fn confetti(count: usize) -> Shape {
    let (mut numbers, mut shape) = (Numbers::new(), Shape::default());
    for _ in 0..count {
        let middle = numbers.point();
        shape.triangle([(); 3].map(|()| middle + numbers.point() * 0.1));
    }
    shape
}

fn coplanar(count: usize) -> Shape {
    let (mut numbers, mut shape) = (Numbers::new(), Shape::default());
    for number in 0..count / 2 {
        let height = [-0.6, -0.2, 0.2, 0.6][number % 4];
        let (x, z) = (numbers.number(), numbers.number());
        let (width, depth) = (0.3 + 0.2 * numbers.number(), 0.3 + 0.2 * numbers.number());
        let corner = |right: f64, back: f64| DVec3::new(x + right, height, z + back);
        shape.quad([corner(0.0, 0.0), corner(width, 0.0), corner(width, depth), corner(0.0, depth)]);
    }
    shape
}

fn book(count: usize) -> Shape {
    let mut shape = Shape { positions: vec![DVec3::NEG_Y, DVec3::Y], triangles: Vec::new() };
    for number in 0..count {
        let angle = TAU * number as f64 / count as f64;
        let leaf = shape.add(DVec3::new(angle.cos(), 0.0, angle.sin()));
        shape.triangles.push([0, 1, leaf]);
    }
    shape
}

/// A lying book, with each leaf seen edge-on.
fn pages(count: usize) -> Shape {
    let lie = |position: DVec3| DVec3::new(position.x, position.z, position.y);
    let Shape { positions, triangles } = book(count);
    Shape { positions: positions.into_iter().map(lie).collect(), triangles }
}

fn fan(count: usize) -> Shape {
    let (mut numbers, mut shape) = (Numbers::new(), Shape { positions: vec![DVec3::ZERO], triangles: Vec::new() });
    for _ in 0..count {
        let tips = [(); 2].map(|()| numbers.point());
        let [first, second] = tips.map(|tip| shape.add(tip));
        shape.triangles.push([0, first, second]);
    }
    shape
}

/// Two rows of four corners for each tooth, a strip of faces between them.
fn comb(count: usize) -> Shape {
    let teeth = (count / 16).max(1);
    let mut shape = Shape::default();
    for tooth in 0..=teeth * 2 {
        let x = place(tooth, teeth * 2);
        let top = if tooth % 2 == 0 { 0.5 } else { 0.0 };
        for (y, z) in [(-0.3, -0.2), (top, -0.2), (top, 0.2), (-0.3, 0.2)] {
            shape.add(DVec3::new(x, y, z));
        }
    }
    for step in 0..(teeth * 2) as u32 {
        for side in 0..4 {
            let (here, next) = (step * 4 + side, step * 4 + (side + 1) % 4);
            shape.triangles.extend([[here, next, next + 4], [here, next + 4, here + 4]]);
        }
    }
    shape
}

/// Walls around hexagonal cells, three to a cell; neighbours share corners.
fn honeycomb(count: usize) -> Shape {
    let side = side_of(count / 6);
    let mut shape = Shape::default();
    let (width, height) = (2.0 / (side as f64 * 3f64.sqrt()), 0.25);
    // A cell's own corner and the next: a lattice with two corners a cell.
    let corner = |column: usize, row: usize, which: usize, level: usize| {
        ((row * (side + 2) + column) * 4 + which * 2 + level) as u32
    };
    for row in 0..side + 2 {
        for column in 0..side + 2 {
            let x = (column as f64 + 0.5 * (row % 2) as f64) * 3f64.sqrt() * width - 1.0;
            let z = row as f64 * 1.5 * width - 1.0;
            for offset in [0.0, width] {
                for level in [0.0, height] {
                    shape.add(DVec3::new(x, level, z + offset));
                }
            }
        }
    }
    for row in 1..=side {
        for column in 1..=side {
            let left = if row % 2 == 0 { column - 1 } else { column };
            // The upright wall of this place, and the two that go down from its far corner to the next row's.
            let walls = [
                [corner(column, row, 0, 0), corner(column, row, 1, 0)],
                [corner(column, row, 1, 0), corner(left, row + 1, 0, 0)],
                [corner(column, row, 1, 0), corner(left + 1, row + 1, 0, 0)],
            ];
            for [from, to] in walls {
                shape.triangles.extend([[from, to, to + 1], [from, to + 1, from + 1]]);
            }
        }
    }
    shape
}

/// A plate of square cells, each with a square hole: 32 triangles a hole.
fn grille(count: usize) -> Shape {
    let side = side_of(count / 24);
    let mut shape = Shape::default();
    for row in 0..side {
        for column in 0..side {
            let (x, z) = (place(column, side), place(row, side));
            let cell = 2.0 / side as f64;
            let ring = |margin: f64, y: f64| {
                let (low, high) = (cell * margin, cell * (1.0 - margin));
                [(low, low), (high, low), (high, high), (low, high)]
                    .map(|(right, back)| DVec3::new(x + right, y, z + back))
            };
            let (outer, inner) = (ring(0.0, 0.1), ring(0.25, 0.1));
            let (below, inner_below) = (ring(0.0, 0.0), ring(0.25, 0.0));
            for corner in 0..4 {
                let next = (corner + 1) % 4;
                shape.quad([outer[corner], inner[corner], inner[next], outer[next]]);
                shape.quad([below[corner], below[next], inner_below[next], inner_below[corner]]);
                shape.quad([inner[corner], inner_below[corner], inner_below[next], inner[next]]);
            }
        }
    }
    shape
}

fn waffle(count: usize) -> Shape {
    let sheets = (count / 4).max(1);
    let mut shape = Shape::default();
    for sheet in 0..sheets {
        let at = -1.0 + 2.0 * (sheet as f64 + 0.5) / sheets as f64;
        let corners = [(-1.0, 0.0), (1.0, 0.0), (1.0, 0.2), (-1.0, 0.2)];
        shape.quad(corners.map(|(along, up)| DVec3::new(at, up, along)));
        shape.quad(corners.map(|(along, up)| DVec3::new(along, up, at)));
    }
    shape
}

fn hair(count: usize) -> Shape {
    let (mut numbers, mut shape) = (Numbers::new(), Shape::default());
    for _ in 0..count {
        let [from, to] = [(); 2].map(|()| numbers.point());
        shape.triangle([from, to, to + numbers.point() * 0.002]);
    }
    shape
}

fn shells(count: usize) -> Shape {
    const ROWS: u32 = 10;
    const COLUMNS: u32 = 16;
    let spheres = (count / (2 * (ROWS as usize - 1) * COLUMNS as usize)).max(1);
    let mut shape = Shape::default();
    for sphere in 0..spheres {
        let radius = 1.0 - 0.9 * sphere as f64 / spheres as f64;
        let first = shape.positions.len() as u32;
        shape.positions.extend([DVec3::Y * radius, DVec3::NEG_Y * radius]);
        for row in 1..ROWS {
            for column in 0..COLUMNS {
                let (polar, around) =
                    (0.5 * TAU * f64::from(row) / f64::from(ROWS), TAU * f64::from(column) / f64::from(COLUMNS));
                let direction = DVec3::new(polar.sin() * around.sin(), polar.cos(), polar.sin() * around.cos());
                shape.positions.push(direction * radius);
            }
        }
        let at = |row: u32, column: u32| match row {
            0 => first,
            ROWS => first + 1,
            row => first + 2 + (row - 1) * COLUMNS + column % COLUMNS,
        };
        for row in 0..ROWS {
            for column in 0..COLUMNS {
                let [a, b, c, d] = [at(row, column), at(row + 1, column), at(row + 1, column + 1), at(row, column + 1)];
                shape
                    .triangles
                    .extend([[a, b, c], [a, c, d]].into_iter().filter(|[a, b, c]| a != b && b != c && c != a));
            }
        }
    }
    shape
}

/// Storeys of square rooms: a slab, walls on two sides and a column for each.
fn building(count: usize) -> Shape {
    let boxes = (count / 12).max(1);
    let side = ((boxes as f64 / 4.0).cbrt().round() as usize).max(1);
    let room = 2.0 / side as f64;
    let mut shape = Shape::default();
    'all: for storey in 0.. {
        for row in 0..side {
            for column in 0..side {
                let low = DVec3::new(place(column, side), -1.0 + storey as f64 * room, place(row, side));
                let parts = [
                    (DVec3::ZERO, DVec3::new(1.0, 0.1, 1.0)),
                    (DVec3::new(0.0, 0.1, 0.0), DVec3::new(1.0, 1.0, 0.1)),
                    (DVec3::new(0.0, 0.1, 0.1), DVec3::new(0.1, 1.0, 1.0)),
                    (DVec3::new(0.8, 0.1, 0.8), DVec3::new(0.9, 1.0, 0.9)),
                ];
                for (from, to) in parts {
                    if shape.triangles.len() >= boxes * 12 {
                        break 'all;
                    }
                    shape.cuboid(low + from * room, low + to * room);
                }
            }
        }
    }
    shape
}

/// Bolts of round shafts and hexagonal heads and nuts, each through a separate plate.
fn assembly(count: usize) -> Shape {
    const SIDES: u32 = 24;
    // A plate, a shaft, a washer, a head and a nut.
    let side = side_of(count / (12 + 2 * (4 * SIDES as usize - 4) + 2 * 20));
    let cell = 2.0 / side as f64;
    let mut shape = Shape::default();
    for row in 0..side {
        for column in 0..side {
            let low = DVec3::new(place(column, side), 0.0, place(row, side));
            let middle = low + DVec3::new(0.5, 0.0, 0.5) * cell;
            let up = |share: f64| middle + DVec3::Y * (share * cell);
            shape.cuboid(low, low + DVec3::new(0.95, 0.2, 0.95) * cell);
            shape.prism(up(-0.3), 0.12 * cell, 0.7 * cell, SIDES);
            shape.prism(up(0.2), 0.3 * cell, 0.05 * cell, SIDES);
            shape.prism(up(0.25), 0.22 * cell, 0.15 * cell, 6);
            shape.prism(up(-0.2), 0.22 * cell, 0.15 * cell, 6);
        }
    }
    shape
}

fn rail(count: usize) -> Shape {
    let squares = (count / 2).max(1);
    let mut shape = Shape::default();
    for square in 0..squares {
        let x = place(square, squares);
        shape.quad([(-0.1, -0.1), (0.1, -0.1), (0.1, 0.1), (-0.1, 0.1)].map(|(y, z)| DVec3::new(x, y, z)));
    }
    shape
}

fn row(count: usize) -> Shape {
    let fins = (count / 12).max(1);
    let mut shape = Shape::default();
    for fin in 0..fins {
        let depth = 1.0 / fins as f64;
        let z = place(fin, fins);
        shape.cuboid(DVec3::new(-1.0, -0.5, z), DVec3::new(1.0, 0.5, z + depth));
    }
    shape
}

fn lattice(count: usize) -> Shape {
    let side = side_of(count / 36);
    let width = 0.6 / side as f64;
    let mut shape = Shape::default();
    for first in 0..side {
        for second in 0..side {
            let (u, v) = (place(first, side), place(second, side));
            for axis in 0..3 {
                let turned = |along: f64, u: f64, v: f64| match axis {
                    0 => DVec3::new(along, u, v),
                    1 => DVec3::new(u, along, v),
                    _ => DVec3::new(u, v, along),
                };
                shape.cuboid(turned(-1.0, u, v), turned(1.0, u + width, v + width));
            }
        }
    }
    shape
}

fn spokes(count: usize) -> Shape {
    let bars = (count / 12).max(1);
    let mut shape = Shape::default();
    for bar in 0..bars {
        let (sin, cos) = (TAU * bar as f64 / bars as f64).sin_cos();
        let turned =
            |corner: DVec3| DVec3::new(cos * corner.x + sin * corner.z, corner.y, cos * corner.z - sin * corner.x);
        shape.turned_cuboid(DVec3::new(0.0, -0.01, -0.01), DVec3::new(1.0, 0.01, 0.01), turned);
    }
    shape
}

fn sticks(count: usize) -> Shape {
    let (mut numbers, mut shape) = (Numbers::new(), Shape::default());
    for _ in 0..(count / 12).max(1) {
        let along = (numbers.point() * DVec3::new(1.0, 0.2, 1.0)).normalize_or(DVec3::X);
        let aside = along.any_orthonormal_vector();
        let frame = DMat3::from_cols(along, aside, along.cross(aside));
        let middle = numbers.point() * DVec3::new(0.3, 0.1, 0.3);
        let half = DVec3::new(1.0, 0.01, 0.01);
        shape.turned_cuboid(-half, half, |corner| middle + frame * corner);
    }
    shape
}

fn twins(count: usize) -> Shape {
    let (mut numbers, mut shape) = (Numbers::new(), Shape::default());
    for _ in 0..(count / 12).max(1) {
        shape.turned_cuboid(DVec3::NEG_ONE, DVec3::ONE, |corner| corner + numbers.point() * 0.001);
    }
    shape
}
