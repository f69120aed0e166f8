//! Instructions by the processor's own counter.

use core::arch::asm;

pub use riscv_rt::entry;

fn retired() -> u32 {
    let count;
    // SAFETY: reads a counter.
    unsafe { asm!("csrr {}, minstret", out(reg) count) };
    count
}

/// Instructions that `work` takes, with those that the counting itself does.
#[inline(never)]
pub fn instructions(work: impl FnOnce()) -> Option<u32> {
    let start = retired();
    work();
    Some(retired().wrapping_sub(start))
}

/// The end of the stack.
#[inline(always)]
pub(super) fn stack_pointer() -> *mut u32 {
    let pointer;
    // SAFETY: reads a register.
    unsafe { asm!("mv {}, sp", out(reg) pointer) };
    pointer
}
