//! Scenes: which mechanism, how long, by which methods.

use std::rc::Rc;

use multibody::{
    Canonical, Composition4, Composition6, Constrained, Differentiable, Dop853, DormandPrince, Euler, GaussLegendre4,
    GaussLegendre6, GeneralisedAlpha, ImplicitMidpoint, Impulsive, Integrator, Radau, Rk4, SecondOrder,
    SemiImplicitEuler, Separable, SymplecticGauss4, SymplecticGauss6, SymplecticMidpoint, System, Verlet,
    WithBaumgarte, simulate, simulate_stiff,
};

use crate::bench::{Bench, Effort, Kind, Scene, Series, Steps};
use crate::growth::{accurate, growth};
use crate::mechanisms::{
    andrews, andrews_loops, double_pendulum, four_bar, four_bar_loop, free_body, governor, panda, pendulum, stewart,
    stewart_loops,
};
use crate::models;
use crate::reference::Truth;
use crate::subject::Subject;
use crate::timing::time;

/// Names of all scenes, in order.
pub(crate) const NAMES: [&str; 9] =
    ["pendulum", "mild", "chaotic", "free_body", "panda", "four_bar", "andrews", "stewart", "governor"];

/// Runs one scene, timings included.
pub(crate) fn run(name: &'static str, effort: Effort) -> Bench {
    let mut bench = match name {
        "pendulum" => {
            let scene = scene("pendulum", "Pendulum from the horizontal, 10 s", Kind::Separable, 0.25, true);
            let (subject, single) = (pendulum::<f64>(), pendulum::<f32>());
            let mut bench = start(scene, effort, &subject);
            general(&mut bench, &subject, "", "f64");
            canonical(&mut bench, &subject);
            separable(&mut bench, &subject, "f64");
            selected(&mut bench, &single, "", "f32");
            separable(&mut bench, &single, "f32");
            bench
        }
        "mild" => {
            double(scene("mild", "Double pendulum, regular motion, 10 s", Kind::Open, 0.25, true), effort, [0.5, 0.8])
        }
        "chaotic" => double(
            scene("chaotic", "Double pendulum, chaotic motion, 5 s", Kind::Chaotic, 0.1, true),
            effort,
            [2.0, 2.5],
        ),
        "free_body" => plain(
            scene("free_body", "Free body about its middle axis, 20 s", Kind::Rotation, 0.25, true),
            effort,
            &free_body(),
            &free_body(),
        ),
        "panda" => plain(
            scene("panda", "Seven-joint arm with friction, 2 s", Kind::Open, 0.05, false),
            effort,
            &panda(),
            &panda(),
        ),
        "four_bar" => looped(
            scene("four_bar", "Four-bar linkage, 4 s", Kind::Loops, 0.1, true),
            effort,
            (&four_bar(), &four_bar()),
            (&four_bar_loop(), &four_bar_loop()),
        ),
        "andrews" => looped(
            scene("andrews", "Andrews' squeezer, 0.05 s", Kind::Loops, 1e-3, true),
            effort,
            (&andrews(), &andrews()),
            (&andrews_loops(), &andrews_loops()),
        ),
        "stewart" => looped(
            scene("stewart", "Stewart-Gough platform on springs, 1 s", Kind::Loops, 0.05, false),
            effort,
            (&stewart(), &stewart()),
            (&stewart_loops(), &stewart_loops()),
        ),
        _ => plain(
            scene("governor", "Governor with stiff links, 2 s", Kind::Stiff, 0.1, false),
            effort,
            &governor(),
            &governor(),
        ),
    };
    time(&mut bench);
    bench
}

/// A mechanism without loops.
fn plain<S, R>(scene: Scene, effort: Effort, subject: &Subject<S>, single: &Subject<R>) -> Bench
where
    S: SecondOrder + Differentiable<Scalar = f64, Input = ()> + Clone + 'static,
    R: System<Scalar = f32, Input = ()> + Clone + 'static,
{
    let mut bench = start(scene, effort, subject);
    general(&mut bench, subject, "", "f64");
    selected(&mut bench, single, "", "f32");
    bench
}

/// A double pendulum from rest.
fn double(scene: Scene, effort: Effort, angles: [f64; 2]) -> Bench {
    let subject = double_pendulum(angles);
    let mut bench = start(scene, effort, &subject);
    general(&mut bench, &subject, "", "f64");
    canonical(&mut bench, &subject);
    selected(&mut bench, &double_pendulum::<f32>(angles), "", "f32");
    bench
}

const fn scene(name: &'static str, title: &'static str, kind: Kind, coarse: f64, conservative: bool) -> Scene {
    Scene { name, title, kind, coarse, conservative }
}

/// A label; order and steps are filled in by the sweep.
const fn by(method: &'static str, handling: &'static str, scalar: &'static str) -> Series {
    Series { method, steps: Steps::Fixed, handling, scalar, order: 0 }
}

/// The scene's growth of errors and energies, from accurate runs.
fn start<S: Differentiable<Scalar = f64, Input = ()>>(scene: Scene, effort: Effort, subject: &Subject<S>) -> Bench {
    let truth = Truth::of(scene.name);
    let growth = growth(subject, &truth, scene.kind);
    let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
    let mut watch = |_: f64, state: &S::State| {
        let kinetic = (subject.laws)(state).energy;
        (least, most) = (least.min(kinetic), most.max(kinetic));
    };
    let end = accurate(subject, scene.kind, truth.end, &subject.start, &mut watch);
    let energy = (subject.laws)(&end).energy;
    let scale = if scene.conservative { 1.0 + energy.abs() } else { 1.0 + (most - least) };
    let jacobian = derivatives(scene.name);
    let mut bench = Bench::new(scene, truth, effort, growth, (energy, scale));
    bench.jacobian = jacobian;
    bench
}

/// What an evaluation of derivatives costs, in evaluations: by operations.
fn derivatives(scene: &str) -> f64 {
    let costs = match scene {
        "pendulum" => models::pendulum::COSTS,
        "mild" | "chaotic" => models::double_pendulum::COSTS,
        "free_body" => models::free_body::COSTS,
        "panda" => models::panda::COSTS,
        "four_bar" => models::four_bar::COSTS,
        "andrews" => models::andrews::COSTS,
        "stewart" => models::stewart::COSTS,
        _ => models::governor::COSTS,
    };
    let operations = |function: &str| {
        let of = costs.iter().find(|cost| cost.function == function);
        of.map_or(1.0, |c| {
            f64::from(c.add + c.mul + c.other) + 8.0 * f64::from(c.div + c.sqrt) + 20.0 * f64::from(c.sincos)
        })
    };
    operations("forward_derivatives") / operations("forward_dynamics")
}

/// Methods for any system.
fn general<S: SecondOrder + Differentiable<Input = ()> + Clone + 'static>(
    bench: &mut Bench,
    subject: &Subject<S>,
    handling: &'static str,
    scalar: &'static str,
) {
    let subject = Rc::new(subject.clone());
    bench.fixed(by("Euler", handling, scalar), &subject, Euler);
    bench.fixed(by("SemiImplicitEuler", handling, scalar), &subject, SemiImplicitEuler);
    bench.fixed(by("Rk4", handling, scalar), &subject, Rk4);
    bench.fixed(by("DormandPrince", handling, scalar), &subject, DormandPrince);
    bench.adaptive(by("DormandPrince", handling, scalar), &subject, DormandPrince);
    bench.fixed(by("Dop853", handling, scalar), &subject, Dop853);
    bench.adaptive(by("Dop853", handling, scalar), &subject, Dop853);
    bench.fixed(by("ImplicitMidpoint", handling, scalar), &subject, ImplicitMidpoint);
    bench.fixed(by("GaussLegendre4", handling, scalar), &subject, GaussLegendre4);
    bench.fixed(by("GaussLegendre6", handling, scalar), &subject, GaussLegendre6);
    bench.adaptive(by("Radau", handling, scalar), &subject, Radau);
    bench.fixed(by("GeneralisedAlpha", handling, scalar), &subject, GeneralisedAlpha::new(0.8));
    chosen(bench, &subject, handling, scalar);
    if bench.scene.kind == Kind::Stiff {
        chosen_for_stiff(bench, &subject, scalar);
    }
}

/// The method that is chosen by itself.
fn chosen<S: System<Input = ()> + 'static>(
    bench: &mut Bench,
    subject: &Rc<Subject<S>>,
    handling: &'static str,
    scalar: &'static str,
) {
    let end = bench.truth.end;
    let solver = Subject::solver(subject, move |subject, accuracy, observe| {
        simulate(&subject.system, 0.0, end, &subject.start, &(), accuracy, observe)
    });
    let (series, mut accuracies) = (by("simulate", handling, scalar), bench.accuracies());
    bench.runs(Series { steps: Steps::Adaptive, ..series }, &mut accuracies, solver);
}

/// The one that is chosen for stiff systems.
fn chosen_for_stiff<S: Differentiable<Input = ()> + 'static>(
    bench: &mut Bench,
    subject: &Rc<Subject<S>>,
    scalar: &'static str,
) {
    let end = bench.truth.end;
    let solver = Subject::solver(subject, move |subject, accuracy, observe| {
        simulate_stiff(&subject.system, 0.0, end, &subject.start, &(), accuracy, observe)
    });
    let (series, mut accuracies) = (by("simulate_stiff", "", scalar), bench.accuracies());
    bench.runs(Series { steps: Steps::Adaptive, ..series }, &mut accuracies, solver);
}

/// Methods in positions and momenta.
fn canonical<S: Canonical<Input = ()> + Clone + 'static>(bench: &mut Bench, subject: &Subject<S>) {
    let subject = Rc::new(subject.clone());
    bench.fixed(by("SymplecticMidpoint", "", "f64"), &subject, SymplecticMidpoint);
    bench.fixed(by("SymplecticGauss4", "", "f64"), &subject, SymplecticGauss4);
    bench.fixed(by("SymplecticGauss6", "", "f64"), &subject, SymplecticGauss6);
}

/// Methods for accelerations that depend on positions alone.
fn separable<S: Separable<Input = ()> + Clone + 'static>(
    bench: &mut Bench,
    subject: &Subject<S>,
    scalar: &'static str,
) {
    let subject = Rc::new(subject.clone());
    bench.fixed(by("Verlet", "", scalar), &subject, Verlet);
    bench.fixed(by("Composition4", "", scalar), &subject, Composition4);
    bench.fixed(by("Composition6", "", scalar), &subject, Composition6);
}

/// Methods that show what else makes a difference: precision, and how loops are kept closed.
fn selected<S: System<Input = ()> + Clone + 'static>(
    bench: &mut Bench,
    subject: &Subject<S>,
    handling: &'static str,
    scalar: &'static str,
) {
    let subject = Rc::new(subject.clone());
    bench.fixed(by("Rk4", handling, scalar), &subject, Rk4);
    bench.adaptive(by("DormandPrince", handling, scalar), &subject, DormandPrince);
    bench.adaptive(by("Dop853", handling, scalar), &subject, Dop853);
    chosen(bench, &subject, handling, scalar);
}

/// A mechanism with loops: in reduced coordinates, then with multipliers and what keeps them closed.
fn looped<S, R, C, D>(
    scene: Scene,
    effort: Effort,
    (double, single): (&Subject<S>, &Subject<R>),
    (double_loop, single_loop): (&Subject<C>, &Subject<D>),
) -> Bench
where
    S: SecondOrder + Differentiable<Scalar = f64, Input = ()> + Clone + 'static,
    R: System<Scalar = f32, Input = ()> + Clone + 'static,
    C: SecondOrder
        + Constrained<Scalar = f64, Input = ()>
        + Impulsive<Rates = <C as Constrained>::Residual>
        + Clone
        + 'static,
    D: Constrained<Scalar = f32, Input = ()> + Clone + 'static,
{
    let mut bench = start(scene, effort, double);
    general(&mut bench, double, "reduced", "f64");
    selected(&mut bench, single, "reduced", "f32");
    selected(&mut bench, double_loop, "none", "f64");
    selected(&mut bench, &double_loop.projected(), "projection", "f64");
    selected(&mut bench, &double_loop.projected_by_mass(), "projection by mass", "f64");
    selected(&mut bench, &double_loop.corrected(), "one correction", "f64");
    baumgarte(&mut bench, double_loop);
    let alpha = GeneralisedAlpha::new(0.8).functional().constrained();
    bench.fixed(by("GeneralisedAlpha", "in the method", "f64"), &Rc::new(double_loop.clone()), alpha);
    selected(&mut bench, &single_loop.projected(), "projection", "f32");
    bench
}

/// Constraints that pull themselves closed: as fast as steps of one length allow, and at a rate of five in the longest
/// step where steps are chosen by error.
fn baumgarte<C>(bench: &mut Bench, subject: &Subject<C>)
where
    C: Constrained<Scalar = f64, Input = ()> + Impulsive<Rates = <C as Constrained>::Residual> + Clone + 'static,
{
    let subject = Rc::new(subject.clone());
    let (end, rate) = (bench.truth.end, 5.0 / bench.scene.coarse);
    let mut steps = bench.steps();
    let series = Series { order: 4, ..by("Rk4", "Baumgarte", "f64") };
    let solver = Subject::solver(&subject, move |subject, step, observe| {
        let system = WithBaumgarte::for_step(&subject.system, step);
        Integrator::fixed(Rk4, step).integrate(&system, 0.0, end, &subject.start, &(), observe)
    });
    bench.runs(series, &mut steps, solver);
    let stabilised = Rc::new(subject.with(|system| WithBaumgarte::new(system, rate)));
    bench.adaptive(by("DormandPrince", "Baumgarte", "f64"), &stabilised, DormandPrince);
    bench.adaptive(by("Dop853", "Baumgarte", "f64"), &stabilised, Dop853);
    chosen(bench, &stabilised, "Baumgarte", "f64");
}
