//! Any bytes as the words of a command line.
#![no_main]

#[path = "../src/words.rs"]
mod words;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    tinta_fuzz::memory::within(tinta_fuzz::memory::of_model(bytes), || words::command_line(bytes));
});
