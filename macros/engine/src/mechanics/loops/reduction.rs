//! Stage `mechanics`: what takes the place of coordinates that are not in the state.
//!
//! In: a derivation on the tree, the structure. Out: a [`Reduction`]: positions, rates and accelerations of driven and
//! dependent coordinates as expressions, and the maps that put them in. All recursions see symbols for every coordinate of
//! the tree; this is what these symbols are replaced by in the end.
//!
//! A dependent coordinate x obeys E(x, known) = 0 with a known inverse slope 1 / (dE/dx). Differentiating by time,
//! dE/dx x' + E'|x = 0, and once more, dE/dx x'' + E''|(x'' = 0) = 0: both need no second solution, only derivatives of
//! the equation. Coordinates that a closed form finds together obey the same with the inverse of dE/dx that it gives, several
//! unknowns of one iteration with the matrix dE/dx, by elimination (`newton`).

use std::collections::{HashMap, HashSet};

use crate::contracts::symbol::Symbol;
use crate::mechanics::analysis::Complaint;
use crate::mechanics::equations::Equations;
use crate::mechanics::translate::names;
use crate::mechanics::translate::symbols::Symbols;
use crate::model::types::{ConstraintId, Coordinate, Expr, JointId, LoopClosure, SolveHow};
use crate::solve::{Balance, Value as SolvedValue};
use crate::symbolic::differentiate::Differentiator;
use crate::symbolic::graph::{BlockKind, Scalar, SymbolId};
use crate::symbolic::structured::solve_structured;

use super::constraints::coordinate_name;
use super::structure::{Means, Role, Step};

/// Expressions by the symbol that they replace.
pub(in crate::mechanics) type Map = HashMap<SymbolId, Scalar>;

/// Definitions of all coordinates outside the state.
#[derive(Clone, Default)]
pub(in crate::mechanics) struct Reduction {
    /// Positions, velocities and accelerations, in symbols of the state and time.
    pub(in crate::mechanics) map: Map,
    /// Positions that linear couplings give, in terms of other coordinates of the tree.
    pub(super) coupled: Map,
    /// Rates of the dependents, in velocities of the state and of driven coordinates; positions are symbols of the tree.
    pub(in crate::mechanics) rates: Vec<(usize, Scalar)>,
    /// The same of positions that follow, in displacements of the state: what rates are before velocities other than the rates of the state
    /// are put in.
    pub(in crate::mechanics) displacements: Vec<(usize, Scalar)>,
    /// Roots that vanish in dead centres, with the unknowns they belong to.
    pub dead_centres: Vec<(Coordinate, Scalar)>,
    /// Sentences for the report.
    pub notes: Vec<String>,
    /// What closed forms are made of.
    pub parts: Vec<Part>,
    /// Largest residual of all iterations.
    pub residuals: Vec<Scalar>,
    /// Unknowns that iterations have found, in the order of the guess.
    pub guesses: Vec<Scalar>,
    /// Of each iteration the derivatives of its equations by its unknowns, row by row, on the tree.
    pub matrices: Vec<Vec<Scalar>>,
    /// In the order in which they are found.
    pub definitions: Vec<Definition>,
    /// Of coordinates of the state whose rates follow: with their own symbols for positions, rates in velocities and positions of the tree.
    pub followed: Vec<Definition>,
}

/// A coefficient or so of the equation that a closed form solves.
#[derive(Clone)]
pub(in crate::mechanics) struct Part {
    /// What the graph calls it.
    pub label: String,
    pub coordinate: Coordinate,
    /// What it is in the equation.
    pub word: &'static str,
    /// Whether the coordinate is found as an angle.
    pub is_angle: bool,
}

/// What Newton's method does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::mechanics) enum Newton {
    Iterated,
    /// Nothing: what it finds stands in the guess already.
    AtGuess,
}

/// A dependent coordinate before it is put in: expressions on the tree.
#[derive(Clone, Copy)]
pub(in crate::mechanics) struct Definition {
    pub coordinate: Coordinate,
    pub position: Scalar,
    pub rate: Scalar,
    pub acceleration: Scalar,
}

impl Reduction {
    /// Definitions of all rates that are no velocity coordinates.
    pub(in crate::mechanics) fn of_rates(&self) -> impl Iterator<Item = &Definition> {
        self.definitions.iter().chain(&self.followed)
    }
}

impl Equations<'_> {
    /// Works out all definitions.
    pub(in crate::mechanics) fn define_all(&mut self, newton: Newton) -> Result<Reduction, Vec<Complaint>> {
        let structure = std::rc::Rc::clone(&self.scene.structure);
        let mut reduction = Reduction::default();
        self.drive(&mut reduction);
        let mut rates = Map::new();
        for step in &structure.steps {
            let definitions = self.step(step, newton, &mut reduction)?;
            if matches!(step.means, Means::Linear(_)) {
                for definition in &definitions {
                    self.couple(definition, &mut reduction.coupled);
                }
            }
            // What one iteration finds does not read each other; what a closed form finds may read what it has found before.
            let at_once = if matches!(step.means, Means::Newton { .. }) { definitions.len() } else { 1 };
            self.define(&definitions, at_once, &mut reduction, &mut rates);
            reduction.definitions.extend(definitions);
        }
        self.close(&mut reduction, &mut rates);
        reduction.displacements.clone_from(&reduction.rates);
        if structure.has_speeds() {
            self.follow_speeds(&mut reduction, &rates);
        }
        Ok(reduction)
    }

    /// Adds what a linear coupling gives. Couplings stand in an order in which each reads earlier ones only; what these give is put in.
    fn couple(&mut self, definition: &Definition, coupled: &mut Map) {
        let position = self.g.substitute(&[definition.position], coupled)[0];
        let own = self.map(&[(self.coordinate_symbols(definition.coordinate)[0], position)]);
        coupled.extend(own);
    }

    /// Couplings stand first, in terms of coordinates that later steps find: these are put into what was defined before.
    fn close(&mut self, reduction: &mut Reduction, rates: &mut Map) {
        if reduction.coupled.is_empty() {
            return;
        }
        let symbols: Vec<Scalar> = reduction.map.keys().filter_map(|&id| self.g.symbol_handle(id)).collect();
        // A coupling may lead to another: as many rounds as there are couplings.
        for _ in 0..=reduction.coupled.len() {
            let open: Vec<(SymbolId, Scalar)> = reduction.map.iter().map(|(&id, &value)| (id, value)).collect();
            let mut open: Vec<(SymbolId, Scalar)> =
                open.into_iter().filter(|&(_, value)| self.g.depends_on(value, &symbols)).collect();
            open.sort_unstable_by_key(|entry| entry.0);
            let values: Vec<Scalar> = open.iter().map(|entry| entry.1).collect();
            let values = self.finish(reduction, &values);
            reduction.map.extend(open.into_iter().map(|entry| entry.0).zip(values));
        }
        for _ in 0..=reduction.coupled.len() {
            let mut open: Vec<(SymbolId, Scalar)> = rates.iter().map(|(&id, &value)| (id, value)).collect();
            open.sort_unstable_by_key(|entry| entry.0);
            let values: Vec<Scalar> = open.iter().map(|entry| entry.1).collect();
            let values = self.g.substitute(&values, rates);
            rates.extend(open.into_iter().map(|entry| entry.0).zip(values));
        }
        let values: Vec<Scalar> = reduction.rates.iter().map(|entry| entry.1).collect();
        let values = self.g.substitute(&values, rates);
        reduction.rates.iter_mut().zip(values).for_each(|(entry, value)| entry.1 = value);
    }

    /// Adds the definitions of one step to the maps, several at once: first all positions, which rates are written with, then all
    /// rates, which accelerations are written with.
    fn define(&mut self, definitions: &[Definition], at_once: usize, reduction: &mut Reduction, rates: &mut Map) {
        let orders: [fn(&Definition) -> Scalar; 3] = [|d| d.position, |d| d.rate, |d| d.acceleration];
        for (order, value) in orders.into_iter().enumerate() {
            for definitions in definitions.chunks(at_once.max(1)) {
                let values: Vec<Scalar> = definitions.iter().map(value).collect();
                let values = self.g.substitute(&values, &reduction.map);
                for (definition, value) in definitions.iter().zip(values) {
                    let symbol = self.coordinate_symbols(definition.coordinate)[order];
                    let named = [
                        None,
                        Some(("rate", "Velocities of what follows.")),
                        Some(("accel", "Accelerations of what follows.")),
                    ];
                    if let Some((what, heading)) = named[order] {
                        let name = names::of_freedom(self.scene.model, definition.coordinate, what);
                        self.g.under(heading, |g| g.label(value, || name));
                    }
                    reduction.map.extend(self.g.symbol_id(symbol).map(|id| (id, value)));
                }
            }
        }
        for definitions in definitions.chunks(at_once.max(1)) {
            let values: Vec<Scalar> = definitions.iter().map(|definition| definition.rate).collect();
            let values = self.g.substitute(&values, rates);
            for (definition, projected) in definitions.iter().zip(values) {
                let symbol = self.coordinate_symbols(definition.coordinate)[1];
                let name = names::of_freedom(self.scene.model, definition.coordinate, "rate");
                self.g.under("Velocities of what follows.", |g| g.label(projected, || name));
                rates.extend(self.g.symbol_id(symbol).map(|id| (id, projected)));
                reduction.rates.push((self.freedom(definition.coordinate), projected));
            }
        }
    }

    /// Position, velocity and acceleration symbols of a coordinate whose rate is its velocity.
    pub(in crate::mechanics) fn coordinate_symbols(&self, coordinate: Coordinate) -> [Scalar; 3] {
        let Coordinate { joint, index } = coordinate;
        let symbols = &self.scene.symbols;
        [&symbols.positions, &symbols.velocities, &symbols.accelerations].map(|lists| Symbols::of(lists, joint)[index])
    }

    /// Symbols of a velocity coordinate and its rate, which may be a speed of the user's choice.
    pub(in crate::mechanics) fn velocity_symbols(&self, coordinate: Coordinate) -> [Scalar; 2] {
        if let Some(number) = coordinate.joint.0.checked_sub(self.scene.model.joints.len()) {
            return self.scene.symbols.speeds[number];
        }
        let [_, velocity, acceleration] = self.coordinate_symbols(coordinate);
        [velocity, acceleration]
    }

    /// The symbol of a speed of the user's choice, if the velocity coordinate is one.
    pub(in crate::mechanics) fn model_speed(&self, coordinate: Coordinate) -> Option<Scalar> {
        self.scene.model.speed(coordinate.joint).map(|_| self.velocity_symbols(coordinate)[0])
    }

    /// Place of a velocity coordinate among all of the tree; speeds of the user's choice stand behind these.
    pub(in crate::mechanics) fn freedom(&self, coordinate: Coordinate) -> usize {
        let symbols = &self.scene.symbols;
        match coordinate.joint.0.checked_sub(self.scene.model.joints.len()) {
            Some(number) => symbols.freedoms + number,
            None => symbols.first[coordinate.joint.0] + coordinate.index,
        }
    }

    /// Velocities of the tree, then speeds of the user's choice, by their places.
    pub(in crate::mechanics) fn all_velocities(&self) -> Vec<Scalar> {
        let symbols = &self.scene.symbols;
        symbols.velocities.iter().flatten().copied().chain(symbols.speeds.iter().map(|speed| speed[0])).collect()
    }

    /// Their rates.
    pub(in crate::mechanics) fn all_accelerations(&self) -> Vec<Scalar> {
        let symbols = &self.scene.symbols;
        symbols.accelerations.iter().flatten().copied().chain(symbols.speeds.iter().map(|speed| speed[1])).collect()
    }

    /// A map from symbols to what replaces them.
    pub(in crate::mechanics) fn map(&self, pairs: &[(Scalar, Scalar)]) -> Map {
        pairs.iter().filter_map(|&(symbol, value)| Some((self.g.symbol_id(symbol)?, value))).collect()
    }

    fn step(
        &mut self,
        step: &Step,
        newton: Newton,
        reduction: &mut Reduction,
    ) -> Result<Vec<Definition>, Vec<Complaint>> {
        match step.means {
            Means::Linear(id) => Ok(self.coupling(id, step).into_iter().collect()),
            Means::Explicit(id) => {
                // As for an iteration: couplings go with the unknown, and what stands in form alone goes.
                let residuals = self.equations_of(LoopClosure::Constraint(id));
                let residuals = self.g.substitute(&residuals, &reduction.coupled);
                let later = self.later_unknowns(step);
                let residuals = self.g.substitute(&residuals, &later);
                Ok(self.affine(&residuals, step).into_iter().collect())
            }
            Means::Solve(item) => {
                let model = self.scene.model;
                match &model.solves[item].how {
                    SolveHow::Formulas(formulas) => Ok(self.formulas(formulas, step)),
                    SolveHow::From { .. } => self.closed_forms(item, reduction),
                }
            }
            Means::Newton { .. } => Ok(self.iterate(step, newton, reduction)),
        }
    }

    /// What a linear coupling gives.
    pub(in crate::mechanics) fn coupling(&mut self, id: ConstraintId, step: &Step) -> Option<Definition> {
        let residuals = self.equations_of(LoopClosure::Constraint(id));
        self.affine(&residuals, step)
    }

    /// What an equation gives that is affine in its unknown, with a factor in which no unknown has a part.
    fn affine(&mut self, residuals: &[Scalar], step: &Step) -> Option<Definition> {
        let (&residual, &unknown) = residuals.first().zip(step.unknowns.first())?;
        let symbol = self.coordinate_symbols(unknown)[0];
        let slope = self.g.derivative(residual, &[(symbol, Scalar::ONE)]);
        let off = self.map(&[(symbol, Scalar::ZERO)]);
        let rest = self.g.substitute(&[residual], &off)[0];
        let inverse = self.g.reciprocal(slope);
        let position = -self.g.mul(inverse, rest);
        let balance = Balance { equation: residual, inverse_slope: inverse };
        Some(self.implicit(unknown, position, &[balance], &[symbol], false))
    }

    /// What the user's formulas give.
    fn formulas(&mut self, formulas: &[Expr], step: &Step) -> Vec<Definition> {
        let definitions = step.unknowns.iter().zip(formulas).map(|(&unknown, formula)| {
            let position = self.scalar(formula);
            let symbol = self.coordinate_symbols(unknown)[0];
            let equation = self.g.sub(symbol, position);
            let balance = Balance { equation, inverse_slope: Scalar::ONE };
            self.implicit(unknown, position, &[balance], &[symbol], false)
        });
        definitions.collect()
    }

    /// What the closed form of a loop gives.
    fn closed_forms(&mut self, item: usize, reduction: &mut Reduction) -> Result<Vec<Definition>, Vec<Complaint>> {
        let model = self.scene.model;
        let found = self.closed_form(item, reduction)?;
        let mut definitions = Vec::with_capacity(found.len());
        for (unknown, solved) in found {
            let symbol = Symbol::Position { joint: unknown.joint, component: unknown.index };
            let name = names::symbol(model, symbol);
            if let [balance] = solved.balances[..] {
                self.g.label(balance.inverse_slope, || format!("slope_{name}_inv"));
            }
            let before = self.g.begin(Some(format!("Closed form of {name}.").into()));
            // As in the report: A cos x + B sin x = C, (r cos x, r sin x) = (u, v).
            let is_angle = matches!(solved.value, SolvedValue::Angle { .. });
            for (word, part) in solved.parts {
                let label = format!("{name}_{word}");
                self.g.label(part, || label.clone());
                reduction.parts.push(Part { label, coordinate: unknown, word, is_angle });
            }
            let position = match solved.value {
                SolvedValue::Angle { cos, sin } => {
                    self.g.label(cos, || format!("cos_{name}"));
                    self.g.label(sin, || format!("sin_{name}"));
                    self.g.angle(cos, sin)
                }
                SolvedValue::Length(x) => self.g.label(x, || name.clone()),
            };
            for root in &solved.roots {
                self.g.label(root.value, || format!("root_{name}"));
                reduction.dead_centres.push((unknown, root.value));
            }
            reduction.notes.push(format!("`{}`: {}", coordinate_name(model, unknown), solved.how));
            self.g.begin(before);
            definitions.push(self.implicit(unknown, position, &solved.balances, &solved.together, true));
        }
        Ok(definitions)
    }

    /// Rate and acceleration from equations with known slopes, which give some unknowns together; `on_bodies` is that of [`Self::implicit_rates`].
    fn implicit(
        &mut self,
        coordinate: Coordinate,
        position: Scalar,
        balances: &[Balance],
        together: &[Scalar],
        on_bodies: bool,
    ) -> Definition {
        let unknowns = self.rates_of(together);
        let name = names::of_freedom(self.scene.model, coordinate, "gap");
        let (mut rates, mut accelerations) = (Vec::new(), Vec::new());
        for &Balance { equation, inverse_slope } in balances {
            let (first, second) = self.implicit_rates(equation, &unknowns, on_bodies);
            self.g.under("Velocities of what follows.", |g| g.label(first, || format!("{name}_rate")));
            self.g.under("Accelerations of what follows.", |g| g.label(second, || format!("{name}_accel")));
            rates.push(-self.g.mul(inverse_slope, first));
            accelerations.push(-self.g.mul(inverse_slope, second));
        }
        let (rate, acceleration) = (self.g.sum(&rates), self.g.sum(&accelerations));
        Definition { coordinate, position, rate, acceleration }
    }

    /// Velocities and accelerations of coordinates, given by the symbols of their positions.
    fn rates_of(&self, positions: &[Scalar]) -> Vec<(Scalar, Scalar)> {
        let symbols = &self.scene.symbols;
        let joints = symbols.positions.iter().zip(&symbols.velocities).zip(&symbols.accelerations);
        let all = joints.flat_map(|((q, v), a)| q.iter().zip(v).zip(a));
        all.filter(|((q, _), _)| positions.contains(q)).map(|((_, &v), &a)| (v, a)).collect()
    }

    /// First derivative by time of an equation with the unknowns at rest, and second one with their accelerations zero. Closed forms read points of
    /// bodies, so they are differentiated `on_bodies`, by angular velocities of these.
    pub(in crate::mechanics) fn implicit_rates(
        &mut self,
        equation: Scalar,
        unknowns: &[(Scalar, Scalar)],
        on_bodies: bool,
    ) -> (Scalar, Scalar) {
        let along = |seeds: &[(Scalar, Scalar)]| match on_bodies {
            true => Differentiator::new(seeds).with_turns_of_bodies(),
            false => Differentiator::new(seeds),
        };
        let seeds = self.seeds(1);
        let rate = along(&seeds).scalar(&mut self.g, equation);
        let rest: Vec<(Scalar, Scalar)> = unknowns.iter().map(|u| (u.0, Scalar::ZERO)).collect();
        let rest = self.map(&rest);
        let first = self.g.substitute(&[rate], &rest)[0];
        let all = self.seeds(2);
        let second = along(&all).scalar(&mut self.g, rate);
        let rest: Vec<(Scalar, Scalar)> = unknowns.iter().map(|u| (u.1, Scalar::ZERO)).collect();
        let rest = self.map(&rest);
        let second = self.g.substitute(&[second], &rest)[0];
        (first, second)
    }

    /// The solution of a square system that is regular but in singular poses.
    pub(in crate::mechanics) fn eliminate(&mut self, size: usize, matrix: &[Scalar], side: &[Scalar]) -> Vec<Scalar> {
        let operands: Vec<Scalar> = matrix.iter().chain(side).copied().collect();
        self.g.block_outputs(BlockKind::Eliminate { size, strict: false }, &operands)
    }

    /// The same, no number in singular poses.
    pub(in crate::mechanics) fn eliminate_strictly(
        &mut self,
        size: usize,
        matrix: &[Scalar],
        side: &[Scalar],
    ) -> Vec<Scalar> {
        let operands: Vec<Scalar> = matrix.iter().chain(side).copied().collect();
        self.g.block_outputs(BlockKind::Eliminate { size, strict: true }, &operands)
    }

    /// A square system, solved by the structure of its matrix, and its rank.
    pub(in crate::mechanics) fn solve_structured(
        &mut self,
        matrix: &[Vec<Scalar>],
        side: &[Scalar],
    ) -> (Vec<Scalar>, Scalar) {
        let parameters: HashSet<SymbolId> =
            self.scene.symbols.params.iter().flatten().filter_map(|&p| self.g.symbol_id(p)).collect();
        solve_structured(&mut self.g, &|id| parameters.contains(&id), matrix, side)
    }

    /// Puts all definitions into results.
    pub(in crate::mechanics) fn finish(&mut self, reduction: &Reduction, roots: &[Scalar]) -> Vec<Scalar> {
        let roots = self.put_in_stand_ins(roots);
        if reduction.map.is_empty() { roots } else { self.g.substitute(&roots, &reduction.map) }
    }

    /// Efforts on the coordinates of the tree as efforts on velocity coordinates and on driven ones: the transposed velocity
    /// map, by reverse accumulation through the rates, so that what several dependents share is passed on once.
    pub(in crate::mechanics) fn project(&mut self, reduction: &Reduction, efforts: &[Scalar]) -> Vec<Scalar> {
        let mut projected = efforts.to_vec();
        projected.resize(self.scene.symbols.places(), Scalar::ZERO);
        if reduction.rates.is_empty() {
            return projected;
        }
        let (outputs, weights): (Vec<Scalar>, Vec<Scalar>) =
            reduction.rates.iter().map(|&(freedom, rate)| (rate, efforts[freedom])).unzip();
        let velocities = self.all_velocities();
        let dependent: Vec<usize> = reduction.rates.iter().map(|rate| rate.0).collect();
        let free: Vec<usize> = (0..velocities.len()).filter(|k| !dependent.contains(k)).collect();
        let inputs: Vec<Scalar> = free.iter().map(|&k| velocities[k]).collect();
        let weighted: Vec<(Scalar, Scalar)> = outputs.into_iter().zip(weights).collect();
        let back = self.g.transpose_linear(&weighted, &inputs);
        for (&freedom, effort) in free.iter().zip(back) {
            projected[freedom] = self.g.add(projected[freedom], effort);
        }
        projected
    }

    /// Coordinates of a role, as places among those of the tree.
    pub(in crate::mechanics) fn freedoms_of(&self, wanted: impl Fn(Role) -> bool) -> Vec<usize> {
        let mut list = Vec::new();
        for (k, velocities) in self.scene.symbols.velocities.iter().enumerate() {
            for index in 0..velocities.len() {
                let coordinate = Coordinate { joint: JointId(k), index };
                if wanted(self.scene.structure.role(coordinate)) {
                    list.push(self.freedom(coordinate));
                }
            }
        }
        list
    }
}
