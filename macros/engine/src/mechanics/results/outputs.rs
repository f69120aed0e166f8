//! Stage `mechanics`: outputs.
//!
//! In: the derivation. Out: the scalars of all outputs in the order of generated structs, on the tree.

use crate::mechanics::analysis::Complaint;
use crate::mechanics::equations::Equations;
use crate::mechanics::translate::values::width;
use crate::model::site::Sited;
use crate::model::types::Output;
use crate::symbolic::graph::Scalar;

impl Equations<'_> {
    /// Output after output, before definitions are put in.
    pub(in crate::mechanics) fn output_scalars(&mut self, wanted: &[&Output]) -> Result<Vec<Scalar>, Vec<Complaint>> {
        let freedoms = self.scene.structure.freedoms();
        let mut scalars = Vec::new();
        for output in wanted {
            let value = self.value(&output.value);
            let before = scalars.len();
            value.flatten(&mut self.g, &mut scalars);
            // Generated code takes as many scalars as the type has: one too many, and all others are misplaced.
            if scalars.len() - before != width(&output.value.ty, freedoms) {
                return Err(vec![misplaced(output)]);
            }
        }
        Ok(scalars)
    }
}

fn misplaced(output: &Output) -> Complaint {
    Complaint {
        at: output.value.site(),
        message: format!(
            "the output `{}` was derived with another number of scalars than its type has",
            output.place.field
        ),
        help: Some("this is an error of multibody: please report it with the model".to_owned()),
    }
}
