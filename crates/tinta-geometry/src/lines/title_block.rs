//! The title block of a sheet: title, scale, unit, projection and size of the paper.

use super::drawing::page::PageSize;
use super::drawing::settings::DrawingSettings;
use super::sheet::{Layout, NAME, ProjectionAngle, rectangle};
use super::sheet_text::{strokes, unknown_letter, width_of};
use super::visible_lines::VisibleLines;
use crate::error::{Error, Result};
use crate::settings::Value;
use glam::DVec2;

/// Height of a row, as a share of the sheet's shorter side, and the block's width, as a share of the sheet's.
const ROW: f64 = 0.05;
const BLOCK: f64 = 0.55;

/// Where the cells of the lower row end, as shares of the block's width.
const CELLS: [f64; 3] = [0.4, 0.55, 0.8];

impl Layout {
    /// The width of the title block, the height of its letters, and the room around them, pixels.
    fn block(&self) -> (f64, f64, f64) {
        (BLOCK * self.sheet_px.x, NAME * self.side, (ROW - NAME) * 0.5 * self.side)
    }

    /// A title as its field holds it.
    ///
    /// # Errors
    ///
    /// [`Error::Setting`] for a letter that has no sign, and for a title too long for its field.
    pub(super) fn lettered(&self, title: &str) -> Result<String> {
        let (width, height, pad) = self.block();
        let room = (width - 2.0 * pad) / height;
        let lettered = title.to_uppercase();
        if let Some(letter) = unknown_letter(&lettered) {
            let problem =
                format!("a sheet's lettering has no sign {letter:?}; it has letters, digits and . , : - + / _ ( )");
            return Err(Error::value("title", title, problem));
        }
        if width_of(&lettered) > room {
            let fits = lettered.char_indices().filter(|(at, _)| width_of(&lettered[..*at]) <= room).count();
            let problem = format!("it is too long for its field, which holds some {} letters", fits.saturating_sub(1));
            return Err(Error::value("title", title, problem));
        }
        Ok(lettered)
    }
}

impl VisibleLines {
    /// Adds the title block: the lettered title, and below it scale, unit, projection and size of the paper.
    pub(super) fn put_block(
        &mut self,
        layout: &Layout,
        (angle, drawing): (ProjectionAngle, &DrawingSettings),
        title: &str,
        scale: Option<&str>,
    ) {
        let [_, high] = layout.frame();
        let (width, height, pad) = layout.block();
        let row = ROW * layout.side;
        let low = high - DVec2::new(width, 2.0 * row);
        let below = low + DVec2::Y * row;
        self.put_strokes(rectangle([low, high]));
        self.put_strokes(vec![[below, below + DVec2::X * width]]);
        let ends = CELLS.map(|share| below + DVec2::X * (share * width));
        self.put_strokes(ends.map(|end| [end, end + DVec2::Y * row]).to_vec());
        let paper = match drawing.page_size {
            PageSize::Paper(paper) => paper.to_string().to_uppercase(),
            _ => String::new(),
        };
        let paper = paper.split('-').next().unwrap_or_default();
        let texts = [
            (low, width, title),
            (below, ends[0].x - below.x, scale.unwrap_or("NOT TO SCALE")),
            (ends[0], ends[1].x - ends[0].x, &drawing.units.text()),
            (ends[2], high.x - ends[2].x, paper),
        ];
        for (corner, cell, text) in texts {
            let height = height.min((cell - 2.0 * pad) / width_of(text).max(1.0));
            self.put_strokes(strokes(text, corner + pad, height));
        }
        self.put_symbol(DVec2::new(ends[2].x - pad, below.y + 0.5 * row), height, angle);
    }
}
