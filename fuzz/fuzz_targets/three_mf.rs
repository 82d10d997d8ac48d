//! Any bytes as a 3MF model.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    if let Some(most) = tinta_fuzz::memory::of_three_mf(bytes) {
        tinta_fuzz::memory::within(most, || tinta_fuzz::readers::three_mf(bytes));
    }
});
