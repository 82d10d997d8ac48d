//! One drawing in every file: a look's PNG and its SVG, drawn by another program, show the same.

use crate::program::done;
use crate::rendered::rendered;
use crate::support::{Folder, PUBLIC_MODELS, failure_folder, public_model, side_by_side};
use std::path::Path;
use tinta::Picture;
use tinta::picture::write_rgba_png;

/// Largest difference of a channel of one and the same pixel: both programs smooth edges, each in its own way.
const LARGEST_DIFFERENCE: u8 = 16;

/// Largest share of pixels that differ by more.
const DIFFERENT_SHARE: f64 = 0.005;

/// A border within a pixel of a pixel is seen in the second next one, be it ever so faint.
const REACH: usize = 2;

/// What two pictures of the same size differ in: the number of pixels, and those farther than a pixel from any border of the second.
fn different(one: &Picture, other: &[u8]) -> (usize, Vec<[usize; 2]>) {
    let [width, height] = [one.size.width, one.size.height].map(|side| side as usize);
    let apart =
        |a: &[u8], b: &[u8]| (0..3).map(|channel| a[channel].abs_diff(b[channel])).max().unwrap() > LARGEST_DIFFERENCE;
    let pixel = |x: usize, y: usize| &other[(y * width + x) * 4..][..4];
    let is_at_border = |x: usize, y: usize| {
        let around = |of: usize, side: usize| of.saturating_sub(REACH)..=(of + REACH).min(side - 1);
        around(y, height).any(|row| around(x, width).any(|column| pixel(column, row) != pixel(x, y)))
    };
    let places = (0..width * height).map(|number| [number % width, number / width]);
    let wrong: Vec<[usize; 2]> =
        places.filter(|[x, y]| apart(&one.pixels[(y * width + x) * 4..][..4], pixel(*x, *y))).collect();
    (wrong.len(), wrong.into_iter().filter(|[x, y]| !is_at_border(*x, *y)).collect())
}

#[test]
fn a_looks_picture_and_its_vectors_differ_at_borders_alone() {
    let folder = Folder::new();
    let built_in = ["builtin:bust", "builtin:gear", "builtin:ant", "builtin:open-box"].map(str::to_owned);
    let public = PUBLIC_MODELS.iter().filter_map(|name| public_model(name));
    let mut failures = Vec::new();
    for model in built_in.into_iter().chain(public) {
        for look in ["print", "technical"] {
            let [png, svg] = ["a.png", "a.svg"].map(|name| folder.path(name));
            for out in [&png, &svg] {
                // One colour without a texture, which vectors leave out.
                let options = ["--look", look, "--surface", "plain", "--no-recipe"];
                done(&[&["render", &model, "-o", out][..], &options].concat());
            }
            let (picture, text) = (Picture::read_png(Path::new(&png)).unwrap(), std::fs::read_to_string(&svg).unwrap());
            let of_svg = Picture { size: picture.size, pixels: rendered(&text, 1.0).data().to_vec() };
            let (count, far) = different(&picture, &of_svg.pixels);
            let share = count as f64 / picture.size.pixel_count() as f64;
            println!("{look} {model}: {:.3} % differ, {} away from borders", share * 100.0, far.len());
            if share > DIFFERENT_SHARE || !far.is_empty() {
                let name = model.rsplit(['/', ':']).next().unwrap();
                let sheet = failure_folder().join(format!("one-drawing-{look}-{name}.png"));
                write_rgba_png(&side_by_side(&of_svg, &picture), &sheet).unwrap();
                let (share, far) = (share * 100.0, &far[..far.len().min(5)]);
                failures.push(format!("{look} {model}: {share:.3} %, far: {far:?}; {}", sheet.display()));
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}
