//! Plans as text, for `--explain` and for tests.

use super::{
    Blend, Depth, Draw, EdgeRun, Faces, Facts, Geometry, LineDrawing, Mark, Paint, Plan, Program, Step, Submission,
    Texture, Value,
};
use crate::scene::Rectangle;
use std::fmt;

impl fmt::Display for Plan {
    /// Prints step by step; `{:#}` adds the facts stated of each draw below it.
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.supersample > 1 {
            writeln!(out, "everything drawn {} times as wide and high as the picture", self.supersample)?;
        }
        match self.submission {
            Submission::Buffers => {}
            Submission::Immediate => writeln!(out, "vertices sent one by one, by glBegin and glEnd")?,
        }
        for (number, pass) in self.passes.iter().enumerate() {
            write!(out, "pass {}: {}{}", number + 1, pass.name, pass.target)?;
            write_scissor(out, pass.scissor)?;
            writeln!(out)?;
            for step in &pass.steps {
                writeln!(out, "  {step}")?;
                if let Step::Draw(Draw { facts, .. }) = step
                    && out.alternate()
                    && *facts != Facts::default()
                {
                    writeln!(out, "    {facts}")?;
                }
            }
        }
        self.write_picture(out)
    }
}

impl fmt::Display for Step {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Clear { color, depth } => {
                write!(out, "clear")?;
                if let Some([r, g, b, a]) = color {
                    write!(out, " to ({r}, {g}, {b}, {a})")?;
                }
                if *depth {
                    let comma = if color.is_some() { "," } else { "" };
                    write!(out, "{comma} depth to 1")?;
                }
                Ok(())
            }
            Self::ClearEach { colors } => {
                write!(out, "clear to ")?;
                for (index, [r, g, b, a]) in colors.iter().enumerate() {
                    write!(out, "{}({r}, {g}, {b}, {a})", if index > 0 { " and " } else { "" })?;
                }
                write!(out, ", depth to 1")
            }
            Self::CopyFramebuffer => write!(out, "copy the framebuffer into the texture BorderMap"),
            Self::CopyDepth => write!(out, "copy the depth buffer into the texture DepthMap"),
            Self::Draw(draw) => draw.fmt(out),
        }
    }
}

impl fmt::Display for Draw {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.geometry {
            Geometry::Objects(Paint::Materials) => write!(out, "draw the objects")?,
            Geometry::Objects(Paint::Uniform([r, g, b, a])) => write!(out, "draw the objects in ({r}, {g}, {b}, {a})")?,
            Geometry::Objects(Paint::Coordinates(_)) => write!(out, "draw the objects by texture coordinates")?,
            Geometry::Objects(Paint::Colors(_)) => write!(out, "draw the objects in colours of their vertices")?,
            Geometry::Edges { runs, mark, width_px, is_smooth, line_drawing } => {
                let mark = if *mark == Mark::Lines { "lines" } else { "points" };
                let smooth = if *is_smooth { "smooth " } else { "" };
                let quads = if *line_drawing == LineDrawing::Quads { " as quads" } else { "" };
                write!(out, "draw {smooth}{mark} of {width_px} px{quads} at")?;
                write_runs(out, runs)?;
            }
            Geometry::BackgroundSquare { color: [r, g, b, a] } => {
                write!(out, "draw the background square in ({r}, {g}, {b}, {a})")?;
            }
            Geometry::ScreenSquare => write!(out, "draw the screen square")?,
            Geometry::PictureSquare => write!(out, "draw the screen square over the picture")?,
        }
        match &self.program {
            None => write!(out, " without shaders")?,
            Some(program) => write!(out, " with {program}")?,
        }
        for uniform in &self.uniforms {
            write!(out, ", {} = {}", uniform.name, uniform.value)?;
        }
        for (sampler, texture) in &self.textures {
            match texture {
                Texture::Material { .. } => write!(out, ", {sampler} = Material")?,
                Texture::Drawn(name) => write!(out, ", {sampler} = {name}")?,
                _ => write!(out, ", {sampler} = {texture:?}")?,
            }
        }
        match self.depth {
            Depth::TestAndWrite => {}
            Depth::TestOnly => write!(out, ", depth not written")?,
            Depth::Equal => write!(out, ", where depth is equal")?,
            Depth::Ignore => write!(out, ", no depth test")?,
        }
        write_sides(out, self)?;
        match self.blend {
            Blend::Replace => {}
            Blend::Over => write!(out, ", blended")?,
            Blend::Multiply => write!(out, ", multiplied")?,
        }
        write_scissor(out, self.scissor)?;
        if let Some(faces) = &self.faces {
            write_faces(out, faces)?;
        }
        Ok(())
    }
}

impl fmt::Display for Value {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Float(x) => write!(out, "{x}"),
            Self::Int(x) => write!(out, "{x}"),
            Self::Vec2([x, y]) | Self::TexelSize([x, y]) | Self::PixelPlace([x, y]) => write!(out, "({x}, {y})"),
            Self::Vec3([x, y, z]) => write!(out, "({x}, {y}, {z})"),
        }
    }
}

impl fmt::Display for Program {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}", self.vertex)?;
        self.fragments.iter().try_for_each(|fragment| write!(out, " + {fragment}"))
    }
}

/// Which faces are drawn, how and where.
fn write_sides(out: &mut fmt::Formatter<'_>, draw: &Draw) -> fmt::Result {
    if draw.cull_back_faces {
        write!(out, ", back faces left out")?;
    } else if draw.culls_doubled_faces {
        write!(out, ", of doubled faces the back ones left out")?;
    }
    if let Some(width_px) = draw.back_faces_as_lines {
        write!(out, ", back faces alone, as lines of {width_px} px")?;
    }
    if let Some([factor, units]) = draw.polygon_offset {
        write!(out, ", pushed back by ({factor}, {units})")?;
    }
    Ok(())
}

fn write_scissor(out: &mut fmt::Formatter<'_>, scissor: Option<Rectangle>) -> fmt::Result {
    match scissor {
        Some(Rectangle { x, y, width, height }) => write!(out, ", only {width} x {height} pixels from ({x}, {y})"),
        None => Ok(()),
    }
}

/// Writes how many objects are drawn, and how many faces of those that are drawn in part.
fn write_faces(out: &mut fmt::Formatter<'_>, faces: &[Faces]) -> fmt::Result {
    let drawn = faces.iter().filter(|faces| **faces != Faces::None).count();
    if drawn < faces.len() {
        write!(out, ", {drawn} of {} objects", faces.len())?;
    }
    let lists: Vec<usize> = faces
        .iter()
        .filter_map(|faces| if let Faces::Listed(list) = faces { Some(list.indices.len() / 3) } else { None })
        .collect();
    match lists.as_slice() {
        [] => Ok(()),
        lists => write!(out, ", {} faces of them", lists.iter().sum::<usize>()),
    }
}

/// Writes the number of edges of each name and colour.
fn write_runs(out: &mut fmt::Formatter<'_>, runs: &[EdgeRun]) -> fmt::Result {
    let mut sums: Vec<(&str, [f32; 4], usize)> = Vec::new();
    for run in runs {
        match sums.iter_mut().find(|(name, color, _)| *name == run.name && *color == run.color) {
            Some((.., count)) => *count += run.ends.len(),
            None => sums.push((run.name, run.color, run.ends.len())),
        }
    }
    if sums.is_empty() {
        write!(out, " no edges")?;
    }
    for (index, (name, [r, g, b, a], count)) in sums.iter().enumerate() {
        let comma = if index > 0 { "," } else { "" };
        write!(out, "{comma} {count} {name} edges in ({r}, {g}, {b}, {a})")?;
    }
    Ok(())
}
