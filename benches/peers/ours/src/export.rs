//! What the first library of a comparison exports beside its functions.

use std::ffi::{CStr, c_char};

use crate::abi::write;

/// How many states each robot has.
pub const COUNT: usize = 64;

/// This library, and what it was compiled for.
pub const PROGRAM: &CStr = if cfg!(peers_native) { c"ours" } else { c"ours, any processor" };
pub const PACKS: &CStr = if cfg!(peers_native) { c"ours, packs" } else { c"ours, packs, any processor" };
pub const MULTIPLIERS: &CStr =
    if cfg!(peers_native) { c"ours, multipliers" } else { c"ours, multipliers, any processor" };

#[unsafe(no_mangle)]
extern "C" fn peers_states(robot: *const c_char, states: *mut f64, length: *mut usize) -> usize {
    // SAFETY: the interface.
    let robot = unsafe { CStr::from_ptr(robot) };
    let (count, all) = crate::unit::states(robot)
        .unwrap_or_else(|| (COUNT, crate::trees::states(robot).unwrap_or_else(|| crate::closed::states(robot))));
    // SAFETY: the interface.
    unsafe {
        *length = all.len() / count;
        write(&all, states);
    }
    count
}
