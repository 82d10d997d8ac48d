//! The line or point that two faces have in common.
//!
//! Two faces pass through one another if each reaches across the other's plane and their parts of the line common to both planes
//! overlap. A corner nearer to a plane than the contact distance lies in it. A face with an edge in the other's plane is told as
//! touching there.

use crate::lines::eye::faces::Faces;
use crate::lines::eye::space::Space;
use crate::lines::eye::touch::lies_in;
use crate::tolerances::CONTACT;
use glam::DVec3;

/// A point where an edge passes through a face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::lines) struct Piercing {
    /// The edge's positions, the lower number first.
    pub edge: [u32; 2],
    /// In the eye's space.
    pub point: DVec3,
}

/// The common part of two faces.
#[derive(Debug, Clone, Copy)]
pub(in crate::lines) struct FaceCrossing {
    /// The one with the lower number first.
    pub faces: [u32; 2],
    pub ends: [DVec3; 2],
    /// Whether it is long enough, and between faces high enough, to be a line: needles are cut but draw none.
    pub is_line: bool,
    pub piercings: [Option<Piercing>; 4],
    /// Each face's edge that lies in the other's plane, if any.
    pub touching: [Option<[u32; 2]>; 2],
}

/// A face with its plane.
pub(in crate::lines) struct FacePlane {
    pub place: u32,
    numbers: [u32; 3],
    pub corners: [DVec3; 3],
    /// Not normalised.
    pub normal: DVec3,
    pub normal_length: f64,
    /// The longest side.
    pub longest: f64,
    pub weld: f64,
    /// The largest contact distance with any other face, times the normal's length.
    loose: f64,
}

/// Two faces that each reach across the other's plane or have an edge in it.
struct Pair<'a> {
    faces: &'a Faces,
    places: [u32; 2],
    /// Each face's corners' distances from the other's plane times the length of its normal, 0 where they touch it.
    distances: [[f64; 3]; 2],
    /// Along both planes.
    direction: DVec3,
    /// The place in each face of the one corner they share.
    shared: Option<[usize; 2]>,
    /// The length of the shortest line.
    shortest: f64,
    /// Each face's edge that lies in the other's plane.
    touching: [Option<[u32; 2]>; 2],
}

/// A point where a side of one face passes the other's plane.
#[derive(Clone, Copy)]
struct Crossing {
    /// Along the common line.
    along: f64,
    piercing: Piercing,
}

impl FacePlane {
    pub(in crate::lines) fn new(space: &Space, faces: &Faces, place: u32) -> Self {
        let face_plane = Self::exact(faces, place);
        let loose = space.contact(face_plane.longest, face_plane.weld) * face_plane.normal_length;
        Self { loose, ..face_plane }
    }

    /// The plane of a face, touched by points in it alone.
    pub(in crate::lines) fn exact(faces: &Faces, place: u32) -> Self {
        let numbers = faces.triangles[place as usize];
        let corners = faces.corners(place);
        let [a, b, c] = corners;
        let normal = (b - a).cross(c - a);
        let (normal_length, weld) = (normal.length(), faces.weld(numbers[0]));
        let longest = longest_side(corners);
        Self { place, numbers, corners, normal, normal_length, longest, weld, loose: 0.0 }
    }

    /// Returns the common part of this face and another, if each has corners on both sides of the other's plane.
    pub(in crate::lines) fn meet(&self, space: &Space, faces: &Faces, other: u32) -> Option<FaceCrossing> {
        let numbers = faces.triangles[other as usize];
        let mut shared = None;
        let mut shared_count = 0;
        for (i, corner) in self.numbers.iter().enumerate() {
            if let Some(j) = numbers.iter().position(|other| other == corner) {
                shared = Some([i, j]);
                shared_count += 1;
            }
        }
        // Neighbours along an edge have only the edge in common, unless they lie on one another.
        if shared_count > 1 {
            return None;
        }
        let own = shared.map(|[_, j]| j);
        let corners = faces.corners(other);
        let raw = self.raw_distances(corners);
        let all = |holds: &dyn Fn(f64) -> bool| (0..3).all(|index| own == Some(index) || holds(raw[index]));
        if all(&|distance| distance > self.loose) || all(&|distance| distance < -self.loose) {
            return None;
        }
        let contact = space.contact(self.longest.min(longest_side(corners)), self.weld.min(faces.weld(numbers[0])));
        // A face no higher than the contact distance is a line and has no plane, but may still pass through a face.
        let is_needle = |face_plane: &Self| face_plane.normal_length <= contact * face_plane.longest;
        // One that lies in this face's plane, needle or not, has no line in common with it.
        if !is_needle(self) && raw.iter().all(|distance| distance.abs() <= contact * self.normal_length) {
            return None;
        }
        let other = Self::new(space, faces, other);
        match (is_needle(self), is_needle(&other)) {
            (true, true) => return None,
            (true, false) => return self.needle_through(faces, &other, contact),
            (false, true) => return other.needle_through(faces, self, contact),
            (false, false) => {}
        }
        let second = Sides::of(raw, own, contact * self.normal_length)?;
        let raw = other.raw_distances(self.corners);
        let first = Sides::of(raw, shared.map(|[i, _]| i), contact * other.normal_length)?;
        // Where each only touches the other's plane, they have a line in common if both edges lie on one another.
        if let (Some(edge), Some(other_edge)) = (first.edge, second.edge)
            && !lie_on_one_line(edge.map(|i| self.corners[i]), other_edge.map(|i| other.corners[i]), contact)
        {
            return None;
        }
        let (face_planes, sides) = match faces.in_order(self.place, other.place) {
            true => ([self, &other], [first, second]),
            false => ([&other, self], [second, first]),
        };
        let touching = [0, 1].map(|face| {
            let [a, b] = sides[face].edge?.map(|corner| face_planes[face].numbers[corner]);
            Some([a.min(b), a.max(b)])
        });
        Pair {
            faces,
            places: face_planes.map(|face_plane| face_plane.place),
            distances: sides.map(|sides| sides.distances),
            direction: face_planes[0].normal.cross(face_planes[1].normal),
            shared: if face_planes[0].place == self.place { shared } else { shared.map(|[i, j]| [j, i]) },
            shortest: contact,
            touching,
        }
        .common()
    }

    /// Returns the points where the sides of this face, too thin to have a plane, pass through another.
    fn needle_through(&self, faces: &Faces, other: &Self, contact: f64) -> Option<FaceCrossing> {
        let distances = Sides::of(other.raw_distances(self.corners), None, contact * other.normal_length)?.distances;
        let (places, kept) = match faces.in_order(self.place, other.place) {
            true => ([self.place, other.place], [distances, [0.0; 3]]),
            false => ([other.place, self.place], [[0.0; 3], distances]),
        };
        let face = usize::from(places[1] == self.place);
        let pair = Pair {
            faces,
            places,
            distances: kept,
            direction: DVec3::ZERO,
            shared: None,
            shortest: contact,
            touching: [None; 2],
        };
        let mut piercings = (0..3)
            .filter_map(|corner| pair.crossing(face, corner, (corner + 1) % 3))
            .map(|crossing| crossing.piercing)
            .filter(|piercing| other.contains(piercing.point));
        let piercings = [piercings.next(), piercings.next(), None, None];
        let point = piercings[0]?.point;
        Some(FaceCrossing { faces: places, ends: [point; 2], is_line: false, piercings, touching: [None; 2] })
    }

    /// Whether a point of another face touches the plane.
    pub(in crate::lines) fn touches(&self, space: &Space, other: &Self, point: DVec3) -> bool {
        self.normal.dot(point - self.corners[0]).abs() <= self.contact(space, other) * self.normal_length
    }

    /// Whether a point of the plane lies in the face, or so near its rim that the error is at most a needless cut.
    fn contains(&self, point: DVec3) -> bool {
        lies_in(self.corners, self.normal, point, CONTACT)
    }

    /// The distance below which this face and another touch, file units.
    pub(in crate::lines) fn contact(&self, space: &Space, other: &Self) -> f64 {
        space.contact(self.longest.min(other.longest), self.weld.min(other.weld))
    }

    /// Points' distances from the plane, times the normal's length.
    fn raw_distances(&self, [a, b, c]: [DVec3; 3]) -> [f64; 3] {
        let distance = |point: DVec3| self.normal.dot(point - self.corners[0]);
        [distance(a), distance(b), distance(c)]
    }
}

/// The position of a face relative to a plane that it reaches.
struct Sides {
    /// 0 for corners that touch the plane. Negative where all others lie on one side.
    distances: [f64; 3],
    /// The two corners that touch it, where the third lies clearly on one side: the face ends or bends there.
    edge: Option<[usize; 2]>,
}

impl Sides {
    /// Returns the position of a face with corners on both sides of a plane, or with an edge in it. A corner that two faces share
    /// lies in both planes.
    fn of(mut distances: [f64; 3], shared: Option<usize>, touching: f64) -> Option<Self> {
        let (mut below, mut above) = (false, false);
        for (index, distance) in distances.iter_mut().enumerate() {
            if shared == Some(index) || distance.abs() <= touching {
                *distance = 0.0;
            }
            below |= *distance < 0.0;
            above |= *distance > 0.0;
        }
        if below && above {
            return Some(Self { distances, edge: None });
        }
        let third = distances.iter().position(|distance| *distance != 0.0)?;
        let edge = [(third + 1) % 3, (third + 2) % 3];
        let touches = edge.iter().all(|corner| distances[*corner] == 0.0);
        touches.then(|| Self { distances: distances.map(|distance| -distance.abs()), edge: Some(edge) })
    }
}

/// The length of a face's longest side.
fn longest_side([a, b, c]: [DVec3; 3]) -> f64 {
    (b - a).length_squared().max((c - a).length_squared()).max((c - b).length_squared()).sqrt()
}

/// Whether the ends of an edge are nearer to the line through another than a distance.
fn lie_on_one_line([a, b]: [DVec3; 2], other: [DVec3; 2], distance: f64) -> bool {
    let along = (b - a).normalize_or_zero();
    other.iter().all(|end| along.cross(*end - a).length() <= distance)
}

impl Pair<'_> {
    /// Returns the line that both have in common, if their parts of it overlap.
    fn common(&self) -> Option<FaceCrossing> {
        let same_place = self.shortest * self.direction.length();
        // Where an edge passes through an edge, both are cut.
        let at_end = |nearer: Crossing, farther: Crossing| {
            let is_in_both = (nearer.along - farther.along).abs() <= same_place;
            [Some(nearer.piercing), is_in_both.then_some(farther.piercing)]
        };
        let mut overlap = true;
        let (ends, piercings) = match self.shared {
            None => {
                let [first, second] = [self.both_crossings(0)?, self.both_crossings(1)?];
                let low = if first.0.along >= second.0.along { [first.0, second.0] } else { [second.0, first.0] };
                let high = if first.1.along <= second.1.along { [first.1, second.1] } else { [second.1, first.1] };
                // Rounding must not lose such a cut.
                if low[0].along - high[0].along > same_place {
                    return None;
                }
                overlap = low[0].along < high[0].along;
                let [a, b] = at_end(low[0], low[1]);
                let [c, d] = at_end(high[0], high[1]);
                ([low[0].piercing.point, high[0].piercing.point], [a, b, c, d])
            }
            Some([i, j]) => {
                let start = self.faces.corners(self.places[0])[i];
                let from_start = start.dot(self.direction);
                let first = self.crossing(0, (i + 1) % 3, (i + 2) % 3)?;
                let second = self.crossing(1, (j + 1) % 3, (j + 2) % 3)?;
                let (first_way, second_way) = (first.along - from_start, second.along - from_start);
                if (first_way > 0.0) != (second_way > 0.0) {
                    return None;
                }
                let nearer = if first_way.abs() <= second_way.abs() { [first, second] } else { [second, first] };
                // The shared corner is no piercing: both edges there end anyway.
                let [a, b] = at_end(nearer[0], nearer[1]);
                ([start, nearer[0].piercing.point], [a, b, None, None])
            }
        };
        let is_line = overlap && ends[0].distance(ends[1]) > self.shortest;
        Some(FaceCrossing { faces: self.places, ends, is_line, piercings, touching: self.touching })
    }

    /// Returns the points where a face's rim passes the other's plane, the lower place along the common line first.
    fn both_crossings(&self, face: usize) -> Option<(Crossing, Crossing)> {
        let mut crossings = (0..3).filter_map(|corner| self.crossing(face, corner, (corner + 1) % 3));
        let (first, second) = (crossings.next()?, crossings.next()?);
        Some(if first.along <= second.along { (first, second) } else { (second, first) })
    }

    /// Returns the point where the side between two corners of a face passes the other's plane, if it does.
    fn crossing(&self, face: usize, from: usize, to: usize) -> Option<Crossing> {
        let numbers = self.faces.triangles[self.places[face] as usize];
        // Two faces that share the side both get the same point, bit for bit.
        let (from, to) = if numbers[from] < numbers[to] { (from, to) } else { (to, from) };
        let (start, end) = (self.distances[face][from], self.distances[face][to]);
        if (start < 0.0) == (end < 0.0) {
            return None;
        }
        let positions = [numbers[from], numbers[to]].map(|number| self.faces.positions[number as usize]);
        let point = positions[0] + (positions[1] - positions[0]) * (start / (start - end));
        let piercing = Piercing { edge: [numbers[from], numbers[to]], point };
        Some(Crossing { along: point.dot(self.direction), piercing })
    }
}
