//! Text and exit by semihosting, stack by paint, and a panic handler that does not link.

use core::ptr::{read_volatile, write_volatile};

use semihosting::io::Write;

use super::processor::stack_pointer;

/// Prints text on the host.
pub fn put(text: &str) {
    if let Ok(mut out) = semihosting::io::stdout() {
        let _ = out.write_all(text.as_bytes());
    }
}

/// Ends the program with success.
pub fn exit() -> ! {
    semihosting::process::exit(0)
}

/// Words that are painted: 64 KiB.
const DEPTH: usize = 16_384;
const PAINT: u32 = 0xa5a5_5a5a;

/// [B] how far below this function's frame `work` writes to the stack; what it reserves there and never writes is not seen.
/// Ends the program with failure where all that is painted was written.
#[inline(never)]
pub fn stack(work: impl FnOnce()) -> u32 {
    let top = stack_pointer();
    // SAFETY: the stack is the last thing in four megabytes of memory, no interrupt is on, and nothing lives below.
    for k in 1..=DEPTH {
        unsafe { write_volatile(top.wrapping_sub(k), PAINT) };
    }
    work();
    let mut deepest = DEPTH;
    // SAFETY: as above.
    while deepest > 0 && unsafe { read_volatile(top.wrapping_sub(deepest)) } == PAINT {
        deepest -= 1;
    }
    if deepest == DEPTH {
        put("the stack is deeper than what is painted\n");
        semihosting::process::exit(1)
    }
    4 * deepest as u32
}

/// A panic that can be reached is an undefined symbol.
#[panic_handler]
fn panic(_: &core::panic::PanicInfo) -> ! {
    unsafe extern "C" {
        fn a_panic_can_be_reached() -> !;
    }
    // SAFETY: it does not exist, so there is no program that calls it.
    unsafe { a_panic_can_be_reached() }
}
