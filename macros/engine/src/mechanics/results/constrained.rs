//! Stage `mechanics`: equations of motion under constraints.
//!
//! In: the tree's inverse dynamics and mass matrix, definitions of dependent coordinates, equations that keep multipliers.
//! Out: accelerations of the state, multipliers, efforts. Velocities of the tree are v = S u + s(t), so efforts project by
//! S^T and the mass matrix is S^T M S (the projection of Kane and Maggi). What is left of the equations, G u' = -gamma,
//! gives multipliers ([`crate::dynamics::saddle`]).

use std::collections::{HashMap, HashSet};
use std::rc::Rc;

use crate::contracts::call::Call;
use crate::contracts::results::{Results, Slot};
use crate::dynamics::elimination::Pattern;
use crate::dynamics::saddle::{Posed, Saddle, Solution};
use crate::invariant::fault::OrFault;
use crate::mechanics::equations::Equations;
use crate::mechanics::loops::advice::Pivoted;
use crate::mechanics::loops::reduction::{Map, Reduction};
use crate::mechanics::loops::structure::{Role, Row};
use crate::mechanics::scene::Method;
use crate::mechanics::translate::forces::LoadCase;
use crate::model::types::{Handling, LoopClosure};
use crate::symbolic::differentiate::Differentiator;
use crate::symbolic::graph::Scalar;

/// Accelerations with what comes beside them.
pub(in crate::mechanics) struct ConstrainedMotion {
    /// Of the state.
    pub accelerations: Vec<Scalar>,
    pub multipliers: Vec<Scalar>,
    pub rank: Option<Scalar>,
}

/// Equations of closings, once they are written.
#[derive(Clone, Default)]
pub(in crate::mechanics) struct Residuals(HashMap<LoopClosure, Rc<[Scalar]>>);

impl ConstrainedMotion {
    /// Where no equation keeps a multiplier.
    pub(in crate::mechanics) fn without_rows(accelerations: Vec<Scalar>) -> Self {
        ConstrainedMotion { accelerations, multipliers: Vec::new(), rank: None }
    }

    /// Accelerations with the rates of own states, those of positions where velocities are others, multipliers and the rank of their
    /// system.
    pub(in crate::mechanics) fn results(&self, rates: Vec<Scalar>, moved: Vec<Scalar>) -> Results<Scalar> {
        let results = Results::velocity(self.accelerations.clone()).with_any(Slot::States, rates);
        let results = results.with_any(Slot::Rates, moved);
        let results = results.with_any(Slot::Multipliers, self.multipliers.clone());
        match self.rank {
            Some(rank) => results.with_scalar(Slot::Rank, rank),
            None => results,
        }
    }
}

/// Constraint equations as the multipliers see them, by row.
pub(in crate::mechanics) struct Rows {
    /// Coefficients of the velocities of the state.
    pub jacobian: Vec<Vec<Scalar>>,
    /// What is left of the second derivative by time where the accelerations of the state are zero.
    pub bias: Vec<Scalar>,
}

impl Equations<'_> {
    /// Rates of the state's positions where velocities are others.
    pub(in crate::mechanics) fn moved(&mut self, reduction: &Reduction) -> Vec<Scalar> {
        if self.scene.structure.has_speeds() { self.position_rates(reduction) } else { Vec::new() }
    }

    /// Rates of the state's positions.
    pub(in crate::mechanics) fn position_rates(&mut self, reduction: &Reduction) -> Vec<Scalar> {
        let state = self.scene.structure.state.clone();
        let rates: Vec<Scalar> = state.iter().map(|&coordinate| self.coordinate_symbols(coordinate)[1]).collect();
        self.finish(reduction, &rates)
    }

    /// Places of velocity coordinates among those of the tree and speeds.
    pub(in crate::mechanics) fn speeds(&self) -> Vec<usize> {
        self.scene.structure.speeds().iter().map(|&coordinate| self.freedom(coordinate)).collect()
    }

    /// Equations of a closing, written once.
    pub(in crate::mechanics) fn equations_of(&mut self, closing: LoopClosure) -> Rc<[Scalar]> {
        if let Some(known) = self.caches.residuals.0.get(&closing) {
            return Rc::clone(known);
        }
        let writing = self.scene.way.writing;
        let residuals: Rc<[Scalar]> = self.residuals(closing, writing).into();
        self.caches.residuals.0.insert(closing, Rc::clone(&residuals));
        residuals
    }

    /// One constraint equation on the tree.
    pub(in crate::mechanics) fn row(&mut self, row: Row) -> Scalar {
        let residuals = self.equations_of(row.closing);
        residuals.get(row.index).copied().or_fault("a row is one of the equations of its closing")
    }

    /// What is left of equations that were left out for the declared parameters, over their scales.
    pub(in crate::mechanics) fn granted(&mut self, reduction: &Reduction) -> Vec<Scalar> {
        let rows = self.granted_residuals();
        self.finish(reduction, &rows)
    }

    /// The same on the tree.
    pub(in crate::mechanics) fn granted_residuals(&mut self) -> Vec<Scalar> {
        let structure = Rc::clone(&self.scene.structure);
        let rows = structure.granted.iter().map(|&row| {
            let residual = self.row(row);
            let inverse = self.g.decimal(1.0 / structure.scale(row));
            self.g.mul(inverse, residual)
        });
        rows.collect()
    }

    /// Efforts that the accelerations take beside all declared forces: of the state, then of driven coordinates, in the
    /// order of the tree.
    pub(super) fn projected_efforts(&mut self, reduction: &Reduction, case: LoadCase) -> Vec<Scalar> {
        let efforts = self.inverse_dynamics(case);
        self.project(reduction, &efforts)
    }

    /// Inverse dynamics in the coordinates of the state.
    pub(in crate::mechanics) fn reduced_efforts(&mut self, reduction: &Reduction, case: LoadCase) -> Vec<Scalar> {
        let efforts = self.state_efforts(reduction, case);
        let efforts = self.finish(reduction, &efforts);
        self.first_order(&efforts)
    }

    /// The same where accelerations of the state are zero, under the declared forces.
    pub(in crate::mechanics) fn reduced_bias(&mut self, reduction: &Reduction) -> Vec<Scalar> {
        let efforts = self.state_efforts(reduction, LoadCase::Declared);
        let bias = self.where_the_state_rests(reduction, &efforts);
        self.first_order(&bias)
    }

    /// With definitions put in, where accelerations of the state are zero.
    pub(super) fn where_the_state_rests(&mut self, reduction: &Reduction, list: &[Scalar]) -> Vec<Scalar> {
        // Dependents' accelerations hold those of the state: they are put in before these are set to zero.
        let list = self.finish(reduction, list);
        let rest = self.rest();
        let list = self.g.substitute(&list, &rest);
        self.finish(reduction, &list)
    }

    /// Efforts of the state, before definitions are put in.
    fn state_efforts(&mut self, reduction: &Reduction, case: LoadCase) -> Vec<Scalar> {
        let efforts = self.projected_efforts(reduction, case);
        self.speeds().into_iter().map(|freedom| efforts[freedom]).collect()
    }

    /// Accelerations of the state set to zero.
    fn rest(&self) -> Map {
        let speeds = self.scene.structure.speeds();
        let pairs: Vec<(Scalar, Scalar)> =
            speeds.iter().map(|&coordinate| (self.velocity_symbols(coordinate)[1], Scalar::ZERO)).collect();
        self.map(&pairs)
    }

    /// S^T M S.
    pub(in crate::mechanics) fn reduced_mass_matrix(&mut self, reduction: &Reduction) -> Vec<Vec<Scalar>> {
        let matrix = self.mass_matrix_on_tree(reduction);
        let flat = self.finish(reduction, &matrix.concat());
        let flat = self.first_order(&flat);
        flat.chunks(matrix.len().max(1)).map(<[Scalar]>::to_vec).collect()
    }

    /// The same before definitions are put in: dependent coordinates are symbols.
    pub(in crate::mechanics) fn mass_matrix_on_tree(&mut self, reduction: &Reduction) -> Vec<Vec<Scalar>> {
        let n = self.scene.symbols.places();
        let entries = self.mass_matrix();
        let matrix: Vec<&[Scalar]> = entries.chunks(n.max(1)).collect();
        let speeds = self.speeds();
        let map = self.velocity_map(reduction, &speeds);
        // M S, column by column, then S^T of it; rows of S are those of the tree.
        let g = &mut self.g;
        let size = speeds.len();
        let mut reduced = vec![vec![Scalar::ZERO; size]; size];
        let columns: Vec<Vec<Scalar>> = (0..size)
            .map(|j| {
                (0..n)
                    .map(|i| {
                        let terms: Vec<Scalar> = (0..n).map(|k| g.mul(matrix[i][k], map[k][j])).collect();
                        g.sum(&terms)
                    })
                    .collect()
            })
            .collect();
        for i in 0..size {
            for j in i..size {
                let terms: Vec<Scalar> = (0..n).map(|k| g.mul(map[k][i], columns[j][k])).collect();
                reduced[i][j] = g.sum(&terms);
                reduced[j][i] = reduced[i][j];
            }
        }
        reduced
    }

    /// S, a row per coordinate of the tree, by velocity coordinates at these places.
    pub(in crate::mechanics) fn velocity_map(&mut self, reduction: &Reduction, speeds: &[usize]) -> Vec<Vec<Scalar>> {
        self.map_by(&reduction.rates, speeds)
    }

    /// How velocities of the tree, of which these follow, change with those at some places.
    pub(in crate::mechanics) fn map_by(&mut self, rates: &[(usize, Scalar)], places: &[usize]) -> Vec<Vec<Scalar>> {
        let n = self.scene.symbols.places();
        let mut map = vec![vec![Scalar::ZERO; places.len()]; n];
        let velocities = self.all_velocities();
        for (j, &freedom) in places.iter().enumerate() {
            if let Some(row) = map.get_mut(freedom) {
                row[j] = Scalar::ONE;
            }
            let mut along = Differentiator::new(&[(velocities[freedom], Scalar::ONE)]);
            for &(dependent, rate) in rates {
                map[dependent][j] = along.scalar(&mut self.g, rate);
            }
        }
        map
    }

    /// Equations of the multipliers, in the state.
    fn rows(&mut self, reduction: &Reduction) -> Rows {
        let structure = Rc::clone(&self.scene.structure);
        let speeds = structure.speeds().to_vec();
        let mut jacobian = Vec::with_capacity(structure.rows.len());
        let mut bias = Vec::with_capacity(structure.rows.len());
        for &row in &structure.rows {
            let residual = self.row(row);
            let (rate, second) = self.row_rates(row);
            let rate = self.finish(reduction, &[rate])[0];
            let mut columns = Vec::with_capacity(speeds.len());
            // A loop concerns few coordinates of a large mechanism.
            let read: HashSet<usize> = self.g.reachable_scalars(&[rate]).into_iter().collect();
            for &coordinate in &speeds {
                let [velocity, _] = self.velocity_symbols(coordinate);
                if !read.contains(&velocity.index()) {
                    columns.push(Scalar::ZERO);
                    continue;
                }
                let column = self.g.derivative(rate, &[(velocity, Scalar::ONE)]);
                columns.push(column);
            }
            jacobian.push(columns);
            let mut rest = self.finish(reduction, &[second])[0];
            let still = self.rest();
            rest = self.g.substitute(&[rest], &still)[0];
            let stabilised = self.stabilising(residual, rate, reduction);
            bias.push(self.g.add(rest, stabilised));
        }
        Rows { jacobian, bias }
    }

    /// Baumgarte's terms.
    fn stabilising(&mut self, residual: Scalar, rate: Scalar, reduction: &Reduction) -> Scalar {
        let model = self.scene.model;
        let Handling::Stabilised { rate: damping, position } = &model.handling else { return Scalar::ZERO };
        let (damping, stiffness) = (self.scalar(damping), self.scalar(position));
        let residual = self.finish(reduction, &[residual])[0];
        let terms = [self.g.mul(damping, rate), self.g.mul(stiffness, residual)];
        self.g.sum(&terms)
    }

    /// Forward dynamics.
    pub(in crate::mechanics) fn solve_constrained(&mut self, reduction: &Reduction) -> ConstrainedMotion {
        if self.scene.way.method == Method::Articulated && self.embeds(reduction) {
            return ConstrainedMotion::without_rows(self.accelerations_embedded(reduction));
        }
        self.system(reduction).2
    }

    /// The system that accelerations and multipliers solve, its rows, and its solution.
    pub(in crate::mechanics) fn system(&mut self, reduction: &Reduction) -> (Saddle, Rows, ConstrainedMotion) {
        let matrix = self.reduced_mass_matrix(reduction);
        let bias = self.reduced_bias(reduction);
        let rhs: Vec<Scalar> = bias.iter().map(|&b| -b).collect();
        let rows = self.rows(reduction);
        let held: Vec<Scalar> = rows.bias.iter().map(|&gamma| -gamma).collect();
        let (saddle, solved) = self.solve_rows(matrix, &rhs, rows.jacobian.clone(), &held);
        (saddle, rows, solved)
    }

    /// The jump of velocities under an impulse: the same system with the impulse for the forces, and given rates of the
    /// equations.
    pub(in crate::mechanics) fn constrained_jump(&mut self, reduction: &Reduction) -> ConstrainedMotion {
        if self.scene.way.method == Method::Articulated && self.embeds(reduction) {
            return ConstrainedMotion::without_rows(self.jump_embedded(reduction));
        }
        let matrix = self.reduced_mass_matrix(reduction);
        let jacobian = self.rows(reduction).jacobian;
        let (impulses, rates) = (self.scene.symbols.impulses.clone(), self.scene.symbols.rates.clone());
        self.solve_rows(matrix, &impulses, jacobian, &rates).1
    }

    /// The least d with G d = r, as if all masses were one: d + G^T mu = 0. Then the rank.
    pub(in crate::mechanics) fn least_displacement(&mut self, reduction: &Reduction) -> Vec<Scalar> {
        let jacobian = self.rows(reduction).jacobian;
        let size = self.scene.structure.freedoms();
        let unit = |i: usize| (0..size).map(|j| if i == j { Scalar::ONE } else { Scalar::ZERO }).collect();
        let rates = self.scene.symbols.rates.clone();
        let found = self.solve_rows((0..size).map(unit).collect(), &vec![Scalar::ZERO; size], jacobian, &rates).1;
        let rank = found.rank.or_fault("equations have a rank");
        found.accelerations.into_iter().chain([rank]).collect()
    }

    /// M a + G^T lambda = rhs, G a = held.
    fn solve_rows(
        &mut self,
        matrix: Vec<Vec<Scalar>>,
        rhs: &[Scalar],
        jacobian: Vec<Vec<Scalar>>,
        held: &[Scalar],
    ) -> (Saddle, ConstrainedMotion) {
        let order = self.state_elimination();
        let groups = self.scene.structure.row_groups(self.scene.model);
        let posed = Posed::new(&mut self.g, matrix, (jacobian, groups), &order);
        let sparse = self.order_of(posed.pattern(), &order);
        let saddle = Saddle::new(&mut self.g, &posed, &sparse, &order);
        self.decided.pivoted = Some(self.pivoted(&saddle));
        let Solution { unknowns: accelerations, multipliers, rank } = saddle.solve(&mut self.g, rhs, held);
        for (k, &multiplier) in multipliers.iter().enumerate() {
            self.g.name(multiplier, || format!("multiplier_{}", k + 1));
        }
        (saddle, ConstrainedMotion { accelerations, multipliers, rank })
    }

    /// What became of its equations.
    fn pivoted(&self, saddle: &Saddle) -> Pivoted {
        let rows = &self.scene.structure.rows;
        let named = |places: &[usize]| places.iter().map(|&k| rows[k]).collect::<Vec<Row>>();
        let (absorbed, cores) = saddle.rows();
        Pivoted { absorbed: named(&absorbed), cores: cores.iter().map(|core| named(core)).collect() }
    }

    /// Where the system has entries, and its coordinates from the leaves inwards.
    pub(in crate::mechanics) fn pattern_of_solution(&mut self, reduction: &Reduction) -> (Pattern, Vec<usize>) {
        let matrix = self.reduced_mass_matrix(reduction);
        let jacobian = self.rows(reduction).jacobian;
        let coordinates = self.state_elimination();
        let groups = self.scene.structure.row_groups(self.scene.model);
        let posed = Posed::new(&mut self.g, matrix, (jacobian, groups), &coordinates);
        (posed.pattern(), coordinates)
    }

    /// What the factors of the system and one solution take, roughly.
    pub(in crate::mechanics) fn cost_of_solution(&mut self, reduction: &Reduction) -> u32 {
        let (pattern, coordinates) = self.pattern_of_solution(reduction);
        let cost = self.order_of(pattern.clone(), &coordinates).cost(&pattern);
        u32::try_from(cost).unwrap_or(u32::MAX)
    }

    /// Elimination of velocity coordinates from the leaves inwards, then of speeds of the user's choice; by place among them.
    fn state_elimination(&self) -> Vec<usize> {
        let speeds = self.speeds();
        let order = self.scene.mechanism.elimination(self.scene.way.method == Method::Floating);
        let chosen = self.scene.symbols.freedoms..self.scene.symbols.places();
        let others = chosen.filter(|place| !order.contains(place)).collect::<Vec<_>>();
        order.into_iter().chain(others).filter_map(|freedom| speeds.iter().position(|&k| k == freedom)).collect()
    }

    /// Residuals of the equations with multipliers.
    pub(in crate::mechanics) fn constraints(&mut self, reduction: &Reduction) -> Vec<Scalar> {
        let structure = Rc::clone(&self.scene.structure);
        let rows: Vec<Scalar> = structure.rows.iter().map(|&row| self.row(row)).collect();
        self.finish(reduction, &rows)
    }

    /// Row by row.
    pub(in crate::mechanics) fn constraint_jacobian(&mut self, reduction: &Reduction) -> Vec<Scalar> {
        self.rows(reduction).jacobian.concat()
    }

    /// By displacements of the state's position, row by row; of equations of velocities by rates of the state's position.
    pub(in crate::mechanics) fn position_jacobian(&mut self, reduction: &Reduction) -> Vec<Scalar> {
        let structure = Rc::clone(&self.scene.structure);
        let map = self.displacement_map(reduction);
        let velocities = self.all_velocities();
        let mut entries = Vec::with_capacity(structure.rows.len() * structure.state.len());
        for &row in &structure.rows {
            let (rate, _) = self.row_rates(row);
            for (at, &coordinate) in structure.state.iter().enumerate() {
                let mut seeds = vec![(self.velocity_symbols(coordinate)[0], Scalar::ONE)];
                let dependents = reduction.displacements.iter();
                seeds.extend(dependents.map(|&(dependent, _)| (velocities[dependent], map[dependent][at])));
                entries.push(self.g.derivative(rate, &seeds));
            }
        }
        self.finish(reduction, &entries)
    }

    pub(in crate::mechanics) fn constraint_rate(&mut self, reduction: &Reduction) -> Vec<Scalar> {
        let structure = Rc::clone(&self.scene.structure);
        let mut rates = Vec::with_capacity(structure.rows.len());
        for &row in &structure.rows {
            rates.push(self.row_rates(row).0);
        }
        self.finish(reduction, &rates)
    }

    pub(in crate::mechanics) fn constraint_bias(&mut self, reduction: &Reduction) -> Vec<Scalar> {
        self.rows(reduction).bias
    }

    /// Puts definitions into results, and the accelerations that were found.
    pub(in crate::mechanics) fn put_in_all(
        &mut self,
        reduction: &Reduction,
        solved: &ConstrainedMotion,
        roots: &[Scalar],
    ) -> Vec<Scalar> {
        let roots = self.finish(reduction, roots);
        let speeds = self.scene.structure.speeds().to_vec();
        let accelerations = speeds.iter().map(|&coordinate| self.velocity_symbols(coordinate)[1]);
        let symbols = accelerations.chain(self.scene.symbols.multipliers.iter().copied());
        let values = solved.accelerations.iter().chain(&solved.multipliers).copied();
        let pairs: Vec<(Scalar, Scalar)> = symbols.zip(values).collect();
        let map = self.map(&pairs);
        self.g.substitute(&roots, &map)
    }

    /// With the greatest residual of all iterations, where there are any.
    pub(in crate::mechanics) fn with_residual(
        &mut self,
        reduction: &Reduction,
        results: Results<Scalar>,
    ) -> Results<Scalar> {
        if reduction.residuals.is_empty() {
            return results;
        }
        let residual = self.worst_residual(reduction);
        let residual = self.finish(reduction, &[residual])[0];
        results.with_scalar(Slot::Residual, residual)
    }

    /// The greatest residual of all iterations.
    pub(in crate::mechanics) fn worst_residual(&mut self, reduction: &Reduction) -> Scalar {
        self.worst(&reduction.residuals)
    }

    pub(in crate::mechanics) fn worst(&mut self, residuals: &[Scalar]) -> Scalar {
        let g = &mut self.g;
        let mut residuals = residuals.iter().copied();
        let first = residuals.next().unwrap_or(Scalar::ZERO);
        residuals.fold(first, |worst, r| g.call(Call::Max, &[worst, r]))
    }

    pub(in crate::mechanics) fn rows_with_multipliers(&self) -> Vec<(Row, Scalar)> {
        self.scene.structure.rows.iter().copied().zip(self.scene.symbols.multipliers.iter().copied()).collect()
    }

    /// Dynamic rows with the multipliers' forces, then the equations, of positions or of velocities.
    pub(in crate::mechanics) fn residual(&mut self, reduction: &Reduction) -> Results<Scalar> {
        let efforts = self.reduced_efforts(reduction, LoadCase::HeldOpen);
        let structure = Rc::clone(&self.scene.structure);
        let rows = structure.rows.iter();
        let gaps: Vec<Scalar> = rows.map(|&row| self.rate_expression(row).unwrap_or_else(|| self.row(row))).collect();
        Results::velocity(efforts).with_any(Slot::Gaps, self.finish(reduction, &gaps))
    }

    /// Whether coordinates follow from others, or equations keep multipliers.
    pub(in crate::mechanics) fn is_constrained(&self) -> bool {
        !self.scene.structure.steps.is_empty()
            || self.scene.structure.has_speeds()
            || !self.scene.structure.rows.is_empty()
            || self.scene.structure.roles.iter().flatten().any(|role| matches!(role, Role::Driven(_)))
            || self.is_first_order()
    }
}
