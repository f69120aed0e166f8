//! The firmware of [`firmware::bounded`]: that it links is the test.

#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg_attr(target_os = "none", firmware::machine::entry)]
fn main() -> ! {
    firmware::bounded::all();
    firmware::machine::put("every model steps without a panic\n");
    firmware::machine::exit()
}
