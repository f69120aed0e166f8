//! Stage `mechanics`: what parameters can break, as tests of numbers.
//!
//! In: the model. Out: [`Test`]s for `Params::check`, of parameters alone: at the default position, all coordinates of the
//! state at zero, states that bodies follow where they start, and time zero, a pivot of the mass matrix must stay above rounding, a loop must have a solution that
//! satisfies the conditions of its `solve`, and what formulas close must be closed. Where a test fails with the declared
//! parameters already (a loop that can't be closed at zero, a singular position) it says nothing and is left out, and so
//! is what no parameter changes.

use crate::contracts::results::Results;
use crate::contracts::symbol::Symbol;
use crate::mechanics::Condition;
use crate::mechanics::loops::constraints::{closings, coordinate_name, row_name, unfit};
use crate::mechanics::loops::reduction::{Map, Reduction};
use crate::mechanics::loops::structure::{Means, Row};
use crate::mechanics::translate::symbols::{freedoms_of, has_quaternion};
use crate::model::types::{Coordinate, Handling, LoopClosure, SolveHow};
use crate::symbolic::evaluate::{Evaluator, Real};
use crate::symbolic::graph::{Scalar, SymbolId};
use crate::symbolic::linear_algebra::Factors;

use super::super::Test;
use super::super::equations::Equations;
use super::{Complaint, Deriving, Role};

/// Beyond this many coordinates a mass matrix is not factorised to be tested: its cost grows with their cube.
const MOST_TESTED: usize = 12;

impl Deriving<'_> {
    /// The tests of a model that has parameters.
    pub(super) fn checks(&mut self) -> Result<Vec<Test>, Vec<Complaint>> {
        if self.model.params.is_empty() || self.structure.guesses() > 0 {
            return Ok(Vec::new());
        }
        let mut tests = Vec::new();
        let found = self.only("", |e| {
            let reduction = e.reduce()?;
            tests = e.parameter_tests(&reduction);
            Ok(Results::vector(tests.iter().flat_map(|test: &Test| test.values.iter().copied()).collect()))
        })?;
        // As they came out, where nothing is left that parameters don't give.
        let Some((_, values)) = found.into_iter().next() else { return Ok(Vec::new()) };
        let mut values = values.list.into_iter();
        for test in &mut tests {
            test.values.iter_mut().zip(&mut values).for_each(|(slot, value)| *slot = value);
        }
        Ok(tests)
    }
}

impl Equations<'_> {
    fn parameter_tests(&mut self, reduction: &Reduction) -> Vec<Test> {
        let mut tests = self.tests_of_loops(reduction);
        tests.extend(self.tests_of_masses(reduction));
        let place = self.default_position();
        let parameters = self.scene.symbols.parameters();
        let others: Vec<Scalar> = self.other_symbols();
        for test in &mut tests {
            let put = self.finish(reduction, &test.values);
            test.values = self.g.substitute(&put, &place);
        }
        tests.retain(|test| {
            test.values.iter().any(|&s| self.g.depends_on(s, &parameters))
                && !test.values.iter().any(|&s| self.g.depends_on(s, &others))
                && self.passes(test)
        });
        tests
    }

    /// With the declared parameters.
    fn passes(&self, test: &Test) -> bool {
        let value = |id: SymbolId| match self.scene.symbols.table.get(id.0) {
            Some(&Symbol::Param { param, element }) => {
                let param = &self.scene.model.params[param];
                param.default[element]
            }
            _ => 0.0,
        };
        let values = Evaluator::new(&self.g, Real { symbols: &value }).run(&test.values);
        match (test.condition, &values[..]) {
            (Condition::Finite, list) => list.iter().all(|x| x.is_finite()),
            (Condition::Pivot, [pivot, whole]) => *pivot > 1e-12 * whole.abs() && pivot.is_finite(),
            (Condition::Small, list) => list.iter().all(|x| x.abs() < 1e-9),
            (Condition::Pivot, _) => false,
        }
    }

    /// Positions at zero, orientations that turn nothing, states that bodies follow at their start, time zero.
    fn default_position(&mut self) -> Map {
        let mut map = Map::new();
        for id in self.scene.model.inertial_states() {
            let start = self.g.decimal(self.scene.model.states[id].start);
            map.extend(self.g.symbol_id(self.scene.symbols.states[id.0]).map(|symbol| (symbol, start)));
        }
        let mut set = |s: Scalar, value: Scalar| map.extend(self.g.symbol_id(s).map(|id| (id, value)));
        set(self.scene.symbols.time, Scalar::ZERO);
        for (joint, list) in self.scene.model.joints.iter().zip(&self.scene.symbols.positions) {
            let straight = if has_quaternion(joint) { joint.kind.freedoms() - 3 } else { joint.kind.freedoms() };
            for (component, &symbol) in list.iter().enumerate() {
                let turns = has_quaternion(joint) && component == straight;
                set(symbol, if turns { Scalar::ONE } else { Scalar::ZERO });
            }
        }
        map
    }

    /// All symbols but parameters.
    fn other_symbols(&self) -> Vec<Scalar> {
        let symbols = &self.scene.symbols;
        let mut list: Vec<Scalar> = vec![symbols.time];
        list.extend(symbols.inputs.iter().flatten().chain(&symbols.states));
        for lists in [&symbols.positions, &symbols.velocities, &symbols.accelerations] {
            list.extend(lists.iter().flatten());
        }
        list
    }

    fn tests_of_loops(&mut self, reduction: &Reduction) -> Vec<Test> {
        let model = self.scene.model;
        let structure = std::rc::Rc::clone(&self.scene.structure);
        let message = |row: Row| unfit(&row_name(model, row.closing, row.index));
        let mut tests = Vec::new();
        for (&row, residual) in structure.granted.iter().zip(self.granted_residuals()) {
            tests.push(Test { what: message(row), condition: Condition::Small, values: vec![residual] });
        }
        if !matches!(model.handling, Handling::Reduced) {
            return tests;
        }
        let mut written: Vec<Scalar> = Vec::new();
        for step in &structure.steps {
            let Means::Solve(item) = step.means else { continue };
            let first = step.unknowns.first().copied();
            let (Some(item), Some(first)) = (model.solves.get(item), first) else { continue };
            if matches!(item.how, SolveHow::Formulas(_)) {
                written.extend(step.unknowns.iter().map(|&unknown| self.coordinate_symbols(unknown)[0]));
                continue;
            }
            let centres = reduction.dead_centres.iter().filter(|centre| step.unknowns.contains(&centre.0));
            let mut values: Vec<Scalar> = centres.map(|centre| centre.1).collect();
            if values.is_empty() {
                values.push(self.coordinate_symbols(first)[0]);
            }
            let name = coordinate_name(model, first);
            let what = format!(
                "at the default position the loop of `{name}` has no solution that satisfies the conditions of its `solve`"
            );
            tests.push(Test { what, condition: Condition::Finite, values });
        }
        for closing in closings(model) {
            let residuals = self.equations_of(closing);
            for (index, &residual) in residuals.iter().enumerate() {
                let row = Row { closing, index };
                let dropped = structure.dropped.contains(&row) && !matches!(closing, LoopClosure::Constraint(_));
                if structure.granted.contains(&row) {
                    continue;
                }
                if dropped || self.g.depends_on(residual, &written) {
                    tests.push(Test { what: message(row), condition: Condition::Small, values: vec![residual] });
                }
            }
        }
        tests
    }

    /// The pivots of the mass matrix, from the tips to the root.
    fn tests_of_masses(&mut self, reduction: &Reduction) -> Vec<Test> {
        let model = self.scene.model;
        let state: Vec<Coordinate> = match self.is_constrained() {
            // With multipliers a coordinate may rest on its constraints alone.
            true => return Vec::new(),
            false => self.scene.structure.state.clone(),
        };
        let all = self.scene.structure.roles.iter().flatten().all(|&role| role == Role::State);
        if state.is_empty() || state.len() > MOST_TESTED {
            return Vec::new();
        }
        let matrix = if all && self.scene.structure.steps.is_empty() {
            let entries = self.mass_matrix();
            let size: usize = model.joints.iter_ids().map(|(id, joint)| freedoms_of(model, id, joint)).sum();
            entries.chunks(size.max(1)).map(<[Scalar]>::to_vec).collect()
        } else {
            self.reduced_mass_matrix(reduction)
        };
        if matrix.len() != state.len() {
            return Vec::new();
        }
        let place = self.default_position();
        let matrix: Vec<Vec<Scalar>> = matrix
            .iter()
            .map(|row| {
                let row = self.finish(reduction, row);
                self.g.substitute(&row, &place)
            })
            .collect();
        let order: Vec<usize> = (0..matrix.len()).rev().collect();
        let factors = Factors::new(&mut self.g, &matrix, &order);
        let mut tests = Vec::with_capacity(order.len());
        for k in order {
            let (Some(&coordinate), Some(pivot)) = (state.get(k), factors.pivot(&mut self.g, k)) else { continue };
            let name = coordinate_name(model, coordinate);
            let what = format!("the mass matrix is singular at the default position: nothing resists `{name}`");
            tests.push(Test { what, condition: Condition::Pivot, values: vec![pivot, matrix[k][k]] });
        }
        tests
    }
}
