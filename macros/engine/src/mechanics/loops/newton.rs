//! Stage `mechanics`: coordinates that Newton's method finds.
//!
//! In: the equations of a step on the tree, the guess. Out: the block of the graph that iterates, and with the Jacobian where it
//! has ended the rates and accelerations: J x' = -E' and J x'' = -E''.
//!
//! An angle that equations read by its cosine and sine alone is iterated as that point (c, s) on the circle, so sines are
//! taken of the guess once and of nothing afterwards. How far it is turned, or a number is moved, in a round: `newton/steps`. In exact
//! arithmetic the point stays on the circle, and small steps add small errors. The angle itself, for the next guess or whoever
//! asks, is the guess and what the point has turned by: whole turns are those of the guess.

mod steps;

use std::collections::HashSet;

use crate::contracts::call::Call;
use crate::contracts::symbol::Symbol;
use crate::invariant::fault::{OrFault, raise};
use crate::mechanics::equations::Equations;
use crate::mechanics::translate::names;
use crate::symbolic::differentiate::Differentiator;
use crate::symbolic::graph::{BlockKind, Graph, Scalar};
use crate::symbolic::lower::Lowering;

use super::reduction::{Definition, Map, Newton, Reduction};
use super::structure::{Means, Step};
use steps::Move;

/// Rounds where the model asks for none: of Newton's method, which three take to rounding from the solution of the last step; a few more
/// serve coarse guesses. The residual tells whether they were enough.
const ROUNDS: usize = 6;
/// ..and of third order.
const ROUNDS_ALONE: usize = 3;

/// An unknown of an iteration.
struct Unknown {
    /// Its position on the tree.
    symbol: Scalar,
    /// What stands for it inside the iteration as a number.
    inner: Scalar,
    /// The same as a point on the circle, if nothing reads the angle itself.
    point: Option<[Scalar; 2]>,
    /// The guess.
    start: Scalar,
    name: String,
}

impl Equations<'_> {
    /// Newton's method on the equations of a step, from the guess, a fixed number of times.
    pub(super) fn iterate(&mut self, step: &Step, newton: Newton, reduction: &mut Reduction) -> Vec<Definition> {
        let Means::Newton { rows, guess } = &step.means else { return Vec::new() };
        let size = step.unknowns.len();
        let symbols: Vec<[Scalar; 3]> = step.unknowns.iter().map(|&u| self.coordinate_symbols(u)).collect();
        let equations: Vec<Scalar> = rows.iter().map(|row| self.row(*row)).collect();
        // A coupled coordinate may depend on the unknowns: it moves with them.
        let equations = self.g.substitute(&equations, &reduction.coupled);
        let later = self.later_unknowns(step);
        let equations = self.g.substitute(&equations, &later);
        let mut matrix = Vec::with_capacity(size * size);
        for &equation in &equations {
            for symbol in &symbols {
                matrix.push(self.g.derivative(equation, &[(symbol[0], Scalar::ONE)]));
            }
        }
        let unknowns = self.unknowns_of(step, *guess, &equations);
        let (positions, residual) = self.solve_by(newton, &unknowns, [&equations, &matrix], &reduction.map);
        reduction.residuals.push(residual);
        reduction.matrices.push(matrix.clone());
        reduction.guesses.extend(&positions);
        // Rates: J x' = -E', with everything on the tree.
        let unknowns: Vec<(Scalar, Scalar)> = symbols.iter().map(|s| (s[1], s[2])).collect();
        let derivatives: Vec<(Scalar, Scalar)> =
            equations.iter().map(|&equation| self.implicit_rates(equation, &unknowns, false)).collect();
        let first: Vec<Scalar> = derivatives.iter().map(|d| -d.0).collect();
        let second: Vec<Scalar> = derivatives.iter().map(|d| -d.1).collect();
        let [rates, accelerations] = self.solve_rates(size, &matrix, [&first, &second], Self::eliminate);
        let mut definitions = Vec::with_capacity(size);
        for (k, &coordinate) in step.unknowns.iter().enumerate() {
            definitions.push(Definition {
                coordinate,
                position: positions[k],
                rate: rates[k],
                acceleration: accelerations[k],
            });
        }
        definitions
    }

    /// How the unknowns of a step are iterated.
    fn unknowns_of(&mut self, step: &Step, guess: usize, equations: &[Scalar]) -> Vec<Unknown> {
        let symbols: Vec<Scalar> = step.unknowns.iter().map(|&u| self.coordinate_symbols(u)[0]).collect();
        let points: Vec<[Scalar; 2]> =
            (0..symbols.len()).map(|k| self.scene.symbols.unknown_point(guess + k)).collect();
        // Where all are points, an angle that is left when vectors have become scalars is read as such.
        let angles: Vec<Scalar> = points.iter().map(|&[cos, sin]| self.g.angle(cos, sin)).collect();
        let map = self.map(&symbols.iter().copied().zip(angles).collect::<Vec<_>>());
        let tried = self.g.substitute(equations, &map);
        let mut lowering = Lowering::new(&self.g);
        let lowered = lowering.run(&tried);
        let read = lowering.to.angles_read(&lowered);
        let unknown = |k: usize| {
            let joint = step.unknowns[k].joint;
            let name = names::symbol(self.scene.model, Symbol::Position { joint, component: step.unknowns[k].index });
            let is_read = points[k].iter().filter_map(|&part| self.g.symbol_id(part)).any(|id| read.contains(&id));
            let point = (!is_read).then_some(points[k]);
            let start = self.scene.symbols.guess(guess + k);
            Unknown { symbol: symbols[k], inner: self.scene.symbols.unknown(guess + k), point, start, name }
        };
        (0..symbols.len()).map(unknown).collect()
    }

    /// Values of unknowns, and the greatest residual. The equations and their derivatives by the unknowns, row by row, are given
    /// on the tree.
    fn solve_by(
        &mut self,
        newton: Newton,
        unknowns: &[Unknown],
        [equations, matrix]: [&[Scalar]; 2],
        known: &Map,
    ) -> (Vec<Scalar>, Scalar) {
        // Inside the loop the unknowns are symbols of its own; known coordinates are put in, so that the loop reads values.
        let mut map = known.clone();
        let inside: Vec<(Scalar, Scalar)> = unknowns
            .iter()
            .map(|unknown| match (newton, unknown.point) {
                (Newton::AtGuess, _) => (unknown.symbol, unknown.start),
                (Newton::Iterated, None) => (unknown.symbol, unknown.inner),
                (Newton::Iterated, Some([cos, sin])) => (unknown.symbol, self.g.angle(cos, sin)),
            })
            .collect();
        map.extend(self.map(&inside));
        let values = self.g.substitute(equations, &map);
        let g = &mut self.g;
        let residual = values.iter().fold(Scalar::ZERO, |worst, &value| {
            let size = g.call(Call::Abs, &[value]);
            if worst == Scalar::ZERO { size } else { g.call(Call::Max, &[worst, size]) }
        });
        if newton == Newton::AtGuess {
            return (unknowns.iter().map(|unknown| unknown.start).collect(), residual);
        }
        let entries = self.g.substitute(matrix, &map);
        let rounds = self.scene.model.rounds;
        let (count, moves) = match (unknowns, &values[..], &entries[..]) {
            ([unknown], &[value], &[slope]) => {
                let curvature = self.g.derivative(matrix[0], &[(unknown.symbol, Scalar::ONE)]);
                let curvature = self.g.substitute(&[curvature], &map)[0];
                let moving = Move::of_third_order(&mut self.g, [value, slope, curvature], unknown.point.is_some());
                (rounds.map_or(ROUNDS_ALONE, steps::of_third_order), vec![moving])
            }
            _ => {
                let found = self.eliminate(unknowns.len(), &entries, &values);
                let moves = unknowns.iter().zip(found);
                let moves = moves.map(|(unknown, by)| Move::by(&mut self.g, by, unknown.point.is_some())).collect();
                (rounds.unwrap_or(ROUNDS), moves)
            }
        };
        let (mut symbols, mut start, mut next) = (Vec::new(), Vec::new(), Vec::new());
        for (unknown, moving) in unknowns.iter().zip(moves) {
            match (unknown.point, moving) {
                (Some(point), Move::Turn { w, m, n }) => {
                    symbols.extend(point);
                    start.extend([self.g.cos(unknown.start), self.g.sin(unknown.start)]);
                    next.extend(steps::turned_back(&mut self.g, point, [w, m, n]));
                }
                (None, Move::Shift(by)) => {
                    symbols.push(unknown.inner);
                    start.push(unknown.start);
                    next.push(self.g.sub(unknown.inner, by));
                }
                (Some(_), Move::Shift(_)) | (None, Move::Turn { .. }) => raise("a point turns, and a number shifts"),
            }
        }
        let unknown_ids = symbols.iter().filter_map(|&s| self.g.symbol_id(s)).collect();
        let kind = BlockKind::Iterate { unknowns: unknown_ids, count };
        let operands: Vec<Scalar> = start.into_iter().chain(next).chain([residual]).collect();
        let mut outputs = self.g.block_outputs(kind, &operands).into_iter();
        let mut positions = Vec::with_capacity(unknowns.len());
        for unknown in unknowns {
            let mut output = || outputs.next().or_fault("an iteration has all its unknowns and a residual");
            let name = &unknown.name;
            let position = if unknown.point.is_some() {
                let (cos, sin) = (output(), output());
                self.g.name(cos, || format!("cos_{name}"));
                self.g.name(sin, || format!("sin_{name}"));
                angle_near(&mut self.g, unknown.start, [cos, sin])
            } else {
                output()
            };
            positions.push(self.g.name(position, || name.clone()));
        }
        let residual = outputs.next().or_fault("an iteration has a residual");
        if let ([unknown], [position], [equation]) = (unknowns, &positions[..], equations) {
            // What the last of few rounds leaves says more than what it began with.
            let mut map = known.clone();
            map.extend(self.map(&[(unknown.symbol, *position)]));
            let value = self.g.substitute(&[*equation], &map)[0];
            let left = self.g.call(Call::Abs, &[value]);
            return (positions, left);
        }
        (positions, residual)
    }

    /// Rates and accelerations from right-hand sides that are linear in what is known of them. Where few velocities are known,
    /// the velocity map is solved for column by column: rates, the transposed map and the mass matrix are products with it. Else
    /// the matrix is inverted, column by column.
    pub(super) fn solve_rates(
        &mut self,
        size: usize,
        matrix: &[Scalar],
        [first, second]: [&[Scalar]; 2],
        solve: fn(&mut Self, usize, &[Scalar], &[Scalar]) -> Vec<Scalar>,
    ) -> [Vec<Scalar>; 2] {
        let read: HashSet<usize> = self.g.reachable_scalars(first).into_iter().collect();
        let velocities = self.all_velocities();
        let known: Vec<Scalar> = velocities.into_iter().filter(|v| read.contains(&v.index())).collect();
        if known.len() >= size {
            let unit = |at: usize| (0..size).map(|k| if k == at { Scalar::ONE } else { Scalar::ZERO }).collect();
            let units: Vec<Vec<Scalar>> = (0..size).map(unit).collect();
            let columns: Vec<Vec<Scalar>> = units.iter().map(|unit| solve(self, size, matrix, unit)).collect();
            return [first, second].map(|side| combined(&mut self.g, &columns, side, size));
        }
        let mut columns = Vec::with_capacity(known.len() + 1);
        for &velocity in &known {
            let mut along = Differentiator::new(&[(velocity, Scalar::ONE)]);
            let side: Vec<Scalar> = first.iter().map(|&rate| along.scalar(&mut self.g, rate)).collect();
            columns.push(solve(self, size, matrix, &side));
        }
        // What changes by time alone.
        let still: Vec<(Scalar, Scalar)> = known.iter().map(|&velocity| (velocity, Scalar::ZERO)).collect();
        let still = self.map(&still);
        let rest = self.g.substitute(first, &still);
        columns.push(solve(self, size, matrix, &rest));
        let factors: Vec<Scalar> = known.into_iter().chain([Scalar::ONE]).collect();
        [combined(&mut self.g, &columns, &factors, size), solve(self, size, matrix, second)]
    }

    /// Unknowns of the steps behind this one, at zero: they stand in its equations in form alone, as a point turned there and back,
    /// so any value will do.
    pub(super) fn later_unknowns(&self, step: &Step) -> Map {
        let behind = self.scene.structure.steps.iter().skip_while(|other| other.unknowns != step.unknowns).skip(1);
        let unknowns = behind.flat_map(|other| other.unknowns.iter().copied());
        let pairs: Vec<(Scalar, Scalar)> =
            unknowns.map(|unknown| (self.coordinate_symbols(unknown)[0], Scalar::ZERO)).collect();
        self.map(&pairs)
    }
}

/// The sum of columns times factors.
fn combined(g: &mut Graph, columns: &[Vec<Scalar>], factors: &[Scalar], size: usize) -> Vec<Scalar> {
    let row = |row: usize| {
        let terms: Vec<Scalar> =
            columns.iter().zip(factors).map(|(column, &factor)| g.mul(column[row], factor)).collect();
        g.sum(&terms)
    };
    (0..size).map(row).collect()
}

/// The angle of a point that is less than half a turn from the one at which it was sought.
fn angle_near(g: &mut Graph, start: Scalar, [cos, sin]: [Scalar; 2]) -> Scalar {
    let (from_cos, from_sin) = (g.cos(start), g.sin(start));
    let products = [g.mul(cos, from_cos), g.mul(sin, from_sin), g.mul(sin, from_cos), -g.mul(cos, from_sin)];
    let (cos, sin) = (g.sum(&products[..2]), g.sum(&products[2..]));
    let turned = g.angle(cos, sin);
    g.add(start, turned)
}
