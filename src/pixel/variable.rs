//! A variable of a fragment shader over the whole picture, recomputed pixel by pixel.

use super::{Explainer, PixelStep, Recomputation, What};
use crate::choice::meant_or;
use crate::error::{Error, Result};
use crate::picture::Picture;
use crate::renderer::Renderer;
use crate::scene::{Rectangle, Scene, Size};
use crate::styles::{Show, Style};
use serde::Serialize;
use std::fmt::{Display, Formatter};
use tinta_geometry::threads::{cores, in_chunks};
use tinta_glsl::{Trace, Type, Value};

/// Where a number is infinite or none, the picture has this colour.
const NOT_FINITE: [u8; 4] = [255, 0, 255, 255];

/// A variable of a fragment shader, with its value in every pixel.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Variable {
    /// Its name.
    pub name: String,
    /// The pass whose shader has it.
    pub pass: &'static str,
    /// The step of that pass.
    pub step: &'static str,
    /// Its type, in GLSL's words.
    #[serde(rename = "type")]
    pub of: String,
    /// The picture's size.
    pub size: Size,
    /// Pixels that have a value.
    pub pixels: usize,
    /// Of these, pixels with a number that is infinite or none.
    pub not_finite: usize,
    /// The smallest and the largest finite number of all its components.
    pub range: [f64; 2],
    /// The numbers that are black and white in its picture: 0 and 1, if none that it shows lies outside, or else the range of those.
    pub shown: [f64; 2],
    /// For each pixel, top row first: its numbers, one to four; `None` where no statement set it.
    #[serde(skip)]
    pub values: Vec<Option<Value>>,
}

impl Variable {
    /// Draws a scene in a style and recomputes a variable in every pixel, with its last value there. `name` is `NAME` or `PASS.NAME`; a
    /// name alone means the last pass that has it. Inputs from the vertices count as variables.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] for an unknown name, with those that exist, for a matrix, and for a variable that no pixel sets; those of
    /// [`Renderer::step_values`] and of [`Explainer`].
    pub fn of(style: &Style, scene: &Scene, renderer: &mut Renderer, name: &str) -> Result<Self> {
        let size = scene.size;
        let plan = style.plan(scene, Show::Final)?;
        let part = Rectangle { x: 0, y: 0, width: size.width, height: size.height };
        let read_back = renderer.step_values(scene, &plan, part)?;
        let (how, replaced) = (Recomputation::like(renderer.context()), renderer.replaced_shaders());
        let explainer = Explainer::with_shaders(scene, &plan, &read_back, how, &replaced)?;
        let steps: Vec<_> = plan.steps().collect();
        let known: Vec<(usize, &str, &str)> = (0..steps.len())
            .flat_map(|number| {
                let pass = steps[number].0;
                explainer.variables(number).into_iter().map(move |variable| (number, pass, variable))
            })
            .collect();
        let is_it = |(_, pass, variable): &&(usize, &str, &str)| {
            *variable == name || name.split_once('.').is_some_and(|(of, rest)| of == *pass && rest == *variable)
        };
        let refuse = |problem: String| Error::value("variable", name, problem);
        let Some((number, _, variable)) = known.iter().rfind(is_it).copied() else {
            return Err(refuse(unknown(name, &known)));
        };
        let values = values(&explainer, number, variable, size)?;
        let Some(of) = values.iter().flatten().map(|value| value.of).next() else {
            return Err(refuse("no pixel of the picture sets it; choose another, or another view".to_owned()));
        };
        if of.is_matrix() {
            return Err(refuse(format!("it is a {of}, and only numbers and vectors make a picture")));
        }
        let (pass, step) = steps[number];
        Ok(Self::new(variable.to_owned(), (pass, step.name()), of, size, values))
    }

    fn new(
        name: String,
        (pass, step): (&'static str, &'static str),
        of: Type,
        size: Size,
        values: Vec<Option<Value>>,
    ) -> Self {
        let range_of = |most: usize| {
            let numbers = || values.iter().flatten().flat_map(|value| value.numbers().iter().copied().take(most));
            let finite = || numbers().filter(|number| number.is_finite());
            let range = [finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max)];
            if range[0] <= range[1] { range } else { [0.0, 0.0] }
        };
        // A fourth number is not shown.
        let (range, in_picture) = (range_of(4), range_of(3));
        let is_shown_as_is = in_picture[0] >= 0.0 && in_picture[1] <= 1.0;
        let is_not_finite = |value: &&Value| value.numbers().iter().any(|number| !number.is_finite());
        Self {
            name,
            pass,
            step,
            of: of.to_string(),
            size,
            pixels: values.iter().flatten().count(),
            not_finite: values.iter().flatten().filter(is_not_finite).count(),
            range,
            shown: if is_shown_as_is { [0.0, 1.0] } else { in_picture },
            values,
        }
    }

    /// Returns its picture: a number as grey, two as red and green, three as red, green and blue; a fourth is not shown. Pixels without a
    /// value are transparent, those with infinite numbers magenta.
    pub fn picture(&self) -> Picture {
        let [black, white] = self.shown;
        let byte = |number: f64| ((number - black) / (white - black) * 255.0).round() as u8;
        let color = |value: &Option<Value>| match value.as_ref().map(Value::numbers) {
            None => [0; 4],
            Some(numbers) if numbers.iter().any(|number| !number.is_finite()) => NOT_FINITE,
            Some([grey]) => [byte(*grey), byte(*grey), byte(*grey), u8::MAX],
            Some([red, green]) => [byte(*red), byte(*green), 0, u8::MAX],
            Some([red, green, blue, ..]) => [byte(*red), byte(*green), byte(*blue), u8::MAX],
            Some([]) => [0; 4],
        };
        Picture { size: self.size, pixels: self.values.iter().flat_map(color).collect() }
    }

    /// Returns its numbers as a file of NumPy: 32-bit floats, height by width, by components if it has several. Pixels without a value are
    /// NaN.
    pub fn npy(&self) -> Vec<u8> {
        let count = self.values.iter().flatten().next().map_or(1, |value| value.numbers().len());
        let Size { width, height } = self.size;
        let components = if count > 1 { format!(", {count}") } else { String::new() };
        let header = format!("{{'descr': '<f4', 'fortran_order': False, 'shape': ({height}, {width}{components}), }}");
        // Magic number, version 1.0, the header's length; all of it a multiple of 64 bytes.
        let length = (10 + header.len() + 1).next_multiple_of(64) - 10;
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        bytes.extend((length as u16).to_le_bytes());
        bytes.extend(format!("{header:<0$}\n", length - 1).bytes());
        let missing = vec![f64::NAN; count];
        for value in &self.values {
            let numbers = value.as_ref().map_or(missing.as_slice(), Value::numbers);
            bytes.extend(numbers.iter().flat_map(|number| (*number as f32).to_le_bytes()));
        }
        bytes
    }
}

impl Display for Variable {
    fn fmt(&self, out: &mut Formatter<'_>) -> std::fmt::Result {
        let Self { name, pass, step, of, pixels, not_finite, range: [low, high], shown: [black, white], .. } = self;
        write!(
            out,
            "{name}, a {of} of {pass}, {step}: {low:.6} to {high:.6} in {pixels} pixels; black is {black:.6}, white {white:.6}"
        )?;
        if *not_finite > 0 {
            write!(out, "; {not_finite} pixels have no finite number and are magenta")?;
        }
        out.write_str(".")
    }
}

/// Why a name is refused: the nearest one, or else all, pass by pass.
fn unknown(name: &str, known: &[(usize, &str, &str)]) -> String {
    let mut passes: Vec<(&str, Vec<&str>)> = Vec::new();
    for (_, pass, variable) in known {
        match passes.iter_mut().find(|(known, _)| known == pass) {
            Some((_, names)) if names.contains(variable) => {}
            Some((_, names)) => names.push(variable),
            None => passes.push((pass, vec![variable])),
        }
    }
    if passes.is_empty() {
        return "no fragment shader of this style has variables that can be recomputed; choose another style"
            .to_owned();
    }
    let all: Vec<&str> = known.iter().map(|(.., variable)| *variable).collect();
    let listed: Vec<String> = passes.iter().map(|(pass, names)| format!("{pass} has {}", names.join(", "))).collect();
    meant_or(
        name.split_once('.').map_or(name, |(_, rest)| rest),
        &all,
        &format!("choose another: {}", listed.join("; ")),
    )
}

/// The last value of a variable in every pixel, top row first.
fn values(explainer: &Explainer<'_>, number: usize, name: &str, size: Size) -> Result<Vec<Option<Value>>> {
    let of_pixel = |x: u32, row: usize| {
        let step = explainer.at_step(number, [x, size.height - 1 - row as u32], Trace::Variable(name))?;
        Ok(last(&step, name))
    };
    // Rows of the model cost more than those of background.
    let rows = in_chunks(size.height as usize, 1, cores(), |rows| -> Result<Vec<Option<Value>>> {
        rows.flat_map(|row| (0..size.width).map(move |x| (x, row))).map(|(x, row)| of_pixel(x, row)).collect()
    });
    Ok(rows.into_iter().collect::<Result<Vec<_>>>()?.concat())
}

/// The last value of a variable in the triangle that decides on a pixel.
fn last(step: &PixelStep, name: &str) -> Option<Value> {
    let fragment = step.decisive()?;
    let given = || fragment.varyings.iter().find(|(known, _)| known == name).map(|(_, value)| *value);
    let set = fragment.events.iter().rev().find_map(|event| match &event.what {
        What::Set { value, .. } => Some(*value),
        _ => None,
    });
    set.or_else(given)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn variable(values: &[Option<Value>]) -> Variable {
        let size = Size { width: values.len() as u32, height: 1 };
        Variable::new("a".to_owned(), ("pass", "step"), values[0].unwrap().of, size, values.to_vec())
    }

    #[test]
    fn numbers_from_0_to_1_are_shown_as_they_are_and_others_by_their_range() {
        let grey = |number: f64| Some(Value::floats(&[number]));
        let plain = variable(&[grey(0.25), None, grey(1.0)]);
        assert_eq!((plain.range, plain.shown, plain.pixels), ([0.25, 1.0], [0.0, 1.0], 2));
        assert_eq!(plain.picture().pixels, [64, 64, 64, 255, 0, 0, 0, 0, 255, 255, 255, 255]);
        let wide = variable(&[grey(-1.0), grey(3.0), grey(f64::NAN), grey(f64::INFINITY)]);
        assert_eq!((wide.shown, wide.not_finite), ([-1.0, 3.0], 2));
        assert_eq!(wide.picture().pixels[..8], [0, 0, 0, 255, 255, 255, 255, 255]);
        assert_eq!(wide.picture().pixels[8..12], NOT_FINITE);
        let color = variable(&[Some(Value::floats(&[-1.0, 0.0, 1.0, 0.5]))]);
        assert_eq!(color.picture().pixels, [0, 128, 255, 255]);
        let with_fourth = variable(&[Some(Value::floats(&[0.2, 0.4, 0.6, 5.0]))]);
        assert_eq!((with_fourth.shown, with_fourth.range), ([0.0, 1.0], [0.2, 5.0]));
        assert_eq!(with_fourth.picture().pixels, [51, 102, 153, 255]);
        let constant = variable(&[grey(7.0)]);
        assert_eq!(constant.picture().pixels[3], 255);
    }

    #[test]
    fn a_file_of_numpy_has_its_header_and_a_float_for_each_component() {
        let pair = variable(&[Some(Value::floats(&[0.5, -2.0])), None]);
        let bytes = pair.npy();
        assert_eq!((&bytes[..8], bytes[10 + usize::from(bytes[8]) - 1]), (&b"\x93NUMPY\x01\x00"[..], b'\n'));
        let start = 10 + usize::from(bytes[8]);
        assert_eq!(start % 64, 0);
        assert!(String::from_utf8_lossy(&bytes[..start]).contains("'shape': (1, 2, 2)"));
        let floats: Vec<f32> =
            bytes[start..].chunks_exact(4).map(|b| f32::from_le_bytes(b.try_into().unwrap())).collect();
        assert_eq!(floats[..2], [0.5, -2.0]);
        assert!(floats[2..].iter().all(|float| float.is_nan()) && floats.len() == 4);
    }
}
