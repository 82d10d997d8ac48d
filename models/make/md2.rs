//! Writes Quake 2 models (MD2, version 8).
//!
//! In: frames of vertices in steps of a byte, triangles with their texels, the
//! skin's name. Out: the file's bytes. In the file x is forward, y left and z
//! up, and triangles are clockwise seen from outside; whoever calls turns them
//! so.

pub struct Frame {
    pub name: String,
    /// Length of a step, and what is added, along x, y and z.
    pub scale: [f32; 3],
    pub translation: [f32; 3],
    pub vertices: Vec<[u8; 3]>,
}

pub struct Model {
    /// The skin's name in the file, if it has one.
    pub skin: Option<&'static str>,
    /// Texels across and down.
    pub skin_size: [u32; 2],
    /// Texture coordinates in texels from the upper left.
    pub texels: Vec<[i16; 2]>,
    /// Three vertices, then three texture coordinates.
    pub triangles: Vec<[u16; 6]>,
    pub frames: Vec<Frame>,
}

impl Model {
    pub fn bytes(&self) -> Vec<u8> {
        const HEADER: usize = 17 * 4;
        const SKIN: usize = 64;
        let vertices = self.frames.first().map_or(0, |frame| frame.vertices.len());
        let skins = usize::from(self.skin.is_some());
        let frame_bytes = 40 + vertices * 4;
        let texels_at = HEADER + skins * SKIN;
        let triangles_at = texels_at + self.texels.len() * 4;
        let frames_at = triangles_at + self.triangles.len() * 12;
        let end = frames_at + self.frames.len() * frame_bytes;
        let mut bytes = b"IDP2".to_vec();
        let numbers = [
            8,
            self.skin_size[0] as usize,
            self.skin_size[1] as usize,
            frame_bytes,
            skins,
            vertices,
            self.texels.len(),
            self.triangles.len(),
            0,
            self.frames.len(),
            HEADER,
            texels_at,
            triangles_at,
            frames_at,
            end,
            end,
        ];
        numbers.iter().for_each(|number| bytes.extend((*number as u32).to_le_bytes()));
        bytes.extend(self.skin.iter().flat_map(|name| padded::<SKIN>(name)));
        self.texels.as_flattened().iter().for_each(|number| bytes.extend(number.to_le_bytes()));
        self.triangles.as_flattened().iter().for_each(|index| bytes.extend(index.to_le_bytes()));
        for frame in &self.frames {
            frame.scale.iter().chain(&frame.translation).for_each(|number| bytes.extend(number.to_le_bytes()));
            bytes.extend(padded::<16>(&frame.name));
            // The fourth byte is a normal out of the game's table, which nobody here reads.
            frame.vertices.iter().for_each(|[x, y, z]| bytes.extend([*x, *y, *z, 0]));
        }
        bytes
    }
}

/// A text in a field of so many bytes, zeros behind it.
fn padded<const LENGTH: usize>(text: &str) -> [u8; LENGTH] {
    let mut field = [0; LENGTH];
    field[..text.len()].copy_from_slice(text.as_bytes());
    field
}
