//! Finds a plan's mistakes without a GL context: reads before writes, missing targets and textures, wrong sizes.
//!
//! In: a plan and the scene it will draw. Out: the first [`Flaw`], a sentence, if any. The renderer checks before it draws, which
//! keeps the contents that an earlier plan left in a texture or a buffer out of the picture.

use super::{Blend, Depth, Draw, Faces, Format, Geometry, Paint, Plan, Step, Target, Texture, TextureName};
use crate::scene::{Rectangle, Scene, Size};

/// A mistake that makes a plan unfit for drawing.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Flaw {
    /// The plan has no passes.
    #[error("it has no pass; give it one that draws a picture")]
    NoPass,
    /// A step reads a texture that a later step makes, or draws over pixels that no step has cleared.
    #[error("the pass {pass} reads {what} before a step has written it; clear, draw or copy it earlier")]
    ReadBeforeWritten {
        /// The pass.
        pass: &'static str,
        /// The texture or buffer.
        what: String,
    },
    /// A step reads or draws into a part that the plan lacks.
    #[error("the pass {pass} needs {what}, which the plan does not have; add it, or do without")]
    Missing {
        /// The pass.
        pass: &'static str,
        /// The texture, buffer or list.
        what: String,
    },
    /// A draw reads the texture that its pass draws into.
    #[error("the pass {pass} reads the texture {name} while it draws into it; draw into another")]
    ReadWhileWritten {
        /// The pass.
        pass: &'static str,
        /// The texture.
        name: TextureName,
    },
    /// A texture has two formats.
    #[error("the texture {name} is drawn into in two formats; keep to one")]
    TwoFormats {
        /// The texture.
        name: TextureName,
    },
    /// A size or a length is wrong.
    #[error("{what} is {found}, not {expected}; make it fit")]
    WrongSize {
        /// What.
        what: String,
        /// The size it has.
        found: String,
        /// The correct size.
        expected: String,
    },
}

impl Plan {
    /// Whether it can be drawn for this scene: every texture and buffer is written before it is read, all it names is there,
    /// and sizes fit. Whether a driver can do it, it does not say.
    ///
    /// ```
    /// # fn main() -> tinta::Result<()> {
    /// use std::sync::Arc;
    /// use tinta::plan::Step;
    /// use tinta::{LoadOptions, Scene, SceneSettings, Show, Style, StyleName, load};
    ///
    /// let mesh = load("builtin:bust", &LoadOptions::default())?.mesh;
    /// let scene = Scene::new(vec![Arc::new(mesh)], &SceneSettings::default())?;
    /// let mut plan = Style::named(StyleName::ThreePass).plan(&scene, Show::Final)?;
    /// assert_eq!(plan.check(&scene), Ok(()));
    ///
    /// plan.passes[0].steps.retain(|step| *step != Step::CopyFramebuffer);
    /// let flaw = plan.check(&scene).unwrap_err();
    /// let sentence = "the pass border reads the texture BorderMap before a step has written it";
    /// assert!(flaw.to_string().starts_with(sentence));
    /// # Ok(())
    /// # }
    /// ```
    ///
    /// # Errors
    ///
    /// The first [`Flaw`] in the order of the steps.
    pub fn check(&self, scene: &Scene) -> Result<(), Flaw> {
        self.check_as_a_whole()?;
        let surface = scene.size.times(self.supersample);
        let mut written = WrittenTargets::default();
        for pass in &self.passes {
            if let Some(scissor) = pass.scissor {
                check_rectangle(scissor, surface, pass.name)?;
            }
            for step in &pass.steps {
                written.follow(self, step, pass.target, pass.name)?;
                if let Step::Draw(draw) = step {
                    check_lists(draw, scene, surface, pass.name)?;
                }
            }
        }
        let last = self.passes.last().ok_or(Flaw::NoPass)?;
        written.needs_color(last.target, last.name)
    }

    /// Checks passes, targets, tables, pictures and supersampling.
    fn check_as_a_whole(&self) -> Result<(), Flaw> {
        let mut formats: Vec<(TextureName, Format)> = Vec::new();
        for pass in &self.passes {
            let Target::Textures(attachments) = pass.target else { continue };
            if attachments.colors.is_empty() {
                return Err(missing(pass.name, "a texture to draw into"));
            }
            for color in attachments.colors {
                match formats.iter().find(|(name, _)| *name == color.name) {
                    Some((name, format)) if *format != color.format => return Err(Flaw::TwoFormats { name: *name }),
                    Some(_) => {}
                    None => formats.push((color.name, color.format)),
                }
            }
        }
        if let Some(table) = self.tables.iter().find(|table| table.texels.is_empty()) {
            return Err(wrong_size(table.name.to_owned(), "empty".to_owned(), "one texel or more"));
        }
        for plan_picture in &self.pictures {
            let (size, bytes) = (plan_picture.picture.size, plan_picture.picture.pixels.len());
            if size.pixel_count() == 0 || bytes != size.pixel_count() * 4 {
                let what = format!("the picture {}", plan_picture.name);
                return Err(wrong_size(what, format!("{bytes} bytes"), format!("4 for each of {size} pixels")));
            }
        }
        let is_shrunk = |step: &Step| matches!(step, Step::Draw(Draw { geometry: Geometry::PictureSquare, .. }));
        let last = self.passes.last().and_then(|pass| pass.steps.last());
        match self.supersample {
            0 => Err(wrong_size("what is drawn".to_owned(), "0 times the picture".to_owned(), "once or more")),
            1 => Ok(()),
            times if !last.is_some_and(is_shrunk) => {
                let what = "the end of the plan".to_owned();
                Err(wrong_size(what, format!("{times} times the picture"), "the picture's size"))
            }
            _ => Ok(()),
        }
    }
}

/// The targets and textures that the steps so far have written.
#[derive(Default)]
struct WrittenTargets {
    /// Textures written by passes.
    textures: Vec<Texture>,
    /// Colour and depth of the framebuffer.
    framebuffer: [bool; 2],
    /// The depth buffer of passes into textures.
    texture_depth: bool,
}

impl WrittenTargets {
    fn follow(&mut self, plan: &Plan, step: &Step, target: Target, pass: &'static str) -> Result<(), Flaw> {
        match step {
            Step::Clear { color, depth } => {
                if color.is_some() {
                    self.write_color(target);
                }
                if *depth {
                    self.write_depth(target, pass)?;
                }
            }
            Step::ClearEach { colors } => {
                let expected = match target {
                    Target::Framebuffer => return Err(missing(pass, "textures to clear, each to its own colour")),
                    Target::Textures(attachments) => attachments.colors.len(),
                };
                if colors.len() != expected {
                    let what = format!("the list of colours that {pass} clears to");
                    return Err(wrong_size(what, colors.len().to_string(), format!("{expected} long")));
                }
                self.write_color(target);
                if has_depth(target) {
                    self.write_depth(target, pass)?;
                }
            }
            Step::CopyFramebuffer => {
                self.needs_color(target, pass)?;
                self.textures.push(Texture::BorderMap);
            }
            Step::CopyDepth => {
                self.needs_depth(target, pass)?;
                self.textures.push(Texture::DepthMap);
                match target {
                    Target::Framebuffer => self.framebuffer[1] = false,
                    Target::Textures(_) => self.texture_depth = false,
                }
            }
            Step::Draw(draw) => {
                self.check_textures(plan, draw, target, pass)?;
                if draw.depth != Depth::Ignore {
                    self.needs_depth(target, pass)?;
                }
                if !fills(draw) {
                    self.needs_color(target, pass)?;
                }
                self.write_color(target);
            }
        }
        Ok(())
    }

    fn check_textures(&self, plan: &Plan, draw: &Draw, target: Target, pass: &'static str) -> Result<(), Flaw> {
        for (_, texture) in &draw.textures {
            match *texture {
                Texture::Material { .. } => {}
                Texture::Table(number) if number >= plan.tables.len() => {
                    return Err(missing(pass, &format!("table {number}, counted from 0")));
                }
                Texture::Table(_) => {}
                Texture::Picture(number) if number >= plan.pictures.len() => {
                    return Err(missing(pass, &format!("picture {number}, counted from 0")));
                }
                Texture::Picture(_) => {}
                Texture::Drawn(name) => {
                    let has_name = |target: Target| match target {
                        Target::Framebuffer => false,
                        Target::Textures(attachments) => attachments.colors.iter().any(|color| color.name == name),
                    };
                    if has_name(target) {
                        return Err(Flaw::ReadWhileWritten { pass, name });
                    }
                    if !plan.passes.iter().any(|pass| has_name(pass.target)) {
                        return Err(missing(pass, &format!("a pass that draws the texture {name}")));
                    }
                    self.needs_texture(*texture, format!("the texture {name}"), pass)?;
                }
                Texture::BorderMap | Texture::DepthMap => {
                    self.needs_texture(*texture, format!("the texture {texture:?}"), pass)?;
                }
            }
        }
        Ok(())
    }

    fn needs_texture(&self, texture: Texture, what: String, pass: &'static str) -> Result<(), Flaw> {
        match self.textures.contains(&texture) {
            true => Ok(()),
            false => Err(Flaw::ReadBeforeWritten { pass, what }),
        }
    }

    fn needs_color(&self, target: Target, pass: &'static str) -> Result<(), Flaw> {
        let Target::Textures(attachments) = target else {
            let what = "the framebuffer".to_owned();
            return if self.framebuffer[0] { Ok(()) } else { Err(Flaw::ReadBeforeWritten { pass, what }) };
        };
        attachments.colors.iter().try_for_each(|color| {
            self.needs_texture(Texture::Drawn(color.name), format!("the texture {:?}", color.name), pass)
        })
    }

    fn needs_depth(&self, target: Target, pass: &'static str) -> Result<(), Flaw> {
        let is_written = match target {
            Target::Framebuffer => self.framebuffer[1],
            Target::Textures(_) if has_depth(target) => self.texture_depth,
            Target::Textures(_) => return Err(missing(pass, "a depth buffer")),
        };
        let what = "the depth buffer".to_owned();
        if is_written { Ok(()) } else { Err(Flaw::ReadBeforeWritten { pass, what }) }
    }

    fn write_color(&mut self, target: Target) {
        match target {
            Target::Framebuffer => self.framebuffer[0] = true,
            Target::Textures(attachments) => {
                self.textures.extend(attachments.colors.iter().map(|color| Texture::Drawn(color.name)));
            }
        }
    }

    fn write_depth(&mut self, target: Target, pass: &'static str) -> Result<(), Flaw> {
        match target {
            Target::Framebuffer => self.framebuffer[1] = true,
            Target::Textures(_) if has_depth(target) => self.texture_depth = true,
            Target::Textures(_) => return Err(missing(pass, "a depth buffer")),
        }
        Ok(())
    }
}

fn has_depth(target: Target) -> bool {
    match target {
        Target::Framebuffer => true,
        Target::Textures(attachments) => attachments.has_depth,
    }
}

/// Whether a draw may be the first into its target: a square that covers it all, whatever it held.
fn fills(draw: &Draw) -> bool {
    matches!(draw.geometry, Geometry::ScreenSquare | Geometry::PictureSquare | Geometry::BackgroundSquare { .. })
        && draw.depth == Depth::Ignore
        && draw.blend == Blend::Replace
        && draw.scissor.is_none()
}

/// The pixels a draw may change lie in the surface, and its lists are as long as the scene's.
fn check_lists(draw: &Draw, scene: &Scene, surface: Size, pass: &'static str) -> Result<(), Flaw> {
    if let Some(scissor) = draw.scissor {
        check_rectangle(scissor, surface, pass)?;
    }
    let count = scene.objects.len();
    let by_object = |what: &str, length: usize| match length == count {
        true => Ok(()),
        false => Err(wrong_size(format!("the list of {what} in {pass}"), length.to_string(), format!("{count} long"))),
    };
    if let Some(faces) = &draw.faces {
        by_object("faces", faces.len())?;
        let is_whole = |faces: &Faces| match faces {
            Faces::Listed(list) => list.indices.len() % 3 == 0,
            Faces::All | Faces::None => true,
        };
        if !faces.iter().all(is_whole) {
            let what = format!("a list of faces in {pass}");
            return Err(wrong_size(what, "cut off".to_owned(), "three indices a face"));
        }
    }
    match &draw.geometry {
        Geometry::Objects(Paint::Coordinates(lists)) => by_object("coordinates", lists.len()),
        Geometry::Objects(Paint::Colors(lists)) => by_object("colours", lists.len()),
        Geometry::Edges { runs, .. } => match runs.iter().find(|run| run.object >= count) {
            Some(run) => Err(missing(pass, &format!("object {} of the scene, counted from 0", run.object))),
            None => Ok(()),
        },
        _ => Ok(()),
    }
}

fn check_rectangle(rectangle: Rectangle, surface: Size, pass: &'static str) -> Result<(), Flaw> {
    let Rectangle { x, y, width, height } = rectangle;
    let ends_within = |first: u32, length: u32, limit: u32| first.checked_add(length).is_some_and(|end| end <= limit);
    match ends_within(x, width, surface.width) && ends_within(y, height, surface.height) {
        true => Ok(()),
        false => {
            let what = format!("what {pass} is confined to");
            Err(wrong_size(what, format!("{width}x{height} pixels from ({x}, {y})"), format!("within {surface}")))
        }
    }
}

fn missing(pass: &'static str, what: &str) -> Flaw {
    Flaw::Missing { pass, what: what.to_owned() }
}

fn wrong_size(what: String, found: String, expected: impl Into<String>) -> Flaw {
    Flaw::WrongSize { what, found, expected: expected.into() }
}

#[cfg(test)]
mod tests;
