//! Times functions of models. `cargo multibody compare --measure` writes this file as it is into a crate of its own, beside
//! one module for each choice of coordinates and constraints; one program times all of them in turn, so that what disturbs
//! the computer disturbs them alike.

use std::hint::black_box;
use std::rc::Rc;
use std::time::{Duration, Instant};

use multibody::projection::{SeparateWeights, assemble_by};
use multibody::{Configuration, Constrained, DisplacementOf, StateSpace, System, Tangent, VelocityOf};

/// States that functions are called at in turn: few, so that they stay in the nearest cache.
const STATES: usize = 16;
/// What is timed at once takes at least that long..
const BATCH: Duration = Duration::from_micros(200);
/// ..and the quickest of so many counts.
const ROUNDS: u32 = 300;
/// `[m]` or `[rad]` farthest from the start in each coordinate, the first that gives a state.
const DISTANCES: [f64; 4] = [0.1, 0.03, 0.01, 0.0];

/// A model with what its functions are called with.
pub struct Bench<S: System> {
    model: S,
    input: S::Input,
    samples: Vec<(f64, S::State)>,
}

/// A function that is timed.
pub struct Subject {
    label: String,
    /// Calls it at all states, so many times.
    run: Box<dyn Fn(u32)>,
}

impl<S: System<Scalar = f64> + 'static> Bench<S> {
    /// States near `start`, displaced by `centre`, whose loops `close` closes. `None` where accelerations are not finite.
    pub fn new(
        model: S,
        input: S::Input,
        start: S::State,
        centre: &[f64],
        close: impl Fn(&S, &S::Input, f64, &S::State) -> Option<S::State>,
    ) -> Option<Rc<Bench<S>>> {
        let (q, _, x) = start.split();
        let mut components = centre.iter();
        let q = q.displace(&DisplacementOf::<S>::zero().map(&mut |_| components.next().copied().unwrap_or(0.0)));
        let mut random = Random(1);
        let mut samples = Vec::new();
        for number in 0..STATES {
            let t = 0.01 * number as f64;
            let mut tries = DISTANCES.iter().map(|&size| start.join(q.displace(&random.vector(size)), random.vector(1.0), x));
            let closed = tries.find_map(|state| {
                close(&model, &input, t, &state).filter(|state| is_finite(&model, t, state, &input))
            });
            // Loops that don't close are open at the start itself: the instructions are the same.
            let state = closed.or_else(|| Some(start.join(q, random.vector(1.0), x)))?;
            if !is_finite(&model, t, &state, &input) {
                return None;
            }
            samples.push((t, state));
        }
        Some(Rc::new(Bench { model, input, samples }))
    }

    /// The function, which the compiler cannot follow to where it is called: it is inlined nowhere, and nothing of a call is
    /// known before it.
    pub fn subject<R: 'static>(
        self: &Rc<Self>,
        label: &str,
        function: fn(&S, f64, &S::State, &S::Input) -> R,
    ) -> Subject {
        let bench = Rc::clone(self);
        let run = move |passes| {
            for _ in 0..passes {
                let (function, bench) = (black_box(function), black_box(&*bench));
                for (t, state) in &bench.samples {
                    black_box(function(&bench.model, *t, state, &bench.input));
                }
            }
        };
        Subject { label: label.to_owned(), run: Box::new(run) }
    }
}

/// Guesses renewed, loops that are solved closed by them.
pub fn accepted<S: System<Scalar = f64>>(model: &S, input: &S::Input, t: f64, state: &S::State) -> Option<S::State> {
    let state = model.accepted(t, state, input);
    (!model.opening(t, &state, input).is_open()).then_some(state)
}

/// Loops that are kept by multipliers closed, and velocities that keep them so.
pub fn assembled<S: Constrained<Scalar = f64>>(
    model: &S,
    input: &S::Input,
    t: f64,
    state: &S::State,
) -> Option<S::State> {
    let all = SeparateWeights {
        position: DisplacementOf::<S>::zero().map(&mut |_| 1.0),
        velocity: VelocityOf::<S>::zero().map(&mut |_| 1.0),
    };
    let assembled = assemble_by(model, t, state, &all).ok()?;
    Some(model.accepted(t, &assembled.state, input))
}

fn is_finite<S: System<Scalar = f64>>(model: &S, t: f64, state: &S::State, input: &S::Input) -> bool {
    let (v, x) = model.derivative(t, state, input);
    let all = v.fold(true, &mut |all, component| all && component.is_finite());
    x.fold(all, &mut |all, component| all && component.is_finite())
}

/// Prints a line for each function: its label and nanoseconds by call.
pub fn measure(subjects: &[Subject]) {
    let time = |subject: &Subject, passes: u32| {
        let begin = Instant::now();
        (subject.run)(passes);
        begin.elapsed()
    };
    let passes: Vec<u32> = subjects
        .iter()
        .map(|subject| {
            let mut passes = 1;
            while time(subject, passes) < BATCH && passes < 1 << 24 {
                passes *= 2;
            }
            passes
        })
        .collect();
    let mut least = vec![f64::INFINITY; subjects.len()];
    for _ in 0..ROUNDS {
        for ((subject, &passes), least) in subjects.iter().zip(&passes).zip(&mut least) {
            let calls = f64::from(passes) * STATES as f64;
            *least = least.min(time(subject, passes).as_secs_f64() * 1e9 / calls);
        }
    }
    for (subject, least) in subjects.iter().zip(&least) {
        println!("{}\t{least}", subject.label);
    }
}

/// Numbers between -1 and 1, the same in every run.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    fn vector<V: Tangent<f64>>(&mut self, size: f64) -> V {
        V::zero().map(&mut |_| size * self.next())
    }
}
