//! The sentences about made-up measurements.

use super::*;
use crate::figures::mix::Mix;
use crate::figures::numbers::{ARTICLE, BackgroundRow, FilterRow, MixRow};
use crate::figures::series::Series;
use tinta::gl::is_software;
use tinta::styles::Filter;

#[test]
fn renderers_are_told_apart_by_their_names() {
    for software in ["llvmpipe (LLVM 15.0.6, 256 bits)", "softpipe", "Google SwiftShader", "Software Rasterizer"] {
        assert!(is_software(software), "{software}");
    }
    for hardware in ["NVIDIA GeForce RTX 3060/PCIe/SSE2", "Mesa Intel(R) UHD Graphics 620", "AMD Radeon Graphics"] {
        assert!(!is_software(hardware), "{hardware}");
    }
}

#[test]
fn hardware_is_never_called_a_program() {
    let host = |renderer: &str| Host {
        renderer: renderer.to_owned(),
        version: String::new(),
        threads: 1,
        is_software: is_software(renderer),
    };
    let (software, hardware) = (drawn_by(&host("llvmpipe")), drawn_by(&host("NVIDIA GeForce RTX 3060")));
    assert!(software.contains("llvmpipe draws, a program on 1 thread of"));
    assert!(hardware.contains("RTX 3060 draws") && !hardware.contains("program") && !hardware.contains("cores"));
}

fn series(median_ms: f64) -> Series {
    Series { median_ms, frames_ms: vec![median_ms], processor_ms: Vec::new() }
}

/// Two scenes; two passes take so many times as long as three, and the square's frames so long.
fn numbers(two_by_three: f64, per_triangle_ms: f64, without_ms: [f64; 2]) -> Numbers {
    let scenes = [1_000, 10_000].map(|triangles| MixRow {
        mix: Mix { wanted: triangles, triangles, gears: 0, ants: 0, busts: 0, box_cuts: 0 },
        covered: 0.5,
    });
    let frames = [1_000, 10_000].into_iter().flat_map(|triangles| {
        let three = 2.0 + triangles as f64 * per_triangle_ms;
        [(2, three * two_by_three), (3, three)].map(|(passes, ms)| FrameRow {
            triangles,
            tones: 3,
            passes,
            series: series(ms),
        })
    });
    let shader = |square_ms: f64| ShaderRow {
        name: "",
        fragments: Vec::new(),
        article_mpixels: None,
        mpixels: (square_ms > 0.0).then(|| square_ms.recip()),
        square_ms,
        squares_ms: vec![square_ms],
        with_square: series(square_ms + 1.0),
    };
    let background = |(distance, covered, without): (f64, f64, f64)| BackgroundRow {
        distance,
        covered,
        three_pass: series(4.0),
        two_pass: series(4.0),
        two_pass_without: series(without),
    };
    Numbers {
        host: Host { renderer: "llvmpipe".to_owned(), version: String::new(), threads: 2, is_software: true },
        size: ARTICLE.size,
        empty: series(0.5),
        scenes: scenes.to_vec(),
        frames: frames.collect(),
        filters: [(Filter::Laplacian4, 4.0), (Filter::Laplacian8, 5.0)]
            .map(|(filter, ms)| FilterRow { filter, series: series(ms) })
            .to_vec(),
        backgrounds: [(1.0, 0.5, without_ms[0]), (3.0, 0.1, without_ms[1])].map(background).to_vec(),
        shaders: [1.0, 2.0, 3.0, 4.0, 3.0, 6.0].map(shader).to_vec(),
        article: ARTICLE,
        reasons: Vec::new(),
    }
}

fn sentences(numbers: &Numbers, about: &str) -> String {
    let all = reasons(numbers).into_iter().filter(|reason| reason.about == about);
    all.map(|reason| reason.sentence).collect::<Vec<_>>().join(" ")
}

#[test]
fn two_passes_are_told_by_their_gains_and_no_verdict() {
    let slower = sentences(&numbers(1.25, 1e-3, [3.0, 2.0]), "frames");
    assert!(slower.contains("of three by -20 % to -20 % in 2 cases; the paper finds"), "{slower}");
}

#[test]
fn what_a_triangle_costs_follows_the_times() {
    let growth = |cost| sentences(&numbers(1.0, cost, [3.0, 2.0]), "frames");
    assert!(growth(1e-3).contains("75 % of the last scene's time comes with its triangles, 1000 ms for a million"));
    assert!(growth(0.0).contains("triangles cost nothing that could be measured"));
}

#[test]
fn gains_are_the_measured_ones() {
    let numbers = numbers(1.0, 1e-3, [4.0, 2.0]);
    let filter = sentences(&numbers, "filter");
    assert!(filter.contains("by +25 %, the border's square alone by +100 %"), "{filter}");
    let background = sentences(&numbers, "background");
    assert!(
        background.contains("largest, +100 %, where the bust covers 10 % of the picture, and smallest, 0 %"),
        "{background}"
    );
    let joint = sentences(&numbers, "throughput");
    assert!(joint.contains("costs 0.80 times") && joint.contains("2.0, 3.0 and 4.0 times"), "{joint}");
    assert_eq!([-0.3, 0.4, 12.5, -7.0].map(signed), ["0 %", "0 %", "+13 %", "-7 %"]);
}
