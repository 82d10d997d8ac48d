//! The faces of a view: which may be seen, where their images end, and which one a ray hits first.

use super::crossings::crossings;
use super::grid::Grid;
use super::region::SeenFace;
use super::snap::Segment;
use crate::error::Result;
use crate::lines::eye::cast::{Hit, first_hit, nearest_hits};
use crate::lines::eye::faces::Faces;
use crate::lines::eye::image::Image;
use crate::lines::eye::pyramid::{Pyramid, is_crowded};
use crate::lines::eye::space::{Space, at_depth};
use crate::lines::progress::{Phase, Progress};
use crate::scene::Scene;
use crate::threads::{cores, in_chunks, sort_by};
use glam::{DVec2, DVec3};

/// How far a line is drawn beyond a border, grid steps: at angles above a hundredth of a degree it then crosses the border.
const BEYOND: f64 = 8192.0;

/// The faces of a scene in the eye's space.
pub(super) struct View<'a> {
    pub scene: &'a Scene,
    pub space: Space,
    pub faces: Faces,
    pub grid: Grid,
    /// Places of the faces that may be seen.
    pub seen: Vec<u32>,
    /// The sides of these faces, sorted: an edge's positions, the lower number first, and the place of a face at it.
    pub sides: Vec<([u32; 2], u32)>,
    /// The lines in which faces pass through one another.
    crossings: Vec<[DVec3; 2]>,
}

impl<'a> View<'a> {
    /// Finds the faces that may be seen, and where they intersect.
    ///
    /// # Errors
    ///
    /// Those of [`Progress::go_on`].
    pub(super) fn of(scene: &'a Scene, progress: &Progress) -> Result<Self> {
        progress.begin(Phase::Areas, 0);
        let space = Space::of(scene);
        let faces = Faces::of(&space, scene);
        progress.go_on()?;
        let pyramid = is_crowded(&space, &faces).then(|| Pyramid::new(&space, &faces)).flatten();
        let all = || vec![true; faces.triangles.len()];
        let is_seen = pyramid.as_ref().map_or_else(all, |pyramid| pyramid.seen(&space, &faces));
        let crossings = crossings(&space, &faces, &is_seen, progress);
        progress.go_on()?;
        let seen: Vec<u32> = (0..faces.triangles.len() as u32).filter(|place| is_seen[*place as usize]).collect();
        let mut sides: Vec<([u32; 2], u32)> = Vec::with_capacity(3 * seen.len());
        for place in &seen {
            let [a, b, c] = faces.triangles[*place as usize];
            sides.extend([[a, b], [b, c], [c, a]].map(|[a, b]| ([a.min(b), a.max(b)], *place)));
        }
        sort_by(&mut sides, cores(), |a, b| a.cmp(b));
        let grid = Grid::over(space.size);
        let mut view = Self { scene, space, faces, grid, seen, sides, crossings };
        view.leave_out_hidden_sheets();
        progress.go_on()?;
        Ok(view)
    }

    /// The image of a line of the eye's space, between the near and the far plane.
    fn image(&self, line: [DVec3; 2]) -> Option<[DVec2; 2]> {
        Image::of(&self.space, line).map(|image| [image.a, image.b])
    }

    /// The part of an image inside the picture.
    fn side(&self, line: [DVec3; 2]) -> Option<Segment> {
        self.grid.segment(self.image(line)?)
    }

    /// The image of a line that ends on borders, and a little more beyond both ends: so it reaches them wherever rounding moves
    /// either.
    pub(super) fn across(&self, line: [DVec3; 2]) -> impl Iterator<Item = Segment> {
        let parts = self.image(line).map(|[from, to]| {
            let beyond = self.grid.px((to - from).normalize_or_zero() * BEYOND);
            [[from, to], [from - beyond, from], [to, to + beyond]].map(|part| self.grid.segment(part))
        });
        parts.into_iter().flatten().flatten()
    }

    /// The lines where planes cut faces that may be seen.
    pub(super) fn plane_cuts(&self) -> impl Iterator<Item = [DVec3; 2]> + '_ {
        let of_face = |place: &u32| {
            let corners = self.faces.corners(*place);
            [self.space.near, self.space.far].map(|plane| {
                let sides = [0, 1, 2].map(|side| [corners[side], corners[(side + 1) % 3]]);
                let mut crossings = sides.into_iter().filter_map(|side| at_depth(side, plane));
                Some([crossings.next()?, crossings.next()?])
            })
        };
        self.seen.iter().flat_map(of_face).flatten()
    }

    /// The images of all places where one face may give way to another: sides of faces that may be seen and that `is_border`
    /// wants, faces passing through one another, cuts by planes, the picture's frame.
    pub(super) fn borders(&self, is_border: impl Fn(&Sides) -> bool + Sync) -> Vec<Segment> {
        let mut segments = Vec::new();
        for of_edge in self.sides.chunk_by(|a, b| a.0 == b.0) {
            let edge = of_edge[0].0;
            if is_border(&Sides { edge, of_edge }) {
                segments.extend(self.side(edge.map(|position| self.faces.positions[position as usize])));
            }
        }
        let more = self.crossings.iter().copied().chain(self.plane_cuts());
        segments.extend(more.flat_map(|line| self.across(line)));
        segments.extend(self.grid.frame());
        segments
    }

    /// Whether a surface goes on across an edge: from one of its two faces to the other, on the other side in the picture.
    pub(super) fn goes_on(&self, Sides { edge, of_edge }: &Sides) -> bool {
        let [(_, first), (_, second)] = **of_edge else { return false };
        let [from, to] = edge.map(|position| self.faces.positions[position as usize]);
        let side = |place: u32| {
            let third = self.faces.triangles[place as usize].into_iter().find(|corner| !edge.contains(corner));
            third.map_or(0.0, |third| self.space.turn(from, to, self.faces.positions[third as usize]).0)
        };
        let [first, second] = [side(first), side(second)];
        first > 0.0 && second < 0.0 || first < 0.0 && second > 0.0
    }

    /// The first face that the ray through a place of the picture hits.
    pub(super) fn first_hit(&self, px: DVec2) -> Option<Hit> {
        first_hit(&self.space, &self.faces, px)
    }

    /// Whether a face is the first that the ray through a place of the picture hits, or touches the first there.
    pub(super) fn is_seen(&self, place: u32, px: DVec2) -> bool {
        nearest_hits(&self.space, &self.faces, px).iter().any(|hit| hit.place == place)
    }

    /// The object and the face in it at a place of the hierarchy.
    pub(super) fn face(&self, place: u32) -> SeenFace {
        let (object, face) = self.faces.in_object(self.faces.numbers[place as usize]);
        SeenFace { object: object as u32, face }
    }

    /// The labels of all cells, by several threads.
    ///
    /// # Errors
    ///
    /// Those of [`Progress::go_on`].
    pub(super) fn labels<T: Send + Sync + Copy>(
        &self,
        count: usize,
        label: impl Fn(u32) -> T + Sync,
        progress: &Progress,
    ) -> Result<Vec<T>> {
        const CHUNK: usize = 256;
        let labels = in_chunks(count, CHUNK, cores(), |range| {
            let rest = range.take_while(|_| !progress.is_over());
            rest.map(|cell| label(cell as u32)).collect::<Vec<T>>()
        });
        progress.go_on()?;
        Ok(labels.concat())
    }
}

/// An edge with those of its faces that may be seen.
pub(super) struct Sides<'a> {
    /// Positions, the lower number first.
    pub edge: [u32; 2],
    /// Places of faces.
    pub of_edge: &'a [([u32; 2], u32)],
}
