//! Any bytes as a list of jobs, and as a journal of them.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    tinta_fuzz::memory::within(tinta_fuzz::memory::of_list(bytes), || tinta_fuzz::readers::batch(bytes));
});
