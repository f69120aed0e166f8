//! The interface of `subject.h`.

use std::ffi::c_char;
use std::sync::OnceLock;

use crate::SUBJECTS;

/// A function of a robot.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct Subject {
    pub robot: *const c_char,
    pub function: *const c_char,
    pub program: *const c_char,
    pub tolerance: f64,
    pub load: extern "C" fn(*const f64, usize),
    pub evaluate: extern "C" fn(usize, *mut f64) -> usize,
    pub run: extern "C" fn(usize),
}

// SAFETY: the pointers are to literals.
unsafe impl Sync for Subject {}
// SAFETY: as above.
unsafe impl Send for Subject {}

/// Numbers that C has handed over.
///
/// # Safety
/// As for `std::slice::from_raw_parts`.
pub unsafe fn numbers<'a>(values: *const f64, count: usize) -> &'a [f64] {
    // SAFETY: the caller's.
    unsafe { std::slice::from_raw_parts(values, count) }
}

/// Writes results and returns how many.
///
/// # Safety
/// `to` has room for them.
pub unsafe fn write(results: &[f64], to: *mut f64) -> usize {
    // SAFETY: the caller's.
    unsafe { std::ptr::copy_nonoverlapping(results.as_ptr(), to, results.len()) };
    results.len()
}

/// A subject: how many numbers a state has, how many states one evaluation takes, what is kept of their numbers, how that
/// is evaluated, and how results are written in the common coordinates.
macro_rules! subject {
    ($robot:expr, $function:expr, $program:expr, $length:expr, $lanes:expr, $point:ty, $keep:expr, $evaluate:expr, $results:expr $(,)?) => {{
        static POINTS: std::sync::OnceLock<Vec<$point>> = std::sync::OnceLock::new();
        extern "C" fn load(states: *const f64, count: usize) {
            let keep: fn(&[f64]) -> $point = $keep;
            // SAFETY: the interface.
            let all = unsafe { $crate::abi::numbers(states, count * $length) };
            POINTS.get_or_init(|| all.chunks_exact($length * $lanes).map(keep).collect());
        }
        fn points() -> &'static [$point] {
            POINTS.get().expect("states are loaded first")
        }
        #[allow(clippy::modulo_one, reason = "most evaluations take one state")]
        extern "C" fn evaluate(state: usize, results: *mut f64) -> usize {
            let point = &points()[state / $lanes];
            let all: Vec<f64> = ($results)(point, state % $lanes, ($evaluate)(point));
            // SAFETY: the interface.
            unsafe { $crate::abi::write(&all, results) }
        }
        extern "C" fn run(count: usize) {
            let points = points();
            let mut k = 0;
            for _ in 0..count / $lanes {
                std::hint::black_box(($evaluate)(std::hint::black_box(&points[k])));
                k = if k + 1 == points.len() { 0 } else { k + 1 };
            }
        }
        $crate::abi::Subject {
            robot: $robot.as_ptr(),
            function: $function.as_ptr(),
            program: $program.as_ptr(),
            tolerance: 1e-11,
            load,
            evaluate,
            run,
        }
    }};
}
pub(crate) use subject;

#[unsafe(no_mangle)]
extern "C" fn peers_subjects(count: *mut usize) -> *const Subject {
    static ALL: OnceLock<Vec<Subject>> = OnceLock::new();
    let all = ALL.get_or_init(|| SUBJECTS.concat());
    // SAFETY: the interface.
    unsafe { *count = all.len() };
    all.as_ptr()
}
