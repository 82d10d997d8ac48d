//! Any bytes as a ramp.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    tinta_fuzz::memory::within(tinta_fuzz::memory::of_picture(bytes), || tinta_fuzz::readers::ramp(bytes));
});
