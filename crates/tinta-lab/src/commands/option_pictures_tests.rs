//! The pictures of docs/guide/options.md: the command below each heading draws them again, without the option of the heading and
//! with it, side by side.
//!
//! `TINTA_UPDATE_PICTURES=1 cargo test -p tinta-lab --all-features option_pictures` writes them anew and then fails, to make
//! every update deliberate; an option's name instead of 1 writes that one. One process and one context draw all of them, which
//! makes it cheap; the program's own functions parse the words, read the models and make the plans.

use super::program;
use std::collections::BTreeSet;
use std::ffi::OsString;
use std::io::BufWriter;
use std::path::{Path, PathBuf};
use tinta::cli::render;
use tinta::request::{ModelCache, Request};
use tinta::{Backend, Picture, Renderer, Size};

/// A pixel counts as different beyond this, 1/255: the rounding of another driver, and half a step of the files' fewer colours.
const LARGEST_DIFFERENCE: u8 = 12;

/// Share of pixels that may be different: edges and grains fall on other pixels where another driver rasterises differently.
const DIFFERENT_SHARE: f64 = 0.01;

/// Least share of a half that an option must change; below it the picture shows nothing.
const LEAST_CHANGE: f64 = 0.001;

/// Largest size of all pictures together, bytes.
const MOST_BYTES: u64 = 1536 * 1024;

/// Width of the line between both halves, pixels.
const GAP: u32 = 4;

/// Colours of the squares behind transparent pixels.
const CHECKS: [u8; 2] = [235, 205];

/// Commands with options that affect a drawing.
const COMMANDS: [&str; 3] = ["render", "compare", "measure"];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).unwrap()
}

fn page() -> String {
    std::fs::read_to_string(root().join("docs/guide/options.md")).unwrap()
}

/// A heading of the page with the text below it.
struct Section {
    /// Without its dashes.
    option: String,
    /// The words of its command, `tinta` first.
    words: Vec<String>,
    picture: PathBuf,
}

fn sections(page: &str) -> Vec<Section> {
    let options = page.split("\n### `--").skip(1).map(|text| text.split("\n## ").next().unwrap());
    let sections = options.flat_map(|text| {
        let option = text.split('`').next().unwrap().to_owned();
        // An option of several settings has a picture for each.
        let parts: Vec<&str> = text.split("\n#### ").filter(|part| part.contains("\n![")).collect();
        assert!(!parts.is_empty(), "no picture: {option}");
        parts.into_iter().map(move |part| section(&option, part)).collect::<Vec<_>>()
    });
    sections.collect()
}

fn section(option: &str, text: &str) -> Section {
    let command =
        text.lines().find_map(|line| line.strip_prefix("    ")).unwrap_or_else(|| panic!("no command: {option}"));
    let picture = text
        .split("](")
        .find_map(|rest| rest.strip_prefix("../").filter(|rest| rest.starts_with("pictures/")))
        .and_then(|rest| rest.split(')').next())
        .unwrap_or_else(|| panic!("no picture: {option}"));
    let words: Vec<String> = command.split_whitespace().map(str::to_owned).collect();
    assert_eq!(words[0], "tinta", "{option}: {command}");
    Section { option: option.to_owned(), words, picture: root().join("docs").join(picture) }
}

/// The command without its option.
fn without(section: &Section) -> Vec<String> {
    let whole = program().command_line();
    let command = whole.find_subcommand(&section.words[1]).unwrap();
    let arg = command.get_arguments().find(|arg| arg.get_long() == Some(&section.option));
    let arg = arg.unwrap_or_else(|| panic!("tinta {} has no --{}", section.words[1], section.option));
    let option = format!("--{}", section.option);
    // The last: an option may be given more than once.
    let at = section.words.iter().rposition(|word| word.split('=').next() == Some(&option));
    let at = at.unwrap_or_else(|| panic!("the command of {option} is without it"));
    let has_value = arg.get_action().takes_values() && section.words[at] == option && !arg.is_require_equals_set();
    let mut words = section.words.clone();
    words.drain(at..at + 1 + usize::from(has_value));
    words
}

/// Returns the command's picture.
fn drawn(renderer: &mut Renderer, words: &[String]) -> Picture {
    let refuse = |error: &dyn std::fmt::Display| -> ! { panic!("{}: {error}", words.join(" ")) };
    let folder = tempfile::tempdir().unwrap();
    let into = |name: &str| {
        let mut words: Vec<OsString> = words.iter().map(Into::into).collect();
        let at = words.iter().position(|word| word == "-o").unwrap() + 1;
        words[at] = folder.path().join(name).into();
        program().carry_out(words, std::time::Instant::now()).unwrap_or_else(|error| refuse(&error));
    };
    match words[1].as_str() {
        "render" => {
            let (request, output) = render::asked_by(words).unwrap_or_else(|error| refuse(&error));
            if output.ends_with(".svg") {
                into("drawing.svg");
                let drawing = std::fs::read_to_string(folder.path().join("drawing.svg")).unwrap();
                return rasterized(&drawing, request.scene.size);
            }
            opaque(tiled(pictures(&request, renderer).unwrap_or_else(|error| refuse(&error))))
        }
        // The picture of a comparison without times: it shows which drawing has each line.
        "compare" => {
            into("");
            Picture::read_png(&folder.path().join("lines.png")).unwrap()
        }
        _ => panic!("{}: no known way to draw its picture", words.join(" ")),
    }
}

/// One picture, or those of an animation.
fn pictures(request: &Request, renderer: &mut Renderer) -> tinta::Result<Vec<Picture>> {
    let (views, _) = render::views(request, &ModelCache::for_one())?;
    views.iter().map(|view| view.picture(renderer)).collect()
}

fn rasterized(svg: &str, size: Size) -> Picture {
    let tree = resvg::usvg::Tree::from_str(svg, &resvg::usvg::Options::default()).unwrap();
    let mut map = resvg::tiny_skia::Pixmap::new(size.width, size.height).unwrap();
    map.fill(resvg::tiny_skia::Color::WHITE);
    resvg::render(&tree, resvg::tiny_skia::Transform::identity(), &mut map.as_mut());
    Picture { size, pixels: map.data().to_vec() }
}

/// Four pictures in a square of half their size each; a single one unchanged.
fn tiled(mut pictures: Vec<Picture>) -> Picture {
    if pictures.len() == 1 {
        return pictures.remove(0);
    }
    assert_eq!(pictures.len(), 4, "an animation is shown by its four pictures");
    let size = pictures[0].size;
    let (half_width, half_height) = (size.width / 2, size.height / 2);
    let mut pixels = Vec::new();
    for y in 0..size.height {
        for x in 0..size.width {
            let picture = &pictures[(x / half_width + 2 * (y / half_height)) as usize];
            let [x, y] = [x % half_width, y % half_height].map(|value| i64::from(value * 2));
            let four = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(right, down)| picture.pixel(x + right, y + down));
            pixels.extend(
                (0..4).map(|channel| (four.iter().map(|pixel| u32::from(pixel[channel])).sum::<u32>() / 4) as u8),
            );
        }
    }
    Picture { size, pixels }
}

/// Squares of two greys behind transparent pixels.
fn opaque(mut picture: Picture) -> Picture {
    let width = picture.size.width as usize;
    for (number, pixel) in picture.pixels.chunks_exact_mut(4).enumerate() {
        let behind = CHECKS[(number % width / 8 + number / width / 8) % 2];
        let alpha = u32::from(pixel[3]);
        for channel in &mut pixel[..3] {
            *channel = ((u32::from(*channel) * alpha + u32::from(behind) * (255 - alpha) + 127) / 255) as u8;
        }
        pixel[3] = 255;
    }
    picture
}

fn side_by_side(left: &Picture, right: &Picture) -> Picture {
    assert_eq!(left.size, right.size);
    let Size { width, height } = left.size;
    let row = |picture: &Picture, y: usize| picture.pixels[y * width as usize * 4..][..width as usize * 4].to_vec();
    let pixels = (0..height as usize)
        .flat_map(|y| [row(left, y), [200, 200, 200, 255].repeat(GAP as usize), row(right, y)].concat())
        .collect();
    Picture { size: Size { width: 2 * width + GAP, height }, pixels }
}

/// With at most 256 colours, in the fewest bits a channel that give so few: a third of the full size.
fn write(picture: &Picture, path: &Path) {
    let reduced = |bits: u32| -> Vec<[u8; 3]> {
        let steps = (1u32 << bits) - 1;
        let nearest = |value: u8| (((u32::from(value) * steps + 127) / 255) * 255 / steps) as u8;
        picture.pixels.chunks_exact(4).map(|pixel| [nearest(pixel[0]), nearest(pixel[1]), nearest(pixel[2])]).collect()
    };
    let (colors, palette) = (2..=8)
        .rev()
        .map(|bits| {
            let colors = reduced(bits);
            let palette: BTreeSet<[u8; 3]> = colors.iter().copied().collect();
            (colors, palette.into_iter().collect::<Vec<_>>())
        })
        .find(|(_, palette)| palette.len() <= 256)
        .expect("two bits a channel are 64 colours");
    let indices: Vec<u8> = colors.iter().map(|color| palette.binary_search(color).unwrap() as u8).collect();
    std::fs::create_dir_all(path.parent().unwrap()).unwrap();
    let file = BufWriter::new(std::fs::File::create(path).unwrap());
    let mut encoder = png::Encoder::new(file, picture.size.width, picture.size.height);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_palette(palette.concat());
    encoder.set_compression(png::Compression::High);
    encoder.set_filter(png::Filter::NoFilter);
    encoder.write_header().unwrap().write_image_data(&indices).unwrap();
}

/// Share of pixels that differ by more than `limit`.
fn different_share(expected: &Picture, actual: &Picture, limit: u8) -> f64 {
    if expected.size != actual.size {
        return 1.0;
    }
    let pairs = expected.pixels.chunks_exact(4).zip(actual.pixels.chunks_exact(4));
    let is_different = |(a, b): &(&[u8], &[u8])| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > limit);
    pairs.filter(is_different).count() as f64 / expected.size.pixel_count() as f64
}

#[test]
fn the_pictures_of_the_options_are_what_their_commands_draw() {
    // Their commands name files from the top folder.
    std::env::set_current_dir(root()).unwrap();
    // One option's name, or 1 for all.
    let update = std::env::var("TINTA_UPDATE_PICTURES").ok();
    let mut sections = sections(&page());
    assert!(sections.len() > 60, "only {} options were found", sections.len());
    if let Some(name) = update.as_deref().filter(|name| *name != "1") {
        sections.retain(|section| section.option == name);
        assert!(!sections.is_empty(), "no option --{name} has a picture");
    }
    let mut renderer = Renderer::new(Backend::Auto).unwrap();
    let mut failures = Vec::new();
    for section in &sections {
        let [left, right] = [without(section), section.words.clone()].map(|words| drawn(&mut renderer, &words));
        let change = different_share(&left, &right, LARGEST_DIFFERENCE);
        if change < LEAST_CHANGE {
            failures.push(format!("--{}: only {:.3} % of the picture change", section.option, change * 100.0));
        }
        let actual = side_by_side(&left, &right);
        if update.is_some() {
            write(&actual, &section.picture);
            continue;
        }
        match Picture::read_png(&section.picture) {
            Err(error) => failures.push(format!("--{}: {error}", section.option)),
            Ok(expected) => {
                let share = different_share(&expected, &actual, LARGEST_DIFFERENCE);
                if share > DIFFERENT_SHARE {
                    failures.push(format!(
                        "--{}: {:.2} % of {} differ by more than {LARGEST_DIFFERENCE}/255 on {}, allowed {:.2} %",
                        section.option,
                        share * 100.0,
                        section.picture.display(),
                        renderer.context().renderer,
                        DIFFERENT_SHARE * 100.0
                    ));
                }
            }
        }
    }
    let how = "if you intended the change: TINTA_UPDATE_PICTURES=1 cargo test -p tinta-lab --all-features option_pictures, and look at them; \
               an option's name instead of 1 updates that one";
    assert!(failures.is_empty(), "{}\n{how}", failures.join("\n"));
    assert!(update.is_none(), "the pictures were written anew: look at them, then run without TINTA_UPDATE_PICTURES");
}

#[test]
fn the_folder_has_the_pages_pictures_and_no_others() {
    let named: BTreeSet<PathBuf> = sections(&page()).into_iter().map(|section| section.picture).collect();
    let folder = root().join("docs/pictures/options");
    let there: BTreeSet<PathBuf> = std::fs::read_dir(folder).unwrap().map(|file| file.unwrap().path()).collect();
    assert_eq!(named, there);
    let bytes: u64 = there.iter().map(|path| path.metadata().unwrap().len()).sum();
    assert!(bytes < MOST_BYTES, "the pictures take {bytes} bytes, allowed are {MOST_BYTES}");
}

#[test]
fn every_option_has_a_picture_or_a_reason_to_have_none() {
    let page = page();
    let pictured: BTreeSet<String> = sections(&page).into_iter().map(|section| section.option).collect();
    let (_, rest) = page.split_once("\n## Without a picture").unwrap();
    let reasons = rest.lines().filter_map(|line| line.strip_prefix("| `--")?.split_once("` | "));
    let mut excused = BTreeSet::new();
    for (option, reason) in reasons {
        assert!(reason.len() > 12, "--{option} has no reason: {reason}");
        assert!(excused.insert(option.to_owned()), "--{option} is excused twice");
    }
    let whole = program().command_line();
    let mut known = BTreeSet::new();
    for name in COMMANDS {
        let arguments = whole.find_subcommand(name).unwrap().get_arguments();
        for option in arguments
            .filter(|arg| !arg.is_hide_set())
            .filter_map(|arg| arg.get_long())
            .filter(|option| *option != "help")
        {
            assert!(
                pictured.contains(option) || excused.contains(option),
                "docs/guide/options.md shows no picture of tinta {name} --{option}: add a heading with a command, or the option and \
                 why it has none to the table \"Without a picture\""
            );
            known.insert(option.to_owned());
        }
    }
    let gone: Vec<_> = pictured.union(&excused).filter(|option| !known.contains(*option)).collect();
    assert!(gone.is_empty(), "docs/guide/options.md names options that no command has: {gone:?}");
    let both: Vec<_> = pictured.intersection(&excused).collect();
    assert!(both.is_empty(), "with a picture and excused from one: {both:?}");
    assert!(known.len() > 90, "only {} options were found", known.len());
}

#[test]
fn a_picture_of_fewer_colours_is_the_picture_within_the_tolerance_and_another_is_not() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("many.png");
    let size = Size { width: 64, height: 48 };
    let pixel = |number: usize| [(number % 251) as u8, (number / 64 * 5) as u8, (number % 64 * 4) as u8, 255];
    let picture = Picture { size, pixels: (0..size.pixel_count()).flat_map(pixel).collect() };
    write(&picture, &path);
    let read = Picture::read_png(&path).unwrap();
    let colors: BTreeSet<&[u8]> = read.pixels.chunks_exact(4).collect();
    assert!(colors.len() <= 256, "{}", colors.len());
    // At two bits a channel, enough for the picture of many colours, half a step is 43.
    assert_eq!(different_share(&picture, &read, 43), 0.0);
    let mut moved = picture.clone();
    moved.pixels.rotate_right(4 * 9);
    assert!(different_share(&picture, &moved, LARGEST_DIFFERENCE) > DIFFERENT_SHARE);
}
