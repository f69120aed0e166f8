//! Instructions by the SysTick timer.
//!
//! Under QEMU's `-icount shift=10` one instruction takes 1,024 ns, and the timer counts every 40 ns, 25.6 times for each.
//! So differences of its values give instructions exactly, up to [`MOST`].

use core::arch::asm;
use core::ptr::{read_volatile, write_volatile};

pub use cortex_m_rt::entry;

const CONTROL: *mut u32 = 0xe000_e010 as *mut u32;
const RELOAD: *mut u32 = 0xe000_e014 as *mut u32;
const VALUE: *mut u32 = 0xe000_e018 as *mut u32;

/// In the control register: the timer has come to zero since it was read last.
const WRAPPED: u32 = 1 << 16;
/// 24 bits of the timer.
const MOST: u32 = 655_360;

/// Instructions that `work` takes, with those that the counting itself does; [`MOST`] where they are that many or more.
#[inline(never)]
pub fn instructions(work: impl FnOnce()) -> Option<u32> {
    // SAFETY: the timer belongs to this function alone.
    unsafe {
        write_volatile(RELOAD, 0x00ff_ffff);
        write_volatile(VALUE, 0);
        write_volatile(CONTROL, 5); // on, with the processor's clock
        while read_volatile(VALUE) == 0 {}
        let _ = read_volatile(CONTROL);
        let start = read_volatile(VALUE);
        work();
        let end = read_volatile(VALUE);
        let wrapped = read_volatile(CONTROL) & WRAPPED != 0;
        Some(if wrapped { MOST } else { ((start - end) * 5 + 64) / 128 })
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
