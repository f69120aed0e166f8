//! A WebAssembly module: one function for each scene, that gives the hash; a panic would be an import that is not there.

use crate::report::digest;
use crate::scenes::{CartPole, DoublePendulum, Newton, Panda, Projected, Quadrotor, Rolling, Stewart};

macro_rules! exports {
    ($($name:ident = $scene:ty;)+) => {
        $(
            /// The hash of the scene's results.
            #[unsafe(no_mangle)] // no other code has these names
            pub extern "C" fn $name() -> u64 {
                digest(&<$scene>::default()).value()
            }
        )+
    };
}

exports! {
    double_pendulum = DoublePendulum;
    cart_pole = CartPole;
    panda = Panda;
    stewart = Stewart;
    quadrotor = Quadrotor;
    newton = Newton;
    projection = Projected;
    rolling = Rolling;
}

/// There is nothing to print on.
pub fn put(_text: &str) {}

/// Not counted here.
pub fn instructions(_work: impl FnOnce()) -> Option<u32> {
    None
}

/// Not measured here.
pub fn stack(_work: impl FnOnce()) -> u32 {
    0
}

/// A panic that can be reached is an import that nobody offers.
#[panic_handler]
fn panic(_: &core::panic::PanicInfo) -> ! {
    unsafe extern "C" {
        fn a_panic_can_be_reached() -> !;
    }
    // SAFETY: it does not exist, so no module that calls it is instantiated.
    unsafe { a_panic_can_be_reached() }
}
