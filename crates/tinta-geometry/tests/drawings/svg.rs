//! Lines as SVG, from hand-made ones: read back by an XML parser and drawn by a renderer that is not ours.

use crate::support::drawn::{lines, segment};
use crate::support::rendered::rendered;
use glam::DVec2;
use resvg::{tiny_skia, usvg};
use roxmltree::{Document, Node};
use std::collections::BTreeSet;
use tinta::edges::Class;
use tinta::lines::{HiddenLines, Length, LineSegment, PageSize, ScenePart, raster, svg};
use tinta::{Background, Color, DrawingSettings, VisibleLines};

const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";

/// A square of silhouettes from shuffled pieces, a crease through it with a hidden part, an intersection.
pub fn drawing() -> VisibleLines {
    use Class::{Crease, Intersection, Silhouette};
    lines(vec![
        segment(Silhouette, true, [100.0, 10.0], [100.0, 70.0]),
        segment(Crease, true, [20.0, 40.0], [50.0, 40.0]),
        segment(Silhouette, true, [20.0, 10.0], [20.0, 70.0]),
        segment(Crease, false, [50.0, 40.0], [100.0, 40.0]),
        segment(Silhouette, true, [100.0, 70.0], [20.0, 70.0]),
        segment(Silhouette, true, [100.0, 10.0], [20.0, 10.0]),
        segment(Intersection, true, [30.0, 20.123_456], [90.0, 60.0]),
    ])
}

fn layers<'a>(document: &'a Document) -> Vec<Node<'a, 'a>> {
    document.root_element().children().filter(|node| node.has_tag_name("g")).collect()
}

pub fn names(text: &str) -> Vec<String> {
    layers(&Document::parse(text).unwrap()).iter().map(|layer| layer.attribute("id").unwrap().to_owned()).collect()
}

/// All path data of a layer, in order.
pub fn data(text: &str, layer: &str) -> Vec<String> {
    let document = Document::parse(text).unwrap();
    let layer = layers(&document).into_iter().find(|node| node.attribute("id") == Some(layer)).unwrap();
    let paths = layer.descendants().filter(|node| node.has_tag_name("path"));
    paths.map(|path| path.attribute("d").unwrap().to_owned()).collect()
}

/// The points of path data that has straight lines only.
pub fn points(data: &str) -> Vec<DVec2> {
    let numbers: Vec<f64> =
        data.split(['M', 'L', 'Z', ' ']).filter(|word| !word.is_empty()).map(|word| word.parse().unwrap()).collect();
    numbers.chunks_exact(2).map(DVec2::from_slice).collect()
}

fn rgba(pixels: &tiny_skia::Pixmap, x: u32, y: u32) -> [u8; 4] {
    let color = pixels.pixel(x, y).unwrap().demultiply();
    [color.red(), color.green(), color.blue(), color.alpha()]
}

#[test]
fn pixels_of_lines_are_those_that_another_renderer_makes_of_their_svg() {
    let settings = DrawingSettings::default();
    for hidden in [HiddenLines::None, HiddenLines::Dashed, HiddenLines::Ghost] {
        for background in [Background::Color(Color([1.0; 3])), Background::Transparent] {
            let settings =
                DrawingSettings { hidden, background, line_width: Some(Length::Px(3.0)), ..settings.clone() };
            let ours = raster(&drawing(), &settings).unwrap();
            let theirs = rendered(&svg(&drawing(), &settings).unwrap(), 1.0);
            assert_eq!((ours.size.width, ours.size.height), (theirs.width(), theirs.height()));
            let (mut sum, mut far) = (0u64, 0);
            for (index, pixel) in ours.pixels.chunks_exact(4).enumerate() {
                let [x, y] = [index as u32 % theirs.width(), index as u32 / theirs.width()];
                // The covered share, on white.
                let on_white = |[red, _, _, alpha]: [u8; 4]| 255 - u32::from(255 - red) * u32::from(alpha) / 255;
                let difference = on_white(pixel.try_into().unwrap()).abs_diff(on_white(rgba(&theirs, x, y)));
                sum += u64::from(difference);
                far += usize::from(difference > 40);
            }
            let inked = ours.pixels.chunks_exact(4).filter(|pixel| pixel[3] > 128 && pixel[0] < 128).count();
            assert!(inked > 500, "{inked}");
            let mean = sum as f64 / inked as f64;
            assert!(mean < 4.0 && far < inked / 50, "{hidden:?}: {mean} {far} of {inked}");
        }
    }
}

#[test]
fn layers_are_groups_by_class_and_visibility_with_the_hidden_ones_below() {
    let text = svg(&drawing(), &DrawingSettings { hidden: HiddenLines::Dashed, ..DrawingSettings::default() }).unwrap();
    let document = Document::parse(&text).unwrap();
    let root = document.root_element();
    assert_eq!(root.attribute("viewBox"), Some("0 0 120 80"));
    assert_eq!((root.attribute("width"), root.attribute("height")), (Some("120"), Some("80")));
    assert_eq!(names(&text), ["hidden-crease", "visible-intersection", "visible-crease", "visible-silhouette"]);
    for layer in layers(&document) {
        assert_eq!(layer.attribute((INKSCAPE, "groupmode")), Some("layer"));
        assert_eq!(layer.attribute((INKSCAPE, "label")).unwrap().replace(' ', "-"), layer.attribute("id").unwrap());
        assert_eq!(layer.attribute("fill"), Some("none"));
        let is_hidden = layer.attribute("id").unwrap().starts_with("hidden");
        assert_eq!(layer.attribute("stroke-dasharray"), is_hidden.then_some("6 5"));
    }
    assert!(document.descendants().all(|node| !node.has_tag_name("image")));
    let without = svg(&drawing(), &DrawingSettings::default()).unwrap();
    assert_eq!(names(&without), ["visible-intersection", "visible-crease", "visible-silhouette"]);
}

#[test]
fn each_of_several_parts_is_a_group_with_an_id_and_a_title_and_the_picture_stays() {
    let mut whole = drawing();
    (0..).zip(&mut whole.segments).for_each(|(number, segment)| segment.part = number % 3);
    let settings = DrawingSettings { hidden: HiddenLines::Ghost, ..DrawingSettings::default() };
    let of_pen = DrawingSettings { is_for_pen: true, ..settings.clone() };
    let (plain, plain_of_pen) = (svg(&whole, &settings).unwrap(), svg(&whole, &of_pen).unwrap());
    let parted = |parts: [[&str; 2]; 3]| {
        let part =
            |[model, name]: [&str; 2]| ScenePart { model: model.into(), name: name.into(), ..Default::default() };
        VisibleLines { parts: parts.map(part).to_vec(), ..whole.clone() }
    };
    for alone in [[["a", ""], ["a", ""], ["a", ""]], [["a", ""], ["a", "bolt"], ["a", "section"]]] {
        assert_eq!(svg(&parted(alone), &settings).unwrap(), plain, "one part has nothing beside it");
    }
    let bolts = [["a", ""], ["a", "bolt <1>"], ["a", "bolt_x0020_1"]];
    for (parts, names) in [
        (bolts, &["bolt <1>", "bolt_x0020_1"][..]),
        ([["a.stl", ""], ["b.stl", ""], ["b.stl", "pin"]], &["a.stl", "b.stl", "b.stl pin"]),
    ] {
        let text = svg(&parted(parts), &settings).unwrap();
        assert_eq!(svg(&parted(parts), &of_pen).unwrap(), plain_of_pen, "a pen's way is the shortest");
        let document = Document::parse(&text).unwrap();
        let nodes = || document.descendants();
        let ids: Vec<&str> = nodes().filter_map(|node| node.attribute("id")).collect();
        assert_eq!(ids.iter().collect::<BTreeSet<_>>().len(), ids.len(), "{ids:?}");
        let is_in_name = |letter: char| letter.is_ascii_alphanumeric() || "-_.".contains(letter);
        assert!(ids.iter().all(|id| id.starts_with(char::is_alphabetic) && id.chars().all(is_in_name)), "{ids:?}");
        let groups: Vec<Node<'_, '_>> = nodes().filter(|node| node.has_attribute("data-part")).collect();
        assert_eq!(
            groups.iter().filter_map(|group| group.attribute("data-part")).collect::<BTreeSet<_>>(),
            names.iter().copied().collect()
        );
        for group in groups {
            let title = group.first_element_child().unwrap();
            assert_eq!((title.tag_name().name(), title.text()), ("title", group.attribute("data-part")));
            let layer = group.parent_element().and_then(|layer| layer.attribute("id")).unwrap();
            assert!(group.attribute("id").unwrap().starts_with(&format!("{layer}_")));
        }
        let [ours, theirs] = [&text, &plain].map(|text| rendered(text, 2.0));
        // Two round ends in place of a round corner have another smooth edge.
        let far: Vec<u8> =
            ours.data().iter().zip(theirs.data()).map(|(a, b)| a.abs_diff(*b)).filter(|by| *by > 8).collect();
        assert!(far.len() < 40 && far.iter().all(|by| *by < 64), "{far:?}");
    }
    // The ring is split where its part changes, and no stroke is lost or drawn twice.
    let text = svg(&parted(bolts), &settings).unwrap();
    assert_eq!(data(&text, "visible-silhouette"), ["M100 10L100 70", "M100 70L20 70", "M20 70L20 10 100 10"]);
}

#[test]
fn pieces_are_chained_and_written_short() {
    let text = svg(&drawing(), &DrawingSettings::default()).unwrap();
    assert_eq!(data(&text, "visible-silhouette"), ["M100 10L100 70 20 70 20 10Z"]);
    assert_eq!(data(&text, "visible-crease"), ["M20 40L50 40"]);
    assert_eq!(data(&text, "visible-intersection"), ["M30 20.123L90 60"]);
    let straight: Vec<LineSegment> = (0..50)
        .map(|k| {
            let at = |k: u32| [10.0 + f64::from(k) / 3.0, 5.0 + f64::from(k) / 7.0];
            segment(Class::Crease, true, at(k), at(k + 1))
        })
        .collect();
    let text = svg(&lines(straight), &DrawingSettings::default()).unwrap();
    assert_eq!(data(&text, "visible-crease"), ["M10 5L26.667 12.143"]);
}

#[test]
fn the_same_lines_are_the_same_bytes() {
    let settings = DrawingSettings { hidden: HiddenLines::Ghost, ..DrawingSettings::default() };
    for is_for_pen in [false, true] {
        let settings = DrawingSettings { is_for_pen, ..settings.clone() };
        assert_eq!(svg(&drawing(), &settings).unwrap(), svg(&drawing(), &settings).unwrap());
    }
}

#[test]
fn every_number_is_finite_and_inside_the_picture() {
    let border = 80.0_f64.next_up();
    let mut edge_cases = drawing();
    edge_cases.segments.push(segment(Class::Boundary, true, [-0.0, -1e-9], [120.0, border]));
    edge_cases.segments.push(segment(Class::Boundary, true, [60.0, 1e-300], [60.0, 2e-300]));
    for is_for_pen in [false, true] {
        let settings = DrawingSettings { hidden: HiddenLines::Dashed, is_for_pen, ..DrawingSettings::default() };
        let text = svg(&edge_cases, &settings).unwrap();
        assert!(!text.contains("NaN") && !text.contains("inf") && !text.contains("-0"), "{text}");
        for layer in names(&text) {
            for point in data(&text, &layer).iter().flat_map(|data| points(data)) {
                assert!((0.0..=120.0).contains(&point.x) && (0.0..=80.0).contains(&point.y), "{point}");
            }
        }
    }
    for bad in [[f64::NAN, 1.0], [f64::INFINITY, 1.0], [121.0, 1.0], [1.0, -1.0]] {
        let broken = lines(vec![segment(Class::Crease, true, [1.0, 1.0], bad)]);
        let message = svg(&broken, &DrawingSettings::default()).unwrap_err().to_string();
        assert!(message.starts_with("line 0 from"), "{message}");
    }
}

#[test]
fn an_empty_drawing_is_a_sound_file() {
    let text = svg(&lines(Vec::new()), &DrawingSettings::default()).unwrap();
    assert!(names(&text).is_empty());
    assert_eq!(rgba(&rendered(&text, 1.0), 60, 40), [255; 4]);
}

#[test]
fn any_command_and_title_can_be_read_back() {
    let nasty = "tinta render 'a<b>&\"c\"]]>.obj' --\u{1}\u{0}\u{1b}[31m é→🖋\u{ffff} <!-- \n\t";
    let settings = DrawingSettings { title: nasty.to_owned(), command: nasty.to_owned(), ..DrawingSettings::default() };
    let text = svg(&drawing(), &settings).unwrap();
    let document = Document::parse(&text).unwrap();
    let mended: String =
        nasty.chars().map(|c| if "\u{1}\u{0}\u{1b}\u{ffff}".contains(c) { '\u{fffd}' } else { c }).collect();
    for name in ["description", "title"] {
        let node = document.descendants().find(|node| node.tag_name().name() == name).unwrap();
        assert_eq!(node.text(), Some(mended.as_str()));
    }
    let metadata = document.descendants().find(|node| node.has_tag_name("metadata")).unwrap();
    assert!(metadata.descendants().any(|node| node.tag_name().name() == "description"));
}

#[test]
fn another_renderer_draws_the_lines_where_they_are() {
    let mut settings = DrawingSettings {
        class_colors: "crease=red,hidden=red".parse().unwrap(),
        class_widths: "silhouette=6,hidden=2".parse().unwrap(),
        hidden: HiddenLines::Ghost,
        ..DrawingSettings::default()
    };
    let pixels = rendered(&svg(&drawing(), &settings).unwrap(), 1.0);
    assert_eq!((pixels.width(), pixels.height()), (120, 80));
    assert_eq!(rgba(&pixels, 5, 5), [255; 4], "the background");
    for (x, y) in [(60, 10), (98, 40), (102, 40), (20, 69), (97, 71)] {
        assert_eq!(rgba(&pixels, x, y), [0, 0, 0, 255], "silhouette at {x}, {y}");
    }
    assert_eq!(rgba(&pixels, 35, 40), [255, 0, 0, 255], "crease, seen");
    let [red, green, _, _] = rgba(&pixels, 80, 40);
    assert!(red == 255 && (170..190).contains(&green), "crease, hidden: {red} {green}");
    let transparent = DrawingSettings { background: Background::Transparent, ..settings.clone() };
    assert_eq!(rgba(&rendered(&svg(&drawing(), &transparent).unwrap(), 1.0), 5, 5)[3], 0);
    settings.hidden = HiddenLines::Dashed;
    let pixels = rendered(&svg(&drawing(), &settings).unwrap(), 1.0);
    let greens: Vec<u8> = (55..95).map(|x| rgba(&pixels, x, 40)[1]).collect();
    assert!(greens.contains(&0) && greens.contains(&255), "dashes and gaps: {greens:?}");
}

#[test]
fn a_pens_lines_come_in_an_order_that_spares_the_way() {
    let at = |k: u32| [f64::from(k * 7919 % 110) + 2.0, f64::from(k * 104_729 % 70) + 2.0];
    let scattered: Vec<LineSegment> =
        (0..300).map(|k| segment(Class::Crease, true, at(k), [at(k)[0] + 3.0, at(k)[1] + 0.25])).collect();
    let travel = |is_for_pen: bool| {
        let settings = DrawingSettings { is_for_pen, min_length: Some(Length::Px(0.0)), ..DrawingSettings::default() };
        let text = svg(&lines(scattered.clone()), &settings).unwrap();
        assert_eq!(text.contains("<rect"), !is_for_pen);
        let paths: Vec<Vec<DVec2>> = data(&text, "visible-crease").iter().map(|data| points(data)).collect();
        let ways = paths.windows(2).map(|pair| pair[0].last().unwrap().distance(pair[1][0]));
        (paths.len(), ways.sum::<f64>())
    };
    let ((count, unsorted), (sorted_count, sorted)) = (travel(false), travel(true));
    assert_eq!(count, sorted_count);
    assert!(sorted < unsorted * 0.3, "{sorted} {unsorted}");
    let hidden = DrawingSettings { is_for_pen: true, hidden: HiddenLines::Dashed, ..DrawingSettings::default() };
    let text = svg(&drawing(), &hidden).unwrap();
    assert!(data(&text, "hidden-crease").len() > 20 && !text.contains("stroke-dasharray"));
}

#[test]
fn sizes_on_paper_are_millimetres_or_inches() {
    let size = |page_size| {
        let text = svg(&drawing(), &DrawingSettings { page_size, ..DrawingSettings::default() }).unwrap();
        let document = Document::parse(&text).unwrap();
        let attribute = |name| document.root_element().attribute(name).unwrap().to_owned();
        assert_eq!(attribute("viewBox"), "0 0 120 80");
        let drawn = usvg::Tree::from_str(&text, &usvg::Options::default()).unwrap().size();
        assert!((drawn.width() / drawn.height() - 1.5).abs() < 1e-4);
        (attribute("width"), attribute("height"))
    };
    assert_eq!(size(PageSize::WidthMm(180.0)), ("180mm".to_owned(), "120mm".to_owned()));
    assert_eq!(size(PageSize::Dpi(300.0)), ("0.4in".to_owned(), "0.266667in".to_owned()));
}

#[test]
fn nonsense_settings_are_refused_by_name() {
    let message = |settings: DrawingSettings| svg(&drawing(), &settings).unwrap_err().to_string();
    assert!(
        message(DrawingSettings { line_width: Some(Length::Px(0.0)), ..DrawingSettings::default() })
            .starts_with("line-width 0")
    );
    let page_size = PageSize::WidthMm(f64::NAN);
    assert!(message(DrawingSettings { page_size, ..DrawingSettings::default() }).starts_with("width-mm NaN"));
}

#[test]
fn an_outline_is_a_layer_of_its_own_above_the_others_whatever_its_classes() {
    let mut outlined = drawing();
    for segment in &mut outlined.segments {
        segment.is_outline = segment.class == Class::Silhouette;
    }
    outlined.segments[0].class = Class::Boundary;
    let class_widths = "outline=3,silhouette=2.5".parse().unwrap();
    let class_colors = "outline=navy".parse().unwrap();
    let settings = DrawingSettings { class_widths, class_colors, ..DrawingSettings::default() };
    let text = svg(&outlined, &settings).unwrap();
    assert_eq!(names(&text), ["visible-intersection", "visible-crease", "visible-outline"]);
    assert_eq!(data(&text, "visible-outline"), ["M100 10L100 70 20 70 20 10Z"]);
    let document = Document::parse(&text).unwrap();
    let layer = layers(&document).into_iter().last().unwrap();
    assert_eq!((layer.attribute("stroke"), layer.attribute("stroke-width")), (Some("#000080"), Some("3")));
    assert_eq!(layer.attribute((INKSCAPE, "label")), Some("visible outline"));
}

#[test]
fn on_paper_the_viewbox_is_the_sheet_and_widths_are_millimetres() {
    let page_size = PageSize::Paper("A4-portrait".parse().unwrap());
    let class_widths = "crease=0.25mm,hidden=0.1mm".parse().unwrap();
    let settings =
        DrawingSettings { page_size, class_widths, hidden: HiddenLines::Ghost, ..DrawingSettings::default() };
    let text = svg(&drawing(), &settings).unwrap();
    let document = Document::parse(&text).unwrap();
    let root = document.root_element();
    assert_eq!((root.attribute("width"), root.attribute("height")), (Some("210mm"), Some("297mm")));
    // 80 pixels of drawing fill 180 mm: 4 pixels are 9 mm.
    let view_box: Vec<f64> =
        root.attribute("viewBox").unwrap().split(' ').map(|number| number.parse().unwrap()).collect();
    let expected = [60.0 - 105.0 * 4.0 / 9.0, 40.0 - 148.5 * 4.0 / 9.0, 210.0 * 4.0 / 9.0, 297.0 * 4.0 / 9.0];
    assert!(view_box.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-5), "{view_box:?}");
    let width = |name: &str| {
        let layers = layers(&document);
        let layer = layers.iter().find(|layer| layer.attribute("id") == Some(name)).unwrap();
        layer.attribute("stroke-width").unwrap().parse::<f64>().unwrap() * 9.0 / 4.0
    };
    for (name, mm) in [("visible-silhouette", 0.5), ("visible-crease", 0.25), ("hidden-crease", 0.1)] {
        assert!((width(name) - mm).abs() < 0.002, "{name} {}", width(name));
    }
    // The sheet as a whole has the background's colour.
    let background = document.descendants().find(|node| node.attribute("id") == Some("background")).unwrap();
    assert_eq!(background.attribute("x").unwrap().parse::<f64>().unwrap(), view_box[0]);
    assert_eq!(data(&text, "visible-crease"), ["M20 40L50 40"], "the lines' own numbers stay");
}
