//! Where a 3DS file's animation has an object in its first frame, which others may carry.

use super::{chunk, chunks};
use crate::bytes::Bytes;
use crate::limits::NODE_LEVELS;
use glam::{DMat4, DQuat, DVec3};
use std::collections::HashMap;

/// An object in the animation.
#[derive(Default)]
pub(super) struct Node {
    pub name: String,
    pub number: u16,
    /// The number of the node that carries it, if there is one of that number.
    carrier: Option<u16>,
    pivot: [f32; 3],
    /// Where its pivot lies in its carrier's space.
    place: Option<[f32; 3]>,
    /// Clockwise by radians around an axis.
    turn: [f32; 4],
    scale: Option<[f32; 3]>,
}

impl Node {
    /// Reads a node up to its first damaged part; it may hold its number, in place of this one.
    pub(super) fn read(number: usize, bytes: Bytes<'_>) -> Self {
        let mut node = Self { number: number as u16, ..Self::default() };
        for (number, mut data) in chunks(bytes).flatten() {
            match number {
                chunk::NODE_NUMBER => node.number = data.u16().unwrap_or(node.number),
                chunk::NODE_HEADER => {
                    node.name = data.text().unwrap_or_default();
                    // Behind two flags.
                    node.carrier = data.u32().and_then(|_| data.u16());
                }
                chunk::PIVOT => node.pivot = data.floats().unwrap_or_default(),
                chunk::PLACES => node.place = first_key(data),
                chunk::TURNS => node.turn = first_key(data).unwrap_or_default(),
                chunk::SCALES => node.scale = first_key(data),
                _ => {}
            }
        }
        node
    }

    /// From where the editor has the mesh, by its matrix, to where the animation first has it; `None` if that is unknown.
    pub(super) fn place(&self, world_from_own: DMat4, numbered: &HashMap<u16, &Self>) -> Option<DMat4> {
        self.place?;
        let carriers = std::iter::successors(Some(self), |node| numbered.get(&node.carrier?).copied());
        let placed = carriers.take(NODE_LEVELS).fold(DMat4::IDENTITY, |own, node| node.carrier_from_own() * own);
        // Where the matrix mirrors, the animation turns the mesh's own x round.
        let mirrored = DMat4::from_scale(DVec3::new(world_from_own.determinant().signum(), 1.0, 1.0));
        let own = DMat4::from_translation(-vector(self.pivot)) * mirrored * world_from_own.inverse();
        Some(placed * own).filter(DMat4::is_finite)
    }

    fn carrier_from_own(&self) -> DMat4 {
        let [angle, axis @ ..] = self.turn.map(f64::from);
        let turn = DQuat::from_axis_angle(DVec3::from_array(axis).normalize_or(DVec3::Z), -angle);
        let (scale, place) = (self.scale.unwrap_or([1.0; 3]), self.place.unwrap_or_default());
        DMat4::from_scale_rotation_translation(vector(scale), turn, vector(place))
    }
}

/// A track's value in its first frame.
fn first_key<const N: usize>(mut track: Bytes<'_>) -> Option<[f32; N]> {
    /// Of the flags and lengths before the number of keys.
    const HEAD_BYTES: usize = 10;
    track.take(HEAD_BYTES)?;
    let (_keys, _frame) = (track.u32().filter(|keys| *keys > 0)?, track.u32()?);
    // Five bits say which numbers for splines stand before the values.
    let splines = (track.u16()? & 0x1f).count_ones() as usize;
    track.take(splines * size_of::<f32>())?;
    track.floats()
}

/// A file's vector in the precision that is computed with.
pub(super) fn vector(of: [f32; 3]) -> DVec3 {
    DVec3::from_array(of.map(f64::from))
}
