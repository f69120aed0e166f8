//! Square roots by the processor's instruction, where stable Rust offers it with std only.
//!
//! This is the one file of the crate that may hold `unsafe`, and it is compiled with the feature `hardware-root` alone;
//! without it the crate forbids `unsafe`. Each block reads registers, writes registers that it declares, and touches
//! neither memory nor stack. It may raise exception flags, so none promises to preserve them. The result is IEEE 754's,
//! correctly rounded, as libm's is. A target without the instruction is refused by the assembler, in `f64` (feature
//! `hardware-root-double`) as in `f32`.
//!
//! On Arm values pass through general registers: rustc gives floating-point ones to assembly only where the unit knows
//! doubles, which that of a Cortex-M4F does not.

#![allow(unsafe_code)]

use core::arch::asm;

/// The square root.
#[inline]
#[cfg(target_arch = "arm")]
pub(super) fn f32(x: f32) -> f32 {
    let root: u32;
    // SAFETY: arithmetic on registers, s0 is declared as overwritten.
    unsafe {
        asm!(
            "vmov s0, {x}",
            "vsqrt.f32 s0, s0",
            "vmov {root}, s0",
            x = in(reg) x.to_bits(),
            root = lateout(reg) root,
            out("s0") _,
            options(pure, nomem, nostack),
        );
    }
    f32::from_bits(root)
}

/// The square root.
#[inline]
#[cfg(all(target_arch = "arm", feature = "hardware-root-double"))]
pub(super) fn f64(x: f64) -> f64 {
    let bits = x.to_bits();
    let (low, high): (u32, u32);
    // SAFETY: arithmetic on registers, d0 is declared as overwritten.
    unsafe {
        asm!(
            "vmov d0, {low}, {high}",
            "vsqrt.f64 d0, d0",
            "vmov {low}, {high}, d0",
            low = inout(reg) bits as u32 => low,
            high = inout(reg) (bits >> 32) as u32 => high,
            out("d0") _,
            options(pure, nomem, nostack),
        );
    }
    f64::from_bits(u64::from(high) << 32 | u64::from(low))
}

/// The square root.
#[inline]
#[cfg(any(target_arch = "riscv32", target_arch = "riscv64"))]
pub(super) fn f32(x: f32) -> f32 {
    let root;
    // SAFETY: arithmetic on two registers.
    unsafe { asm!("fsqrt.s {}, {}", out(freg) root, in(freg) x, options(pure, nomem, nostack)) };
    root
}

/// The square root.
#[inline]
#[cfg(all(any(target_arch = "riscv32", target_arch = "riscv64"), feature = "hardware-root-double"))]
pub(super) fn f64(x: f64) -> f64 {
    let root;
    // SAFETY: arithmetic on two registers.
    unsafe { asm!("fsqrt.d {}, {}", out(freg) root, in(freg) x, options(pure, nomem, nostack)) };
    root
}
