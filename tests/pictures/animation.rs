//! Animations written and decoded again, without a GL context: pictures, delays, loops, holes.

use crate::support::{Folder, frames_of_gif, full_sizes};
use image::codecs::png::PngDecoder;
use image::{AnimationDecoder, Frame};
use std::fs::File;
use std::io::BufReader;
use tinta::{AnimationTarget, AnimationWriter, Picture, Size};

/// A disc of few colours that moves to the right on a plain background.
fn moving_disc(frames: u32, alpha: u8) -> Vec<Picture> {
    let size = Size { width: 61, height: 40 };
    let pixel = |frame: u32, x: u32, y: u32| {
        let (from_x, from_y) = (x as f32 - 10.0 - 4.0 * frame as f32, y as f32 - 20.0);
        match from_x.hypot(from_y) {
            distance if distance < 6.0 => [200, 30, 40 + frame as u8, 255],
            distance if distance < 9.0 => [0, 0, 0, 255],
            distance if distance < 10.0 => [0, 0, 0, if alpha == 255 { 255 } else { 160 }],
            distance if distance < 11.0 => [0, 0, 0, if alpha == 255 { 255 } else { 90 }],
            _ => [255, 254, 250, alpha],
        }
    };
    let picture = |frame| {
        let pixels = (0..size.height).flat_map(|y| (0..size.width).flat_map(move |x| pixel(frame, x, y)));
        Picture { size, pixels: pixels.collect() }
    };
    (0..frames).map(picture).collect()
}

/// More colours than a palette has: a gradient that shifts, above a flat field.
fn gradients(frames: u32) -> Vec<Picture> {
    let size = Size { width: 128, height: 128 };
    let picture = |frame: u32| {
        let pixel = move |x: u32, y: u32| match y {
            0..96 => [(x * 2) as u8, (y * 2 + frame) as u8, 128, 255],
            _ => [250, 247, 242, 255],
        };
        let pixels = (0..size.height).flat_map(|y| (0..size.width).flat_map(move |x| pixel(x, y)));
        Picture { size, pixels: pixels.collect() }
    };
    (0..frames).map(picture).collect()
}

fn write(name: &str, pictures: &[Picture], transparent: bool, delay_ms: u16) {
    let target = AnimationTarget::check(name, transparent).unwrap();
    let mut writer = AnimationWriter::new(target, pictures.len() as u32, delay_ms).unwrap();
    pictures.iter().for_each(|picture| writer.add(picture.clone()).unwrap());
    let written = writer.finish().unwrap();
    assert_eq!(written.encode_ms.len(), pictures.len());
    assert!(written.bytes > 0);
}

fn frames_of_apng(name: &str) -> Vec<Frame> {
    let decoder = PngDecoder::new(BufReader::new(File::open(name).unwrap())).unwrap();
    decoder.apng().unwrap().into_frames().collect_frames().unwrap()
}

fn assert_same(frames: &[Frame], pictures: &[Picture]) {
    assert_eq!(frames.len(), pictures.len());
    for (number, (frame, picture)) in frames.iter().zip(pictures).enumerate() {
        assert_eq!(frame.buffer().dimensions(), (picture.size.width, picture.size.height));
        assert!(*frame.buffer().as_raw() == picture.pixels, "frame {number} differs");
    }
}

fn delays_ms(frames: &[Frame]) -> Vec<u32> {
    frames.iter().map(|frame| frame.delay().numer_denom_ms().0 / frame.delay().numer_denom_ms().1).collect()
}

#[test]
fn a_gif_of_few_colours_is_exact_and_loops_with_its_delays() {
    let folder = Folder::new();
    let name = folder.path("disc.gif");
    let pictures = moving_disc(9, 255);
    write(&name, &pictures, false, 44);
    let frames = frames_of_gif(&name);
    assert_same(&frames, &pictures);
    // 44 ms in hundredths of a second: as many of 40 as of 50, and nine take 396 to the nearest hundredth.
    let delays = delays_ms(&frames);
    assert!(delays.iter().all(|delay| [40, 50].contains(delay)) && delays.iter().sum::<u32>() == 400, "{delays:?}");
    let bytes = std::fs::read(&name).unwrap();
    let netscape = bytes.windows(11).position(|window| window == b"NETSCAPE2.0").unwrap();
    assert_eq!(bytes[netscape + 11..][..4], [3, 1, 0, 0], "it repeats without end");
}

#[test]
fn an_apng_is_exact_with_alpha_and_loops() {
    let folder = Folder::new();
    for (alpha, transparent) in [(255, false), (0, true)] {
        let name = folder.path("disc.apng");
        let pictures = moving_disc(7, alpha);
        write(&name, &pictures, transparent, 33);
        let frames = frames_of_apng(&name);
        assert_same(&frames, &pictures);
        assert_eq!(delays_ms(&frames), [33; 7]);
        let bytes = std::fs::read(&name).unwrap();
        let control = bytes.windows(4).position(|window| window == b"acTL").unwrap();
        assert_eq!(bytes[control + 4..][..8], [0, 0, 0, 7, 0, 0, 0, 0], "seven frames, without end");
    }
}

#[test]
fn a_transparent_gif_keeps_ink_to_its_edge_and_no_fringe() {
    let folder = Folder::new();
    let name = folder.path("disc.gif");
    let pictures = moving_disc(6, 0);
    write(&name, &pictures, true, 50);
    // A pixel with at least half the alpha becomes opaque, in its own colour; the others become transparent.
    let expected: Vec<Picture> = pictures
        .into_iter()
        .map(|mut picture| {
            picture.pixels.chunks_exact_mut(4).for_each(|pixel| match pixel[3] {
                128.. => pixel[3] = 255,
                _ => pixel.fill(0),
            });
            picture
        })
        .collect();
    let frames = frames_of_gif(&name);
    for (number, (frame, picture)) in frames.iter().zip(&expected).enumerate() {
        for (found, wanted) in frame.buffer().pixels().zip(picture.pixels.chunks_exact(4)) {
            // The colour of a fully transparent pixel has no meaning.
            assert!(found.0 == wanted || (found.0[3] == 0 && wanted[3] == 0), "frame {number}: {found:?} {wanted:?}");
        }
    }
}

#[test]
fn what_stands_still_is_stored_once() {
    let folder = Folder::new();
    for extension in ["gif", "apng"] {
        let (still, single) = (folder.path(&format!("still.{extension}")), folder.path(&format!("one.{extension}")));
        let picture = gradients(1).remove(0);
        write(&single, std::slice::from_ref(&picture), false, 100);
        let frames = if full_sizes() { 10 } else { 4 };
        write(&still, &vec![picture; frames], false, 100);
        let length = |name: &str| std::fs::metadata(name).unwrap().len();
        assert!(length(&still) < length(&single) + (frames as u64 - 1) * 900, "{} {}", length(&still), length(&single));
    }
}

#[test]
fn more_than_256_colours_keep_flat_tones_and_come_near_the_others() {
    let folder = Folder::new();
    let name = folder.path("gradients.gif");
    let pictures = gradients(if full_sizes() { 4 } else { 2 });
    write(&name, &pictures, false, 100);
    let frames = frames_of_gif(&name);
    for (frame, picture) in frames.iter().zip(&pictures) {
        let mean = |channel: usize, left: u32, top: u32, value: &dyn Fn(u32, u32) -> [u8; 4]| -> f64 {
            let places = (0..64).map(|place| (left + place % 8, top + place / 8));
            places.map(|(x, y)| f64::from(value(x, y)[channel])).sum::<f64>() / 64.0
        };
        let found = |x, y| frame.buffer().get_pixel(x, y).0;
        let wanted = |x, y| picture.pixel(i64::from(x), i64::from(y));
        for (x, y) in (0..128).flat_map(|x| (96..128).map(move |y| (x, y))) {
            assert_eq!(found(x, y), wanted(x, y), "the flat field at {x}, {y}");
        }
        for (left, top) in (0..16).flat_map(|x| (0..12).map(move |y| (x * 8, y * 8))) {
            for channel in 0..3 {
                let (a, b) = (mean(channel, left, top, &found), mean(channel, left, top, &wanted));
                assert!((a - b).abs() < 4.0, "at {left}, {top}: {a}, wanted {b}");
            }
        }
    }
}

#[test]
fn numbered_pictures_are_written_one_by_one() {
    let folder = Folder::new();
    let pictures = moving_disc(3, 255);
    write(&folder.path("disc-%03d.png"), &pictures, false, 40);
    for (number, picture) in pictures.iter().enumerate() {
        let path = folder.path(&format!("disc-{:03}.png", number + 1));
        assert_eq!(Picture::read(path.as_ref()).unwrap(), *picture);
    }
}

#[test]
fn what_cannot_be_an_animation_is_refused_before_the_work() {
    let folder = Folder::new();
    let message = |name: &str, transparent| AnimationTarget::check(name, transparent).unwrap_err().to_string();
    for name in ["a.png", "a", "-", "a.jpg"] {
        let message = message(name, false);
        assert!(message.starts_with(&format!("{name}: ")) && message.contains("frame-%04d.png"), "{message}");
    }
    assert!(message("no/such/a.gif", false).contains("the folder no/such does not exist"));
    assert!(message("no/such/%d.png", false).contains("the folder no/such does not exist"));
    assert!(message(&folder.path("%d.jpg"), true).contains("no transparency"));
    std::fs::create_dir(folder.path("folder.gif")).unwrap();
    assert!(message(&folder.path("folder.gif"), false).contains("directory"));
    assert!(!AnimationTarget::is_meant_by("100%.png") && AnimationTarget::is_meant_by("a.GIF"));
}

#[test]
fn an_animation_without_all_its_pictures_is_not_written() {
    let folder = Folder::new();
    for name in ["a.gif", "a.apng"] {
        let name = folder.file(name, b"what was there");
        let begun = |frames| AnimationWriter::new(AnimationTarget::check(&name, false).unwrap(), frames, 40).unwrap();
        let pictures = moving_disc(3, 255);
        let mut early = begun(3);
        early.add(pictures[0].clone()).unwrap();
        drop(early);
        let mut short = begun(3);
        pictures[..2].iter().for_each(|picture| short.add(picture.clone()).unwrap());
        assert!(short.finish().unwrap_err().to_string().contains("only 2 of 3 pictures came"));
        let mut mixed = begun(2);
        mixed.add(pictures[0].clone()).unwrap();
        let other = Picture { size: Size { width: 1, height: 1 }, pixels: vec![0; 4] };
        let failed = mixed.add(other).and_then(|()| mixed.finish().map(drop)).unwrap_err().to_string();
        assert!(failed.contains("a picture of 1x1 follows one of 61x40"), "{failed}");
        assert_eq!(std::fs::read(&name).unwrap(), b"what was there");
        let target = AnimationTarget::check(&name, false).unwrap();
        assert!(AnimationWriter::new(target, 0, 40).is_err());
        let mut full = begun(1);
        full.add(pictures[0].clone()).unwrap();
        assert!(full.add(pictures[1].clone()).unwrap_err().to_string().contains("more pictures came"));
    }
}
