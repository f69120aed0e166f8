//! What a control loop calls, one function of a model each.

mod cart_pole;
mod double_pendulum;
mod newton;
mod panda;
mod projection;
mod quadrotor;
mod rolling;
mod stewart;

pub use cart_pole::CartPole;
pub use double_pendulum::DoublePendulum;
pub use newton::Newton;
pub use panda::Panda;
pub use projection::Projected;
pub use quadrotor::Quadrotor;
pub use rolling::Rolling;
pub use stewart::Stewart;

use crate::Scalar;
pub use crate::random::{Draw, Random};

/// A function of a model, and a sequence of inputs to it.
pub trait Scene: Default {
    /// What the function takes.
    type Input: Copy;
    /// What it gives.
    type Output: Copy;
    /// Its name in reports.
    const NAME: &'static str;

    /// The function; never inlined, so that its bytes are counted as its own.
    fn call(&self, input: &Self::Input) -> Self::Output;
    /// The first input of the sequence.
    fn start(&self) -> Self::Input;
    /// The next one.
    fn next(&self, input: &Self::Input, output: &Self::Output) -> Self::Input;
    /// An input with all angles and other coordinates drawn by `coordinate`.
    fn random(&self, random: &mut Random, coordinate: Draw) -> Self::Input;
    /// Hands on the numbers of a result.
    fn numbers(output: &Self::Output, each: impl FnMut(Scalar));
}
