//! Some of the random models through `rustc` with each build: no warning may come of them.

#![deny(warnings, missing_docs, unused, unreachable_pub, clippy::all, clippy::pedantic)]
#![forbid(unsafe_code)]

#[path = "handful/models.rs"]
pub mod models;

/// Small ones, so that they compile in seconds.
const SEEDS: [u64; 9] = [101, 104, 106, 110, 113, 116, 122, 123, 125];

/// The file holds what the generator says; `UPDATE=1` writes it anew.
#[test]
fn are_as_the_generator_says() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/handful/models.rs");
    let want = multibody_fuzz::grammar_campaign::file(&SEEDS);
    if std::env::var_os("UPDATE").is_some() {
        std::fs::write(path, &want).expect("a file of this package");
    }
    let held = std::fs::read_to_string(path).expect("a file of this package");
    assert!(held == want, "run `UPDATE=1 cargo test -p multibody-fuzz --test handful`");
}
