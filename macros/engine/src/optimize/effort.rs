//! Stage `optimize`: what an evaluation takes, by its operations.
//!
//! In: a compiled function. Out: its work. The count of [`Cost`] has one round of each iteration and weighs operations as
//! it needs to choose between ways to one function. Formulations differ in whether they iterate at all, and in how much
//! of their work is linear systems, so here every round counts, and systems are weighed apart.

use crate::contracts::call::Call;
use crate::contracts::cost::Cost;
use crate::symbolic::graph::BlockKind;

use super::program::{Expression, Function, Statement};

// Weights are rounded from a fit to the times of compiled forward dynamics of 180 choices of the project's models (f64, level 3,
// Intel Xeon, November 2026), by least squares of relative errors: 0.12 ns for an addition, since a processor does several
// at once, 2.1 for a quotient, 4.3 for sine and cosine, 27 for an arc tangent, 0.4 n^3 + 5 n^2 for a system. Half of the
// times are within 10 percent of eight to the nanosecond, nine of ten within 40; of 48 models with several choices the least
// work, or the fewest multipliers within 10 percent of it, is the fastest in 47, within 5 percent.

/// Additions, products, selections, comparisons.
const SHORT: u32 = 1;
/// Quotients and roots.
const LONG: u32 = 20;
/// Sine and cosine of one angle.
const SINES: u32 = 35;
/// Any other function.
const CALL: u32 = 220;
/// By n^3 of a pivoted solution with n unknowns, half of that where the matrix is symmetric..
const ELIMINATION: u32 = 4;
/// ..and by n^2.
const PIVOTING: u32 = 40;

/// Operations of one evaluation.
#[derive(Default)]
pub struct Effort {
    /// Outside of linear systems.
    straight: Cost,
    /// Pivoted solutions of linear systems: size, whether they are symmetric, how many.
    systems: Vec<(usize, bool, u32)>,
    /// Of `straight` what rounds of iterations are beyond the first.
    rounds: Cost,
}

impl Effort {
    /// Of a function as it is compiled.
    pub fn of(function: &Function) -> Effort {
        let mut effort = Effort::default();
        effort.add(&function.program.statements, 1);
        // What was added are rounds beyond the first: the count has this one, with the work of systems.
        let systems = effort.systems.iter().map(|&(size, symmetric, _)| of_system(size, symmetric));
        let systems = systems.fold(Cost::default(), Cost::plus);
        effort.rounds = effort.straight;
        effort.straight = less(function.after.plus(effort.straight), systems);
        effort
    }

    /// Statements that are run so many times.
    fn add(&mut self, statements: &[Statement], times: u32) {
        let beyond = |cost: Cost| repeated(cost, times - 1);
        for statement in statements {
            match statement {
                Statement::Let { value, .. } => self.straight = self.straight.plus(beyond(of_expression(value))),
                Statement::Pack { size, value, .. } => {
                    self.straight = self.straight.plus(repeated(beyond(of_expression(value)), size.members() as u32));
                }
                Statement::PackSines(size, sine) => {
                    let cost = of_expression(&sine.angle).plus(Cost { sincos: 1, ..Cost::default() });
                    self.straight = self.straight.plus(repeated(beyond(cost), size.members() as u32));
                }
                Statement::Members { .. } => {}
                Statement::SinCos(sines) => {
                    let angles = of_all(sines.iter().map(|sine| &sine.angle));
                    let cost = angles.plus(Cost { sincos: size(sines), ..Cost::default() });
                    self.straight = self.straight.plus(beyond(cost));
                }
                Statement::Called { arguments, .. } => {
                    let cost = of_all(arguments).plus(Cost { other: 1, ..Cost::default() });
                    self.straight = self.straight.plus(beyond(cost));
                }
                Statement::Solve { size, symmetric, matrix, rhs, .. } => {
                    self.straight = self.straight.plus(beyond(of_all(matrix.iter().chain(rhs))));
                    self.systems.push((*size, *symmetric, times));
                }
                Statement::Iterate { count, start, body, next, residual, .. } => {
                    self.straight = self.straight.plus(beyond(of_all(start)));
                    let rounds = times.saturating_mul(u32::try_from(*count).unwrap_or(u32::MAX)).max(1);
                    let last = of_all(next.iter().chain([&residual.1]));
                    self.straight = self.straight.plus(repeated(last, rounds - 1));
                    self.add(body, rounds);
                }
            }
        }
    }

    /// One number by which choices are compared: about eight to the nanosecond.
    pub fn work(&self) -> u32 {
        weighed(self.straight).saturating_add(self.in_systems())
    }

    /// By the counting rule, with all rounds of iterations.
    pub fn operations(&self) -> Cost {
        let systems = self.systems.iter().map(|&(size, symmetric, times)| repeated(of_system(size, symmetric), times));
        systems.fold(self.straight, Cost::plus)
    }

    fn in_systems(&self) -> u32 {
        let systems =
            self.systems.iter().map(|&(size, symmetric, times)| times.saturating_mul(system(size, symmetric)));
        systems.fold(0, u32::saturating_add)
    }

    /// What the structure of the equations makes dear, where that is a quarter of the work or more.
    pub fn burden(&self) -> Option<String> {
        let share = |part: u32| 100.0 * f64::from(part) / f64::from(self.work().max(1));
        let (systems, rounds) = (share(self.in_systems()), share(weighed(self.rounds)));
        let largest = self.systems.iter().map(|(size, ..)| *size).max().unwrap_or(0);
        if rounds.max(systems) < 25.0 {
            return None;
        }
        Some(match rounds > systems {
            true => format!("{rounds:.0} percent of its work in the rounds of Newton's method"),
            false => format!("{systems:.0} percent of its work in linear systems, the largest of {largest} unknowns"),
        })
    }
}

fn weighed(cost: Cost) -> u32 {
    let Cost { add, mul, div, sqrt, sincos, compare, other } = cost;
    let weighed =
        [(add, SHORT), (mul, SHORT), (compare, SHORT), (div, LONG), (sqrt, LONG), (sincos, SINES), (other, CALL)];
    weighed.into_iter().map(|(count, weight)| count.saturating_mul(weight)).fold(0, u32::saturating_add)
}

/// A pivoted solution.
fn system(size: usize, symmetric: bool) -> u32 {
    let n = u32::try_from(size).unwrap_or(u32::MAX);
    let square = n.saturating_mul(n);
    let eliminated = square.saturating_mul(n).saturating_mul(ELIMINATION) / if symmetric { 2 } else { 1 };
    eliminated.saturating_add(square.saturating_mul(PIVOTING))
}

/// As the compiler's count has it.
fn of_system(size: usize, symmetric: bool) -> Cost {
    Cost::of_block(&BlockKind::Solve { size, symmetric, groups: Box::default() })
}

fn of_all<'a>(expressions: impl IntoIterator<Item = &'a Expression>) -> Cost {
    expressions.into_iter().map(of_expression).fold(Cost::default(), Cost::plus)
}

fn of_expression(expression: &Expression) -> Cost {
    let (own, operands): (Cost, Vec<&Expression>) = match expression {
        Expression::Literal(_) | Expression::Symbol(_) | Expression::Field(_) | Expression::Local(_) => {
            (Cost::default(), Vec::new())
        }
        Expression::Neg(inner) => (Cost::default(), vec![inner]),
        Expression::Pack(_) => (Cost::default(), Vec::new()),
        Expression::Sum(terms) => {
            (Cost { add: count(terms) - 1, ..Cost::default() }, terms.iter().map(|(_, term)| term).collect())
        }
        Expression::Fused(operands) => (Cost { add: 1, mul: 1, ..Cost::default() }, operands.iter().collect()),
        Expression::Product(factors) => (Cost { mul: count(factors) - 1, ..Cost::default() }, factors.iter().collect()),
        Expression::Quotient(a, b) => (Cost { div: 1, ..Cost::default() }, vec![a, b]),
        Expression::Call(call, arguments) => (of_call(*call), arguments.iter().collect()),
    };
    operands.into_iter().map(of_expression).fold(own, Cost::plus)
}

fn of_call(call: Call) -> Cost {
    let cost = Cost::default();
    match call {
        Call::Nan | Call::Epsilon => cost,
        Call::Sqrt => Cost { sqrt: 1, ..cost },
        Call::Min | Call::Max | Call::Select => Cost { add: 1, ..cost },
        call if call.is_comparison() => Cost { compare: 1, ..cost },
        _ => Cost { other: 1, ..cost },
    }
}

fn count<T>(list: &[T]) -> u32 {
    size(list).max(1)
}

fn size<T>(list: &[T]) -> u32 {
    u32::try_from(list.len()).unwrap_or(u32::MAX)
}

/// An operation of the count, kind by kind.
fn kinds(a: Cost, b: Cost, of: impl Fn(u32, u32) -> u32) -> Cost {
    Cost {
        add: of(a.add, b.add),
        mul: of(a.mul, b.mul),
        div: of(a.div, b.div),
        sqrt: of(a.sqrt, b.sqrt),
        sincos: of(a.sincos, b.sincos),
        compare: of(a.compare, b.compare),
        other: of(a.other, b.other),
    }
}

fn repeated(cost: Cost, times: u32) -> Cost {
    kinds(cost, cost, |count, _| count.saturating_mul(times))
}

fn less(cost: Cost, part: Cost) -> Cost {
    kinds(cost, part, u32::saturating_sub)
}
