//! Stage `symbolic`: what is left of a value after cancellation.
//!
//! In: values of symbols. Out: values of nodes in double precision, each with its *size*, the sum of the amounts of which
//! the value is made. Where a value is below the rounding of its size nothing is left of it: it may be any number, or zero.

use crate::contracts::call::Call;

use super::evaluate::{Field, call_f64, solve_f64};
use super::graph::{Graph, Scalar, SymbolId};
use super::number::Number;

/// What is left of a value where it is nothing but rounding.
const NOTHING: f64 = 64.0 * f64::EPSILON;

/// A value and its size.
#[derive(Clone, Copy, Debug)]
pub struct Sized {
    pub value: f64,
    size: f64,
}

impl Sized {
    fn whole(value: f64) -> Sized {
        Sized { value, size: value.abs() }
    }

    /// Whether it can't be told from zero.
    pub fn is_rounding(self) -> bool {
        self.value.abs() <= NOTHING * self.size
    }
}

/// Double precision with sizes.
pub struct WithSizes<'a> {
    pub symbols: &'a dyn Fn(SymbolId) -> f64,
}

impl Field for WithSizes<'_> {
    type Value = Sized;
    fn literal(&self, n: Number) -> Sized {
        Sized::whole(n.value())
    }
    fn symbol(&self, id: SymbolId) -> Sized {
        Sized::whole((self.symbols)(id))
    }
    fn add(&self, a: Sized, b: Sized) -> Sized {
        Sized { value: a.value + b.value, size: a.size + b.size }
    }
    fn mul(&self, a: Sized, b: Sized) -> Sized {
        Sized { value: a.value * b.value, size: a.size * b.size }
    }
    fn neg(&self, a: Sized) -> Sized {
        Sized { value: -a.value, size: a.size }
    }
    fn reciprocal(&self, a: Sized) -> Sized {
        Sized { value: 1.0 / a.value, size: a.size / (a.value * a.value) }
    }
    fn call(&self, call: Call, x: &[Sized]) -> Sized {
        let values: Vec<f64> = x.iter().map(|x| x.value).collect();
        Sized::whole(call_f64(call, &values))
    }
    fn point(&self, _: &Graph, _: Scalar, angle: Sized, _: &dyn Fn(Scalar) -> Sized) -> (Sized, Sized) {
        (Sized::whole(angle.value.cos()), Sized::whole(angle.value.sin()))
    }
    fn solve(&self, _: bool, matrix: &[Sized], rhs: &[Sized]) -> Vec<Sized> {
        let values = |list: &[Sized]| list.iter().map(|x| x.value).collect::<Vec<f64>>();
        solve_f64(&values(matrix), &values(rhs)).into_iter().map(Sized::whole).collect()
    }
}
