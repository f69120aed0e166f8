//! How long it takes: inverse kinematics along the heave by four methods, and single functions.

use std::hint::black_box;
use std::time::Instant;

use multibody::FreeRollPitchYaw;
use multibody::nalgebra::{SMatrix, SVector};

use crate::models::{hybrid, iterated, level, reduced};
use crate::motion::{PERIOD, heave, level_plate};

/// Steps of one period.
const STEPS: usize = 2000;
/// [s]
const STEP: f64 = PERIOD / STEPS as f64;
/// Runs over a period, of which the fastest counts.
const RUNS: usize = 25;

/// First and second angle and stroke, leg after leg.
type Joints = SVector<f64, 18>;

/// Finds the joints' coordinates for a pose of the plate, step by step.
trait Method {
    /// Goes to the next pose and velocity of the plate.
    fn step(&mut self, plate: &FreeRollPitchYaw<f64>, rate: &FreeRollPitchYaw<f64>);
    fn joints(&self) -> Joints;
}

/// The emitted closed form, with its rates and accelerations.
#[derive(Default)]
struct Analytic {
    model: reduced::Model,
    joints: Joints,
    rates: Joints,
}

impl Method for Analytic {
    fn step(&mut self, plate: &FreeRollPitchYaw<f64>, rate: &FreeRollPitchYaw<f64>) {
        let state =
            reduced::State { q: reduced::Position { platform: *plate }, v: reduced::Velocity { platform: *rate } };
        let found = self.model.kinematics_2(0.0, &state, &reduced::Velocity::default());
        (self.joints, self.rates) = (found.position, found.velocity);
    }

    fn joints(&self) -> Joints {
        leg_by_leg(&self.joints)
    }
}

/// Angles of all legs first, then their strokes: in the order in which `find` names them.
fn leg_by_leg(found: &Joints) -> Joints {
    Joints::from_fn(|row, _| {
        let (leg, component) = (row / 3, row % 3);
        if component < 2 { found[2 * leg + component] } else { found[12 + leg] }
    })
}

/// Newton's method on all 18 equations, as a user of the emitted constraints would write it: nalgebra's LU, whose last
/// factors serve the rates too.
struct Dense {
    model: hybrid::Model,
    q: SVector<f64, 24>,
    rates: Joints,
    /// Ends the iteration, which starts from the last step's coordinates. Infinite: from an Euler step, corrected once.
    tolerance: f64,
    iterations: usize,
}

impl Dense {
    fn new(start: &Joints, rates: &Joints, tolerance: f64) -> Self {
        let mut q = SVector::<f64, 24>::zeros();
        q.fixed_rows_mut::<18>(6).copy_from(start);
        Self { model: hybrid::Model::default(), q, rates: *rates, tolerance, iterations: 0 }
    }
}

impl Method for Dense {
    fn step(&mut self, plate: &FreeRollPitchYaw<f64>, rate: &FreeRollPitchYaw<f64>) {
        let plate = SVector::<f64, 6>::from(reduced::Position { platform: *plate });
        let rate = SVector::<f64, 6>::from(reduced::Velocity { platform: *rate });
        self.q.fixed_rows_mut::<6>(0).copy_from(&plate);
        let mut legs = self.q.fixed_rows_mut::<18>(6);
        if self.tolerance.is_infinite() {
            legs += self.rates * STEP;
        }
        for _ in 0..20 {
            let q = hybrid::Position::from(self.q);
            let residual = self.model.constraints(0.0, &q);
            if self.tolerance.is_finite() && residual.amax() < self.tolerance {
                break;
            }
            let jacobian = self.model.constraint_jacobian(0.0, &q);
            let factors = jacobian.fixed_columns::<18>(6).into_owned().lu();
            let mut change = residual;
            let mut rates = jacobian.fixed_columns::<6>(0) * -rate;
            if !factors.solve_mut(&mut change) || !factors.solve_mut(&mut rates) {
                break;
            }
            legs = self.q.fixed_rows_mut::<18>(6);
            legs -= change;
            self.rates = rates;
            self.iterations += 1;
            if self.tolerance.is_infinite() {
                break;
            }
        }
    }

    fn joints(&self) -> Joints {
        self.q.fixed_rows::<18>(6).into_owned()
    }
}

/// Newton's method as the engine emits it: leg by leg, three equations each.
struct Blocks {
    model: iterated::Model,
    state: iterated::State,
}

impl Method for Blocks {
    fn step(&mut self, plate: &FreeRollPitchYaw<f64>, rate: &FreeRollPitchYaw<f64>) {
        self.state.q.platform = *plate;
        self.state.v.platform = *rate;
        self.state = self.model.close(0.0, &self.state).state;
    }

    fn joints(&self) -> Joints {
        self.state.guess.into()
    }
}

/// Poses and velocities of the plate, by Euler's method.
fn course() -> Vec<[FreeRollPitchYaw<f64>; 2]> {
    let mut position = heave(0.0)[0];
    let steps = (0..STEPS).map(|k| {
        let rate = heave(k as f64 * STEP)[1];
        position += rate * STEP;
        [position, rate].map(level_plate)
    });
    steps.collect()
}

/// Coordinates and rates of the joints by the closed form.
fn exact([plate, rate]: [FreeRollPitchYaw<f64>; 2]) -> [Joints; 2] {
    let state = reduced::State { q: reduced::Position { platform: plate }, v: reduced::Velocity { platform: rate } };
    let found = reduced::Model::<f64>::default().kinematics_2(0.0, &state, &reduced::Velocity::default());
    [found.position, found.velocity].map(|list| leg_by_leg(&list))
}

/// One row of the table: a method, its best time, its largest error.
struct Row<'a> {
    name: &'a str,
    published: &'a str,
    make: Box<dyn Fn() -> Box<dyn Method> + 'a>,
    /// [ns] a step
    time: f64,
    error: f64,
}

impl<'a> Row<'a> {
    fn new(name: &'a str, published: &'a str, make: impl Fn() -> Box<dyn Method> + 'a) -> Self {
        let mut method = make();
        let mut error = 0.0_f64;
        for step in course() {
            method.step(&step[0], &step[1]);
            error = error.max((method.joints() - exact(step)[0]).amax());
        }
        Self { name, published, make: Box::new(make), time: f64::INFINITY, error }
    }
}

pub(crate) fn kinematics() {
    println!(
        "Fixed-step Euler of the driven plate, {STEPS} steps of {:.3} ms; all joint coordinates in each:\n",
        STEP * 1e3
    );
    let [start, rates] = exact([heave(0.0)[0], heave(0.0)[1]].map(level_plate));
    let steps = course();
    let mut dense = Dense::new(&start, &rates, 1e-10);
    steps.iter().for_each(|[plate, rate]| dense.step(plate, rate));
    let iterations = dense.iterations as f64 / STEPS as f64;
    let dense = format!("Newton on 18 equations, dense LU, to 1e-10 ({iterations:.2} a step)");
    let mut rows = [
        Row::new("closed form, with rates and accelerations", "1", || Box::new(Analytic::default())),
        Row::new(&dense, "3.5", || Box::new(Dense::new(&start, &rates, 1e-10))),
        Row::new("one projection a step, dense LU", "2.5", || Box::new(Dense::new(&start, &rates, f64::INFINITY))),
        Row::new("Newton as the engine emits it, six blocks of three", "", || {
            let state = iterated::State { guess: start.into(), ..Default::default() };
            Box::new(Blocks { model: iterated::Model::default(), state })
        }),
    ];
    // Turn by turn, so that what else the machine does meets all of them.
    for _ in 0..RUNS {
        for row in &mut rows {
            let mut method = (row.make)();
            let begin = Instant::now();
            for [plate, rate] in &steps {
                method.step(black_box(plate), rate);
                black_box(&method);
            }
            row.time = row.time.min(begin.elapsed().as_secs_f64() * 1e9 / STEPS as f64);
        }
    }
    println!("  {:<62}{:>8}{:>7}{:>11}{:>11}", "", "ns", "ratio", "published", "error");
    let unit = rows[0].time;
    for Row { name, published, time, error, .. } in rows {
        println!("  {name:<62}{time:>8.0}{:>7.1}{published:>11}{error:>11.0e}", time / unit);
    }
}

pub(crate) fn functions() {
    // Angles of a whole turn, one after the other.
    let mut angle = 0.0_f64;
    let unit = time(|| {
        angle = if angle > 3.0 { angle - 6.0 } else { angle + 0.37 };
        black_box(angle).sin_cos()
    });
    println!("\nTimes of one evaluation in units of one `sin_cos` of f64, which takes {unit:.1} ns:\n");
    let plate = heave(0.3).map(level_plate);
    let [q, v, a] = plate;
    let free = Box::new((
        reduced::Model::<f64>::default(),
        reduced::State { q: reduced::Position { platform: q }, v: reduced::Velocity { platform: v } },
        reduced::Input::<f64>::default(),
        reduced::Velocity { platform: a },
    ));
    let [q, v, a] = heave(0.3);
    let driven = Box::new((
        level::Model::<f64>::default(),
        level::State { q: level::Position { platform: q }, v: level::Velocity { platform: v } },
        level::Input::<f64>::default(),
        level::Velocity { platform: a },
    ));
    let line = |name: &str, time: f64| println!("  {name:<62}{time:>8.0} ns{:>8.1}", time / unit);
    line("six strokes, their rates and accelerations", {
        time(|| {
            let (model, state, _, accel) = black_box(&*free);
            model.kinematics(0.0, state, accel)
        })
    });
    line("the same with the twelve angles", {
        time(|| {
            let (model, state, _, accel) = black_box(&*free);
            model.kinematics_2(0.0, state, accel)
        })
    });
    line("inverse dynamics, plate driven level", {
        time(|| {
            let (model, state, input, accel) = black_box(&*driven);
            model.inverse_dynamics(0.0, state, input, accel)
        })
    });
    line("inverse dynamics", {
        time(|| {
            let (model, state, input, accel) = black_box(&*free);
            model.inverse_dynamics(0.0, state, input, accel)
        })
    });
    line("forward dynamics", {
        time(|| {
            let (model, state, input, _) = black_box(&*free);
            model.forward_dynamics(0.0, state, input)
        })
    });
    let q = hybrid::Position { platform: level_plate(heave(0.3)[0]), ..Default::default() };
    let dense = Box::new((hybrid::Model::<f64>::default(), q));
    line("for comparison: LU of the 18 by 18 Jacobian, with its emission", {
        time(|| {
            let (model, q) = black_box(&*dense);
            let jacobian: SMatrix<f64, 18, 24> = model.constraint_jacobian(0.0, q);
            jacobian.fixed_columns::<18>(6).into_owned().lu()
        })
    });
}

/// [ns] a call, of the fastest batch.
fn time<R>(mut call: impl FnMut() -> R) -> f64 {
    const CALLS: u32 = 1000;
    const BATCHES: u32 = 200;
    let batches = (0..BATCHES).map(|_| {
        let start = Instant::now();
        for _ in 0..CALLS {
            black_box(call());
        }
        start.elapsed().as_secs_f64() * 1e9 / f64::from(CALLS)
    });
    batches.fold(f64::INFINITY, f64::min)
}
