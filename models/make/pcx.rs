//! Writes PCX pictures of 256 colours, as the skins of Quake 2 are.
//!
//! In: a colour for each pixel, of at most 256 different ones. Out: the
//! file's bytes, run-length coded, the palette at the end.

pub type Color = [u8; 3];

/// The file of a picture `width` pixels wide, row by row from the top.
pub fn bytes(width: usize, pixels: &[Color]) -> Result<Vec<u8>, String> {
    let mut palette: Vec<Color> = pixels.to_vec();
    palette.sort_unstable();
    palette.dedup();
    if palette.len() > 256 {
        return Err(format!("a skin has 256 colours, not {}", palette.len()));
    }
    let [right, bottom] = [width - 1, pixels.len() / width - 1].map(|last| (last as u16).to_le_bytes());
    let line = (width as u16).to_le_bytes();
    // Version 5, coded, 8 bits; the window; no dots per inch and no palette of 16 here; one plane.
    let mut file = vec![10, 5, 1, 8, 0, 0, 0, 0, right[0], right[1], bottom[0], bottom[1]];
    file.resize(65, 0);
    file.extend([1, line[0], line[1], 1, 0]);
    file.resize(128, 0);
    for row in pixels.chunks_exact(width) {
        let mut left = row;
        while let Some(color) = left.first() {
            let run = left.iter().take(63).take_while(|next| *next == color).count();
            let index = palette.binary_search(color).map_err(|_| "a colour is not in its palette")? as u8;
            // A number that looks like a run is written as a run of one.
            if run > 1 || index >= 0xc0 {
                file.push(0xc0 | run as u8);
            }
            file.push(index);
            left = &left[run..];
        }
    }
    file.push(12);
    palette.resize(256, [0; 3]);
    file.extend(palette.as_flattened());
    Ok(file)
}
