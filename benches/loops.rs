//! Forward dynamics of loops in every choice of coordinates, in units of one sine and cosine of std; projections beside it.
//!
//! `RUSTFLAGS=-Ctarget-cpu=native cargo bench -p multibody-benches --bench loops`. Everything runs in turns and counts with its least
//! time of all, so that what else the machine does weighs little; only ratios of one run mean anything.

#[path = "../tests/models/iterated.rs"]
mod iterated;
#[path = "../tests/models/stewart.rs"]
mod stewart;

use std::f64::consts::PI;
use std::hint::black_box;
use std::time::Instant;

use multibody::{Constrained, multibody};

/// Crank-rockers side by side, as equations.
mod rows {
    use super::multibody;
    multibody! {
    mod bar {
        port shaft: Frame; port pivot: Frame;
        body crank { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body coupler { mass: 3.5, com: 1.75 * X, inertia: rod(3.5, 3.5, X) }
        body rocker { mass: 3.0, com: 1.5 * X, inertia: rod(3.0, 3.0, X) }
        joint turn: Revolute { parent: shaft, child: crank, axis: Z }
        joint knee: Revolute { parent: crank.at(X), child: coupler, axis: Z }
        joint swing: Revolute { parent: pivot, child: rocker, axis: Z }
        #[cut] joint pin: Revolute { parent: coupler.at(3.5 * X), child: rocker.at(3.0 * X), axis: Z }
    }
    pub mod ten {
        world { gravity: -9.81 * Y }
        part bars: [bar; 10] = |i| bar { shaft: ground.at(5.0 * i * X), pivot: ground.at((5.0 * i + 4.0) * X) };
        formulation { constraints: Multipliers }
        emit forward_dynamics;
    }
    pub mod twenty {
        world { gravity: -9.81 * Y }
        part bars: [bar; 20] = |i| bar { shaft: ground.at(5.0 * i * X), pivot: ground.at((5.0 * i + 4.0) * X) };
        formulation { constraints: Multipliers }
        emit forward_dynamics;
    }
    pub mod forty {
        world { gravity: -9.81 * Y }
        part bars: [bar; 40] = |i| bar { shaft: ground.at(5.0 * i * X), pivot: ground.at((5.0 * i + 4.0) * X) };
        formulation { constraints: Multipliers }
        emit forward_dynamics;
    }
    pub mod sixty {
        world { gravity: -9.81 * Y }
        part bars: [bar; 60] = |i| bar { shaft: ground.at(5.0 * i * X), pivot: ground.at((5.0 * i + 4.0) * X) };
        formulation { constraints: Multipliers }
        emit forward_dynamics;
    }
    }
}

/// Evaluations in a row, and how often it is each one's turn.
const ROW: usize = 200;
const TURNS: usize = 400;

/// A name, and what is timed.
struct Subject {
    name: String,
    run: Box<dyn FnMut()>,
    /// Seconds of one evaluation.
    least: f64,
}

impl Subject {
    fn new(name: impl Into<String>, run: impl FnMut() + 'static) -> Subject {
        Subject { name: name.into(), run: Box::new(run), least: f64::INFINITY }
    }
}

/// Everything in its turn.
fn time(subjects: &mut [Subject], row: usize, turns: usize) {
    for _ in 0..turns {
        for subject in subjects.iter_mut() {
            let clock = Instant::now();
            (0..row).for_each(|_| (subject.run)());
            subject.least = subject.least.min(clock.elapsed().as_secs_f64() / row as f64);
        }
    }
}

macro_rules! forward {
    ($list:ident, $($file:ident::$model:ident)*) => {
        $({
            let model = Box::new($file::$model::Model::<f64>::default());
            let (state, input) = (Box::new($file::$model::State::default()), Box::<$file::$model::Input>::default());
            $list.push(Subject::new(concat!(stringify!($file), "::", stringify!($model)), move || {
                black_box(black_box(&model).forward_dynamics(0.0, black_box(&state), black_box(&input)));
            }));
        })*
    };
}

macro_rules! projection {
    ($list:ident, $($file:ident::$model:ident)*) => {
        $({
            let model = Box::new($file::$model::Model::<f64>::default());
            let q = Box::new($file::$model::State::default().q);
            $list.push(Subject::new(concat!(stringify!($file), "::", stringify!($model), ", a displacement"), move || {
                let gap = model.constraints(0.0, black_box(&q));
                black_box(black_box(&model).least_correction(0.0, black_box(&q), &gap));
            }));
        })*
    };
}

fn main() {
    // Sines of a thousand angles, none of which is known before.
    let angles: Vec<f64> = (0..1000).map(|k| PI * (2.0 * (f64::from(k) * 0.754_877_666).fract() - 1.0)).collect();
    let mut at = 0;
    let mut list = vec![Subject::new("sin_cos", move || {
        at = (at + 1) % angles.len();
        black_box(black_box(angles[at]).sin_cos());
    })];
    forward! { list,
        stewart::reduced stewart::hybrid stewart::assumed_hybrid stewart::joint_coordinates stewart::assumed_joints
        stewart::absolute iterated::delta_closed iterated::delta_newton iterated::delta_multipliers iterated::rps_newton iterated::rps_near iterated::rps_multipliers
        iterated::wishbone_closed iterated::wishbone_newton iterated::wishbone_near iterated::wishbone_multipliers iterated::sarrus_newton iterated::sarrus_near iterated::sarrus_multipliers
        iterated::stephenson_newton iterated::stephenson_near iterated::stephenson_multipliers
        iterated::delta_rods_closed iterated::delta_rods_newton iterated::delta_rods_multipliers
    }
    forward! { list, rows::ten rows::twenty rows::forty rows::sixty }
    projection! { list, stewart::hybrid stewart::assumed_hybrid stewart::joint_coordinates stewart::assumed_joints }
    time(&mut list, ROW, TURNS);
    let unit = list[0].least;
    for Subject { name, least, .. } in &list {
        println!("{name:48} {:8.1} ns {:8.1} sin_cos", least * 1e9, least / unit);
    }
}
