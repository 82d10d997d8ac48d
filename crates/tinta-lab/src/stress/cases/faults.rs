//! A driver that refuses, runs out of memory or loses its context, simulated by src/gl/faults.rs.

use super::case::{Case, Demand, Group, Work};
use crate::stress::Variant;
use tinta::gl::Fault;
use tinta::styles::StyleName;

pub(super) fn cases() -> Vec<Case> {
    let fails = |name: &str, fault, style, kind, words| {
        let work = Work::Fail(fault, Box::new(Variant::published(style)));
        Case::of(Group::Faults, name, work, Demand::Refused { kind, words })
    };
    use StyleName::{Charcoal, Inking, Mrt, ThreePass};
    vec![
        fails("a context is refused", Fault::ContextRefused, ThreePass, "no-context", "OpenGL 2.1"),
        fails("the first shader is refused", Fault::ShaderRefused { after: 0 }, ThreePass, "shader", "map.vert"),
        fails("the last shader is refused", Fault::ShaderRefused { after: 5 }, ThreePass, "shader", "border.frag"),
        fails("no memory at all", Fault::OutOfMemory { after: 0 }, ThreePass, "gl", "GL_OUT_OF_MEMORY"),
        fails("no memory for the third thing", Fault::OutOfMemory { after: 2 }, Inking, "gl", "GL_OUT_OF_MEMORY"),
        fails("no memory for a texture", Fault::OutOfMemory { after: 1 }, Charcoal, "gl", "GL_OUT_OF_MEMORY"),
        fails("a context lost at once", Fault::ContextLost { after: 0 }, ThreePass, "context-lost", "lost"),
        fails("a context lost while drawing", Fault::ContextLost { after: 4 }, Mrt, "context-lost", "lost"),
        fails("a context lost without a word", Fault::ContextReset { after: 3 }, ThreePass, "context-lost", "lost"),
    ]
}
