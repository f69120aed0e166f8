//! An error of this compiler, from where it is found to the boundary where it becomes a refusal.
//!
//! A fault unwinds: it can be found anywhere, and nobody between there and the boundary can go on without the value. It is
//! raised by `resume_unwind`, which prints nothing. [`guard`] catches it, and any other panic of the stages, in every build
//! profile: cargo compiles procedural macros with unwinding whatever a user's profile says.

use std::any::Any;
use std::panic::{AssertUnwindSafe, Location, catch_unwind, resume_unwind};

/// What was found, and where in the sources of this compiler.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// A folder of the sources, as ARCHITECTURE.md has it.
    pub stage: String,
    /// `schedule.rs:310` where it is known.
    pub place: Option<String>,
    /// The law that does not hold.
    pub what: String,
}

/// Ends the derivation: `what` is a law that does not hold, as a sentence without capital and full stop.
#[track_caller]
#[cold]
pub fn raise(what: &str) -> ! {
    let at = Location::caller();
    let path = at.file().replace('\\', "/");
    let inside = path.rsplit_once("src/").map_or(path.as_str(), |(_, inside)| inside);
    let (stage, file) = inside.split_once('/').unwrap_or(("lib", inside));
    let place = Some(format!("{file}:{}", at.line()));
    resume_unwind(Box::new(Fault { stage: stage.to_owned(), place, what: what.to_owned() }))
}

/// The answer of a lookup that has one unless this compiler is wrong.
pub trait OrFault<T> {
    /// `law` says why the answer is there.
    fn or_fault(self, law: &str) -> T;
}

impl<T> OrFault<T> for Option<T> {
    #[track_caller]
    #[inline]
    fn or_fault(self, law: &str) -> T {
        match self {
            Some(value) => value,
            None => raise(law),
        }
    }
}

/// What a stage gives, or why it could not. A panic that is no fault, such as an index out of range, is one of `stage`.
pub fn guard<T>(stage: &str, work: impl FnOnce() -> T) -> Result<T, Fault> {
    // Nothing that a stage has left unfinished is read afterwards: its results are dropped, and what it has read is not
    // changed by it.
    catch_unwind(AssertUnwindSafe(work)).map_err(|payload| of_panic(stage, payload))
}

fn of_panic(stage: &str, payload: Box<dyn Any + Send>) -> Fault {
    let payload = match payload.downcast::<Fault>() {
        Ok(fault) => return *fault,
        Err(payload) => payload,
    };
    let text = payload.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| payload.downcast_ref::<&str>().copied());
    Fault { stage: stage.to_owned(), place: None, what: text.unwrap_or("a panic without a message").to_owned() }
}

#[cfg(test)]
mod tests {
    use super::{OrFault, guard};

    #[test]
    fn a_fault_names_its_stage_and_its_law() {
        let none: Option<u8> = None;
        let fault = guard("mechanics", || none.or_fault("there is a number")).unwrap_err();
        assert_eq!((fault.stage.as_str(), fault.what.as_str()), ("invariant", "there is a number"));
        assert!(fault.place.is_some_and(|place| place.starts_with("fault.rs:")));
        assert_eq!(guard("mechanics", || Some(1).or_fault("")), Ok(1));
    }

    #[test]
    fn a_panic_is_a_fault_of_the_stage_that_ran() {
        let index = std::hint::black_box(7);
        let fault = guard("optimize", || [1, 2, 3][index]).unwrap_err();
        assert_eq!(fault.stage, "optimize");
        assert!(fault.what.contains("index out of bounds"), "{}", fault.what);
    }
}
