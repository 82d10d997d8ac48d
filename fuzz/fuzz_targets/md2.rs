//! Any bytes as an MD2 model.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    tinta_fuzz::memory::within(tinta_fuzz::memory::of_model(bytes), || tinta_fuzz::readers::md2(bytes));
});
