//! Some of the random models through `rustc` with each build: no warning may come of them.

#![deny(warnings, missing_docs, unused, unreachable_pub, clippy::all, clippy::pedantic)]
#![forbid(unsafe_code)]

#[path = "handful/models.rs"]
pub mod models;

/// What some of them call.
#[derive(Debug)]
pub struct Curve;

impl<T: multibody::Real, const N: usize> multibody::Function<T, N> for Curve {
    fn value(x: [T; N]) -> T {
        x.into_iter().fold(T::lit(1.0), |sum, x| sum + multibody::Real::tanh(x))
    }

    fn slopes(x: [T; N]) -> [T; N] {
        x.map(|x| {
            let share = multibody::Real::tanh(x);
            T::lit(1.0) - share * share
        })
    }
}

/// Small ones, so that they compile in seconds.
const SEEDS: [u64; 9] = [101, 106, 113, 115, 124, 133, 142, 145, 155];

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
