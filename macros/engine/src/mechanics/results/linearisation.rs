//! Stage `mechanics`: partial derivatives of the equations of motion.
//!
//! In: the derivation, definitions of dependent coordinates. Out: the derivatives of inverse and of forward dynamics by
//! displacements of the position, velocities, own states and inputs. With the residual F(x, z) = (M a + bias + G^T l,
//! G a + gamma) and z = (a, l), forward dynamics is F(x, z(x)) = 0, so that dz/dx = -(dF/dz)^-1 dF/dx at fixed z: the
//! matrix is the one that forward dynamics has factorised, and nothing is differentiated through the solution
//! (Carpentier and Mansard 2018). Rates of own states depend on neither a nor l.
//!
//! Dependent positions are not differentiated through their closed form either: they move by the velocity map, whatever
//! found them, and so an iteration's results have derivatives too.

use std::collections::HashMap;

use crate::contracts::results::{Results, Slot};
use crate::dynamics::saddle::{Saddle, Solution};
use crate::mechanics::equations::Equations;
use crate::mechanics::loops::reduction::Reduction;
use crate::mechanics::loops::structure::Means;
use crate::mechanics::translate::forces::LoadCase;
use crate::mechanics::translate::time::Seeds;
use crate::symbolic::differentiate::Differentiator;
use crate::symbolic::graph::{Scalar, ScalarNode};

use super::constrained::ConstrainedMotion;
use super::kinks;

/// From which side derivatives are accumulated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::mechanics) enum Accumulation {
    /// Column by column, along each direction.
    Forward,
    /// Row by row, back from each result.
    Reverse,
    /// Row by row, back from all equations at once, each weighted by an entry of the inverse matrix: accelerations come
    /// without solving for every column.
    Weighted,
}

/// A sum of expressions with weights.
type Weighted = Vec<(Scalar, Scalar)>;

/// Directions, one per column, in the order of [`crate::contracts::function::FunctionKind::ForwardDerivatives`].
pub(super) struct Directions {
    pub columns: Vec<Seeds>,
    /// Numbers of positions, velocities, own states and inputs.
    pub counts: [usize; 4],
}

/// What changes along one direction.
#[derive(Default)]
pub(super) struct Column {
    pub accelerations: Vec<Scalar>,
    /// Not where rows are weighted.
    pub multipliers: Vec<Scalar>,
    /// Of own states.
    pub rates: Vec<Scalar>,
}

/// Derivatives of the motion, with what they are derivatives of.
pub(super) struct Motion {
    pub directions: Directions,
    pub columns: Vec<Column>,
    /// What was differentiated.
    pub values: Vec<Scalar>,
    pub solved: ConstrainedMotion,
}

impl Equations<'_> {
    /// Derivatives of the efforts, matrix by matrix, each row by row.
    pub(in crate::mechanics) fn inverse_derivatives(
        &mut self,
        reduction: &Reduction,
        accumulation: Accumulation,
    ) -> Results<Scalar> {
        let efforts = self.reduced_efforts(reduction, LoadCase::Declared);
        let directions = self.directions(reduction);
        let columns = self.partials(&efforts, &directions.columns, accumulation);
        let results = directions.matrices(&columns, efforts.len());
        Results { list: kinks::guarded(&mut self.g, &efforts, &results.list), ..results }
    }

    /// Derivatives of the rates of positions, in the same order.
    pub(in crate::mechanics) fn rate_derivatives(&mut self, reduction: &Reduction) -> Results<Scalar> {
        let directions = self.directions(reduction);
        let values = self.position_rates(reduction);
        let columns = self.partials(&values, &directions.columns, Accumulation::Forward);
        let results = directions.matrices(&columns, values.len());
        Results { list: kinks::guarded(&mut self.g, &values, &results.list), ..results }
    }

    /// Derivatives of the accelerations and of the rates of own states, in the same order.
    pub(in crate::mechanics) fn forward_derivatives(
        &mut self,
        reduction: &Reduction,
        accumulation: Accumulation,
    ) -> Results<Scalar> {
        let motion = self.motion_slopes(reduction, accumulation);
        let count = self.scene.structure.freedoms() + self.scene.model.states.len();
        let columns: Vec<Vec<Scalar>> =
            motion.columns.into_iter().map(|column| [column.accelerations, column.rates].concat()).collect();
        let results = motion.directions.matrices(&columns, count);
        Results { list: kinks::guarded(&mut self.g, &motion.values, &results.list), ..results }
    }

    /// How accelerations, multipliers and rates of own states change along each direction.
    pub(super) fn motion_slopes(&mut self, reduction: &Reduction, accumulation: Accumulation) -> Motion {
        let (mut saddle, rows, solved) = self.system(reduction);
        let directions = self.directions(reduction);
        // Positions and velocities move while accelerations and multipliers stay: these are symbols for now.
        let mut residual = self.reduced_efforts(reduction, LoadCase::HeldOpen);
        let freedoms = residual.len();
        let accelerations: Vec<Scalar> =
            self.scene.structure.speeds().iter().map(|&at| self.velocity_symbols(at)[1]).collect();
        for (row, &gamma) in rows.jacobian.iter().zip(&rows.bias) {
            let mut terms: Vec<Scalar> = row.iter().zip(&accelerations).map(|(&c, &a)| self.g.mul(c, a)).collect();
            terms.push(gamma);
            residual.push(self.g.sum(&terms));
        }
        saddle.invert(&mut self.g);
        let mut columns = match accumulation {
            Accumulation::Weighted => self.weighted(&saddle, &residual, &directions.columns, freedoms),
            accumulation => self.partials(&residual, &directions.columns, accumulation),
        };
        self.settle(&mut columns, &solved);
        let columns = columns.into_iter().map(|column| match accumulation {
            Accumulation::Weighted => Column { accelerations: column, ..Column::default() },
            _ => {
                let negative: Vec<Scalar> = column.iter().map(|&entry| -entry).collect();
                let (efforts, equations) = negative.split_at(freedoms);
                let Solution { unknowns, multipliers, .. } = saddle.solve(&mut self.g, efforts, equations);
                Column { accelerations: unknowns, multipliers, rates: Vec::new() }
            }
        });
        let mut columns: Vec<Column> = columns.collect();
        // The checker lets no rate depend on accelerations or reactions.
        let model = self.scene.model;
        let rates: Vec<Scalar> = model.states.iter().map(|state| self.scalar(&state.rate)).collect();
        let rates = self.finish(reduction, &rates);
        let values = [residual, rates.clone()].concat();
        let rates = self.partials(&rates, &directions.columns, Accumulation::Forward);
        columns.iter_mut().zip(rates).for_each(|(column, rates)| column.rates = rates);
        Motion { directions, columns, values, solved }
    }

    /// -(dF/dz)^-1 dF/dx, row by row: the matrix is symmetric, so a column of its inverse is a row of weights for the equations.
    fn weighted(
        &mut self,
        saddle: &Saddle,
        residual: &[Scalar],
        columns: &[Seeds],
        freedoms: usize,
    ) -> Vec<Vec<Scalar>> {
        let mut results = Vec::with_capacity(freedoms);
        for row in 0..freedoms {
            let mut unit = vec![Scalar::ZERO; residual.len()];
            unit[row] = Scalar::ONE;
            let (efforts, equations) = unit.split_at(freedoms);
            let weights = saddle.solve(&mut self.g, efforts, equations);
            let weights = weights.unknowns.into_iter().chain(weights.multipliers).map(|weight| -weight);
            results.push(residual.iter().copied().zip(weights).collect());
        }
        self.backward(&results, columns)
    }

    /// Puts in the accelerations and multipliers that were found.
    pub(super) fn settle(&mut self, columns: &mut [Vec<Scalar>], solved: &ConstrainedMotion) {
        let speeds = self.scene.structure.speeds().to_vec();
        let accelerations = speeds.iter().map(|&coordinate| self.velocity_symbols(coordinate)[1]);
        let symbols = accelerations.chain(self.scene.symbols.multipliers.iter().copied());
        let values = solved.accelerations.iter().chain(&solved.multipliers).copied();
        let pairs: Vec<(Scalar, Scalar)> = symbols.zip(values).collect();
        let map = self.map(&pairs);
        let flat = self.g.substitute(&columns.concat(), &map);
        let mut flat = flat.into_iter();
        for column in columns {
            column.iter_mut().zip(flat.by_ref()).for_each(|(entry, value)| *entry = value);
        }
    }

    fn directions(&mut self, reduction: &Reduction) -> Directions {
        let state = self.scene.structure.state.clone();
        let map = self.displacement_map(reduction);
        let mut columns = Vec::new();
        for (at, &coordinate) in state.iter().enumerate() {
            let mut seeds = self.direction(coordinate);
            for (dependent, symbol, iterated) in self.dependents(reduction) {
                let Some(&value) = self.g.symbol_id(symbol).and_then(|id| reduction.map.get(&id)) else { continue };
                let slope = self.finish(reduction, &[map[dependent][at]])[0];
                self.follow_dependent(value, slope, iterated, &mut seeds);
            }
            columns.push(seeds);
        }
        let speeds = self.scene.structure.speeds();
        let velocities: Vec<Scalar> = speeds.iter().map(|&at| self.velocity_symbols(at)[0]).collect();
        let (states, inputs) = (self.scene.symbols.states.clone(), self.scene.symbols.inputs.concat());
        let counts = [state.len(), velocities.len(), states.len(), inputs.len()];
        columns.extend(velocities.into_iter().chain(states).chain(inputs).map(|symbol| vec![(symbol, Scalar::ONE)]));
        Directions { columns, counts }
    }

    /// How coordinates of the tree move with the positions of the state, whatever velocities are; nothing where none follows.
    pub(super) fn displacement_map(&mut self, reduction: &Reduction) -> Vec<Vec<Scalar>> {
        if reduction.displacements.is_empty() {
            return Vec::new();
        }
        let places: Vec<usize> = self.scene.structure.state.iter().map(|&at| self.freedom(at)).collect();
        self.map_by(&reduction.displacements, &places)
    }

    /// Places of dependent coordinates in the tree, their positions, and whether Newton's method finds them.
    fn dependents(&self, reduction: &Reduction) -> Vec<(usize, Scalar, bool)> {
        let steps = self.scene.structure.steps.iter();
        let unknowns = steps.flat_map(|step| {
            let iterated = matches!(step.means, Means::Newton { .. });
            step.unknowns.iter().map(move |&unknown| (unknown, iterated))
        });
        let found = |freedom: &usize| reduction.displacements.iter().any(|rate| rate.0 == *freedom);
        unknowns
            .map(|(unknown, iterated)| (self.freedom(unknown), self.coordinate_symbols(unknown)[0], iterated))
            .filter(|(freedom, ..)| found(freedom))
            .collect()
    }

    /// How a dependent position moves: an angle with its cosine and sine. Newton's method gives the guess, which rests, and the
    /// angle that has been turned since: a sum of both with something else may stand there taken apart, so that angle moves too.
    fn follow_dependent(&mut self, value: Scalar, slope: Scalar, iterated: bool, seeds: &mut Seeds) {
        let mut moves = |node: Scalar, slope: Scalar, is_plain: bool| {
            if !is_plain && !seeds.iter().any(|seed| seed.0.index() == node.index()) {
                let slope = if node == node.positive() { slope } else { -slope };
                seeds.push((node.positive(), slope));
            }
        };
        let plain = |node: &ScalarNode| matches!(node, ScalarNode::Literal(_) | ScalarNode::Symbol(_));
        let g = &mut self.g;
        moves(value, slope, plain(g.node(value)));
        let angle = if iterated { g.angle_in(value) } else { Some(value) };
        if let Some(angle) = angle.filter(|&angle| matches!(g.node(angle), ScalarNode::Angle(..))) {
            moves(angle, slope, false);
            let (cos, sin) = (g.cos(value), g.sin(value));
            let (by_cos, by_sin) = (-g.mul(sin, slope), g.mul(cos, slope));
            moves(cos, by_cos, plain(g.node(cos)));
            moves(sin, by_sin, plain(g.node(sin)));
        }
    }

    /// Derivatives of results, column by column. Seeds may stand at any nodes: what is behind them is not visited.
    pub(super) fn partials(
        &mut self,
        results: &[Scalar],
        columns: &[Seeds],
        accumulation: Accumulation,
    ) -> Vec<Vec<Scalar>> {
        let g = &mut self.g;
        if accumulation == Accumulation::Forward {
            return columns.iter().map(|seeds| Differentiator::new(seeds).scalars(g, results)).collect();
        }
        let results: Vec<Weighted> = results.iter().map(|&result| vec![(result, Scalar::ONE)]).collect();
        self.backward(&results, columns)
    }

    /// Derivatives of weighted sums, column by column.
    fn backward(&mut self, results: &[Weighted], columns: &[Seeds]) -> Vec<Vec<Scalar>> {
        let g = &mut self.g;
        let mut nodes: Vec<Scalar> = Vec::new();
        let mut places: HashMap<usize, usize> = HashMap::new();
        for &(node, _) in columns.iter().flatten() {
            places.entry(node.index()).or_insert_with(|| {
                nodes.push(node.positive());
                nodes.len() - 1
            });
        }
        let mut entries = vec![Vec::with_capacity(results.len()); columns.len()];
        for result in results {
            let adjoints = g.transpose_linear(result, &nodes);
            for (entries, seeds) in entries.iter_mut().zip(columns) {
                let terms: Vec<Scalar> = seeds
                    .iter()
                    .map(|&(node, slope)| {
                        let slope = if node == node.positive() { slope } else { -slope };
                        g.mul(adjoints[places[&node.index()]], slope)
                    })
                    .collect();
                entries.push(g.sum(&terms));
            }
        }
        entries
    }
}

impl Directions {
    /// A matrix for positions, velocities, own states and inputs, each row by row.
    fn matrices(&self, columns: &[Vec<Scalar>], rows: usize) -> Results<Scalar> {
        let mut results = Results::default();
        let mut from = 0;
        let slots = [Slot::ByPosition, Slot::ByVelocity, Slot::ByState, Slot::ByInput];
        for (slot, count) in slots.into_iter().zip(self.counts) {
            let matrix = &columns[from..from + count];
            let entries = (0..rows).flat_map(|row| matrix.iter().map(move |column| column[row])).collect();
            results = results.with_matrix(slot, (rows, count), entries);
            from += count;
        }
        results
    }
}
