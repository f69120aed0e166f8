//! Stage `model`: units, checked.
//!
//! In: doc comments that begin with a unit in brackets (`docs`), the typed expressions of all items. Out: errors where
//! an expression joins two units, or gives one where another belongs; each at the term, with both units as written.
//!
//! A unit is a dimension and a scale (`dimension`). What has one: what declares it in its doc comment (`param`,
//! `input`, `state`, `const`, `let`), and what the language gives: coordinates, quantities of frames, efforts,
//! energies, time (`quantities`). The code computes in m, kg, s and rad and converts nothing, so a unit of another
//! scale is refused where it meets one of the SI: `[mm]` beside a length, `[deg]` beside an angle (`deg(x)` makes it
//! rad).
//!
//! The rule: a unit is known, or any (`value`).
//!
//! - **No unit, no check.** What declares none, and brackets that hold no known unit, are of any unit, and what is
//!   calculated from them by a product is too. Two units of which the user has declared neither are not compared: a
//!   bead on `y - x * x`, or an effort of `-j.rate`, leaves out a factor of one that only its writer knows.
//! - **A literal takes the unit that fits.** In a sum that is the other term's. In a product nobody can tell: `9.81 *
//!   m` is a force, `0.001 * d` may turn mm into m, `2.0 * x` may be a spring of 2 N/m. So such a product is of any
//!   unit. One half alone (`0.5 *`, `/ 2.0`) is a plain number where it stands with a square and a further factor of a
//!   declared unit, as in `0.5 * k * x * x`: there it comes from an integral. `PI` and the vectors `X`, `Y`, `Z` are
//!   plain numbers in products.
//! - Terms of sums, both sides of comparisons, arguments of `min`, `max`, `hypot`, `atan2` and `select` have one unit.
//!   Products multiply, roots and powers with a literal exponent follow. Angles, exponents and logarithms take plain
//!   numbers.
//! - What stands in a field has the field's unit, an output, `const`, `let` or default its own, a state's rate its own
//!   per second; of vectors and arrays that are written out each element.
//! - What is asked of another model has the unit that it has there, and what its variables are given theirs (`asked`).
//! - A mistake is said once: what is calculated from it is not checked.

mod asked;
mod check;
mod declared;
pub(super) mod dimension;
mod expressions;
mod parse;
pub(super) mod quantities;
mod squares;
mod table;
mod value;

pub(super) use asked::Wanted;
pub(super) use check::Units;
pub(super) use declared::{Declared, declared};
pub(super) use value::Value;
