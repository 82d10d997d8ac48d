//! A line explained in words: what it is, and what hides each of its pieces.

use std::fmt::Write;
use tinta::cli::plain;
use tinta::glam::DVec2;
use tinta::lines::{Hider, Why, WhyLine, WhyPiece};

/// Hiders named at a place, and those named at each piece.
const MOST: usize = 8;
const MOST_OF_PIECE: usize = 2;

pub(super) fn in_words(why: &Why) -> String {
    let Why { asked_px, line, nearest_px, distance_px, is_visible, hidden_by, pieces, is_drawn_otherwise } = why;
    let mut text = format!("The nearest line: {}.\n", of_line(line));
    let state = if *is_visible { "visible" } else { "hidden" };
    let _ = writeln!(text, "It is {state} at {}, {distance_px:.2} px from {}.", pixel(*nearest_px), pixel(*asked_px));
    if *is_drawn_otherwise {
        text.push_str(
            "The drawing shows this line otherwise: a fault in tinta's search for lines. Report it with the model.\n",
        );
    }
    let along = match (pieces.first(), pieces.last()) {
        (Some(first), Some(last)) => DVec2::from(last.to_px) - DVec2::from(first.from_px),
        _ => DVec2::X,
    };
    for hider in hidden_by.iter().take(MOST) {
        let _ = writeln!(text, "  {}", of_hider(hider, along));
    }
    if hidden_by.len() > MOST {
        let _ = writeln!(text, "  and {} more", hidden_by.len() - MOST);
    }
    text.push_str("\nAll of it, from one end to the other:\n");
    for WhyPiece { from_px, to_px, is_visible, hidden_by } in pieces {
        let state = if *is_visible { "visible" } else { "hidden" };
        let _ = write!(text, "  {} to {}  {state}", pixel(*from_px), pixel(*to_px));
        let named: Vec<String> = hidden_by.iter().take(MOST_OF_PIECE).map(name_of).collect();
        let more = hidden_by.len().saturating_sub(MOST_OF_PIECE);
        let more = if more > 0 { format!(" and {more} more") } else { String::new() };
        if !named.is_empty() {
            let _ = write!(text, " by {}{more}", named.join(", "));
        }
        text.push('\n');
    }
    text
}

fn pixel([x, y]: [f64; 2]) -> String {
    format!("{x:.2},{y:.2}")
}

fn of_line(line: &WhyLine) -> String {
    let WhyLine { class, name, edge, angle_degrees, .. } = line;
    let edge = edge.map_or_else(String::new, |[first, second]| format!(", from vertex {first} to {second}"));
    let angle = angle_degrees.map_or_else(String::new, |degrees| format!(", {degrees:.1} degrees between its faces"));
    format!("{class} of {}{edge}{angle}", plain(name))
}

fn name_of(hider: &Hider) -> String {
    match hider {
        Hider::Face { name, face: Some(face), .. } => format!("face {face} of {}", plain(name)),
        Hider::Face { name, vertices: [a, b, c], .. } => {
            format!("the face of vertices {a}, {b} and {c} of {}", plain(name))
        }
        Hider::Line { line, .. } => of_line(line),
    }
}

/// What hides a line, and which side of it: `along` is the line's direction in the picture.
fn of_hider(hider: &Hider, along: DVec2) -> String {
    let name = name_of(hider);
    match hider {
        Hider::Line { in_front: 0.0, .. } => format!("{name} is in the same place and is drawn for both"),
        Hider::Line { in_front, .. } => format!("{name} lies on it, nearer by {in_front:.6}"),
        Hider::Face { left: true, right: true, in_front, .. } => {
            format!("{name} is nearer by {in_front:.6}, on both sides")
        }
        Hider::Face { left, in_front, .. } => {
            // Left of a line that runs to the right is up, with y down.
            let side = if *left { DVec2::new(along.y, -along.x) } else { DVec2::new(-along.y, along.x) };
            let side = match (side.x.abs() > side.y.abs(), side.x > 0.0, side.y > 0.0) {
                (true, true, _) => "right",
                (true, false, _) => "left",
                (false, _, true) => "lower",
                (false, _, false) => "upper",
            };
            format!("{name} is nearer by {in_front:.6}, on the {side} side")
        }
    }
}
