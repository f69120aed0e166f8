//! Stage `mechanics`: whether solutions close their loops.
//!
//! In: definitions of all dependent coordinates. Out: complaints about formulas that a user wrote and that leave a gap.
//! With the definitions put in, every equation that no iteration solves must vanish: exactly, by the normal form of the
//! graph, or, for formulas over rounded decimals and for roots, to 1e-12 (relative to one plus the largest term) at random
//! configurations in double precision. An equation is asked for once the last of its unknowns is found: what a user wrote
//! may close a loop together with a closed form.

use crate::contracts::results::{Results, Slot};
use crate::invariant::fault::raise;
use crate::mechanics::analysis::Complaint;
use crate::mechanics::equations::Equations;
use crate::model::site::Sited;
use crate::model::types::{Expr, JointId, Kinematics, Solve, SolveHow};
use crate::symbolic::graph::Scalar;

use super::branches::these;
use super::constraints::{closing_name, coordinate_name};
use super::reduction::Reduction;
use super::structure::Means;

const TOLERANCE: f64 = 1e-12;

impl Equations<'_> {
    /// Values, rates and accelerations of the coordinates to find; they may depend on the given ones alone.
    pub(in crate::mechanics) fn kinematics(
        &mut self,
        wanted: &Kinematics,
        reduction: &Reduction,
    ) -> Result<Results<Scalar>, Vec<Complaint>> {
        let symbols: Vec<[Scalar; 3]> = wanted.find.iter().map(|&c| self.coordinate_symbols(c)).collect();
        let roots: Vec<Scalar> = (0..3).flat_map(|order| symbols.iter().map(move |s| s[order])).collect();
        let mut found = self.finish(reduction, &roots);
        // Of loops that have a part in it.
        let mut guesses = reduction.guesses.iter().copied();
        let sizes = self.scene.structure.steps.iter().filter(|step| matches!(step.means, Means::Newton { .. }));
        let own: Vec<Vec<Scalar>> = sizes.map(|step| guesses.by_ref().take(step.unknowns.len()).collect()).collect();
        let residuals = reduction.residuals.iter().zip(own);
        let read = residuals.filter(|(_, own)| found.iter().any(|&root| self.g.depends_on(root, own)));
        let residuals: Vec<Scalar> = read.map(|(&residual, _)| residual).collect();
        let residual = self.worst(&residuals);
        found.extend(self.finish(reduction, &[residual]));
        let joints = self.scene.symbols.positions.iter().enumerate();
        let others: Vec<Scalar> = joints
            .filter(|(k, _)| !wanted.given.contains(&JointId(*k)))
            .flat_map(|(_, positions)| positions.iter().copied())
            .collect();
        match found.iter().position(|&s| self.g.depends_on(s, &others)) {
            None => {
                let slots = [Slot::Positions, Slot::Rates, Slot::Accelerations].into_iter();
                let orders = (0..3).map(|order| found[order * symbols.len()..][..symbols.len()].to_vec());
                let results =
                    slots.zip(orders).fold(Results::default(), |results, (slot, list)| results.with(slot, list));
                Ok(results.with_scalar(Slot::Residual, found[roots.len()]))
            }
            Some(at) => {
                let coordinate = wanted.find.get(at % wanted.find.len().max(1));
                let name = coordinate.map_or_else(String::new, |&c| coordinate_name(self.scene.model, c));
                Err(vec![Complaint {
                    at: wanted.site(),
                    message: format!("`{name}` does not follow from what is given"),
                    help: Some("give more coordinates, or write a `solve` item for its loop".to_owned()),
                }])
            }
        }
    }

    /// Results of iterations that begin where the coordinates stand that they find.
    pub(in crate::mechanics) fn begin_where_it_stands(&mut self, results: Results<Scalar>) -> Results<Scalar> {
        let guessed = self.scene.structure.guessed().into_iter().enumerate();
        let pairs: Vec<(Scalar, Scalar)> =
            guessed.map(|(at, c)| (self.scene.symbols.guess(at), self.coordinate_symbols(c)[0])).collect();
        let map = self.map(&pairs);
        Results { list: self.g.substitute(&results.list, &map), ..results }
    }

    /// The conditions that have chosen solutions hold for those that were made: where one holds nowhere, another solution was
    /// made than was chosen; where it fails somewhere, it chooses none there.
    fn verify_branches(&mut self, reduction: &Reduction) -> Vec<Complaint> {
        let model = self.scene.model;
        let structure = std::rc::Rc::clone(&self.scene.structure);
        let items = structure.steps.iter().filter_map(|step| match step.means {
            Means::Solve(item) => Some(&model.solves[item]),
            Means::Linear(_) | Means::Explicit(_) | Means::Newton { .. } => None,
        });
        let chosen = items.filter_map(|item| match &item.how {
            SolveHow::From { branches, .. } if !branches.is_empty() => Some((item, branches)),
            _ => None,
        });
        let chosen: Vec<(&Solve, &Vec<Expr>)> = chosen.collect();
        if chosen.is_empty() {
            return Vec::new();
        }
        // What is made here is forgotten: how functions are written does not depend on what was checked before.
        let (graph, caches) = (self.g.clone(), self.caches.clone());
        let mut complaints = Vec::new();
        for (item, branches) in chosen {
            // With the unknowns, so that configurations without a real solution are left out; those of other loops are no reason
            // to leave any out, as they were none where the solution was chosen.
            let unknowns: Vec<Scalar> = item.unknowns.iter().map(|&u| self.coordinate_symbols(u)[0]).collect();
            let conditions: Vec<Scalar> = branches.iter().map(|condition| self.scalar(condition)).collect();
            let roots = self.g.substitute(&[&unknowns[..], &conditions].concat(), &reduction.map);
            let samples = self.samples(&roots, &reduction.map);
            let fails = |k: usize| samples.iter().filter(|row| row[unknowns.len() + k] == 0.0).count();
            let fails: Vec<usize> = (0..conditions.len()).map(fails).collect();
            if !samples.is_empty() && fails.contains(&samples.len()) {
                raise("a closed form is the solution that its conditions choose");
            }
            if fails.iter().any(|&count| count > 0) {
                complaints.push(Complaint {
                    at: item.site(),
                    message: format!("no solution of {} satisfies the conditions everywhere", these(item)),
                    help: Some(
                        "choose one by conditions that hold on its branch alone, `solve .. from .. { sin(a) > 0.0 }`"
                            .to_owned(),
                    ),
                });
            }
        }
        (self.g, self.caches) = (graph, caches);
        complaints
    }

    /// Sentences about loops that close in numbers alone, or complaints at the `solve` items whose unknowns stand in equations
    /// that stay open.
    pub(in crate::mechanics) fn verify(&mut self, reduction: &Reduction) -> Result<Vec<String>, Vec<Complaint>> {
        let (model, structure) = (self.scene.model, std::rc::Rc::clone(&self.scene.structure));
        let (mut complaints, mut notes) = (Vec::new(), Vec::new());
        let step_unknowns: Vec<Vec<Scalar>> = structure
            .steps
            .iter()
            .map(|step| step.unknowns.iter().map(|&u| self.coordinate_symbols(u)[0]).collect())
            .collect();
        let item_of = |step: usize| match structure.steps.get(step)?.means {
            Means::Solve(item) => model.solves.get(item),
            _ => None,
        };
        let written = |step: usize| item_of(step).is_some_and(|item| matches!(item.how, SolveHow::Formulas(_)));
        let mut concerned = vec![false; structure.steps.len()];
        for closing in super::constraints::closings(model) {
            let residuals = self.equations_of(closing);
            let speaks = |list: &Vec<Scalar>| residuals.iter().any(|&r| self.g.depends_on(r, list));
            let steps: Vec<usize> = (0..step_unknowns.len()).filter(|&step| speaks(&step_unknowns[step])).collect();
            steps.iter().for_each(|&step| concerned[step] = true);
            // It must be closed once the last of its unknowns is found, by whichever of them were written by the user.
            let Some(last) = steps.last().copied().filter(|&last| item_of(last).is_some()) else { continue };
            let blamed = steps.iter().copied().rfind(|&step| written(step)).unwrap_or(last);
            let Some(item) = item_of(blamed) else { continue };
            let roots = self.finish(reduction, &residuals);
            if roots.iter().all(|&root| root == Scalar::ZERO) {
                continue;
            }
            let samples = self.samples(&roots, &reduction.map);
            let worst = samples.into_iter().flatten().fold(0.0_f64, |worst, gap| worst.max(gap.abs()));
            let name = closing_name(model, closing);
            if worst > if written(last) { TOLERANCE } else { 1e-8 } {
                complaints.push(Complaint {
                    at: item.site(),
                    message: format!("this solution does not close its loop: `{name}` stays open by up to {worst:.1e}"),
                    help: Some(
                        "the formulas must satisfy every equation of the loop, for all values of what they depend on"
                            .to_owned(),
                    ),
                });
            } else if written(blamed) {
                notes.push(format!("`{name}` closes to {worst:.0e} at random configurations (numerical check)"));
            }
        }
        complaints.extend(self.verify_branches(reduction));
        for step in (0..structure.steps.len()).filter(|&step| written(step) && !concerned[step]) {
            complaints.extend(item_of(step).map(|item| Complaint {
                at: item.site(),
                message: "this solution closes no loop: no equation concerns what it solves for".to_owned(),
                help: Some("leave it out, or declare the joint or constraint that it satisfies".to_owned()),
            }));
        }
        if complaints.is_empty() { Ok(notes) } else { Err(complaints) }
    }
}
