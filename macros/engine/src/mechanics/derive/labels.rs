//! Stage `mechanics`: what the results of generated functions are called.
//!
//! In: a function's results. Out: labels on them, from which everything that goes into one result alone takes its name in
//! generated code. What the derivation has named itself keeps that name.

use crate::contracts::function::FunctionKind;
use crate::contracts::symbol::Symbol;
use crate::mechanics::translate::names;
use crate::mechanics::translate::values::width;
use crate::model::types::{Body, Type};
use crate::symbolic::graph::Scalar;

use super::Deriving;

const AXES: [&str; 3] = ["x", "y", "z"];

impl Deriving<'_> {
    pub(super) fn label(&mut self, kind: FunctionKind, results: &[Scalar]) {
        let (names, rest) = self.result_names(kind);
        let before = self.graph.begin(Some("Results.".into()));
        for (k, &result) in results.iter().enumerate() {
            self.graph.label(result, || match names.get(k) {
                Some(name) => name.clone(),
                None => format!("{rest}_{}", k - names.len()),
            });
        }
        self.graph.begin(before);
    }

    /// Names of the first results, and what the others are called with a number.
    fn result_names(&self, kind: FunctionKind) -> (Vec<String>, &'static str) {
        let model = self.model;
        let of_state = |word: &str| -> Vec<String> {
            let speeds = self.structure.speeds().iter();
            speeds.map(|&coordinate| names::of_freedom(model, coordinate, word)).collect()
        };
        let entries = |word: &str| -> Vec<String> {
            let columns = of_state(word);
            let of_row = |row: usize| columns.iter().map(move |column| format!("row_{}_{column}", row + 1));
            (0..self.structure.rows.len()).flat_map(of_row).collect()
        };
        match kind {
            FunctionKind::ForwardDynamics => {
                let mut names = of_state("accel");
                names.extend(model.states.iter().map(|state| format!("{}_rate", names::path(model, &state.place))));
                names.extend((0..self.structure.rows.len()).map(|row| format!("multiplier_{}", row + 1)));
                (names, "rank")
            }
            FunctionKind::InverseDynamics if !model.solve_for.is_empty() => {
                let inputs = model
                    .solve_for
                    .iter()
                    .map(|wanted| names::symbol(model, Symbol::Input { input: wanted.input, element: wanted.element }));
                (inputs.collect(), "rank")
            }
            FunctionKind::InverseDynamics | FunctionKind::Bias => (of_state("effort"), "effort"),
            FunctionKind::MassMatrix | FunctionKind::MassMatrixLower => (Vec::new(), "mass_matrix"),
            FunctionKind::KineticEnergy => (vec!["kinetic_energy".to_owned()], "energy"),
            FunctionKind::PotentialEnergy => (vec!["potential_energy".to_owned()], "energy"),
            FunctionKind::Constraints => (Vec::new(), "gap"),
            FunctionKind::ConstraintJacobian => (entries("slope"), "slope"),
            FunctionKind::PositionJacobian => (Vec::new(), "slope"),
            FunctionKind::ConstraintRate => (Vec::new(), "gap_rate"),
            FunctionKind::ConstraintBias => (Vec::new(), "gap_bias"),
            FunctionKind::Residual => (of_state("effort"), "gap"),
            FunctionKind::Kinematics(_) => (Vec::new(), "found"),
            FunctionKind::AssemblyCondition => (Vec::new(), "condition"),
            FunctionKind::Assembly => (Vec::new(), "found"),
            FunctionKind::Guess => (Vec::new(), "unknown"),
            FunctionKind::DeadCentres => (Vec::new(), "root"),
            FunctionKind::Margins => (Vec::new(), "margin"),
            FunctionKind::Granted => (Vec::new(), "gap"),
            FunctionKind::PositionRates => {
                let state = self.structure.state.iter();
                (state.map(|&coordinate| names::of_freedom(model, coordinate, "rate")).collect(), "rate")
            }
            FunctionKind::RateDerivatives => (Vec::new(), "derivative"),
            FunctionKind::Displacement => (of_state("step"), "rank"),
            FunctionKind::ForwardDerivatives | FunctionKind::InverseDerivatives | FunctionKind::Linearization => {
                (Vec::new(), "derivative")
            }
            FunctionKind::Impulse => {
                let mut names = of_state("jump");
                names.extend((0..self.structure.rows.len()).map(|row| format!("multiplier_{}", row + 1)));
                (names, "rank")
            }
            FunctionKind::Momentum => (of_state("momentum"), "momentum"),
            FunctionKind::MomentumRate => (of_state("momentum_rate"), "momentum_rate"),
            FunctionKind::MomentumVelocity => (of_state("rate"), "rate"),
            FunctionKind::CentroidalMomentumMatrix => (Vec::new(), "centroidal"),
            FunctionKind::CentroidalMomentum => (Vec::new(), "momentum"),
            FunctionKind::Poses => {
                let one = |body: &Body| {
                    let name = names::path(model, &body.place);
                    let rotation = (0..9).map(|k| format!("rotation_{k}"));
                    let components = AXES.iter().map(|axis| (*axis).to_string()).chain(rotation);
                    components.map(|component| format!("{name}_{component}")).collect::<Vec<String>>()
                };
                (model.bodies.iter().flat_map(one).collect(), "pose")
            }
            FunctionKind::Outputs | FunctionKind::OutputGroup(_) => {
                let freedoms = self.structure.freedoms();
                let one = |output: &crate::model::types::Output| {
                    let name = names::path(model, &output.place);
                    let count = width(&output.value.ty, freedoms);
                    (0..count).map(|k| format!("{name}{}", component(&output.value.ty, k))).collect::<Vec<String>>()
                };
                match kind {
                    FunctionKind::OutputGroup(number) => {
                        let places = model.output_groups[number].outputs();
                        (places.map(|place| &model.outputs[place]).flat_map(one).collect(), "output")
                    }
                    _ => (model.outputs.iter().flat_map(one).collect(), "output"),
                }
            }
        }
    }
}

fn component(ty: &Type, k: usize) -> String {
    match ty {
        Type::Scalar => String::new(),
        Type::Vec3 => format!("_{}", AXES[k % 3]),
        _ => format!("_{k}"),
    }
}
