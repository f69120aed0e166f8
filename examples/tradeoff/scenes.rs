//! Scenes: which mechanism, how long, by which methods.

use std::rc::Rc;

use multibody::{Constrained, DormandPrince, Euler, Integrator, Rk4, SemiImplicitEuler, System};

use crate::bench::{Bench, Effort, Kind, Scene, Series, Steps};
use crate::growth::growth;
use crate::mechanisms::{
    andrews, andrews_loops, double_pendulum, four_bar, four_bar_loop, free_body, governor, panda, pendulum, stewart,
    stewart_loops,
};
use crate::reference::Truth;
use crate::subject::Subject;

/// Names of all scenes, in order.
pub(crate) const NAMES: [&str; 9] =
    ["pendulum", "mild", "chaotic", "free_body", "panda", "four_bar", "andrews", "stewart", "governor"];

/// Runs one scene, timings included.
pub(crate) fn run(name: &'static str, effort: Effort) -> Bench {
    let mut bench = match name {
        "pendulum" => plain(
            scene("pendulum", "Pendulum from the horizontal, 10 s", Kind::Separable, 0.25, true),
            effort,
            &pendulum(),
            &pendulum(),
        ),
        "mild" => plain(
            scene("mild", "Double pendulum, regular motion, 10 s", Kind::Open, 0.25, true),
            effort,
            &double_pendulum([0.5, 0.8]),
            &double_pendulum([0.5, 0.8]),
        ),
        "chaotic" => plain(
            scene("chaotic", "Double pendulum, chaotic motion, 5 s", Kind::Chaotic, 0.1, true),
            effort,
            &double_pendulum([2.0, 2.5]),
            &double_pendulum([2.0, 2.5]),
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
            scene("governor", "Governor with stiff links, 4 s", Kind::Stiff, 0.1, false),
            effort,
            &governor(),
            &governor(),
        ),
    };
    bench.time();
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
fn start<S: System<Scalar = f64, Input = ()>>(scene: Scene, effort: Effort, subject: &Subject<S>) -> Bench {
    let truth = Truth::of(scene.name);
    let growth = growth(subject, &truth);
    let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
    let watch = |_: f64, state: &S::State| {
        let kinetic = (subject.laws)(state).energy;
        (least, most) = (least.min(kinetic), most.max(kinetic));
    };
    let accurate = Integrator::adaptive(DormandPrince, 1e-13, 1e-13);
    let (end, _) = accurate.integrate(&subject.system, 0.0, truth.end, &subject.start, &(), watch).expect("smooth motion");
    let energy = (subject.laws)(&end).energy;
    let scale = if scene.conservative { 1.0 + energy.abs() } else { 1.0 + (most - least) };
    Bench::new(scene, truth, effort, growth, (energy, scale))
}

/// A mechanism without loops.
fn plain<S, R>(scene: Scene, effort: Effort, double: &Subject<S>, single: &Subject<R>) -> Bench
where
    S: System<Scalar = f64, Input = ()> + Clone + 'static,
    R: System<Scalar = f32, Input = ()> + Clone + 'static,
{
    let mut bench = start(scene, effort, double);
    all(&mut bench, double, "", "f64");
    some(&mut bench, single, "", "f32");
    bench
}

/// A mechanism with loops: in reduced coordinates, then with multipliers and what keeps them closed.
fn looped<S, R, C, D>(
    scene: Scene,
    effort: Effort,
    (double, single): (&Subject<S>, &Subject<R>),
    (double_loop, single_loop): (&Subject<C>, &Subject<D>),
) -> Bench
where
    S: System<Scalar = f64, Input = ()> + Clone + 'static,
    R: System<Scalar = f32, Input = ()> + Clone + 'static,
    C: Constrained<Scalar = f64, Input = ()> + Clone + 'static,
    D: Constrained<Scalar = f32, Input = ()> + Clone + 'static,
{
    let mut bench = start(scene, effort, double);
    all(&mut bench, double, "reduced", "f64");
    some(&mut bench, single, "reduced", "f32");
    some(&mut bench, double_loop, "none", "f64");
    some(&mut bench, &double_loop.projected(), "projection", "f64");
    some(&mut bench, &double_loop.corrected(), "one correction", "f64");
    some(&mut bench, &single_loop.projected(), "projection", "f32");
    bench
}

/// All methods.
fn all<S: System<Input = ()> + Clone + 'static>(
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
}

/// Those that show what else makes a difference: precision, and how loops are kept closed.
fn some<S: System<Input = ()> + Clone + 'static>(
    bench: &mut Bench,
    subject: &Subject<S>,
    handling: &'static str,
    scalar: &'static str,
) {
    let subject = Rc::new(subject.clone());
    bench.fixed(by("Rk4", handling, scalar), &subject, Rk4);
    bench.adaptive(by("DormandPrince", handling, scalar), &subject, DormandPrince);
}
