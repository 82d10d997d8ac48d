//! Pictures of scenes of small parts: tiny and huge, slivers, far apart, repeated.

#[path = "../../fuzz/src/scenes.rs"]
mod scenes;

use crate::support::renderer;
use scenes::{DRAWINGS, drawing, scene};

/// Bytes that look random, the same on each run.
fn random(seed: u64) -> Vec<u8> {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 56) as u8
    };
    let parts = 1 + usize::from(next() % 5);
    (0..parts * 7).map(|_| next()).collect()
}

/// Draws so many scenes as vectors, and every tenth as pixels.
fn drawn_or_refused(count: u64) {
    let mut renderer = renderer(tinta::Backend::Auto);
    for seed in 0..count {
        let bytes = random(seed);
        println!("seed {seed}: {bytes:?}");
        drawing(&bytes);
        if seed % 10 != 0 {
            continue;
        }
        for options in DRAWINGS {
            let Ok((request, scene)) = scene(&bytes, options) else { continue };
            if let Err(error) = request.still(scene, false).and_then(|view| view.picture(&mut renderer)) {
                assert!(error.to_string().len() < 2000, "{error}");
            }
        }
    }
}

#[test]
fn small_scenes_are_drawn_or_refused() {
    drawn_or_refused(60);
}

#[test]
#[ignore = "nightly: 3,000 scenes, 300 of them as pictures"]
fn thousands_of_small_scenes_are_drawn_or_refused_nightly() {
    drawn_or_refused(3_000);
}
