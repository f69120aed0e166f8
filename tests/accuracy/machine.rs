//! Emitted programs in a scalar, statement by statement, by the runtime that generated code calls.
//!
//! Sums and products go from left to right, as they are printed; sines of one group go through one call, systems through the
//! runtime's own solvers. These are generic over the size, which is known here only as the program runs: a system is filled up with
//! zeros to the next size that is compiled. Rows of zeros are never chosen before others, change no other number and
//! don't count in the rank, so solutions have the bits that the size itself gives; the threshold of the rank grows with the size.

use multibody::Real;
use multibody::linear::{solve, solve_symmetric_measured};
use multibody_engine::contracts::call::Call;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::optimize::program::{Expression, Local, MEMBERS, Program, Sine, Statement};

/// What programs read.
pub(crate) struct Reads<'a, T> {
    pub(crate) symbol: &'a dyn Fn(Symbol) -> T,
    pub(crate) fields: &'a [T],
}

/// Results of a program.
pub(crate) fn run<T: Real>(program: &Program, reads: &Reads<'_, T>) -> Vec<T> {
    let nothing = T::lit(f64::NAN);
    let count = program.locals.len();
    let mut machine = Machine { locals: vec![[nothing; MEMBERS]; count], member: 0, reads };
    machine.run(&program.statements);
    machine.values(&program.results)
}

struct Machine<'a, T> {
    /// A scalar stands in all members.
    locals: Vec<[T; MEMBERS]>,
    /// Of packs that is worked with.
    member: usize,
    reads: &'a Reads<'a, T>,
}

/// A call of what is generic over a size, with the first of these sizes that is large enough.
macro_rules! sized {
    ($n:expr, $of:ident $arguments:tt, $($size:literal)*) => {
        match $n {
            $(n if n <= $size => $of::<T, $size> $arguments,)*
            n => panic!("{n} in one call: add a size"),
        }
    };
}

impl<T: Real> Machine<'_, T> {
    fn run(&mut self, statements: &[Statement]) {
        statements.iter().for_each(|statement| self.statement(statement));
    }

    fn set(&mut self, local: Local, value: T) {
        self.locals[local.0] = [value; MEMBERS];
    }

    fn statement(&mut self, statement: &Statement) {
        match statement {
            Statement::Let { local, value } => {
                let value = self.value(value);
                self.set(*local, value);
            }
            Statement::SinCos(sines) => self.sines(sines),
            Statement::Called { .. } => unreachable!("no model here calls functions of Rust"),
            Statement::Pack { local, value, .. } => self.locals[local.0] = self.members(value),
            Statement::PackSines(_, sine) => {
                let points = Real::sin_cos_all(self.members(&sine.angle));
                self.locals[sine.sin.0] = points.map(|point| point.0);
                self.locals[sine.cos.0] = points.map(|point| point.1);
            }
            Statement::Members { pack, members, .. } => {
                for (local, value) in members.iter().zip(self.members(pack)) {
                    local.iter().for_each(|&local| self.set(local, value));
                }
            }
            Statement::Solve { size, symmetric, groups, matrix, rhs, measures, results } => {
                let [matrix, rhs, measures] = [matrix, rhs, measures].map(|list| self.values(list));
                debug_assert_eq!(rhs.len(), *size);
                let x =
                    if *symmetric { solved_symmetric(&matrix, &rhs, &measures, groups) } else { solved(&matrix, &rhs) };
                results.iter().zip(x).for_each(|(&local, x)| self.set(local, x));
            }
            Statement::Iterate { count, unknowns, start, body, next, residual } => {
                let mut values = self.values(start);
                for _ in 0..*count {
                    unknowns.iter().zip(&values).for_each(|(&local, &x)| self.set(local, x));
                    self.run(body);
                    let size = self.value(&residual.1);
                    self.set(residual.0, size);
                    values = self.values(next);
                }
                unknowns.iter().zip(&values).for_each(|(&local, &x)| self.set(local, x));
            }
        }
    }

    fn sines(&mut self, sines: &[Sine]) {
        let angles: Vec<T> = sines.iter().map(|sine| self.value(&sine.angle)).collect();
        let points = match angles[..] {
            [angle] => vec![Real::sin_cos(angle)],
            _ => sized!(angles.len(), together(&angles), 2 3 4 5 6 7 8),
        };
        for (sine, (sin, cos)) in sines.iter().zip(points) {
            self.set(sine.sin, sin);
            self.set(sine.cos, cos);
        }
    }

    fn members(&mut self, expression: &Expression) -> [T; MEMBERS] {
        let values = std::array::from_fn(|member| {
            self.member = member;
            self.value(expression)
        });
        self.member = 0;
        values
    }

    fn values(&self, list: &[Expression]) -> Vec<T> {
        list.iter().map(|expression| self.value(expression)).collect()
    }

    fn value(&self, expression: &Expression) -> T {
        match expression {
            Expression::Literal(x) => T::lit(*x),
            Expression::Symbol(symbol) => (self.reads.symbol)(*symbol),
            Expression::Field(field) => self.reads.fields[field.0],
            Expression::Local(local) => self.locals[local.0][self.member],
            Expression::Pack(list) => self.value(&list[self.member.min(list.len() - 1)]),
            Expression::Neg(x) => -self.value(x),
            Expression::Sum(terms) => terms.iter().fold(T::lit(-0.0), |sum, (minus, term)| {
                let term = self.value(term);
                if *minus { sum - term } else { sum + term }
            }),
            // With one rounding, as on targets that have an instruction for it.
            Expression::Fused(operands) => {
                let [a, b, c] = operands.each_ref().map(|operand| self.value(operand));
                a.simd_mul_add(b, c)
            }
            Expression::Product(list) => list.iter().fold(T::lit(1.0), |product, factor| product * self.value(factor)),
            Expression::Quotient(a, b) => self.value(a) / self.value(b),
            Expression::Call(call, list) => function(*call, &self.values(list)),
        }
    }
}

fn function<T: Real>(call: Call, x: &[T]) -> T {
    let zero = T::lit(0.0);
    let mask = |mask: T::Mask| Real::select(mask, T::lit(1.0), zero);
    let is = |x: T| !Real::eq(x, zero);
    match call {
        Call::External(_) | Call::ExternalSlope(..) | Call::ExternalCurvature(_) => {
            unreachable!("no model here calls functions of Rust")
        }
        Call::Epsilon => <T as Real>::epsilon(),
        Call::Nan => T::lit(f64::NAN),
        Call::Tan => Real::tan(x[0]),
        Call::Asin => Real::asin(x[0]),
        Call::Acos => Real::acos(x[0]),
        Call::Atan => Real::atan(x[0]),
        Call::Atan2 => Real::atan2(x[0], x[1]),
        Call::Sinh => Real::sinh(x[0]),
        Call::Cosh => Real::cosh(x[0]),
        Call::Tanh => Real::tanh(x[0]),
        Call::Exp => Real::exp(x[0]),
        Call::Ln => Real::ln(x[0]),
        Call::Powf => Real::powf(x[0], x[1]),
        Call::Sqrt => Real::sqrt(x[0]),
        Call::Abs => Real::abs(x[0]),
        Call::Signum => Real::signum(x[0]),
        Call::Min => Real::min(x[0], x[1]),
        Call::Max => Real::max(x[0], x[1]),
        Call::Less => mask(Real::lt(x[0], x[1])),
        Call::LessEqual => mask(Real::le(x[0], x[1])),
        Call::Equal => mask(Real::eq(x[0], x[1])),
        Call::And => mask(is(x[0]) & is(x[1])),
        Call::Or => mask(is(x[0]) | is(x[1])),
        Call::Not => mask(!is(x[0])),
        Call::Select => Real::select(is(x[0]), x[1], x[2]),
    }
}

fn together<T: Real, const N: usize>(angles: &[T]) -> Vec<(T, T)> {
    T::sin_cos_all::<N>(std::array::from_fn(|k| angles[k])).to_vec()
}

/// Filled up with zeros.
fn square<T: Real, const N: usize>(matrix: &[T], size: usize) -> [[T; N]; N] {
    let entry = |i: usize, j: usize| if i.max(j) < size { matrix[i * size + j] } else { T::lit(0.0) };
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
}

/// The same.
fn column<T: Real, const N: usize>(list: &[T]) -> [T; N] {
    std::array::from_fn(|k| list.get(k).copied().unwrap_or(T::lit(0.0)))
}

/// The unknowns, then the rank.
fn solved<T: Real>(matrix: &[T], rhs: &[T]) -> Vec<T> {
    sized!(rhs.len(), system(matrix, rhs), 1 2 3 4 5 6 7 8 9 10 11 12 14 16 20 24 32 48 64 96 128)
}

fn solved_symmetric<T: Real>(matrix: &[T], rhs: &[T], measures: &[T], groups: &[usize]) -> Vec<T> {
    sized!(rhs.len(), symmetric_system(matrix, rhs, measures, groups), 1 2 3 4 5 6 7 8 9 10 11 12 14 16 20 24 32 48 64 96 128)
}

fn system<T: Real, const N: usize>(matrix: &[T], rhs: &[T]) -> Vec<T> {
    let size = rhs.len();
    let (x, rank) = solve::<T, N>(square(matrix, size), column(rhs));
    x.into_iter().take(size).chain([rank]).collect()
}

fn symmetric_system<T: Real, const N: usize>(matrix: &[T], rhs: &[T], measures: &[T], groups: &[usize]) -> Vec<T> {
    let size = rhs.len();
    let matrix = square::<T, N>(matrix, size);
    let measures = if measures.is_empty() { std::array::from_fn(|k| matrix[k][k]) } else { column(measures) };
    // What is zero is never the greatest of a group, whichever it is in.
    let groups = std::array::from_fn(|k| groups.get(k).copied().unwrap_or(k));
    let (x, rank) = solve_symmetric_measured(matrix, column(rhs), measures, &groups);
    x.into_iter().take(size).chain([rank]).collect()
}

#[cfg(test)]
mod tests {
    use multibody::linear::{solve, solve_symmetric};
    use multibody_tests::support::random::Random;

    use super::{solved, solved_symmetric};

    /// Filled up, a system has the solution that the runtime gives it in its own size, to the last bit.
    #[test]
    fn zeros_change_no_bit() {
        const N: usize = 17;
        let mut random = Random::new(17);
        for rank in [N, N - 3] {
            let rows: [[f64; N]; N] = std::array::from_fn(|_| std::array::from_fn(|_| random.unit()));
            // The last rows repeat the first ones where the rank is less.
            let row = |i: usize| if i < rank { rows[i] } else { rows[i - rank] };
            let rows: [[f64; N]; N] = std::array::from_fn(row);
            let gram: [[f64; N]; N] = rows.map(|a| rows.map(|b| a.iter().zip(b).fold(0.0, |sum, (x, y)| sum + x * y)));
            let rhs: [f64; N] = std::array::from_fn(|k| rows[k][0] + rows[k][1]);
            let (x, full) = solve(rows, rhs);
            assert_eq!(full, rank as f64);
            assert_eq!(solved(rows.as_flattened(), &rhs), [&x[..], &[full]].concat());
            let (x, full) = solve_symmetric(gram, rhs);
            assert_eq!(full, rank as f64);
            assert_eq!(solved_symmetric(gram.as_flattened(), &rhs, &[], &[]), [&x[..], &[full]].concat());
        }
    }
}
