//! What may be said of a mechanism on wheels that is refused, and what has to be true then. Nothing else excuses a refusal.

use nalgebra::DMatrix;

use super::loops::drawn;
use crate::algebra::{least, rank};
use crate::closed::{Equations, Source, state};
use crate::mechanism::wheels::put_in;
use crate::mechanism::{Load, Mechanism};
use crate::random::Random;

/// Words of a message, and what must be true of a mechanism about which a message has them.
type Excuse = (&'static str, fn(&Mechanism, &str) -> bool);

const EXCUSES: [Excuse; 16] = [
    ("and its orientation is a quaternion", has_quaternions),
    ("and it is a quaternion", has_quaternions),
    ("how they share the load is not determined by rigid bodies", reads_shared_loads),
    ("depends on how loops share their load", |m, _| is_redundant(m)),
    ("is a coupling of coordinates that is put in where they are", |m, _| reads(m, |l| matches!(l, Load::Coupling(_)))),
    (", or contradicts that, wherever it was looked at", |m, _| is_redundant(m) || never_moves(m)),
    (": their velocities leave none for it", |m, _| never_moves(m)),
    ("is of velocities, but none that is free has a say in it", |m, _| is_redundant(m) || never_moves(m)),
    ("leaves no freedom: nothing can move among", names_what_stands_still),
    ("the drive prescribes what follows from the loops and other drives", |m, _| is_redundant(m)),
    ("cannot close: ", |m, _| never_moves(m)),
    ("how many of its equations count is not known", |m, _| is_singular(m)),
    ("counts the turns of", |m, _| m.tail.contains("Absolute") && !m.couplings.is_empty()),
    ("follows from other speeds", |m, _| has_dependent_speeds(m)),
    ("in a way that leaves no velocities to choose", |m, _| multiplies_coordinates(m)),
    ("determine the rates that", |m, _| has_dependent_speeds(m)),
];

/// Whether all that was said is true.
pub fn excuse(mechanism: &Mechanism, said: &[String]) -> bool {
    let holds = |text: &String| EXCUSES.iter().any(|(words, is_true)| text.contains(words) && is_true(mechanism, text));
    !said.is_empty() && said.iter().all(holds)
}

fn has_quaternions(m: &Mechanism, _: &str) -> bool {
    let mut tree = m.joints[..m.bodies.len()].iter();
    m.tail.contains("Absolute(Quaternion)") || tree.any(|joint| joint.kind.quaternion().is_some())
}

fn reads(m: &Mechanism, what: fn(&Load) -> bool) -> bool {
    m.loads.iter().any(what)
}

/// Equations at the drawn pose, and at some others.
fn several(m: &Mechanism) -> Vec<Equations> {
    let mut random = Random::new(7);
    let states = (0..5).filter_map(|_| state(m, &mut random));
    drawn(m).into_iter().chain(states).map(|at| Equations::new(m, &at)).collect()
}

/// At no pose are all the multipliers known that are read.
fn reads_shared_loads(m: &Mechanism, _: &str) -> bool {
    let of = |load: &Load| match *load {
        Load::Force(k) | Load::Row(k, _) => Source::Held(k),
        Load::Rod(k) => Source::Rod(k),
        Load::Coupling(k) => Source::Coupling(k),
        Load::Drive(k) => Source::Drive(k),
    };
    let several = several(m);
    m.loads.iter().any(|load| {
        let is_shared = |equations: &Equations| {
            let mut own = equations.sources.iter().zip(equations.stands_alone()).filter(|one| *one.0 == of(load));
            match load {
                Load::Row(_, row) => own.nth(*row).is_some_and(|one| !one.1),
                _ => own.any(|one| !one.1),
            }
        };
        several.iter().all(is_shared)
    })
}

/// At no pose are all equations independent.
pub fn is_redundant(m: &Mechanism) -> bool {
    several(m).iter().all(|equations| equations.rank() < equations.slope.nrows())
}

/// There are no velocities that obey all equations, or no positions.
fn never_moves(m: &Mechanism) -> bool {
    let mut random = Random::new(8);
    (0..8).all(|_| state(m, &mut random).is_none())
}

/// What the message names cannot move, by equations of positions.
fn names_what_stands_still(m: &Mechanism, text: &str) -> bool {
    let named: Vec<&str> = text.split("among").nth(1).unwrap_or_default().split('`').skip(1).step_by(2).collect();
    let several = several(m);
    let mut column = 0;
    let mut still = true;
    for (k, joint) in m.joints[..m.bodies.len()].iter().enumerate() {
        for i in 0..joint.kind.freedoms() {
            let is_named = named.iter().any(|name| match name.strip_prefix(&format!("j{k}")) {
                Some("") => true,
                Some(of) => joint.kind.names().get(i).is_some_and(|own| of.strip_prefix('.') == Some(own)),
                None => false,
            });
            still &= !is_named || several.iter().all(|equations| stands_still(&equations.position_slope(), column));
            column += 1;
        }
    }
    still && !named.is_empty()
}

/// A unit velocity is among the combinations of rows: they hold it at zero.
fn stands_still(slope: &DMatrix<f64>, column: usize) -> bool {
    let unit = nalgebra::DVector::from_fn(slope.ncols(), |i, _| f64::from(u8::from(i == column)));
    let across = slope.transpose();
    let (x, ..) = least(&across, &unit);
    (across * x - unit).norm() < 1e-6
}

/// The drawn pose is near a singular one, or fewer equations are independent there than elsewhere.
fn is_singular(m: &Mechanism) -> bool {
    let ranks: Vec<usize> = several(m).iter().map(Equations::rank).collect();
    ranks.windows(2).any(|pair| pair[0] != pair[1]) || super::loops::loses_rank_where_closed(m)
}

/// Speeds with what is taken out of the state beside them determine fewer rates than there are of both.
fn has_dependent_speeds(m: &Mechanism) -> bool {
    let several = several(m);
    if m.speeds.is_empty() || several.is_empty() {
        return false;
    }
    let is_reduced = m.tail.contains("Reduced");
    let is_short = |out: DMatrix<f64>| {
        let (rows, taken) = (out.nrows(), rank(&out));
        let entry = |i: usize, k: usize| if i < rows { out[(i, k)] } else { m.speeds[i - rows][k] };
        let all = DMatrix::from_fn(rows + m.speeds.len(), m.freedoms(), entry);
        taken + m.speeds.len() != m.freedoms() || rank(&all) < m.freedoms()
    };
    if is_reduced {
        return several.into_iter().all(|of| is_short(of.slope));
    }
    // What is linear by numbers may not be so in the form in which it is derived: then it isn't taken out.
    let drives = |of: &Equations| -> DMatrix<f64> {
        let rows = (0..of.sources.len()).filter(|&k| matches!(of.sources[k], Source::Drive(_)));
        of.slope.select_rows(&rows.collect::<Vec<usize>>())
    };
    is_short(put_in(&several)) || is_short(drives(&several[0]))
}

/// A coordinate that is found may be one whose factor is another coordinate, which is zero as the mechanism stands: no rates are known
/// there, whichever are taken.
fn multiplies_coordinates(m: &Mechanism) -> bool {
    m.tail.contains("Reduced") && m.couplings.iter().any(|coupling| coupling.product.is_some())
}
