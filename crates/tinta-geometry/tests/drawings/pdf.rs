//! Lines as PDF: the lines of the SVG, on a page of the same size.

use crate::support::drawn::lines;
use crate::svg::{data, drawing, names, points};
use glam::DVec2;
use tinta::DrawingSettings;
use tinta::lines::{HiddenLines, PageSize, pdf, svg};

/// The file as text, a byte a letter, and its page's content.
fn read(bytes: &[u8]) -> (String, String) {
    let text: String = bytes.iter().map(|byte| char::from(*byte)).collect();
    let content = text.split("stream\n").nth(1).unwrap().split("\nendstream").next().unwrap().to_owned();
    (text, content)
}

/// The paths of a page's content: their points, and whether they are closed.
fn paths(content: &str) -> Vec<(Vec<DVec2>, bool)> {
    let mut paths = Vec::new();
    let mut points = Vec::new();
    let mut numbers: Vec<f64> = Vec::new();
    for word in content.split_whitespace() {
        match word {
            "m" | "l" => points.push(DVec2::from_slice(&numbers[numbers.len() - 2..])),
            "S" | "s" => paths.push((std::mem::take(&mut points), word == "s")),
            _ => {}
        }
        match word.parse() {
            Ok(number) => numbers.push(number),
            Err(_) => numbers.clear(),
        }
    }
    paths
}

fn settings() -> DrawingSettings {
    DrawingSettings { title: "A é (drawing)".to_owned(), hidden: HiddenLines::Dashed, ..DrawingSettings::default() }
}

fn media_box(text: &str) -> Vec<f64> {
    let numbers = text.split("/MediaBox [").nth(1).unwrap().split(']').next().unwrap();
    numbers.split_whitespace().map(|number| number.parse().unwrap()).collect()
}

#[test]
fn a_pdf_has_the_coordinates_of_the_svg_in_the_same_layers_and_order() {
    let paper = PageSize::Paper("A4".parse().unwrap());
    for page_size in [PageSize::Unset, PageSize::WidthMm(180.0), paper] {
        for is_for_pen in [false, true] {
            let settings = DrawingSettings { page_size, is_for_pen, ..settings() };
            let drawn = svg(&drawing(), &settings).unwrap();
            let (text, content) = read(&pdf(&drawing(), &settings).unwrap());
            let layers = names(&drawn);
            let of_svg: Vec<(Vec<DVec2>, bool)> = layers
                .iter()
                .flat_map(|layer| data(&drawn, layer))
                .map(|data| (points(&data), data.ends_with('Z')))
                .collect();
            let of_pdf = paths(&content);
            assert_eq!(of_pdf.len(), of_svg.len());
            assert!(of_svg.len() >= 4);
            for ((of_pdf, is_closed), (of_svg, was_closed)) in of_pdf.iter().zip(&of_svg) {
                assert_eq!(is_closed, was_closed);
                assert_eq!(of_pdf, of_svg, "the very numbers");
            }
            assert_eq!(content.matches("BDC").count(), layers.len());
            for layer in layers {
                assert!(text.contains(&format!("({})", layer.replacen('-', " ", 1))), "{layer}");
            }
        }
    }
}

#[test]
fn its_page_has_the_true_size_in_points_and_the_lines_lie_on_it() {
    // The picture is 120 x 80 pixels; its lines from 20, 10 to 100, 70.
    let page = |page_size| {
        let (text, content) = read(&pdf(&drawing(), &DrawingSettings { page_size, ..settings() }).unwrap());
        let matrix = content.split(" cm\n").next().unwrap().lines().last().unwrap().to_owned();
        let matrix: Vec<f64> = matrix.split_whitespace().map(|number| number.parse().unwrap()).collect();
        (media_box(&text), matrix)
    };
    let assert_near = |actual: Vec<f64>, expected: &[f64]| {
        assert_eq!(actual.len(), expected.len());
        assert!(actual.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-3), "{actual:?} {expected:?}");
    };
    let (sheet, matrix) = page(PageSize::Unset);
    assert_near(sheet, &[0.0, 0.0, 90.0, 60.0]);
    assert_near(matrix, &[0.75, 0.0, 0.0, -0.75, 0.0, 60.0]);
    let mm = 72.0 / 25.4;
    let (sheet, matrix) = page(PageSize::WidthMm(60.0));
    assert_near(sheet, &[0.0, 0.0, 60.0 * mm, 40.0 * mm]);
    assert_near(matrix, &[0.5 * mm, 0.0, 0.0, -0.5 * mm, 0.0, 40.0 * mm]);
    assert_near(page(PageSize::Dpi(72.0)).0, &[0.0, 0.0, 120.0, 80.0]);
    // It is wider than high: 267 x 180 mm are free, 80 x 60 pixels fill them to 3 mm a pixel.
    let (sheet, matrix) = page(PageSize::Paper("A4".parse().unwrap()));
    assert_near(sheet, &[0.0, 0.0, 841.8898, 595.2756]);
    let place = |x: f64, y: f64| [matrix[0] * x + matrix[4], matrix[3] * y + matrix[5]].map(|points| points / mm);
    assert_near(place(20.0, 70.0).to_vec(), &[28.5, 15.0]);
    assert_near(place(100.0, 10.0).to_vec(), &[268.5, 195.0]);
}

#[test]
fn the_same_lines_are_the_same_bytes_without_times() {
    let bytes = pdf(&drawing(), &settings()).unwrap();
    assert_eq!(bytes, pdf(&drawing(), &settings()).unwrap());
    let (text, _) = read(&bytes);
    assert!(text.starts_with("%PDF-1.7") && text.trim_end().ends_with("%%EOF"));
    for stamp in ["Date", "/ID", "xmp"] {
        assert!(!text.contains(stamp), "{stamp}");
    }
}

#[test]
fn a_page_beyond_what_pdf_knows_is_refused() {
    for (page_size, name) in [(PageSize::WidthMm(6000.0), "14,400"), (PageSize::Dpi(1e6), "3 to")] {
        let message = pdf(&drawing(), &DrawingSettings { page_size, ..settings() }).unwrap_err().to_string();
        assert!(message.contains(name), "{message}");
        assert!(svg(&drawing(), &DrawingSettings { page_size, ..settings() }).is_ok());
    }
}

#[test]
fn an_empty_drawing_is_a_page() {
    let (text, content) = read(&pdf(&lines(Vec::new()), &settings()).unwrap());
    assert!(paths(&content).is_empty() && !text.contains("OCProperties"));
    assert_eq!(media_box(&text), [0.0, 0.0, 90.0, 60.0]);
}
