//! Stage `mechanics`: the equations as a linear system about a state.
//!
//! In: the derivation, definitions of dependent coordinates. Out: A, B, C and D of x' = A x + B u, y = C x + D u for small
//! changes x = (displacements of the position, velocities, own states), u of inputs and y of outputs. With z for
//! accelerations and multipliers, dz/dx comes from [`super::linearisation`]; an output y(x, z(x)) changes by
//! dy/dx at fixed z, and by dy/dz dz/dx.
//!
//! A displacement d of a unit quaternion is q (0, d) / 2 in the child's axes, which turn with the angular velocity w: d' is
//! the change of w, less w x d. All other coordinates have q' = v, and velocities that are no rates of the state have q' = N u + n, which
//! changes with positions too.

use crate::contracts::results::{Results, Slot};
use crate::mechanics::analysis::Complaint;
use crate::mechanics::equations::Equations;
use crate::mechanics::loops::reduction::Reduction;
use crate::mechanics::translate::time::Seeds;
use crate::model::types::Coordinate;
use crate::symbolic::graph::{Scalar, ScalarNode};

use super::kinks;
use super::linearisation::{Accumulation, Motion};

impl Equations<'_> {
    /// The four matrices, each row by row.
    pub(in crate::mechanics) fn linearized(
        &mut self,
        reduction: &Reduction,
        accumulation: Accumulation,
    ) -> Result<Results<Scalar>, Vec<Complaint>> {
        // What accelerations in outputs stand for comes first: in an open tree they are nodes of forward dynamics.
        let outputs = self.output_scalars(&self.scene.model.outputs.iter().collect::<Vec<_>>())?;
        let motion = self.motion_slopes(reduction, accumulation);
        let outputs = self.finish(reduction, &outputs);
        let slopes = self.output_slopes(reduction, &motion, &outputs);
        let displacements = self.displacement_rates(reduction, &motion.directions.columns);
        let [positions, velocities, states, _] = motion.directions.counts;
        let columns: Vec<Vec<Scalar>> = motion
            .columns
            .iter()
            .zip(displacements)
            .map(|(column, moved)| [&moved[..], &column.accelerations, &column.rates].concat())
            .collect();
        let size = positions + velocities + states;
        let [state, inputs] = [&columns[..size], &columns[size..]];
        let [shown, through] = [&slopes[..size], &slopes[size..]];
        let rows = |columns: &[Vec<Scalar>], count: usize| -> Vec<Scalar> {
            (0..count).flat_map(|row| columns.iter().map(move |column| column[row])).collect()
        };
        let results = Results::default()
            .with_matrix(Slot::StateMatrix, (size, size), rows(state, size))
            .with_matrix(Slot::InputMatrix, (size, inputs.len()), rows(inputs, size))
            .with_matrix(Slot::OutputMatrix, (outputs.len(), size), rows(shown, outputs.len()))
            .with_matrix(Slot::Feedthrough, (outputs.len(), inputs.len()), rows(through, outputs.len()));
        let values = [motion.values, outputs].concat();
        Ok(Results { list: kinks::guarded(&mut self.g, &values, &results.list), ..results })
    }

    /// How outputs change along each direction, accelerations and multipliers with them.
    fn output_slopes(&mut self, reduction: &Reduction, motion: &Motion, outputs: &[Scalar]) -> Vec<Vec<Scalar>> {
        let (accelerations, multipliers) = self.moving(reduction);
        let seeds: Vec<Seeds> = motion
            .directions
            .columns
            .iter()
            .zip(&motion.columns)
            .map(|(direction, column)| {
                let mut seeds = direction.clone();
                let moved = accelerations.iter().zip(&column.accelerations);
                for (&node, &slope) in moved.chain(multipliers.iter().zip(&column.multipliers)) {
                    // A literal rests, and a symbol of a direction moves already.
                    let rests = matches!(self.g.node(node), ScalarNode::Literal(_));
                    if !rests && !seeds.iter().any(|seed| seed.0.index() == node.index()) {
                        seeds.push((node.positive(), if node.is_negative() { -slope } else { slope }));
                    }
                }
                seeds
            })
            .collect();
        let mut slopes = self.partials(outputs, &seeds, Accumulation::Forward);
        self.settle(&mut slopes, &motion.solved);
        slopes
    }

    /// What stands for accelerations of the state and for multipliers in outputs.
    fn moving(&mut self, reduction: &Reduction) -> (Vec<Scalar>, Vec<Scalar>) {
        let all = self.accelerations();
        let speeds = self.scene.structure.speeds();
        let at = |c: &Coordinate| match self.model_speed(*c) {
            Some(_) => self.velocity_symbols(*c)[1],
            None => all[self.freedom(*c)],
        };
        let accelerations: Vec<Scalar> = speeds.iter().map(at).collect();
        (self.finish(reduction, &accelerations), self.scene.symbols.multipliers.clone())
    }

    /// Rates of the displacements along each direction.
    pub(super) fn displacement_rates(&mut self, reduction: &Reduction, directions: &[Seeds]) -> Vec<Vec<Scalar>> {
        let state = self.scene.structure.state.clone();
        let count = state.len();
        let rates: Vec<Scalar> = state.iter().map(|&coordinate| self.coordinate_symbols(coordinate)[1]).collect();
        let rates = self.finish(reduction, &rates);
        let mut columns = if self.scene.structure.has_speeds() {
            self.partials(&rates, directions, Accumulation::Forward)
        } else {
            let mut columns = vec![vec![Scalar::ZERO; count]; directions.len()];
            (0..count).for_each(|place| columns[count + place][place] = Scalar::ONE);
            columns
        };
        for (place, &coordinate) in state.iter().enumerate() {
            let kind = self.scene.model.joints[coordinate.joint].kind;
            if !kind.has_quaternion() {
                continue;
            }
            let Some(turned) = coordinate.index.checked_sub(kind.freedoms() - 3) else { continue };
            // Row `turned` of -w x d.
            let first = place - turned;
            let [next, last] = [(turned + 1) % 3, (turned + 2) % 3];
            let rate = &rates[first..first + 3];
            let (less, more) = (columns[first + last][place], columns[first + next][place]);
            columns[first + last][place] = self.g.sub(less, rate[next]);
            columns[first + next][place] = self.g.add(more, rate[last]);
        }
        columns
    }
}
