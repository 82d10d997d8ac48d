//! The limits on the size of pictures.

use crate::limits::{MEMORY_FACTOR, PICTURE_BYTES, PICTURE_SIDE_PX, PIXELS_A_BYTE};
use crate::values::Size;

/// Returns an error for a picture whose pixels would exceed the limits, `most` bytes among them, or more than its file can hold.
pub(super) fn check_size(
    Size { width, height }: Size,
    file_bytes: usize,
    most: u64,
) -> std::result::Result<(), String> {
    if width.max(height) > PICTURE_SIDE_PX {
        return Err(too_large());
    }
    let (pixels, file_bytes) = (u64::from(width) * u64::from(height), file_bytes as u64);
    if pixels > file_bytes.saturating_mul(PIXELS_A_BYTE) {
        return Err(format!(
            "its {file_bytes} bytes cannot hold {width} x {height} pixels; it is damaged, save it again"
        ));
    }
    if pixels * 4 > PICTURE_BYTES.max(file_bytes.saturating_mul(MEMORY_FACTOR as u64)).min(most) {
        return Err(format!(
            "its {width} x {height} pixels take {} MiB of memory, more than its file or its model is worth; scale it down",
            (pixels * 4) >> 20
        ));
    }
    Ok(())
}

pub(super) fn too_large() -> String {
    format!("it is longer than {PICTURE_SIDE_PX} pixels on a side; scale it down")
}
