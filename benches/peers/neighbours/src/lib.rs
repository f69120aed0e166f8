//! Other crates' functions, for the comparison: see `subject.h`. Those are here that are maintained, compute in f64, and
//! give one of the functions by itself.

#[path = "../../ours/src/abi.rs"]
mod abi;
mod dynibo;
mod phyz;

use abi::Subject;

/// All of them.
static SUBJECTS: &[&[Subject]] = &[dynibo::SUBJECTS, phyz::SUBJECTS];

/// The file of a robot that `robots.py` has written.
fn file(robot: &str, ending: &str) -> String {
    format!("{}/{robot}.{ending}", env!("PEERS_ROBOTS"))
}
