//! Stage `mechanics`: loads of all joints as numbers, at closed poses.
//!
//! In: a model with its structure, how its loops are written. Out: a [`Sample`] at a pose: velocities that the mechanism allows, the motion
//! that follows from all loads, multipliers of the equations that were kept, and what self-stress adds to each. Equations of motion of
//! all coordinates, e(q, v, a, lambda) = 0 where no drive holds, and the second derivatives of all equations of loops are one linear
//! system for a and lambda. Self-stress s is what multipliers of all equations, those left out included, may have beside them: the columns of e by
//! lambda, G^T, take it to nothing (Pellegrino and Calladine 1986). Inputs, states and parameters that have no say in loops are
//! random, so that nothing rests on a mass or a load that is zero by default.

use std::collections::HashSet;
use std::ops::Range;
use std::rc::Rc;

use crate::contracts::symbol::Symbol;
use crate::invariant::fault::raise;
use crate::mechanics::equations::Equations;
use crate::mechanics::loops::constraints::{Writing, closings, rate_rows, row_count};
use crate::mechanics::loops::reduction::Reduction;
use crate::mechanics::loops::structure::{Role, Row, Structure};
use crate::mechanics::scene::{Choices, Scene};
use crate::mechanics::translate::build::FixedFrame;
use crate::mechanics::translate::dependencies::Dependencies;
use crate::mechanics::translate::forces::LoadCase;
use crate::mechanics::translate::symbols::Symbols;
use crate::mechanics::translate::values::Value;
use crate::model::types::{JointId, Model, Output};
use crate::symbolic::evaluate::solve_f64;
use crate::symbolic::graph::{Graph, Scalar};
use crate::symbolic::lower::Lowering;

use super::dense::{ROUNDING, least, unit};
use super::problem::{Point, Problem, Random};
use super::rank::{self, Basis};
use super::rates::LATE;
use super::singular::dot;
use super::tape::{Tape, Values};

/// What is looked at, as programs for numbers.
#[derive(Clone)]
pub(super) struct Statics {
    tape: Tape,
    /// The same with flat functions of time replaced too: velocities and accelerations that drives and constraints prescribe are taken from it, since
    /// any course will do and the declared one may stand still for long.
    courses: Tape,
    rows: Vec<Row>,
    /// Places of rows that were not left out.
    kept: Vec<usize>,
    velocities: Vec<usize>,
    /// Symbols of accelerations that no drive gives.
    accelerations: Vec<usize>,
    multipliers: Vec<usize>,
    positions: Vec<usize>,
    /// Symbols that don't stand at their defaults.
    moved: Vec<usize>,
    /// Of these and the time, what keeps its sign: parameters may be masses.
    signed: HashSet<usize>,
    /// Time, where loops and drives don't know of it.
    free_time: Option<usize>,
    /// (symbol, root), of positions, velocities and accelerations.
    driven: Vec<(usize, usize)>,
    /// Roots: efforts where no drive holds, rates of rows and second derivatives.
    efforts: Range<usize>,
    rates: Range<usize>,
    second: Range<usize>,
    /// By joint, force and then moment in world axes.
    wrenches: Range<usize>,
    outputs: Vec<Range<usize>>,
    values: Values,
}

/// What one pose shows.
pub(super) struct Sample {
    /// Values of all symbols.
    at: Vec<f64>,
    /// The same where nothing is closed, and nothing in line.
    anywhere: Vec<f64>,
    /// Of the equations that were kept; more than one solution where they depend on each other here.
    pub multipliers: Vec<Vec<f64>>,
    /// Self-stress by row, each with wrenches about as great as those of the loads.
    pub stress: Vec<Vec<f64>>,
}

/// Slopes of a scalar by multipliers, and bounds of what each is made of where a sample is and where nothing is closed.
pub(super) struct Slopes {
    slopes: Vec<f64>,
    here: Vec<f64>,
    anywhere: Vec<f64>,
}

/// What is made large in a sample: loads that are small beside others while inputs and parameters are about one may outweigh them elsewhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Emphasis {
    None,
    /// One in so many inputs, states, parameters and the time, from this number on. Inputs and states get the factor's sign.
    Share {
        first: usize,
        of: usize,
        factor: f64,
    },
    Velocities,
    /// Nothing moves that no drive moves: at a pose where motions cross, not all velocities that its equations allow can be.
    Rest,
}

/// Factor of velocities, with whose squares most loads grow.
const FAST: f64 = 1e3;

/// Force and moment by joint.
pub(super) type Wrenches = Vec<[[f64; 3]; 2]>;

/// Rows of slopes, and values where what they are slopes by is zero.
type Linear = (Vec<Vec<f64>>, Vec<f64>);

/// Roots of one tape.
#[derive(Default)]
struct Roots(Vec<Scalar>);

impl Roots {
    fn extend(&mut self, values: impl IntoIterator<Item = Scalar>) -> Range<usize> {
        let first = self.0.len();
        self.0.extend(values);
        first..self.0.len()
    }
}

impl Statics {
    /// As they are, and with loads and outputs that are made of pieces as some of each piece.
    pub(super) fn both(model: &Model, structure: &Structure, writing: Writing, outputs: &[&Output]) -> [Statics; 2] {
        let mut rows: Vec<Row> = closings(model)
            .into_iter()
            .flat_map(|closing| (0..row_count(model, closing)).map(move |index| Row { closing, index }))
            .collect();
        rows.extend(rate_rows(model));
        let mut e = held(model, rows.clone(), writing, outputs);
        let mut roots = Roots::default();
        let symbols = Rc::clone(&e.scene.symbols);
        let number = |e: &Equations<'_>, s: Scalar| e.g.symbol_id(s).map(|id| id.0);
        let is_driven =
            |place: usize| symbols.coordinate_at(place).is_some_and(|c| matches!(structure.role(c), Role::Driven(_)));
        let free: Vec<usize> = (0..symbols.freedoms).filter(|&place| !is_driven(place)).collect();
        let in_places = |e: &Equations<'_>, lists: &[Vec<Scalar>]| {
            let all = lists.concat();
            free.iter().filter_map(|&place| number(e, *all.get(place)?)).collect::<Vec<usize>>()
        };
        let efforts = e.inverse_dynamics(LoadCase::Held);
        let efforts = roots.extend(free.iter().map(|&place| efforts[place]));
        let pairs: Vec<(Scalar, Scalar)> = rows.iter().map(|&row| e.row_rates(row)).collect();
        let rates = roots.extend(pairs.iter().map(|pair| pair.0));
        let second = roots.extend(pairs.iter().map(|pair| pair.1));
        let mut reduction = Reduction::default();
        e.drive(&mut reduction);
        let mut followed: Vec<(usize, Scalar)> = reduction.map.iter().map(|(id, &value)| (id.0, value)).collect();
        followed.sort_unstable_by_key(|one| one.0);
        let courses = roots.extend(followed.iter().map(|one| one.1));
        let driven: Vec<(usize, usize)> = followed.iter().map(|one| one.0).zip(courses).collect();
        let joints: Vec<Scalar> =
            (0..model.joints.len()).flat_map(|joint| e.transmitted_in_world(JointId(joint))).collect();
        let wrenches = roots.extend(joints);
        let read: Vec<Range<usize>> = outputs
            .iter()
            .map(|output| {
                let value = e.value(&output.value);
                let mut list = Vec::new();
                value.flatten(&mut e.g, &mut list);
                roots.extend(list)
            })
            .collect();
        let mut lowering = Lowering::new(&e.g);
        let lowered = lowering.run(&roots.0);
        let exact = rates.clone().chain(second.clone()).chain(courses_of(&driven)).collect::<Vec<usize>>();
        let tape = Tape::new(&lowering.to, &lowered);
        let blended = tape.clone().blended(exact.into_iter());
        let courses = tape.clone().blended(std::iter::empty());
        let closing: HashSet<usize> = rates.clone().chain(second.clone()).flat_map(|root| tape.symbols(root)).collect();
        let of_drives: HashSet<usize> = courses_of(&driven).flat_map(|root| tape.symbols(root)).collect();
        let is_moved = |&k: &usize| match symbols.table[k] {
            Symbol::Input { .. } | Symbol::State { .. } => true,
            Symbol::Param { .. } => !closing.contains(&k) && !of_drives.contains(&k),
            _ => false,
        };
        let is_position = |&k: &usize| matches!(symbols.table[k], Symbol::Position { .. });
        let free_time = number(&e, symbols.time).filter(|time| !closing.contains(time) && !of_drives.contains(time));
        let moved: Vec<usize> = (0..symbols.table.len()).filter(is_moved).collect();
        let is_parameter = |&k: &usize| matches!(symbols.table[k], Symbol::Param { .. });
        let signed = moved.iter().copied().filter(is_parameter).chain(free_time).collect();
        let kept = (0..rows.len()).filter(|&k| !structure.dropped.contains(&rows[k])).collect();
        let plain = Statics {
            kept,
            velocities: in_places(&e, &symbols.velocities),
            accelerations: in_places(&e, &symbols.accelerations),
            multipliers: symbols.multipliers.iter().filter_map(|&s| number(&e, s)).collect(),
            moved,
            signed,
            positions: (0..symbols.table.len()).filter(is_position).collect(),
            free_time,
            courses: tape.clone(),
            tape,
            rows,
            driven,
            efforts,
            rates,
            second,
            wrenches,
            outputs: read,
            values: Values::default(),
        };
        let blended = Statics { tape: blended, courses, ..plain.clone() };
        [plain, blended]
    }

    pub(super) fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// How many inputs, states and parameters are not at their defaults, and the time if it is free.
    pub(super) fn moved(&self) -> usize {
        self.moved.len() + usize::from(self.free_time.is_some())
    }

    /// Whether any of these is an input or a state.
    pub(super) fn has_inputs(&self) -> bool {
        self.moved.iter().any(|symbol| !self.signed.contains(symbol))
    }

    /// At a closed pose; nothing where the mechanism allows no velocities there, or something has no number.
    pub(super) fn sample(
        &mut self,
        problem: &Problem,
        point: &Point,
        emphasis: Emphasis,
        random: &mut Random,
    ) -> Option<Sample> {
        let mut at = point.0.clone();
        let count = self.multipliers.iter().max().map_or(0, |most| most + 1).max(at.len());
        at.resize(count, 0.0);
        for &symbol in &self.moved {
            let (factor, more) = (1.0 + 0.3 * random.next(), 0.3 * random.next());
            // What has a value by default keeps its sign and its size.
            at[symbol] = if at[symbol] == 0.0 { more } else { at[symbol] * factor };
        }
        if let Some(time) = self.free_time {
            at[time] = LATE * random.next().abs();
        }
        if let Emphasis::Share { first, of, factor } = emphasis {
            let all = self.moved.iter().copied().chain(self.free_time);
            all.skip(first).step_by(of).for_each(|symbol| {
                let free = factor * (0.1 + 0.3 * random.next().abs());
                at[symbol] = if self.signed.contains(&symbol) { at[symbol] * factor.abs() } else { free };
            });
        }
        let is_place = |symbol: usize| self.positions.contains(&symbol);
        for (tape, of_places) in [(&self.tape, true), (&self.courses, false)] {
            tape.run_for(&mut self.values, &at, self.driven.iter().map(|one| one.1));
            for &(symbol, root) in self.driven.iter().filter(|one| is_place(one.0) == of_places) {
                at[symbol] = tape.value(&self.values, root);
            }
        }
        self.velocities.iter().for_each(|&symbol| at[symbol] = random.next());
        match emphasis {
            Emphasis::Rest => {
                self.velocities.iter().for_each(|&symbol| at[symbol] = 0.0);
                self.move_along(&mut at)?;
            }
            Emphasis::Velocities => {
                self.move_along(&mut at)?;
                self.velocities.iter().for_each(|&symbol| at[symbol] *= FAST);
                self.move_along(&mut at)?;
            }
            _ => self.move_along(&mut at)?,
        }
        let columns: Vec<usize> = self.accelerations.iter().chain(&self.multipliers).copied().collect();
        let forces = self.linear(&at, self.efforts.clone(), &columns);
        let mut closings = self.linear(&at, self.second.clone(), &columns);
        closings.1 = self.rest(&at, self.second.clone(), &columns);
        let freedoms = self.accelerations.len();
        let stress = stresses(&forces.0, freedoms, self.rows.len());
        let held: Vec<Vec<f64>> = unit(self.kept.iter().map(|&k| closings.0[k][..freedoms].to_vec()));
        let mut multipliers = Vec::new();
        for rows in self.ways(&held) {
            let (accelerations, all) = self.solution(&forces, &closings, &rows);
            if multipliers.is_empty() {
                self.accelerations.iter().zip(accelerations).for_each(|(&symbol, x)| at[symbol] = x);
            }
            multipliers.push(all);
        }
        let mut anywhere = at.clone();
        let loose = problem.start(random, 1.0).0;
        self.positions.iter().for_each(|&symbol| anywhere[symbol] = loose[symbol]);
        let mut sample = Sample { at, anywhere, multipliers, stress: Vec::new() };
        let zero = vec![0.0; self.rows.len()];
        let still = self.wrenches(&sample, &zero);
        let size = greatest(&self.wrenches(&sample, &sample.multipliers[0].clone()));
        if !size.is_finite() {
            return None;
        }
        let size = if size > 0.0 { size } else { 1.0 };
        sample.stress = stress
            .into_iter()
            .map(|mut stress| {
                let response = greatest(&difference(&self.wrenches(&sample, &stress), &still));
                let factor = if response > ROUNDING { size / response } else { 1.0 };
                stress.iter_mut().for_each(|x| *x *= factor);
                stress
            })
            .collect();
        Some(sample)
    }

    /// Which of the kept rows hold the mechanism: all of them, as the runtime's pivots choose; where they depend on each other, the last ones that
    /// don't as well.
    fn ways(&self, held: &[Vec<f64>]) -> Vec<Vec<usize>> {
        let mut basis = Basis::default();
        let mut last: Vec<usize> =
            (0..held.len()).filter(|&k| basis.grow(&held[held.len() - 1 - k], rank::DEPENDENT)).collect();
        last.iter_mut().for_each(|k| *k = self.kept[held.len() - 1 - *k]);
        if last.len() == held.len() { vec![self.kept.clone()] } else { vec![self.kept.clone(), last] }
    }

    /// Accelerations, and multipliers of all rows, if some of them hold the mechanism.
    fn solution(&self, forces: &Linear, closings: &Linear, rows: &[usize]) -> (Vec<f64>, Vec<f64>) {
        let freedoms = self.accelerations.len();
        let own = |row: &[f64]| -> Vec<f64> {
            row[..freedoms].iter().copied().chain(rows.iter().map(|&k| row[freedoms + k])).collect()
        };
        let all = forces.0.iter().chain(rows.iter().map(|&k| &closings.0[k]));
        let matrix: Vec<f64> = all.flat_map(|row| own(row)).collect();
        let right: Vec<f64> = forces.1.iter().chain(rows.iter().map(|&k| &closings.1[k])).map(|x| -x).collect();
        let solution = solve_f64(&matrix, &right);
        let mut multipliers = vec![0.0; self.rows.len()];
        rows.iter().zip(&solution[freedoms..]).for_each(|(&k, &x)| multipliers[k] = x);
        (solution[..freedoms].to_vec(), multipliers)
    }

    /// Velocities become the nearest ones that the equations allow.
    fn move_along(&mut self, at: &mut [f64]) -> Option<()> {
        let (rows, _) = self.linear_at(at, self.rates.clone(), &self.velocities.clone());
        let rest = self.rest(at, self.rates.clone(), &[]);
        let step = least(&rows, &rest);
        for (&symbol, step) in self.velocities.iter().zip(step) {
            at[symbol] -= step;
        }
        let left = self.rest(at, self.rates.clone(), &[]).into_iter().map(f64::abs).fold(0.0, f64::max);
        (left < 1e-6).then_some(())
    }

    /// Roots with some symbols at zero, and with any courses of time: what is left of them where nothing moves.
    fn rest(&mut self, at: &[f64], roots: Range<usize>, zero: &[usize]) -> Vec<f64> {
        let (mut moving, mut still) = (at.to_vec(), at.to_vec());
        zero.iter().for_each(|&symbol| moving[symbol] = 0.0);
        let driven = self.driven.iter().map(|one| one.0).filter(|symbol| !self.positions.contains(symbol));
        zero.iter().chain(&self.velocities).copied().chain(driven).for_each(|symbol| still[symbol] = 0.0);
        let mut of = |tape: &Tape, at: &[f64]| -> Vec<f64> {
            tape.run_for(&mut self.values, at, roots.clone());
            roots.clone().map(|root| tape.value(&self.values, root)).collect()
        };
        let (mut rest, course, own) = (of(&self.tape, &moving), of(&self.courses, &still), of(&self.tape, &still));
        rest.iter_mut().zip(course.iter().zip(own)).for_each(|(x, (course, own))| *x += course - own);
        rest
    }

    /// Roots with accelerations and multipliers at zero, and their slopes.
    fn linear(&mut self, at: &[f64], roots: Range<usize>, columns: &[usize]) -> Linear {
        let mut still = at.to_vec();
        columns.iter().for_each(|&symbol| still[symbol] = 0.0);
        self.linear_at(&still, roots, columns)
    }

    fn linear_at(&mut self, at: &[f64], roots: Range<usize>, columns: &[usize]) -> Linear {
        self.tape.run_for(&mut self.values, at, roots.clone());
        let mut place = vec![usize::MAX; at.len()];
        columns.iter().enumerate().for_each(|(k, &symbol)| place[symbol] = k);
        let (mut rows, mut rest) = (Vec::new(), Vec::new());
        for root in roots {
            rest.push(self.tape.value(&self.values, root));
            let mut row = vec![0.0; columns.len()];
            self.tape.gradient(&mut self.values, root, |symbol, slope| {
                if let Some(entry) = place.get(symbol).and_then(|&k| row.get_mut(k)) {
                    *entry += slope;
                }
            });
            rows.push(row);
        }
        (rows, rest)
    }

    fn run(&mut self, sample: &Sample, multipliers: &[f64], roots: Range<usize>) -> Vec<f64> {
        let mut at = sample.at.clone();
        self.multipliers.iter().zip(multipliers).for_each(|(&symbol, &x)| at[symbol] = x);
        self.tape.run_for(&mut self.values, &at, roots.clone());
        roots.map(|root| self.tape.value(&self.values, root)).collect()
    }

    /// What joints transmit under some multipliers, at their child frames in world axes.
    pub(super) fn wrenches(&mut self, sample: &Sample, multipliers: &[f64]) -> Wrenches {
        let list = self.run(sample, multipliers, self.wrenches.clone());
        list.chunks(6).map(|w| [[w[0], w[1], w[2]], [w[3], w[4], w[5]]]).collect()
    }

    /// The same as what it is made of, with nothing cancelled.
    pub(super) fn wrench_bounds(&mut self, sample: &Sample, multipliers: &[f64]) -> Wrenches {
        self.run(sample, multipliers, self.wrenches.clone());
        let bounds: Vec<f64> = self.wrenches.clone().map(|root| self.tape.size_bound(&self.values, root)).collect();
        bounds.chunks(6).map(|w| [[w[0], w[1], w[2]], [w[3], w[4], w[5]]]).collect()
    }

    /// How an output's scalars change with multipliers.
    pub(super) fn slopes(&mut self, sample: &Sample, multipliers: &[f64], output: usize) -> Vec<Slopes> {
        let roots = self.outputs[output].clone();
        let mut rows = vec![usize::MAX; sample.at.len()];
        self.multipliers.iter().enumerate().for_each(|(row, &symbol)| rows[symbol] = row);
        let count = multipliers.len();
        let [here, anywhere] = [&sample.at, &sample.anywhere].map(|at| {
            let mut at = at.clone();
            self.multipliers.iter().zip(multipliers).for_each(|(&symbol, &x)| at[symbol] = x);
            self.tape.run_for(&mut self.values, &at, roots.clone());
            roots
                .clone()
                .map(|root| {
                    let (mut slopes, mut bounds) = (vec![0.0; count], vec![0.0; count]);
                    self.tape.slope_bounds(&self.values, root, |symbol, bound| {
                        if let Some(slot) = rows.get(symbol).and_then(|&row| bounds.get_mut(row)) {
                            *slot += bound;
                        }
                    });
                    self.tape.gradient(&mut self.values, root, |symbol, slope| {
                        if let Some(slot) = rows.get(symbol).and_then(|&row| slopes.get_mut(row)) {
                            *slot += slope;
                        }
                    });
                    (slopes, bounds)
                })
                .collect::<Vec<_>>()
        });
        let both = here.into_iter().zip(anywhere);
        both.map(|((slopes, here), (_, anywhere))| Slopes { slopes, here, anywhere }).collect()
    }
}

impl Slopes {
    /// By so much the scalar changes as multipliers change by a step. What does not change has no part in it, whatever its slope.
    pub(super) fn change(&self, step: &[f64]) -> f64 {
        self.slopes.iter().zip(step).filter(|one| *one.1 != 0.0).map(|(slope, x)| slope * x).sum()
    }

    /// What such a change is made of, with nothing cancelled: where the sample is, and where nothing is closed.
    pub(super) fn bounds(&self, step: &[f64]) -> [f64; 2] {
        [&self.here, &self.anywhere].map(|bounds| {
            let bound: f64 = bounds.iter().zip(step).map(|(bound, x)| bound * x.abs()).sum();
            if bound.is_finite() { bound } else { 0.0 }
        })
    }
}

fn courses_of(driven: &[(usize, usize)]) -> impl Iterator<Item = usize> + '_ {
    driven.iter().map(|one| one.1)
}

/// A model whose loops are all held by multipliers, none left out, with accelerations as symbols.
fn held<'m>(model: &'m Model, rows: Vec<Row>, writing: Writing, outputs: &[&Output]) -> Equations<'m> {
    let mut graph = Graph::new();
    let structure = Structure { rows, ..Structure::open(model) };
    let symbols = Symbols::new(&mut graph, model).with_structure(&mut graph, model, &structure, 0);
    let kept = Dependencies::of(outputs.iter().map(|output| &output.value)).kept(model);
    let plain = Scene::new(model, Rc::new(symbols));
    let scene =
        Scene { structure: Rc::new(structure), way: Choices { writing, ..Choices::PLAIN }, kept: kept.into(), ..plain };
    Equations::new(graph, scene)
}

impl Equations<'_> {
    /// What a joint transmits, in world axes.
    fn transmitted_in_world(&mut self, joint: JointId) -> [Scalar; 6] {
        let Value::Pair(force, moment) = self.reaction(joint, &FixedFrame::GROUND) else {
            raise("a reaction is a force and a moment")
        };
        let [force, moment] = [force, moment].map(|v| self.g.components(v));
        [force[0], force[1], force[2], moment[0], moment[1], moment[2]]
    }
}

/// Multipliers that take the free coordinates nowhere: `forces` has a row for each of these.
fn stresses(forces: &[Vec<f64>], freedoms: usize, rows: usize) -> Vec<Vec<f64>> {
    let column = |k: usize| forces.iter().map(|row| row[freedoms + k]).collect::<Vec<f64>>();
    let columns: Vec<Vec<f64>> = (0..rows).map(column).collect();
    let lengths: Vec<f64> = columns.iter().map(|column| dot(column, column).sqrt()).collect();
    let combinations = rank::combinations(&unit(columns.into_iter()));
    let in_units = |combination: Vec<f64>| -> Vec<f64> {
        let longest = lengths.iter().fold(0.0_f64, |most, &x| most.max(x));
        let of_row = |(x, &length): (f64, &f64)| if length > ROUNDING * longest { x / length } else { x };
        combination.into_iter().zip(&lengths).map(of_row).collect()
    };
    combinations.into_iter().map(in_units).collect()
}

pub(super) fn difference(a: &Wrenches, b: &Wrenches) -> Wrenches {
    let minus =
        |(a, b): (&[[f64; 3]; 2], &[[f64; 3]; 2])| [0, 1].map(|part| [0, 1, 2].map(|k| a[part][k] - b[part][k]));
    a.iter().zip(b).map(minus).collect()
}

/// The greatest component of any.
pub(super) fn greatest(wrenches: &Wrenches) -> f64 {
    // A NaN is greater than all.
    let greater = |most: f64, &x: &f64| if x.is_nan() || x.abs() > most { x.abs() } else { most };
    wrenches.iter().flatten().flatten().fold(0.0, greater)
}
