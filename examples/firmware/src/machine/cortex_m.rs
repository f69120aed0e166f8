//! Instructions by the SysTick timer.
//!
//! Under QEMU's `-icount shift=10` one instruction takes 1,024 ns, and the timer counts every 40 ns, 25.6 times for each.
//! So differences of its values give instructions exactly, up to 650,000.

use core::arch::asm;
use core::ptr::{read_volatile, write_volatile};

pub use cortex_m_rt::entry;

const CONTROL: *mut u32 = 0xe000_e010 as *mut u32;
const RELOAD: *mut u32 = 0xe000_e014 as *mut u32;
const VALUE: *mut u32 = 0xe000_e018 as *mut u32;

/// Instructions that `work` takes, with those that the counting itself does.
#[inline(never)]
pub fn instructions(work: impl FnOnce()) -> Option<u32> {
    // SAFETY: the timer belongs to this function alone.
    unsafe {
        write_volatile(RELOAD, 0x00ff_ffff);
        write_volatile(VALUE, 0);
        write_volatile(CONTROL, 5); // on, with the processor's clock
        while read_volatile(VALUE) == 0 {}
        let start = read_volatile(VALUE);
        work();
        let ticks = start.wrapping_sub(read_volatile(VALUE)) & 0x00ff_ffff;
        Some((ticks * 5 + 64) / 128)
    }
}

/// The end of the stack.
#[inline(always)]
pub(super) fn stack_pointer() -> *mut u32 {
    let pointer;
    // SAFETY: reads a register.
    unsafe { asm!("mov {}, sp", out(reg) pointer) };
    pointer
}
