//! This library's functions, for the comparison with others: see `subject.h`.

mod abi;
mod closed;
mod export;
mod floating;
mod lanes;
mod loops;
#[path = "../../../../tests/support/random.rs"]
#[allow(dead_code, reason = "what tests share has more than this needs")]
mod random;
mod samples;
mod trees;
mod unit;

/// The robots of `robots.py`.
#[allow(clippy::all, reason = "written by a script")]
mod robots {
    use multibody::multibody;

    include!(env!("PEERS_MODELS"));
}

use abi::Subject;

/// All of them; the first library of a comparison says what others have to agree with.
static SUBJECTS: &[&[Subject]] = &[trees::SUBJECTS, lanes::SUBJECTS, closed::SUBJECTS, unit::SUBJECTS];
