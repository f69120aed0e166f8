//! Stage `mechanics`: the forces by which loops hold whose coordinates are eliminated.
//!
//! In: the tree, the equations by which dependent coordinates are found. Out: a multiplier for each of these equations. The
//! equations of motion M a = f - G^T lambda hold for dependent coordinates too: with e the efforts that the motion takes
//! beside all declared forces, G_d^T lambda = -e_d, as many equations as multipliers. Linear couplings of coordinates are
//! seen through (they act on coordinates, so that no link is loaded by them), those of places of frames are not. The rest falls into the smallest systems that can be
//! solved one after the other, each by its structure ([`crate::symbolic::structured`]).

use std::rc::Rc;

use crate::mechanics::equations::Equations;
use crate::mechanics::loops::reduction::Map;
use crate::mechanics::loops::structure::{Means, Row};
use crate::mechanics::translate::forces::LoadCase;
use crate::mechanics::translate::manipulations::loads_links;
use crate::model::types::{Coordinate, LoopClosure};
use crate::symbolic::graph::Scalar;
use crate::symbolic::triangular_form::{components, matching};

/// Multipliers of the equations by which dependent coordinates are found.
#[derive(Clone, Default)]
pub(in crate::mechanics) struct Holding(Option<Rc<[(Row, Scalar)]>>);

/// A dependent coordinate's equation of motion.
struct Balance {
    /// By equation of the loops: its coefficient of the coordinate's velocity.
    slopes: Vec<Scalar>,
    /// What the multipliers must provide.
    needed: Scalar,
}

impl Equations<'_> {
    /// Multipliers of the equations by which dependent coordinates are found, linear couplings left out; in symbols of the
    /// tree's coordinates and accelerations.
    pub(super) fn reaction_multipliers(&mut self) -> Rc<[(Row, Scalar)]> {
        if let Some(known) = &self.caches.holding.0 {
            return Rc::clone(known);
        }
        let (rows, unknowns) = self.held_rows();
        // As many equations as unknowns, by analysis.
        let found = if rows.len() == unknowns.len() && !rows.is_empty() {
            let balances = self.balances(&rows, &unknowns);
            let multipliers = self.multipliers_of(&balances);
            rows.into_iter().zip(multipliers).collect()
        } else {
            Vec::new()
        };
        let found: Rc<[(Row, Scalar)]> = found.into();
        self.caches.holding.0 = Some(Rc::clone(&found));
        found
    }

    /// Equations and unknowns of all steps but linear couplings of coordinates.
    fn held_rows(&self) -> (Vec<Row>, Vec<Coordinate>) {
        let structure = Rc::clone(&self.scene.structure);
        let mut rows = structure.independent.clone();
        rows.extend(&structure.rates.rows);
        let mut unknowns = structure.rates.held.clone();
        for step in &structure.steps {
            match step.means {
                Means::Linear(id) if !loads_links(self.scene.model, id) => {
                    rows.retain(|row| row.closing != LoopClosure::Constraint(id));
                }
                Means::Linear(_) | Means::Explicit(_) | Means::Solve(_) | Means::Newton { .. } => {
                    unknowns.extend(&step.unknowns);
                }
            }
        }
        rows.retain(|row| !structure.rows.contains(row));
        (rows, unknowns)
    }

    fn balances(&mut self, rows: &[Row], unknowns: &[Coordinate]) -> Vec<Balance> {
        let coupled = self.coupled_rates();
        let map: Map = coupled
            .iter()
            .filter_map(|&(coordinate, rate)| Some((self.g.symbol_id(self.coordinate_symbols(coordinate)[1])?, rate)))
            .collect();
        let mut rates = Vec::with_capacity(rows.len());
        for &row in rows {
            let rate = self.row_rates(row).0;
            rates.extend(self.g.substitute(&[rate], &map));
        }
        let efforts = self.inverse_dynamics(LoadCase::Held);
        let effort = |at: usize| efforts[at];
        let mut balances = Vec::with_capacity(unknowns.len());
        for &unknown in unknowns {
            let velocity = self.coordinate_symbols(unknown)[1];
            let slopes = rates.iter().map(|&rate| self.g.derivative(rate, &[(velocity, Scalar::ONE)])).collect();
            let mut terms = vec![-effort(self.freedom(unknown))];
            for &(coordinate, rate) in &coupled {
                let slope = self.g.derivative(rate, &[(velocity, Scalar::ONE)]);
                terms.push(-self.g.mul(slope, effort(self.freedom(coordinate))));
            }
            balances.push(Balance { slopes, needed: self.g.sum(&terms) });
        }
        balances
    }

    /// Rates of coordinates that linear couplings give, in velocities of the others.
    fn coupled_rates(&mut self) -> Vec<(Coordinate, Scalar)> {
        let structure = Rc::clone(&self.scene.structure);
        let (mut map, mut coupled) = (Map::new(), Vec::new());
        for step in &structure.steps {
            let Means::Linear(id) = step.means else { continue };
            if loads_links(self.scene.model, id) {
                continue;
            }
            if let Some(definition) = self.coupling(id, step) {
                let rate = self.g.substitute(&[definition.rate], &map)[0];
                let velocity = self.coordinate_symbols(definition.coordinate)[1];
                map.extend(self.g.symbol_id(velocity).map(|id| (id, rate)));
                coupled.push((definition.coordinate, rate));
            }
        }
        coupled
    }

    fn multipliers_of(&mut self, balances: &[Balance]) -> Vec<Scalar> {
        let size = balances.len();
        let mut multipliers = vec![Scalar::ZERO; size];
        for (members, rows) in systems(balances) {
            let mut matrix = Vec::with_capacity(members.len());
            let mut rest = Vec::with_capacity(members.len());
            for &member in &members {
                let Balance { slopes, needed } = &balances[member];
                let mut terms = vec![*needed];
                for (&slope, &known) in slopes.iter().zip(&multipliers) {
                    terms.push(-self.g.mul(slope, known));
                }
                rest.push(self.g.sum(&terms));
                matrix.push(rows.iter().map(|&row| slopes[row]).collect());
            }
            for (row, multiplier) in rows.into_iter().zip(self.solve_structured(&matrix, &rest).0) {
                self.g.name(multiplier, || format!("multiplier_{}", row + 1));
                multipliers[row] = multiplier;
            }
        }
        multipliers
    }
}

/// Balances with the equations whose multipliers they give, in an order in which each needs multipliers of earlier ones only.
fn systems(balances: &[Balance]) -> Vec<(Vec<usize>, Vec<usize>)> {
    let held: Vec<Vec<(usize, f64)>> = balances
        .iter()
        .map(|balance| {
            let slopes = balance.slopes.iter().enumerate();
            slopes.filter(|(_, slope)| **slope != Scalar::ZERO).map(|(row, _)| (row, 1.0)).collect()
        })
        .collect();
    let matched = matching(&held, balances.len());
    let of: Option<Vec<usize>> = matched.into_iter().collect();
    let Some(of) = of else {
        let all: Vec<usize> = (0..balances.len()).collect();
        return vec![(all.clone(), all)];
    };
    let owner = |row: usize| of.iter().position(|&other| other == row);
    let needs: Vec<Vec<usize>> =
        held.iter().map(|list| list.iter().filter_map(|&(row, _)| owner(row)).collect()).collect();
    components(&needs)
        .into_iter()
        .map(|members| {
            let rows = members.iter().map(|&member| of[member]).collect();
            (members, rows)
        })
        .collect()
}
