//! Stage `mechanics`: rates that follow from velocity coordinates which are no rates of the state.
//!
//! In: equations of velocities A v + b = 0 that keep no multipliers, what speeds of the user's choice stand for, u = U v + c, definitions
//! of dependent coordinates. Out: rates and accelerations of the coordinates x whose rates these give, as many as equations. With
//! E(v, u) = 0 for all of them and J = dE/dx', constant in velocities, J x' = -E at x' = 0 and J x'' = -E' at x'' = 0. So v = N u + n, and
//! all that stands on the velocity map, mass matrix, efforts, Jacobians, is in u without knowing it (Kane and Levinson 1985; Maggi's
//! equations).
//!
//! What depends on positions in steps of its own has been defined before, in rates of the state: its rates are put into E, and what
//! follows here is put into them.

use crate::invariant::fault::raise;
use crate::mechanics::equations::Equations;
use crate::model::types::Coordinate;
use crate::symbolic::differentiate::Differentiator;
use crate::symbolic::graph::Scalar;

use super::reduction::{Definition, Map, Reduction};

/// Rates and accelerations that were found, on the tree.
#[derive(Default)]
struct Followed {
    unknowns: Vec<Coordinate>,
    values: Vec<[Scalar; 2]>,
}

impl Followed {
    fn add(&mut self, unknowns: &[Coordinate], rates: &[Scalar], accelerations: &[Scalar]) {
        self.unknowns.extend(unknowns);
        self.values.extend(rates.iter().zip(accelerations).map(|(&rate, &acceleration)| [rate, acceleration]));
    }
}

impl Equations<'_> {
    /// Adds the rates that are no velocity coordinates. `rates` are those of dependents in rates of the state, on the tree.
    pub(super) fn follow_speeds(&mut self, reduction: &mut Reduction, rates: &Map) {
        let mechanism = std::rc::Rc::clone(&self.scene.mechanism);
        let structure = std::rc::Rc::clone(&self.scene.structure);
        let accelerations = self.accelerations_of_dependents(reduction);
        let (mut all, mut volumes) = (Followed::default(), Vec::new());
        for ball in &mechanism.balls {
            let (first, second, volume) = self.hinge_rates(ball);
            volumes.push(volume);
            all.add(&ball.hinges, &first, &second);
        }
        let hinged = all.unknowns.clone();
        let unknowns: Vec<Coordinate> =
            structure.rates.unknowns.iter().copied().filter(|unknown| !hinged.contains(unknown)).collect();
        let symbols: Vec<[Scalar; 2]> = unknowns.iter().map(|&unknown| self.velocity_symbols(unknown)).collect();
        let known = [0, 1].map(|order| self.map(&self.pairs(&all, order)));
        let equations = self.equations_of_speeds();
        let rest = |order: usize| symbols.iter().map(move |symbols| (symbols[order], Scalar::ZERO));
        let (at_rest, unaccelerated) = (self.map(&rest(0).collect::<Vec<_>>()), self.map(&rest(1).collect::<Vec<_>>()));
        let (mut matrix, mut first, mut second) = (Vec::new(), Vec::new(), Vec::new());
        for (rate, acceleration) in equations {
            let rate = self.g.substitute(&[rate], rates)[0];
            let rate = self.g.substitute(&[rate], &known[0])[0];
            matrix.extend(symbols.iter().map(|symbols| self.g.derivative(rate, &[(symbols[0], Scalar::ONE)])));
            first.push(-self.g.substitute(&[rate], &at_rest)[0]);
            let acceleration = self.g.substitute(&[acceleration], &accelerations)[0];
            let acceleration = self.g.substitute(&[acceleration], &known[1])[0];
            second.push(-self.g.substitute(&[acceleration], &unaccelerated)[0]);
        }
        if first.len() != unknowns.len() {
            raise("there are as many equations of velocities and of speeds as rates that follow");
        }
        if !unknowns.is_empty() {
            let readable = self.scene.way.for_readers;
            let turned = if readable { Vec::new() } else { self.along_headings(&unknowns, &mut matrix) };
            let solve = if readable { Self::solve_for_readers } else { Self::eliminate_strictly };
            let mut found = self.solve_rates(unknowns.len(), &matrix, [&first, &second], solve);
            found.iter_mut().for_each(|values| self.turn_back(&turned, values));
            all.add(&unknowns, &found[0], &found[1]);
        }
        // One margin for all of them.
        reduction.matrices.push(beside(&volumes, &matrix, unknowns.len()));
        // Rates with positions on the tree, by which efforts are projected.
        let on_tree = self.map(&self.pairs(&all, 0));
        for at in 0..reduction.rates.len() {
            let rate = reduction.rates[at].1;
            reduction.rates[at].1 = self.g.substitute(&[rate], &on_tree)[0];
        }
        for (&coordinate, [rate, acceleration]) in all.unknowns.iter().zip(&all.values) {
            let [position, ..] = self.coordinate_symbols(coordinate);
            let (rate, acceleration) = (*rate, *acceleration);
            reduction.rates.push((self.freedom(coordinate), rate));
            reduction.followed.push(Definition { coordinate, position, rate, acceleration });
        }
        // The same finished: first rates, which accelerations are written with. What is not read any more is in the map all the same, so
        // that no older node is found in which it cancels.
        for order in [0, 1] {
            let still =
                self.pairs(&all, order).into_iter().map(|(symbol, _)| (symbol, Scalar::ZERO)).collect::<Vec<_>>();
            reduction.map.extend(self.map(&still));
        }
        let mut found = Map::new();
        for order in [0, 1] {
            let pairs = self.pairs(&all, order);
            let (of, values): (Vec<Scalar>, Vec<Scalar>) = pairs.into_iter().unzip();
            let values = self.finish(reduction, &values);
            found.extend(self.map(&of.into_iter().zip(values).collect::<Vec<_>>()));
            self.put_into_definitions(reduction, &found);
            reduction.map.extend(found.iter().map(|(&id, &value)| (id, value)));
        }
    }

    /// Symbols of rates, or of accelerations, with their values.
    fn pairs(&self, followed: &Followed, order: usize) -> Vec<(Scalar, Scalar)> {
        let symbols = followed.unknowns.iter().map(|&unknown| self.velocity_symbols(unknown)[order]);
        symbols.zip(followed.values.iter().map(|values| values[order])).collect()
    }

    /// Equations of velocities, and those of speeds, u - (U v + c), but for speeds of balls, with their rates; on the tree.
    fn equations_of_speeds(&mut self) -> Vec<(Scalar, Scalar)> {
        let structure = std::rc::Rc::clone(&self.scene.structure);
        let mut equations: Vec<(Scalar, Scalar)> =
            structure.rates.rows.iter().map(|&row| self.row_rates(row)).collect();
        let model = self.scene.model;
        let balls = &self.scene.mechanism.balls;
        let of_balls: Vec<usize> = balls.iter().flat_map(|ball| ball.speed..ball.speed + 3).collect();
        for (number, speed) in model.speeds.iter().enumerate().filter(|(number, _)| !of_balls.contains(number)) {
            let value = self.scalar(&speed.value);
            let seeds = self.seeds(2);
            let rate = Differentiator::new(&seeds).scalar(&mut self.g, value);
            let [speed, accelerated] = self.scene.symbols.speeds[number];
            equations.push((self.g.sub(value, speed), self.g.sub(rate, accelerated)));
        }
        equations
    }

    /// Accelerations of dependents in those of the state; positions and rates are symbols of the tree.
    fn accelerations_of_dependents(&mut self, reduction: &Reduction) -> Map {
        let mut map = Map::new();
        // A coupling may read what later steps find.
        let rounds = if reduction.definitions.is_empty() { 0 } else { 1 + reduction.coupled.len() };
        for _ in 0..rounds {
            for definition in &reduction.definitions {
                let value = self.g.substitute(&[definition.acceleration], &map)[0];
                let [_, acceleration] = self.velocity_symbols(definition.coordinate);
                map.extend(self.g.symbol_id(acceleration).map(|id| (id, value)));
            }
        }
        // Of drives there are no definitions, and nothing of the state stands in them.
        map
    }

    /// Puts rates, or accelerations, into what was defined in them.
    fn put_into_definitions(&mut self, reduction: &mut Reduction, found: &Map) {
        let symbols: Vec<Scalar> = found.keys().filter_map(|&id| self.g.symbol_handle(id)).collect();
        let mut open: Vec<_> = reduction.map.iter().map(|(&id, &value)| (id, value)).collect();
        open.retain(|&(_, value)| self.g.depends_on(value, &symbols));
        open.sort_unstable_by_key(|entry| entry.0);
        let values: Vec<Scalar> = open.iter().map(|entry| entry.1).collect();
        let values = self.g.substitute(&values, found);
        reduction.map.extend(open.into_iter().map(|entry| entry.0).zip(values));
    }
}

/// A matrix of this size with numbers in front of it on the diagonal, row by row.
fn beside(diagonal: &[Scalar], matrix: &[Scalar], size: usize) -> Vec<Scalar> {
    let (first, whole) = (diagonal.len(), diagonal.len() + size);
    let mut entries = vec![Scalar::ZERO; whole * whole];
    for (k, &entry) in diagonal.iter().enumerate() {
        entries[k * whole + k] = entry;
    }
    for (k, &entry) in matrix.iter().enumerate() {
        entries[(first + k / size) * whole + first + k % size] = entry;
    }
    entries
}
