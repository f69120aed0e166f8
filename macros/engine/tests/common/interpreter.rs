//! Programs as numbers: statement by statement in double precision.

use multibody_engine::contracts::call::Call;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::optimize::program::{Expression, FieldId, Local, MEMBERS, Program, Statement};
use multibody_engine::symbolic::evaluate::{call_f64, solve_f64};

/// Results of a program.
pub(crate) fn run(program: &Program, symbols: &dyn Fn(Symbol) -> f64, fields: &dyn Fn(FieldId) -> f64) -> Vec<f64> {
    let packs = vec![None; program.locals.len()];
    let mut machine = Machine { locals: vec![None; program.locals.len()], packs, symbols, fields };
    machine.run(&program.statements);
    program.results.iter().map(|e| machine.value(e)).collect()
}

struct Machine<'a> {
    locals: Vec<Option<f64>>,
    packs: Vec<Option<[f64; MEMBERS]>>,
    symbols: &'a dyn Fn(Symbol) -> f64,
    fields: &'a dyn Fn(FieldId) -> f64,
}

impl Machine<'_> {
    fn run(&mut self, statements: &[Statement]) {
        for statement in statements {
            self.statement(statement);
        }
    }

    /// Outside of loops a local is set once.
    fn set(&mut self, local: Local, value: f64) {
        self.locals[local.0] = Some(value);
    }

    fn statement(&mut self, statement: &Statement) {
        match statement {
            Statement::Let { local, value } => {
                let value = self.value(value);
                self.set(*local, value);
            }
            Statement::SinCos(sines) => {
                let angles: Vec<f64> = sines.iter().map(|sine| self.value(&sine.angle)).collect();
                for (sine, angle) in sines.iter().zip(angles) {
                    self.set(sine.sin, angle.sin());
                    self.set(sine.cos, angle.cos());
                }
            }
            Statement::Called { function, arguments, value, slopes } => {
                let arguments: Vec<f64> = arguments.iter().map(|argument| self.value(argument)).collect();
                self.set(*value, call_f64(Call::External(*function), &arguments));
                for (k, &slope) in slopes.iter().enumerate() {
                    self.set(slope, call_f64(Call::ExternalSlope(*function, k), &arguments));
                }
            }
            Statement::Pack { local, value, .. } => self.packs[local.0] = Some(self.members(value)),
            Statement::PackSines(_, sine) => {
                let angles = self.members(&sine.angle);
                self.packs[sine.sin.0] = Some(angles.map(f64::sin));
                self.packs[sine.cos.0] = Some(angles.map(f64::cos));
            }
            Statement::Members { pack, members, .. } => {
                for (local, value) in members.iter().zip(self.members(pack)) {
                    local.iter().for_each(|&local| self.set(local, value));
                }
            }
            Statement::Solve { symmetric, groups, matrix, rhs, measures, results, .. } => {
                let (matrix, rhs, measures) = (self.values(matrix), self.values(rhs), self.values(measures));
                let solved = match symmetric {
                    true => solve_symmetric(&matrix, &rhs, (&measures, groups)),
                    false => solve_f64(&matrix, &rhs),
                };
                results.iter().zip(solved).for_each(|(&local, x)| self.set(local, x));
            }
            Statement::Iterate { count, unknowns, start, body, next, residual } => {
                let mut values = self.values(start);
                for _ in 0..*count {
                    unknowns.iter().zip(&values).for_each(|(&local, &x)| self.set(local, x));
                    // What a round doesn't set, it can't read: nothing is left of the one before.
                    body.iter().flat_map(Statement::defined).for_each(|local| self.locals[local.0] = None);
                    self.run(body);
                    let size = self.value(&residual.1);
                    self.set(residual.0, size);
                    values = self.values(next);
                }
                body.iter().flat_map(Statement::defined).for_each(|local| self.locals[local.0] = None);
                unknowns.iter().zip(&values).for_each(|(&local, &x)| self.set(local, x));
            }
        }
    }

    fn values(&self, list: &[Expression]) -> Vec<f64> {
        list.iter().map(|e| self.value(e)).collect()
    }

    /// Of an expression on packs: scalars stand in packs alone there.
    fn members(&self, expression: &Expression) -> [f64; MEMBERS] {
        let each =
            |a: [f64; MEMBERS], b: [f64; MEMBERS], of: fn(f64, f64) -> f64| std::array::from_fn(|k| of(a[k], b[k]));
        match expression {
            Expression::Local(local) => self.packs[local.0].expect("a pack that is set"),
            Expression::Pack(list) => match &self.values(list)[..] {
                [one] => [*one; MEMBERS],
                list => list.try_into().expect("a scalar for each member"),
            },
            Expression::Neg(x) => self.members(x).map(|x| -x),
            Expression::Sum(terms) => terms.iter().fold([0.0; MEMBERS], |sum, (minus, term)| {
                each(sum, self.members(term), if *minus { |a, b| a - b } else { |a, b| a + b })
            }),
            Expression::Fused(operands) => {
                let [a, b, c] = operands.each_ref().map(|operand| self.members(operand));
                std::array::from_fn(|k| a[k].mul_add(b[k], c[k]))
            }
            Expression::Product(list) => {
                list.iter().fold([1.0; MEMBERS], |product, factor| each(product, self.members(factor), |a, b| a * b))
            }
            Expression::Quotient(a, b) => each(self.members(a), self.members(b), |a, b| a / b),
            Expression::Call(Call::Sqrt, x) => self.members(&x[0]).map(f64::sqrt),
            other => panic!("no expression on packs: {other:?}"),
        }
    }

    fn value(&self, expression: &Expression) -> f64 {
        match expression {
            Expression::Literal(x) => *x,
            Expression::Symbol(symbol) => (self.symbols)(*symbol),
            Expression::Field(field) => (self.fields)(*field),
            Expression::Local(local) => self.locals[local.0].expect("a local that is set"),
            Expression::Neg(x) => -self.value(x),
            Expression::Sum(terms) => {
                terms.iter().fold(0.0, |sum, (minus, x)| if *minus { sum - self.value(x) } else { sum + self.value(x) })
            }
            Expression::Fused(operands) => {
                let [a, b, c] = operands.each_ref().map(|operand| self.value(operand));
                a.mul_add(b, c)
            }
            Expression::Product(list) => list.iter().map(|x| self.value(x)).product(),
            Expression::Quotient(a, b) => self.value(a) / self.value(b),
            Expression::Call(Call::Sqrt, x) => self.value(&x[0]).sqrt(),
            Expression::Call(call, list) => call_f64(*call, &self.values(list)),
            Expression::Pack(_) => panic!("a pack is no number"),
        }
    }
}

/// The unknowns of a symmetric system given by rows, then its rank: pivots from the diagonal, measured as the runtime's
/// `linear::solve_symmetric_measured` does. Without measures these are the diagonal, without groups each row is one.
fn solve_symmetric(matrix: &[f64], rhs: &[f64], (measures, groups): (&[f64], &[usize])) -> Vec<f64> {
    let n = rhs.len();
    let threshold = 16.0 * n as f64 * f64::EPSILON;
    let mut a: Vec<Vec<f64>> = matrix.chunks(n).map(<[f64]>::to_vec).collect();
    let measure = |k: usize| if measures.is_empty() { matrix[k * n + k] } else { measures[k] };
    let group = |k: usize| if groups.is_empty() { k } else { groups[k] };
    let greatest = |k: usize| (0..n).filter(|&other| group(other) == group(k)).map(measure).fold(0.0, f64::max);
    let counts = |k: usize| measure(k) > threshold * threshold * greatest(k);
    let size = |a: &[Vec<f64>], k: usize| if counts(k) { a[k][k] / measure(k) } else { 0.0 };
    let (mut left, mut taken): (Vec<usize>, Vec<usize>) = ((0..n).collect(), Vec::new());
    let mut b = rhs.to_vec();
    while let Some(&k) = left.iter().max_by(|&&i, &&j| size(&a, i).total_cmp(&size(&a, j))) {
        if size(&a, k) <= threshold {
            break;
        }
        left.retain(|&other| other != k);
        taken.push(k);
        for &i in &left {
            let factor = a[i][k] / a[k][k];
            left.iter().for_each(|&j| a[i][j] -= factor * a[k][j]);
            b[i] -= factor * b[k];
        }
    }
    let mut x = vec![0.0; n];
    for &k in taken.iter().rev() {
        let known: f64 = (0..n).filter(|&j| j != k).map(|j| a[k][j] * x[j]).sum();
        x[k] = (b[k] - known) / a[k][k];
    }
    x.push(taken.len() as f64);
    x
}
