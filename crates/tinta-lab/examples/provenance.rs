//! Prints which values of a style its text prints, which follow from it, and which are tinta's:
//! `cargo run -p tinta-lab --example provenance -- three-pass`; without a style those of all, as one page of tables.

use tinta::StyleName;
use tinta_lab::provenance::{page, text};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    match std::env::args().nth(1) {
        Some(style) => print!("{}", text(Some(style.parse::<StyleName>()?))),
        None => print!("{}", page()),
    }
    Ok(())
}
