//! Any bytes as a scene of small parts, drawn as SVG in the default look, with smooth silhouettes, and hatched.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    tinta_fuzz::memory::within(tinta_fuzz::memory::OF_DRAWING, || tinta_fuzz::scenes::drawing(bytes));
});
