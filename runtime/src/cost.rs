//! Operation counts of generated functions: [`Cost`].

use core::fmt;

/// Operation counts of one generated function.
///
/// An addition or subtraction is one `add`, a product one `mul`, a quotient one `div`, a square root one `sqrt`, sine
/// and cosine of one angle together one `sincos`; sign changes and factors of one are free. A minimum, a maximum and a
/// selection count as one `add` each; comparisons and other functions are in `other`.
///
/// ```
/// use multibody::Cost;
///
/// const STEP: Cost =
///     Cost { function: "forward_dynamics", add: 14, mul: 20, div: 1, sqrt: 0, sincos: 2, other: 0 };
/// assert_eq!(STEP.flops(), 35);
/// assert_eq!(STEP.to_string(), "forward_dynamics: 14 add, 20 mul, 1 div, 0 sqrt, 2 sincos, 0 other");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Cost {
    /// Name of the function.
    pub function: &'static str,
    /// Additions and subtractions, with `min`, `max` and `select`.
    pub add: u32,
    /// Products.
    pub mul: u32,
    /// Quotients.
    pub div: u32,
    /// Square roots.
    pub sqrt: u32,
    /// Pairs of sine and cosine.
    pub sincos: u32,
    /// Everything else.
    pub other: u32,
}

impl Cost {
    /// Floating point operations: additions, products, quotients and square roots.
    pub const fn flops(&self) -> u32 {
        self.add.saturating_add(self.mul).saturating_add(self.div).saturating_add(self.sqrt)
    }
}

impl fmt::Display for Cost {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { function, add, mul, div, sqrt, sincos, other } = self;
        write!(f, "{function}: {add} add, {mul} mul, {div} div, {sqrt} sqrt, {sincos} sincos, {other} other")
    }
}
