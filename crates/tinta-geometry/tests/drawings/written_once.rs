//! Lines that coincide in a file are written once, and none is lost; lines on the picture's rim are drawn.

use crate::support::families::FAMILIES;
use crate::support::lines::{assert_near, scene_of, total, view};
use crate::support::shapes::{Random, cuboid};
use glam::{DQuat, DVec3};
use std::collections::BTreeMap;
use tinta::lines::{HiddenLines, PageSize, chain, dxf, svg};
use tinta::{CameraSettings, DrawingSettings, LineSettings, Scene, SceneSettings, VisibleLines};

/// The stretches of the paths of an SVG, in thousandths of pixels.
fn stretches(svg: &str) -> Vec<[[i64; 2]; 2]> {
    let mut found = Vec::new();
    for data in svg.split(" d=\"").skip(1).map(|rest| rest.split('"').next().unwrap()) {
        let numbers = data.split(|it: char| it.is_ascii_alphabetic() || it == ' ').filter(|it| !it.is_empty());
        let steps: Vec<i64> = numbers.map(|it| (it.parse::<f64>().unwrap() * 1e3).round() as i64).collect();
        let mut points: Vec<[i64; 2]> = steps.chunks(2).map(|pair| [pair[0], pair[1]]).collect();
        if data.ends_with('Z') {
            points.push(points[0]);
        }
        found.extend(points.windows(2).map(|pair| [pair[0], pair[1]]).filter(|[a, b]| a != b));
    }
    found
}

fn length_px([[ax, ay], [bx, by]]: [[i64; 2]; 2]) -> f64 {
    ((bx - ax) as f64).hypot((by - ay) as f64) / 1e3
}

/// The length that stretches cover, each place once, and the length that they cover twice, pixels.
fn once_and_twice(stretches: &[[[i64; 2]; 2]]) -> [f64; 2] {
    let mut of_lines: BTreeMap<(i64, i64, i128), Vec<[f64; 2]>> = BTreeMap::new();
    for [a, b] in stretches {
        let (mut x, mut y) = (b[0] - a[0], b[1] - a[1]);
        let mut factor = [x.abs(), y.abs()];
        while factor[1] != 0 {
            factor = [factor[1], factor[0] % factor[1]];
        }
        let sign = if (x, y) < (0, 0) { -1 } else { 1 };
        (x, y) = (x / factor[0] * sign, y / factor[0] * sign);
        let offset = i128::from(x) * i128::from(a[1]) - i128::from(y) * i128::from(a[0]);
        let along = |point: &[i64; 2]| (point[0] * x + point[1] * y) as f64 / (x as f64).hypot(y as f64) / 1e3;
        of_lines.entry((x, y, offset)).or_default().push([along(a).min(along(b)), along(a).max(along(b))]);
    }
    let (mut once, mut twice) = (0.0, 0.0);
    for parts in of_lines.values_mut() {
        parts.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let mut reach = f64::NEG_INFINITY;
        for [from, to] in parts {
            once += (*to - from.max(reach)).max(0.0);
            twice += (to.min(reach) - *from).max(0.0);
            reach = reach.max(*to);
        }
    }
    [once, twice]
}

#[test]
fn the_edges_of_a_box_a_little_off_an_axis_are_written_once() {
    let box_from = |azimuth: &str| {
        let scene = scene_of(vec![cuboid(DVec3::splat(-2.0), DVec3::splat(2.0))], view(&format!("{azimuth},0"), true));
        VisibleLines::of(&scene, &LineSettings::default()).unwrap()
    };
    let right = total(&box_from("89.999995"), true);
    let lines = box_from("89.99995");
    assert!(total(&lines, true) > right + 400.0, "two lines in space");
    let settings = DrawingSettings::default();
    let of_svg: f64 = stretches(&svg(&lines, &settings).unwrap()).into_iter().map(length_px).sum();
    assert_near(of_svg, right, 0.01, "SVG");
    let pairs = dxf(&lines, &settings).unwrap();
    let values: Vec<(&str, &str)> = pairs.lines().collect::<Vec<_>>().chunks(2).map(|it| (it[0], it[1])).collect();
    let (mut of_dxf, mut polyline) = (0.0, Vec::new());
    let mut is_closed = false;
    for (at, (code, value)) in values.iter().enumerate() {
        match (*code, *value) {
            ("0", "POLYLINE") => polyline.clear(),
            ("70", closed) => is_closed = closed == "1",
            ("0", "VERTEX") => {
                let number =
                    |code: &str| values[at..].iter().find(|it| it.0 == code).unwrap().1.parse::<f64>().unwrap();
                polyline.push([number("10"), number("20")]);
            }
            ("0", "SEQEND") => {
                polyline.extend(is_closed.then_some(polyline[0]));
                of_dxf += polyline.windows(2).map(|it| (it[1][0] - it[0][0]).hypot(it[1][1] - it[0][1])).sum::<f64>();
            }
            _ => {}
        }
    }
    assert_near(of_dxf, right, 0.01, "DXF");
}

#[test]
fn in_drawings_of_every_family_nothing_is_written_twice_and_nothing_is_lost() {
    let (mut drawings, mut joined) = (0, 0);
    for (name, family) in FAMILIES {
        for seed in 0..4 {
            let scene = family(&mut Random::seeded(seed));
            let off = ["0.00005,0", "90.00004,0.00003", "180.00002,0", "0.00003,90"].map(|it| view(it, true));
            let others = off.into_iter().map(|camera| {
                scene.seen_with(&SceneSettings { camera, size: scene.size, ..SceneSettings::default() }).unwrap()
            });
            for scene in others.collect::<Vec<Scene>>().iter().chain([&scene]) {
                let lines =
                    VisibleLines::of(scene, &LineSettings { finds_hidden: true, ..Default::default() }).unwrap();
                let settings = DrawingSettings {
                    hidden: HiddenLines::Ghost,
                    min_length: Some("0".parse().unwrap()),
                    ..Default::default()
                };
                let written = stretches(&svg(&lines, &settings).unwrap());
                let [once, twice] = once_and_twice(&written);
                assert!(twice <= 1.5e-3 * written.len() as f64, "{name} {seed}: {twice} px twice");
                // The same paths as they came, straight in the same places.
                let before: Vec<_> = chain(&lines.segments)
                    .into_iter()
                    .flat_map(|path| {
                        let one = VisibleLines {
                            segments: path.segments.iter().map(|it| lines.segments[*it].clone()).collect(),
                            ..lines.clone()
                        };
                        stretches(&svg(&one, &settings).unwrap())
                    })
                    .collect();
                let [all, repeated] = once_and_twice(&before);
                assert_near(once, all, 2e-3 * before.len() as f64, name);
                drawings += 1;
                joined += usize::from(repeated > 1.0);
            }
        }
    }
    assert!(drawings > 100 && joined > 20, "{joined} of {drawings}");
}

#[test]
fn lines_on_the_pictures_rim_are_drawn_from_every_side() {
    for step in 0..48 {
        let azimuth = f64::from(step) * 7.5;
        let mut cube = cuboid(DVec3::NEG_ONE, DVec3::ONE);
        let turn = DQuat::from_rotation_y(azimuth.to_radians());
        cube.positions.iter_mut().for_each(|position| *position = turn * *position);
        let camera = CameraSettings { height: Some(2.0), ..view(&format!("{azimuth},0"), true) };
        let lines = VisibleLines::of(&scene_of(vec![cube], camera), &LineSettings::default()).unwrap();
        assert_near(total(&lines, true), 4.0 * 512.0, 1e-6, &format!("from {azimuth} degrees"));
        svg(&lines, &DrawingSettings::default()).unwrap();
    }
}

#[test]
fn a_dxf_in_millimetres_says_so() {
    let scene = scene_of(vec![cuboid(DVec3::NEG_ONE, DVec3::ONE)], view("30,20", false));
    let lines = VisibleLines::of(&scene, &LineSettings::default()).unwrap();
    for (page_size, is_said) in
        [(PageSize::Unset, false), (PageSize::WidthMm(180.0), true), (PageSize::Dpi(96.0), true)]
    {
        let text = dxf(&lines, &DrawingSettings { page_size, ..DrawingSettings::default() }).unwrap();
        assert_eq!(text.contains("\n9\n$INSUNITS\n70\n4\n9\n"), is_said, "{page_size:?}");
    }
}
