//! Limits on file contents, each with its unit and its reason.
//!
//! A reader compares the sizes that a file claims with the file's length before it allocates memory. The limits below bound the
//! rest: reading a model takes at most [`MEMORY_FACTOR`] times the bytes read plus [`MEMORY_SLACK_BYTES`]. Pictures have
//! separate limits, because a few bytes may be a large valid picture. A test checks that `docs/dev/limits.md` lists every
//! limit.
//!
//! ```
//! // Eight thousand pixels a side, four bytes each, is the largest picture believed.
//! assert_eq!(tinta_geometry::limits::PICTURE_BYTES, 8192 * 8192 * 4);
//! ```

/// Most main memory for reading a model, in multiples of its files' bytes, beyond [`MEMORY_SLACK_BYTES`].
pub const MEMORY_FACTOR: usize = 20;

/// Main memory for reading a file of any size, bytes: tables, threads' buffers, small files of dense formats.
pub const MEMORY_SLACK_BYTES: usize = 64 << 20;

/// Most main memory for the copies of meshes that a glTF file places many times, bytes, where the system does not tell how much
/// is free.
pub const COPIES_BYTES: u64 = 2 << 30;

/// Largest model file, bytes: vertices and corners are counted in 32 bits.
pub const MODEL_BYTES: u64 = 4 << 30;

/// Largest material file of an OBJ model, bytes.
pub const MATERIAL_FILE_BYTES: u64 = 64 << 20;

/// Largest picture file, bytes: the largest picture without any compression, with 16 bits a channel, is little more.
pub const PICTURE_FILE_BYTES: u64 = 640 << 20;

/// Largest drawing to be judged, bytes: an SVG of a million paths.
pub const DRAWING_BYTES: u64 = 640 << 20;

/// Largest file of measured rows, bytes.
pub const ROWS_BYTES: u64 = 1 << 30;

/// Largest list of a batch's jobs, and largest file of a batch's records, bytes.
pub const BATCH_BYTES: u64 = 1 << 30;

/// Longest line of such a list, bytes: some hundred times what all options need.
pub const JOB_BYTES: usize = 64 << 10;

/// Longest label of a point, letters: several lines of a page.
pub const LABEL_CHARACTERS: usize = 1000;

/// Most strokes of a hatched drawing: some hundred times what a sheet of paper holds.
pub const HATCH_STROKES: usize = 1_000_000;

/// Longest side of a picture, pixels: the largest texture that OpenGL drivers take.
pub const PICTURE_SIDE_PX: u32 = 16_384;

/// Most memory for a picture's pixels at four bytes each: 8192 x 8192. A larger picture is read where its file has at least
/// a [`MEMORY_FACTOR`]th of that, as photographs have and pictures made to fill memory have not.
pub const PICTURE_BYTES: u64 = 256 << 20;

/// Most memory for all pictures on a model's materials, bytes, by the same rule.
pub const MODEL_PICTURES_BYTES: u64 = 1 << 30;

/// Most pixels per byte of a picture file, in any format read here: eight pixels a byte, compressed 1032 times by PNG.
pub const PIXELS_A_BYTE: u64 = 8 * 1032;

/// Most triangles of a model: their corners are counted in 32 bits.
pub const TRIANGLES: usize = 1 << 30;

/// Most corners of a polygon that is not convex: cutting it may take up to the square of their number, a third of a second for
/// the slowest known of this many. Longer ones are left out and counted.
pub const CONCAVE_CORNERS: usize = 32_768;

/// Most corners of a polygon that crosses itself: cutting it may take their cube. Longer ones are left out likewise.
pub const CROSSING_CORNERS: usize = 1024;

/// Longest header of a PLY file, bytes.
pub const PLY_HEADER_BYTES: usize = 64 << 10;

/// Most colours of a PLY file's faces that are materials; more, as of a photograph, are averaged at the vertices.
pub const FACE_COLORS: usize = 256;

/// Most materials of a model.
pub const MATERIALS: usize = 16_384;

/// Most material files that an OBJ model may name.
pub const MATERIAL_FILES: usize = 1024;

/// Most levels of the tree of nodes of glTF or 3DS: skeletons have a few dozen.
pub const NODE_LEVELS: usize = 4096;

/// Most objects that a 3MF file puts anywhere, each time counted.
pub const PLACES: usize = 1 << 20;

/// Most bytes that the parts of a 3MF file unpack to, in multiples of its own, beyond [`MEMORY_SLACK_BYTES`]. XML shrinks to a tenth.
pub const UNPACKED_FACTOR: usize = 100;

/// Most skins searched for an MD2 model; the game's own limit is 32.
pub const SKINS: usize = 256;

/// Most remarks of one kind about a file; the others are counted.
pub const REMARKS: usize = 8;

/// Most characters that a message shows of a name from a file.
pub const SHOWN_CHARACTERS: usize = 120;

/// Most pixels of a picture that is drawn: 2 GiB of memory, A1 at 600 dots an inch nearly twice.
pub const DRAWN_PIXELS: usize = 1 << 29;

/// Most pixels drawn in one piece: with depth and copies such a surface takes some 3 GiB. Larger pictures are drawn in tiles.
pub const DRAWN_AT_ONCE_PIXELS: usize = 1 << 27;

/// Longest side of a tile, pixels: its surface, depth and copies then take 320 MiB at most.
pub const TILE_SIDE_PX: u32 = 4096;
