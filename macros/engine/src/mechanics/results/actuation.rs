//! Stage `mechanics`: inputs that produce a motion.
//!
//! In: efforts beside all declared forces, on the state and on driven coordinates; the inputs to solve for. Out: these
//! inputs. The efforts are linear in the inputs and in the multipliers of the loops, e = e0 + A u, and all of them must
//! vanish: A u = -e0. The system is solved
//! with pivots in the runtime, which reports its rank: a rank below the number of inputs means that they cannot produce
//! every motion at this configuration.

use crate::contracts::results::{Results, Slot};
use crate::mechanics::analysis::Complaint;
use crate::mechanics::equations::Equations;
use crate::mechanics::loops::reduction::Reduction;
use crate::mechanics::loops::structure::Role;
use crate::mechanics::translate::forces::LoadCase;
use crate::mechanics::translate::names;
use crate::model::site::Sited;
use crate::symbolic::graph::{BlockKind, Scalar};

impl Equations<'_> {
    /// The inputs that are asked for, then the rank of their system.
    pub(in crate::mechanics) fn actuate(&mut self, reduction: &Reduction) -> Result<Results<Scalar>, Vec<Complaint>> {
        let model = self.scene.model;
        let efforts = self.projected_efforts(reduction, LoadCase::Held);
        let mut rows: Vec<usize> = self.freedoms_of(|role| matches!(role, Role::State));
        rows.extend(self.freedoms_of(|role| matches!(role, Role::Driven(_))));
        let efforts: Vec<Scalar> = rows.iter().map(|&freedom| efforts[freedom]).collect();
        let efforts = self.finish(reduction, &efforts);
        let inputs: Vec<Scalar> =
            model.solve_for.iter().map(|wanted| self.scene.symbols.inputs[wanted.input.0][wanted.element]).collect();
        let multipliers = self.scene.symbols.multipliers.clone();
        let (wanted, size) = (inputs.len(), inputs.len() + multipliers.len());
        let inputs: Vec<Scalar> = inputs.into_iter().chain(multipliers).collect();
        let at = model.solve_for.first().map_or_else(|| model.site(), |wanted| wanted.site());
        let refuse = |message: String, help: &str| Err(vec![Complaint { at, message, help: Some(help.to_owned()) }]);
        if rows.len() != size {
            let few = if rows.len() > size { "too few" } else { "too many" };
            return refuse(
                format!(
                    "{few} inputs to solve for: {wanted} where {} are needed",
                    (rows.len() + wanted).saturating_sub(size)
                ),
                "name as many scalar inputs as there are freedoms: coordinates in the state and driven ones, less the \
                 equations that keep multipliers",
            );
        }
        let matrix = self.slopes_by(&efforts, &inputs);
        if matrix.iter().any(|&entry| self.g.depends_on(entry, &inputs)) {
            return refuse(
                "the equations are not linear in the inputs to solve for".to_owned(),
                "let the forces depend on these inputs linearly",
            );
        }
        let holds: Vec<Vec<bool>> =
            matrix.chunks(size.max(1)).map(|row| row.iter().map(|&entry| entry != Scalar::ZERO).collect()).collect();
        if structural_rank(&holds) < size {
            return refuse(
                "these inputs cannot produce every motion: their forces don't reach all equations".to_owned(),
                "solve for inputs that act on every coordinate of the state and on every driven one",
            );
        }
        let mut outputs = self.solve_linear(&efforts, &inputs, matrix);
        outputs.drain(wanted..size);
        for (&input, &output) in inputs.iter().zip(&outputs) {
            if let Some(&symbol) = self.g.symbol_id(input).and_then(|id| self.scene.symbols.table.get(id.0)) {
                self.g.label(output, || names::symbol(self.scene.model, symbol));
            }
        }
        let rank = outputs.split_off(wanted);
        Ok(rank.into_iter().fold(Results::default().with(Slot::Inputs, outputs), |results, rank| {
            results.with_scalar(Slot::Rank, rank)
        }))
    }

    /// Derivatives, row by row.
    fn slopes_by(&mut self, efforts: &[Scalar], inputs: &[Scalar]) -> Vec<Scalar> {
        let mut matrix = Vec::with_capacity(efforts.len() * inputs.len());
        for &effort in efforts {
            for &input in inputs {
                matrix.push(self.g.derivative(effort, &[(input, Scalar::ONE)]));
            }
        }
        matrix
    }

    /// Inputs for which linear efforts vanish, then the rank of their system.
    fn solve_linear(&mut self, efforts: &[Scalar], inputs: &[Scalar], matrix: Vec<Scalar>) -> Vec<Scalar> {
        let size = inputs.len();
        let off: Vec<(Scalar, Scalar)> = inputs.iter().map(|&input| (input, Scalar::ZERO)).collect();
        let off = self.map(&off);
        let rest = self.g.substitute(efforts, &off);
        let operands: Vec<Scalar> = matrix.into_iter().chain(rest.into_iter().map(|e| -e)).collect();
        self.g.block_outputs(BlockKind::Solve { size, symmetric: false, groups: [].into() }, &operands)
    }
}

/// Most entries of a pattern that lie in different rows and columns (augmenting paths).
fn structural_rank(holds: &[Vec<bool>]) -> usize {
    let columns = holds.first().map_or(0, Vec::len);
    let mut taken: Vec<Option<usize>> = vec![None; columns];
    (0..holds.len()).filter(|&row| place(row, holds, &mut taken, &mut vec![false; columns])).count()
}

fn place(row: usize, holds: &[Vec<bool>], taken: &mut [Option<usize>], seen: &mut [bool]) -> bool {
    for column in 0..taken.len() {
        if !holds[row][column] || std::mem::replace(&mut seen[column], true) {
            continue;
        }
        if taken[column].is_none_or(|other| place(other, holds, taken, seen)) {
            taken[column] = Some(row);
            return true;
        }
    }
    false
}
