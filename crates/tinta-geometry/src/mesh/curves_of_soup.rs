//! Curves and points of a file or of a program, put into a mesh.

use super::curves::Curves;
use super::soup::Soup;
use super::{LoadOptions, Mesh, NONE, options};
use crate::error::{Error, Result};
use crate::limits::LABEL_CHARACTERS;
use glam::DVec3;

impl Curves {
    /// Takes a soup's segments and points whose ends are finite and apart, over the positions that they use.
    pub(super) fn of(soup: &Soup, finite: &[bool]) -> Self {
        let mut curves = Self::default();
        if soup.segments.is_empty() && soup.points.is_empty() {
            return curves;
        }
        let mut number = vec![NONE; soup.positions.len()];
        let mut use_position = |vertex: u32, curves: &mut Self| {
            let slot = &mut number[vertex as usize];
            if *slot == NONE {
                *slot = curves.positions.len() as u32;
                curves.positions.push(soup.positions[vertex as usize]);
                curves.file_vertices.push(vertex);
            }
            *slot
        };
        for segment in &soup.segments {
            let [a, b] = segment.map(|vertex| soup.positions[vertex as usize]);
            if segment.iter().all(|vertex| finite[*vertex as usize]) && a != b {
                let ends = segment.map(|vertex| use_position(vertex, &mut curves));
                curves.segments.push(ends);
            }
        }
        for vertex in soup.points.iter().filter(|vertex| finite[**vertex as usize]) {
            let point = use_position(*vertex, &mut curves);
            curves.points.push(point);
        }
        curves
    }
}

impl Mesh {
    /// Builds a model without faces from a program's curves and points: each curve is a list of positions in order, world space,
    /// any unit. `labels` are the points' texts in their order, empty for a point without one; or there are none.
    ///
    /// ```
    /// # fn main() -> tinta_geometry::Result<()> {
    /// use glam::DVec3;
    /// use tinta_geometry::{LoadOptions, Mesh};
    ///
    /// let arc = vec![DVec3::X, DVec3::Y, -DVec3::X];
    /// let model = Mesh::of_curves("an arc", &[arc], &[DVec3::ZERO], &["centre"], &LoadOptions::default())?;
    /// assert_eq!((model.curves.segments.len(), model.curves.points.len()), (2, 1));
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::File`] for a curve of fewer than two positions, for coordinates that are not finite, for labels that are too many,
    /// too few or longer than [`LABEL_CHARACTERS`], and as in [`Mesh::of_triangles`].
    pub fn of_curves(
        name: &str,
        curves: &[Vec<DVec3>],
        points: &[DVec3],
        labels: &[&str],
        options: &LoadOptions,
    ) -> Result<Self> {
        options::check(options)?;
        if !labels.is_empty() && labels.len() != points.len() {
            let problem = format!("there are {} labels for {} points; give each point one", labels.len(), points.len());
            return Err(Error::model(name, problem));
        }
        if let Some(number) = labels.iter().position(|text| text.chars().nth(LABEL_CHARACTERS).is_some()) {
            let problem = format!("label {number} has more than {LABEL_CHARACTERS} letters; shorten it");
            return Err(Error::model(name, problem));
        }
        let mut soup = Soup::default();
        for (number, curve) in curves.iter().enumerate() {
            let refused = |problem: &str| Err(Error::model(name, format!("curve {number} {problem}")));
            if curve.len() < 2 {
                return refused("has fewer than two positions; give it two or more, or give a point");
            }
            if curve.iter().any(|position| !position.is_finite()) {
                return refused("has a coordinate that is not a finite number; leave that position out");
            }
            let first = soup.positions.len() as u32;
            soup.segments.extend((1..curve.len() as u32).map(|place| [first + place - 1, first + place]));
            soup.positions.extend(curve);
        }
        if let Some(number) = points.iter().position(|point| !point.is_finite()) {
            let problem = format!("point {number} has a coordinate that is not a finite number; leave it out");
            return Err(Error::model(name, problem));
        }
        let first = soup.positions.len() as u32;
        soup.points.extend((0..points.len() as u32).map(|place| first + place));
        soup.positions.extend(points);
        let mut mesh = soup.into_mesh(name, options)?;
        let given = labels.iter().enumerate().filter(|(_, text)| !text.is_empty());
        mesh.curves.labels = given.map(|(point, text)| (point as u32, (*text).to_owned())).collect();
        Ok(mesh)
    }
}
