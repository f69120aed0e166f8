//! Sweeps: one method on one subject over many steps or tolerances, each run checked.

use std::io::Write;
use std::rc::Rc;
use std::time::Duration;

use multibody::{IntegrationError, Integrator, Method, Statistics, System};

use crate::reference::Truth;
use crate::subject::{Solver, Subject};

/// A run with a greater error is no solution, whatever the problem's growth of errors.
const SOLUTION: f64 = 0.1;

/// How much is run.
#[derive(Clone, Copy)]
pub(crate) struct Effort {
    /// Factor between one step or tolerance and the next.
    pub(crate) step_factor: f64,
    pub(crate) tolerance_factor: f64,
    /// Greatest number of evaluations of one run.
    pub(crate) budget: f64,
    /// How often all runs are timed; the least time counts.
    pub(crate) passes: u32,
    /// A timing takes at least that long..
    pub(crate) timing: Duration,
    /// ..in batches of at least that; the quickest counts.
    pub(crate) batch: Duration,
}

impl Effort {
    pub(crate) const FULL: Self = Self {
        step_factor: std::f64::consts::SQRT_2,
        tolerance_factor: 3.162_277_660_168_379_5,
        budget: 150_000.0,
        passes: 5,
        timing: Duration::from_millis(1),
        batch: Duration::from_micros(100),
    };
    pub(crate) const QUICK: Self = Self {
        step_factor: 4.0,
        tolerance_factor: 10.0,
        budget: 5_000.0,
        passes: 1,
        timing: Duration::from_micros(100),
        batch: Duration::from_micros(20),
    };
}

/// A mechanism in motion, with the truth about its end.
pub(crate) struct Scene {
    pub(crate) name: &'static str,
    pub(crate) title: &'static str,
    pub(crate) kind: Kind,
    /// `[s]` the longest step of a sweep
    pub(crate) coarse: f64,
    /// Whether the energy is kept.
    pub(crate) conservative: bool,
}

/// Kinds of scenes for which methods are recommended.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) enum Kind {
    Separable,
    Open,
    Chaotic,
    Rotation,
    Loops,
    Stiff,
}

/// Who chose the steps.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Steps {
    Fixed,
    Adaptive,
}

/// One curve: a method with all that is held over its sweep.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Series {
    pub(crate) method: &'static str,
    pub(crate) steps: Steps,
    /// How loops are kept closed.
    pub(crate) handling: &'static str,
    pub(crate) scalar: &'static str,
    pub(crate) order: u32,
}

/// One point of a curve.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Point {
    pub(crate) series: Series,
    /// `[s]` step, or tolerance, or accuracy
    pub(crate) setting: f64,
    pub(crate) statistics: Statistics,
    /// Evaluations, with those of derivatives at what they cost.
    pub(crate) evaluations: f64,
    /// As [`Truth::error`] says.
    pub(crate) error: f64,
    /// The same divided by the growth of errors.
    pub(crate) own: f64,
    /// `[m]` the greatest gap of a loop over the whole motion
    pub(crate) gap: f64,
    /// Change of energy over the motion, relative: the greatest where energy is kept, else the last against the truth.
    pub(crate) drift: f64,
    /// Time per simulated second.
    pub(crate) seconds: f64,
    /// What can be relied on: the greatest of `own` with this or any finer setting.
    pub(crate) bound: f64,
}

/// All runs of a scene.
pub(crate) struct Bench {
    pub(crate) scene: Scene,
    pub(crate) truth: Truth,
    pub(crate) effort: Effort,
    /// Growth of errors, at least one.
    pub(crate) growth: f64,
    /// `[J]` at the true end, where energy is not kept, and what energies are relative to
    energy: (f64, f64),
    /// What an evaluation of derivatives costs, in evaluations.
    pub(crate) jacobian: f64,
    pub(crate) points: Vec<Point>,
    /// Runs that did not reach the end.
    pub(crate) failures: Vec<(Series, f64, IntegrationError)>,
    /// What gave each point.
    pub(crate) solvers: Vec<Rc<Solver>>,
}

impl Bench {
    pub(crate) fn new(scene: Scene, truth: Truth, effort: Effort, growth: f64, energy: (f64, f64)) -> Self {
        // What explicit methods take there is a part of the picture.
        let share = if scene.kind == Kind::Stiff { 8.0 } else { 1.0 };
        let effort = Effort { budget: share * effort.budget, ..effort };
        Self {
            scene,
            truth,
            effort,
            growth,
            energy,
            jacobian: 1.0,
            points: Vec::new(),
            failures: Vec::new(),
            solvers: Vec::new(),
        }
    }

    /// `[s]` lengths of steps, from long to short ones.
    pub(crate) fn steps(&self) -> impl Iterator<Item = f64> + 'static {
        let (first, factor, end) = (self.scene.coarse, self.effort.step_factor, self.truth.end);
        (0..).map(move |k| end / (end / first * factor.powi(k)).round())
    }

    /// Accuracies to ask for.
    pub(crate) fn accuracies(&self) -> impl Iterator<Item = f64> + 'static {
        let factor = self.effort.tolerance_factor;
        (0..).map(move |k| 1e-1 / factor.powi(k)).take_while(|accuracy| *accuracy > 1e-15)
    }

    /// Steps of one length, from long to short ones.
    pub(crate) fn fixed<S, M>(&mut self, series: Series, subject: &Rc<Subject<S>>, method: M)
    where
        S: System<Input = ()> + 'static,
        M: Method<S> + 'static,
    {
        let solver = self.integrating(subject, method, Integrator::fixed);
        let mut steps = self.steps();
        self.runs(Series { steps: Steps::Fixed, order: M::ORDER, ..series }, &mut steps, solver);
    }

    /// Steps by tolerance, from loose to tight ones.
    pub(crate) fn adaptive<S, M>(&mut self, series: Series, subject: &Rc<Subject<S>>, method: M)
    where
        S: System<Input = ()> + 'static,
        M: Method<S> + 'static,
    {
        let solver = self.integrating(subject, method, |method, within| Integrator::adaptive(method, within, within));
        let factor = self.effort.tolerance_factor;
        let mut settings = (0..).map(move |k| 1e-1 / factor.powi(k)).take_while(|tolerance| *tolerance > 2e-16);
        self.runs(Series { steps: Steps::Adaptive, order: M::ORDER, ..series }, &mut settings, solver);
    }

    fn integrating<S, M>(&self, subject: &Rc<Subject<S>>, method: M, integrator: fn(M, f64) -> Integrator<M>) -> Solver
    where
        S: System<Input = ()> + 'static,
        M: Method<S> + 'static,
    {
        let (end, most) = (self.truth.end, (2.0 * self.effort.budget) as u32);
        Subject::solver(subject, move |subject, setting, observe| {
            let integrator = integrator(method, setting).max_steps(most);
            integrator.integrate(&subject.system, 0.0, end, &subject.start, &(), observe)
        })
    }

    /// Runs of any kind: until a budget is spent, or errors no longer fall.
    pub(crate) fn runs(&mut self, series: Series, settings: &mut dyn Iterator<Item = f64>, solver: Solver) {
        let solver = Rc::new(solver);
        let (mut best, mut stale, mut wild) = (f64::INFINITY, 0, 0);
        for setting in settings {
            let outcome = match (solver.observed)(setting) {
                Ok(outcome) => outcome,
                Err(error) => {
                    self.failures.push((series, setting, error));
                    wild += 1;
                    if wild > 12 || matches!(error, IntegrationError::TooManySteps { .. }) {
                        break;
                    }
                    continue;
                }
            };
            let (error, statistics) = (self.truth.error(&outcome.motion), outcome.statistics);
            let evaluations = f64::from(statistics.evaluations) + self.jacobian * f64::from(statistics.jacobians);
            let (at_end, scale) = self.energy;
            let drift =
                if self.scene.conservative { outcome.worst.energy } else { (outcome.last.energy - at_end).abs() };
            let bound = if error <= SOLUTION { error / self.growth } else { f64::INFINITY };
            self.points.push(Point {
                series,
                setting,
                statistics,
                evaluations,
                error,
                own: error / self.growth,
                gap: outcome.worst.gap,
                drift: drift / scale,
                seconds: f64::INFINITY,
                bound,
            });
            self.solvers.push(Rc::clone(&solver));
            // Coarser runs that were better by luck.
            for earlier in self.points.iter_mut().rev().skip(1).take_while(|earlier| earlier.series == series) {
                earlier.bound = greater(earlier.bound, bound);
            }
            stale = if error > 0.6 * best { stale + 1 } else { 0 };
            best = error.min(best);
            // Errors that no longer fall have met rounding; two that fell by luck, and early, have not.
            let [floor, luck] = if series.scalar == "f32" { [1e-5, 1e-4] } else { [1e-13, 1e-10] };
            let settled = (stale >= 2 && best / self.growth < floor) || (stale >= 4 && best / self.growth < luck);
            if evaluations > self.effort.budget || settled {
                break;
            }
        }
        self.progress(series.method);
    }

    /// What is being done, on one line of the terminal.
    pub(crate) fn progress(&self, what: &str) {
        print!("\r  {}: {} runs, {what:<20}", self.scene.name, self.points.len());
        let _ = std::io::stdout().flush();
    }
}

/// The greater of two, NaN if one is.
pub(crate) fn greater(a: f64, b: f64) -> f64 {
    if b <= a { a } else { b }
}
