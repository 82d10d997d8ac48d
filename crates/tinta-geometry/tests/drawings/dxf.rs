//! Lines as DXF: the polylines of the SVG in millimetres, each once, on layers by class.

use crate::support::families::FAMILIES;
use crate::support::shapes::Random;
use crate::support::{Folder, skip};
use crate::svg::{data, drawing, names, points};
use glam::DVec2;
use std::collections::BTreeMap;
use std::process::Command;
use tinta::lines::{HiddenLines, PageSize, dxf, svg};
use tinta::{DrawingSettings, LineSettings, VisibleLines};

/// Polylines by layer, each with whether it is closed, in the file's order.
type Polylines = BTreeMap<String, Vec<(Vec<DVec2>, bool)>>;

/// The entities of a file, read pair by pair.
fn read(text: &str) -> Polylines {
    let lines: Vec<&str> = text.lines().collect();
    assert!(lines.len().is_multiple_of(2) && text.ends_with("0\nEOF\n"));
    let mut pairs = lines.chunks(2).map(|pair| (pair[0].parse::<u32>().unwrap(), pair[1]));
    pairs.by_ref().find(|pair| *pair == (2, "ENTITIES")).unwrap();
    let (mut polylines, mut kind, mut layer, mut x) = (Polylines::new(), "", String::new(), 0.0);
    for (code, value) in pairs {
        match code {
            0 => kind = value,
            8 => {
                layer = value.to_owned();
                if ["POLYLINE", "POINT"].contains(&kind) {
                    polylines.entry(layer.clone()).or_default().push((Vec::new(), false));
                }
            }
            70 => polylines.get_mut(&layer).unwrap().last_mut().unwrap().1 = value == "1",
            10 => x = value.parse().unwrap(),
            20 => {
                let point = DVec2::new(x, value.parse().unwrap());
                polylines.get_mut(&layer).unwrap().last_mut().unwrap().0.push(point);
            }
            _ => {}
        }
    }
    polylines
}

/// The paths of an SVG in the coordinates of DXF: millimetres if it has a size on paper, from the lower left corner; and the size of a
/// pixel in them.
fn of_svg(text: &str) -> (Polylines, f64) {
    let document = roxmltree::Document::parse(text).unwrap();
    let of = |name: &str| document.root_element().attribute(name).unwrap().to_owned();
    let frame: Vec<f64> = of("viewBox").split(' ').map(|number| number.parse().unwrap()).collect();
    let width: f64 = of("width").trim_end_matches("mm").parse().unwrap();
    let place = |px: DVec2| DVec2::new(px.x - frame[0], frame[1] + frame[3] - px.y) * width / frame[2];
    let path = |data: String| (points(&data).into_iter().map(place).collect(), data.ends_with('Z'));
    let of_layer = |layer: String| (layer.clone(), data(text, &layer).into_iter().map(path).collect());
    (names(text).into_iter().map(of_layer).collect(), width / frame[2])
}

/// Lines of a family of scenes and of the drawing of other tests.
fn drawings() -> Vec<VisibleLines> {
    let mut drawings = vec![drawing()];
    for (_, family) in FAMILIES {
        let scene = family(&mut Random::seeded(3));
        drawings.push(VisibleLines::of(&scene, &LineSettings::default()).unwrap());
    }
    drawings
}

#[test]
fn a_dxf_has_the_polylines_of_the_svg_once_each_in_millimetres() {
    let paper = PageSize::Paper("A4".parse().unwrap());
    let mut compared = 0;
    for lines in drawings() {
        for page_size in [PageSize::Unset, PageSize::WidthMm(180.0), paper] {
            for (hidden, is_for_pen) in
                [(HiddenLines::None, false), (HiddenLines::Ghost, false), (HiddenLines::Dashed, true)]
            {
                let settings = DrawingSettings { page_size, hidden, is_for_pen, ..DrawingSettings::default() };
                let text = dxf(&lines, &settings).unwrap();
                assert_eq!(text, dxf(&lines, &settings).unwrap());
                let found = read(&text);
                let (expected, pixel) = of_svg(&svg(&lines, &settings).unwrap());
                assert_eq!(found.keys().collect::<Vec<_>>(), expected.keys().collect::<Vec<_>>());
                for (layer, expected) in expected {
                    let found = &found[&layer];
                    assert_eq!(found.len(), expected.len(), "{layer}");
                    for ((found, is_closed), (expected, was_closed)) in found.iter().zip(&expected) {
                        assert_eq!((found.len(), is_closed), (expected.len(), was_closed), "{layer}");
                        // The SVG's coordinates are rounded to thousandths of pixels, those of the DXF to millionths.
                        let most = found.iter().zip(expected).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
                        assert!(most <= 0.5e-3 * pixel * 2f64.sqrt() + 1e-6, "{layer}: {most}");
                        compared += 1;
                    }
                }
            }
        }
    }
    assert!(compared > 1000, "{compared}");
}

/// Prints the polylines, their vertices and the layers of each file, and what ezdxf repairs or finds wrong.
const EZDXF: &str = "
import sys, ezdxf
for name in sys.argv[1:]:
    document = ezdxf.readfile(name)
    audit = document.audit()
    lines = [it for it in document.modelspace() if it.dxftype() == 'POLYLINE']
    layers = sorted({it.dxf.layer for it in document.modelspace()})
    assert all(layer in document.layers for layer in layers)
    print(len(lines), sum(len(it.vertices) for it in lines), len(audit.errors), len(audit.fixes), *layers)
";

#[test]
fn ezdxf_reads_the_same_polylines_and_finds_nothing_to_repair() {
    let python = |arguments: &[&str]| Command::new("python3").args(arguments).output();
    if !python(&["-c", "import ezdxf"]).is_ok_and(|done| done.status.success()) {
        return skip("ezdxf: python3 has no such package");
    }
    let folder = Folder::new();
    let (mut names, mut expected) = (Vec::new(), String::new());
    for (number, lines) in drawings().iter().enumerate() {
        let settings =
            DrawingSettings { hidden: HiddenLines::Dashed, page_size: PageSize::Dpi(96.0), ..Default::default() };
        let text = dxf(lines, &settings).unwrap();
        names.push(folder.file(&format!("{number}.dxf"), text.as_bytes()));
        let layers = read(&text);
        let polylines: Vec<usize> =
            layers.values().flatten().map(|(points, _)| points.len()).filter(|it| *it > 1).collect();
        let layers: Vec<&str> = layers.keys().map(String::as_str).collect();
        let vertices: usize = polylines.iter().sum();
        expected += &format!("{} {vertices} 0 0 {}\n", polylines.len(), layers.join(" "));
    }
    let done = python(&[&["-c", EZDXF], &names.iter().map(String::as_str).collect::<Vec<_>>()[..]].concat()).unwrap();
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    assert_eq!(String::from_utf8_lossy(&done.stdout), expected);
}
