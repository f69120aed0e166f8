//! A program that must not link: an index that may be out of range. It shows that the check of the others can fail.

#![cfg_attr(target_os = "none", no_std, no_main)]

use core::hint::black_box;

#[cfg_attr(target_os = "none", firmware::machine::entry)]
fn main() -> ! {
    let names = ["shoulder\n", "elbow\n"];
    firmware::machine::put(names[black_box(1)]);
    firmware::machine::exit()
}
