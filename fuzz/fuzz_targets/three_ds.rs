//! Any bytes as a 3DS model.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    tinta_fuzz::memory::within(tinta_fuzz::memory::of_model(bytes), || tinta_fuzz::readers::three_ds(bytes));
});
