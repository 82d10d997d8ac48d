//! The presets that ship: the articles' constants, each a TOML file in `presets/` that names its source.

/// Their names and texts; static: a program holds them once.
pub static SHIPPED: [(&str, &str); 5] = [
    ("paper:evangelista-three-pass", include_str!("../../presets/evangelista-three-pass.toml")),
    ("paper:evangelista-two-pass", include_str!("../../presets/evangelista-two-pass.toml")),
    ("paper:dachsbacher-inking", include_str!("../../presets/dachsbacher-inking.toml")),
    ("paper:valente-charcoal-in-part", include_str!("../../presets/valente-charcoal.toml")),
    ("paper:valente-sand-in-part", include_str!("../../presets/valente-sand.toml")),
];
