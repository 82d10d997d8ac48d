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

/// The same of pictures of thin strokes, whose pixels are nearly all at borders: of level ones the most.
const HATCHED_SHARE: f64 = 0.08;

/// Side of the squares, pixels, in whose mean the strokes are compared, and the largest difference of a channel there: the other program
/// only estimates how much of a pixel a thin stroke covers.
const SQUARE: usize = 16;
const LARGEST_IN_MEAN: f64 = 24.0;

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

/// The largest difference of a channel's mean in a square of two pictures of the same size.
fn apart_in_mean(one: &Picture, other: &[u8]) -> f64 {
    let width = one.size.width as usize;
    let mut sums = std::collections::HashMap::new();
    for (number, (a, b)) in one.pixels.iter().zip(other).enumerate() {
        let [x, y] = [number / 4 % width, number / 4 / width].map(|place| place / SQUARE);
        *sums.entry((x, y, number % 4)).or_insert(0.0) += f64::from(*a) - f64::from(*b);
    }
    sums.into_values().map(|sum: f64| sum.abs() / (SQUARE * SQUARE) as f64).fold(0.0, f64::max)
}

/// Draws a model by these options as PNG and as SVG; returns a message if more than this share of pixels differs, or one away from
/// borders.
fn apart(folder: &Folder, model: &str, options: &str, most_share: f64) -> Option<String> {
    let [png, svg] = ["a.png", "a.svg"].map(|name| folder.path(name));
    for out in [&png, &svg] {
        let words = ["render", model, "-o", out, "--no-recipe"].into_iter().chain(options.split(' '));
        done(&words.collect::<Vec<_>>());
    }
    let (picture, text) = (Picture::read_png(Path::new(&png)).unwrap(), std::fs::read_to_string(&svg).unwrap());
    let of_svg = Picture { size: picture.size, pixels: rendered(&text, 1.0).data().to_vec() };
    let (count, far) = different(&picture, &of_svg.pixels);
    let share = count as f64 / picture.size.pixel_count() as f64;
    let in_mean = apart_in_mean(&picture, &of_svg.pixels);
    println!("{model} {options}: {:.3} % differ, {} away from borders, {in_mean:.1} in mean", share * 100.0, far.len());
    (share > most_share || !far.is_empty() || in_mean > LARGEST_IN_MEAN).then(|| {
        let name = model.rsplit(['/', ':']).next().unwrap();
        let kept: String = options.chars().filter(|letter| letter.is_ascii_alphanumeric()).collect();
        let sheet = failure_folder().join(format!("one-drawing-{name}-{kept}.png"));
        write_rgba_png(&side_by_side(&of_svg, &picture), &sheet).unwrap();
        let (share, far) = (share * 100.0, &far[..far.len().min(5)]);
        format!("{model} {options}: {share:.3} %, far: {far:?}; {}", sheet.display())
    })
}

#[test]
fn a_looks_picture_and_its_vectors_differ_at_borders_alone() {
    let folder = Folder::new();
    let built_in = ["builtin:bust", "builtin:gear", "builtin:ant", "builtin:open-box"].map(str::to_owned);
    let public = PUBLIC_MODELS.iter().filter_map(|name| public_model(name));
    let mut failures = Vec::new();
    for model in built_in.into_iter().chain(public) {
        for look in ["print", "technical"] {
            // A photograph has details within a face.
            let options = format!("--look {look} --surface plain");
            failures.extend(apart(&folder, &model, &options, DIFFERENT_SHARE));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn strokes_of_tones_are_the_same_in_pixels_and_in_vectors() {
    let folder = Folder::new();
    let mut failures = Vec::new();
    for model in ["builtin:bust", "builtin:gear", "builtin:ant", "builtin:open-box"] {
        for options in [
            "--look print --hatch auto",
            "--look print --hatch 8,hatch-angle=30 --ground shadow",
            "--style three-pass --hatch 6 --no-borders --size 640x480",
        ] {
            failures.extend(apart(&folder, model, options, HATCHED_SHARE));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// A box each of whose faces shows the inside of one field of a palette, and the pictures of its colours.
fn palette_box(folder: &Folder) -> String {
    let colors = ["200 40 30", "40 90 200", "250 210 60", "60 150 70", "20 20 20", "250 250 250"];
    // Six fields of eight by eight texels beside one another.
    let row = colors.map(|color| format!("{color} ").repeat(8)).concat() + "\n";
    std::fs::write(folder.path("palette.ppm"), format!("P3 48 8 255\n{}", row.repeat(8))).unwrap();
    std::fs::write(folder.path("box.mtl"), "newmtl palette\nmap_Kd palette.ppm\n").unwrap();
    let corners = (0..8).map(|corner| format!("v {} {} {}\n", corner & 1, corner >> 1 & 1, corner >> 2));
    let places = (0..6).flat_map(|field| {
        let place = move |x: f64, y: f64| format!("vt {} {y}\n", (f64::from(field) + x) / 6.0);
        [place(0.2, 0.2), place(0.8, 0.2), place(0.8, 0.8), place(0.2, 0.8)]
    });
    let faces = ["5 6 8 7", "2 1 3 4", "3 7 8 4", "1 2 6 5", "6 2 4 8", "1 5 7 3"];
    let face = |(number, face): (usize, &str)| {
        let corners =
            face.split(' ').enumerate().map(|(corner, position)| format!(" {position}/{}", 4 * number + corner + 1));
        format!("f{}\n", corners.collect::<String>())
    };
    let faces = faces.into_iter().enumerate().map(face);
    let text = corners.chain(places).chain(["usemtl palette\n".to_owned()]).chain(faces).collect::<String>();
    let path = folder.path("box.obj");
    std::fs::write(&path, format!("mtllib box.mtl\n{text}")).unwrap();
    path
}

#[test]
fn a_palettes_colours_are_the_same_in_pixels_and_in_vectors() {
    let folder = Folder::new();
    let model = palette_box(&folder);
    let mut failures = Vec::new();
    for view in ["30,23", "150,-20", "-60,40"] {
        for options in
            ["--look print", "--look print --hatch auto", "--style three-pass --surface textured --exact-lines"]
        {
            let share = if options.contains("hatch") { HATCHED_SHARE } else { DIFFERENT_SHARE };
            failures.extend(apart(&folder, &model, &format!("{options} --view={view}"), share));
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    let svg = std::fs::read_to_string(folder.path("a.svg")).unwrap();
    assert!(svg.contains("object 0 palette"), "{svg}");
}
