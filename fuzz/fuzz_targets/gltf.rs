//! Any bytes as a glTF model.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    if let Some(most) = tinta_fuzz::memory::of_gltf(bytes) {
        tinta_fuzz::memory::within(most, || tinta_fuzz::readers::gltf(bytes));
    }
});
