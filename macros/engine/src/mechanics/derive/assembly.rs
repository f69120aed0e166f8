//! Stage `mechanics`, its whole: assembly modes.
//!
//! In: what is given and what is to be found. Out: the condition on what tells a mode, and what belongs to it.

use std::rc::Rc;

use crate::contracts::function::FunctionKind;
use crate::contracts::results::Results;

use crate::mechanics::translate::symbols::Symbols;
use crate::symbolic::graph::Scalar;

use super::{Candidates, Deriving};

impl Deriving<'_> {
    /// One of the two functions; no condition where no point of the circle tells the modes.
    pub(super) fn assembly(&mut self, kind: FunctionKind) -> Candidates {
        let Some(wanted) = &self.model.assembly else { return Ok(Vec::new()) };
        let Some(closure) = self.structure.assembly.clone() else { return Ok(Vec::new()) };
        // Where legs have formulas, these lead from the pose to their joints, whatever becomes of the loops elsewhere.
        let solved = Rc::new(self.structure.solved(self.model));
        let before = std::mem::replace(&mut self.structure, solved);
        // What follows is replaced, also where it merely seems to be read.
        let following: Vec<Scalar> = closure
            .steps
            .iter()
            .flat_map(|step| &step.unknowns)
            .map(|c| Symbols::of(&self.symbols.positions, c.joint)[c.index])
            .filter(|&symbol| self.graph.marks(symbol) == 0)
            .collect();
        following.iter().for_each(|&symbol| self.graph.mark(symbol, Symbols::STAND_INS));
        let mut modes = None;
        let found = self.maybe(self.way(), |e| {
            let reduction = e.reduce()?;
            let assembly = e.assembly(wanted, &closure, &reduction)?;
            modes = Some(assembly.modes);
            Ok(match kind {
                FunctionKind::AssemblyCondition => assembly.condition.map(|c| (assembly.name, Results::scalar(c))),
                _ => Some((assembly.name, assembly.results)),
            })
        });
        following.iter().for_each(|&symbol| self.graph.unmark(symbol, Symbols::STAND_INS));
        self.structure = before;
        self.modes = self.modes.or(modes);
        Ok(found?.into_iter().collect())
    }
}
