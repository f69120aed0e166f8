//! Stage `mechanics`: inputs that produce a motion.
//!
//! In: efforts beside all declared forces, on the state and on driven coordinates; the inputs to solve for. Out: these
//! inputs. The efforts are linear in the inputs and in the multipliers of the loops, e = e0 + A u, and all of them must
//! vanish: A u = -e0. The system is solved by the structure of A ([`crate::symbolic::structured`]): a motor on each joint
//! costs a sign, gear ratios that are parameters a product each. What is left is solved with pivots in the runtime. A rank
//! below the number of inputs and multipliers means that they cannot produce every motion at this configuration.

use crate::contracts::results::{Results, Slot};
use crate::mechanics::analysis::Complaint;
use crate::mechanics::equations::Equations;
use crate::mechanics::loops::reduction::Reduction;
use crate::mechanics::loops::structure::Role;
use crate::mechanics::translate::forces::LoadCase;
use crate::mechanics::translate::names;
use crate::model::site::Sited;
use crate::symbolic::graph::Scalar;
use crate::symbolic::triangular_form::matching;

impl Equations<'_> {
    /// The inputs that are asked for, then the rank of their system.
    pub(in crate::mechanics) fn actuate(&mut self, reduction: &Reduction) -> Result<Results<Scalar>, Vec<Complaint>> {
        let model = self.scene.model;
        let efforts = self.projected_efforts(reduction, LoadCase::Held);
        let mut rows = self.speeds();
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
                "name as many scalar inputs as there are freedoms: velocities and driven coordinates, less the equations that \
                 keep multipliers",
            );
        }
        let matrix = self.slopes_by(&efforts, &inputs);
        if self.g.read_by(&matrix.concat(), &inputs).contains(&true) {
            return refuse(
                "the equations are not linear in the inputs to solve for".to_owned(),
                "let the forces depend on these inputs linearly",
            );
        }
        if structural_rank(&matrix) < size {
            return refuse(
                "these inputs cannot produce every motion: their forces don't reach all equations".to_owned(),
                "solve for inputs that act on every coordinate of the state and on every driven one",
            );
        }
        let off: Vec<(Scalar, Scalar)> = inputs.iter().map(|&input| (input, Scalar::ZERO)).collect();
        let off = self.map(&off);
        let rest: Vec<Scalar> = self.g.substitute(&efforts, &off).into_iter().map(|effort| -effort).collect();
        let (mut outputs, rank) = self.solve_structured(&matrix, &rest);
        outputs.truncate(wanted);
        for (&input, &output) in inputs.iter().zip(&outputs) {
            if let Some(&symbol) = self.g.symbol_id(input).and_then(|id| self.scene.symbols.table.get(id.0)) {
                self.g.label(output, || names::symbol(self.scene.model, symbol));
            }
        }
        Ok(Results::default().with(Slot::Inputs, outputs).with_scalar(Slot::Rank, rank))
    }

    /// Derivatives, row by row.
    fn slopes_by(&mut self, efforts: &[Scalar], inputs: &[Scalar]) -> Vec<Vec<Scalar>> {
        let mut row = |&effort: &Scalar| {
            let read = self.g.read_by(&[effort], inputs);
            let slope = |(&input, is_read): (&Scalar, bool)| match is_read {
                true => self.g.derivative(effort, &[(input, Scalar::ONE)]),
                false => Scalar::ZERO,
            };
            inputs.iter().zip(read).map(slope).collect()
        };
        efforts.iter().map(&mut row).collect()
    }
}

/// Most entries that are not zero whatever they hold, in different rows and columns.
fn structural_rank(matrix: &[Vec<Scalar>]) -> usize {
    let row = |row: &Vec<Scalar>| {
        (0..row.len()).filter(|&column| row[column] != Scalar::ZERO).map(|column| (column, 1.0)).collect()
    };
    let pattern: Vec<Vec<(usize, f64)>> = matrix.iter().map(row).collect();
    matching(&pattern, matrix.len()).iter().flatten().count()
}
