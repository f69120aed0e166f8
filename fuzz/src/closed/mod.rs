//! Loops, wheels and blades in plain numbers: residuals, their rates and accelerations, states that satisfy them, and the accelerations that
//! follow from the plain mass matrix with a multiplier for each equation, redundant ones included.

mod held;
mod joints;

use nalgebra::{DMatrix, DVector};

use crate::algebra::{V3, apply, cross, dot, least, minus, norm, plus, rank, scaled};
use crate::mechanism::expression::Point;
use crate::mechanism::{Kind, Mechanism};
use crate::plain::{Plain, displaced, split};
use crate::random::Random;
use held::Contact;
use joints::Relative;

/// What an equation says.
#[derive(Clone, Copy, Debug)]
enum Says {
    /// A function of positions, of which this is left, is zero.
    Positions(f64),
    /// Of velocities alone.
    Velocities,
}

/// One scalar equation at a point.
#[derive(Clone, Copy, Debug)]
struct Row {
    says: Says,
    rate: f64,
    acceleration: f64,
}

impl Row {
    fn of_positions(residual: f64, rate: f64, acceleration: f64) -> Row {
        Row { says: Says::Positions(residual), rate, acceleration }
    }

    fn of_velocities(rate: f64, acceleration: f64) -> Row {
        Row { says: Says::Velocities, rate, acceleration }
    }
}

/// Whose equations stand together, by number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// A joint that closes a loop.
    Cut(usize),
    /// A rod.
    Rod(usize),
    /// A wheel, a blade, rates.
    Held(usize),
    /// A coupling.
    Coupling(usize),
    /// A drive.
    Drive(usize),
}

/// All equations at a point, with what they are of.
fn sourced(of: &Mechanism, at: &Point) -> Vec<(Source, Row)> {
    let plain = Plain::new(of, at);
    let mut list = Vec::new();
    let mut put = |source: Source, rows: Vec<Row>| list.extend(rows.into_iter().map(|row| (source, row)));
    for (k, joint) in of.cuts().iter().enumerate() {
        let relative = Relative::new(&plain.frame(&joint.parent), &plain.frame(&joint.child));
        put(Source::Cut(k), relative.rows(&joint.kind, at));
    }
    for (k, rod) in of.rods.iter().enumerate() {
        let [a, b] = rod.between.each_ref().map(|frame| plain.frame(frame));
        let (d, v) = (minus(b.place, a.place), minus(b.velocity, a.velocity));
        let (reach, length) = (norm(d), rod.length.value(at));
        let n = scaled(1.0 / reach, d);
        let acceleration = dot(n, minus(b.acceleration, a.acceleration)) + (dot(v, v) - dot(n, v).powi(2)) / reach;
        put(Source::Rod(k), vec![Row::of_positions(reach - length, dot(n, v), acceleration)]);
    }
    for (k, one) in of.held.iter().enumerate() {
        put(Source::Held(k), held::rows(one, &plain, at));
    }
    for (k, coupling) in of.couplings.iter().enumerate() {
        put(Source::Coupling(k), vec![held::coupling(coupling, at)]);
    }
    for (k, drive) in of.drives.iter().enumerate() {
        put(Source::Drive(k), vec![held::drive(drive, at)]);
    }
    list
}

fn rows(of: &Mechanism, at: &Point) -> impl Iterator<Item = Row> {
    sourced(of, at).into_iter().map(|(_, row)| row)
}

/// All equations at a pose and a time: their rates are `slope * v + drift`.
pub struct Equations {
    /// What each is of.
    pub sources: Vec<Source>,
    /// Rates by velocity coordinate.
    pub slope: DMatrix<f64>,
    /// Rates where nothing moves.
    pub drift: DVector<f64>,
    /// Which of them are of positions, and what is left of these.
    positions: Vec<(usize, f64)>,
}

impl Equations {
    /// At the positions and the time of a point.
    pub fn new(of: &Mechanism, at: &Point) -> Equations {
        let mut at = at.clone();
        at.v.iter_mut().chain(&mut at.a).for_each(|list| list.fill(0.0));
        let still = sourced(of, &at);
        let drift = DVector::from_iterator(still.len(), still.iter().map(|(_, row)| row.rate));
        let n = of.freedoms();
        let mut slope = DMatrix::zeros(still.len(), n);
        for k in 0..n {
            let unit: Vec<f64> = (0..n).map(|i| f64::from(u8::from(i == k))).collect();
            at.v = split(of, &unit);
            let moving = DVector::from_iterator(still.len(), rows(of, &at).map(|row| row.rate));
            slope.set_column(k, &(moving - &drift));
        }
        let residual = |(k, (_, row)): (usize, &(Source, Row))| match row.says {
            Says::Positions(residual) => Some((k, residual)),
            Says::Velocities => None,
        };
        let positions = still.iter().enumerate().filter_map(residual).collect();
        Equations { sources: still.iter().map(|(source, _)| *source).collect(), slope, drift, positions }
    }

    /// What is left of those of positions.
    pub fn residuals(&self) -> DVector<f64> {
        DVector::from_iterator(self.positions.len(), self.positions.iter().map(|one| one.1))
    }

    /// Slopes of those of positions.
    pub fn position_slope(&self) -> DMatrix<f64> {
        self.slope.select_rows(self.positions.iter().map(|one| &one.0))
    }

    /// How many are independent.
    pub fn rank(&self) -> usize {
        rank(&self.slope)
    }

    /// Of each whether it takes part in no combination of equations that vanishes, so that its multiplier is known: then the nearest
    /// that all rates together come to its unit is that unit.
    pub fn stands_alone(&self) -> Vec<bool> {
        let count = self.slope.nrows();
        let alone = |k: usize| {
            let unit = DVector::from_fn(count, |i, _| f64::from(u8::from(i == k)));
            let (x, ..) = least(&self.slope, &unit);
            (&self.slope * x - unit).norm() < 1e-7
        };
        (0..count).map(alone).collect()
    }
}

/// Equations of positions whose slopes are the same at all these poses: they are linear.
pub fn linear(list: &[Equations]) -> Vec<usize> {
    let [first, others @ ..] = list else { return Vec::new() };
    let is_constant = |k: usize| others.iter().all(|other| (other.slope.row(k) - first.slope.row(k)).amax() < 1e-9);
    first.positions.iter().map(|one| one.0).filter(|&k| !others.is_empty() && is_constant(k)).collect()
}

/// Whether some velocity turns the ends of a screw that closes a loop about another axis than its own.
pub fn turns_beside(of: &Mechanism, at: &Point) -> bool {
    let n = of.freedoms();
    let mut at = at.clone();
    (0..n).any(|k| {
        let unit: Vec<f64> = (0..n).map(|i| f64::from(u8::from(i == k))).collect();
        at.v = split(of, &unit);
        let plain = Plain::new(of, &at);
        of.cuts().iter().any(|joint| match &joint.kind {
            Kind::Screw(axis, _) => {
                let relative = Relative::new(&plain.frame(&joint.parent), &plain.frame(&joint.child));
                let axis = axis.value(&at);
                norm(cross(axis, relative.w)) > 1e-9 * norm(axis)
            }
            _ => false,
        })
    })
}

/// Position and velocity that close the loops and obey all equations, near those given.
pub fn settled(of: &Mechanism, mut at: Point) -> Option<Point> {
    let mut last = f64::INFINITY;
    let mut equations = Equations::new(of, &at);
    for _ in 0..40 {
        let gap = equations.residuals();
        last = if gap.is_empty() { 0.0 } else { gap.amax() };
        if last < 1e-14 {
            break;
        }
        let (step, ..) = least(&equations.position_slope(), &-gap);
        let step = if step.amax() > 0.5 { &step * (0.5 / step.amax()) } else { step };
        at.q = displaced(of, &at.q, &split(of, step.as_slice()), 1.0);
        equations = Equations::new(of, &at);
    }
    if last.is_nan() || last > 1e-12 {
        return None;
    }
    let v = DVector::from(at.v.concat());
    let (step, ..) = least(&equations.slope, &-(&equations.slope * &v + &equations.drift));
    let v = v + step;
    // Equations may leave no velocity at all, as one that holds still what a drive moves.
    let missed = (&equations.slope * &v + &equations.drift).amax();
    at.v = split(of, v.as_slice());
    (missed < 1e-9 * (1.0 + v.amax() + equations.drift.amax())).then_some(at)
}

/// A closed state some way from the configuration that was drawn.
pub fn state(of: &Mechanism, random: &mut Random) -> Option<Point> {
    let mut at = of.point(random);
    at.params.clear();
    for default in &of.params {
        let value = default.value(&at);
        at.params.push(value);
    }
    at.q = of.closed.clone();
    if !of.held.is_empty() {
        let pace = *random.pick(&[1.0, 1.0, 1.0, 5.0, 20.0]);
        at.v.iter_mut().flatten().for_each(|v| *v *= pace);
    }
    let away = *random.pick(&[0.0, 0.1, 0.3, 0.6]);
    let direction: Vec<f64> = (0..of.freedoms()).map(|_| random.unit()).collect();
    // Along the motion that the loops allow, in small steps, so that it stays on the branch.
    for _ in 0..6 {
        let slope = Equations::new(of, &at).position_slope();
        let d = DVector::from(direction.clone());
        let (back, ratio, _) = least(&slope, &-(&slope * &d));
        if ratio < 1e-2 {
            return None;
        }
        at.q = displaced(of, &at.q, &split(of, (d + back).as_slice()), away / 6.0);
        at = settled(of, at)?;
    }
    Some(at)
}

/// What the plain equations say of a closed state.
pub struct Closed {
    /// Of all tree coordinates.
    pub accelerations: Vec<f64>,
    /// Those of positions and velocities.
    pub equations: Equations,
    /// Of the equations, where they are known: those that share their load with others have none.
    pub multipliers: Vec<Option<f64>>,
    /// What equations exert that is not known is worth beside that.
    pub greatest: f64,
    /// Of the equations.
    pub rank: usize,
    /// Least over greatest singular value of the equations.
    pub ratio: f64,
}

/// Accelerations: M a + bias + G^T l = 0 and G a + rest = 0.
pub fn accelerations(of: &Mechanism, at: &Point) -> Option<Closed> {
    let mut still = at.clone();
    still.a.iter_mut().for_each(|list| list.fill(0.0));
    let bias = DVector::from(Plain::new(of, &still).efforts().0);
    let matrix = Plain::mass_matrix(of, at);
    let equations = Equations::new(of, at);
    let gamma = DVector::from_iterator(equations.sources.len(), rows(of, &still).map(|row| row.acceleration));
    let slope = &equations.slope;
    let factor = matrix.clone().cholesky()?;
    let free = -factor.solve(&bias);
    let answer = factor.solve(&slope.transpose());
    let system = slope * &answer;
    let (_, ratio, rank) = least(slope, &gamma);
    let (multipliers, ..) = least(&system, &-(gamma + slope * &free));
    let accelerations = free + answer * multipliers;
    // What the motion takes tells multipliers more exactly than the system that has both the masses and the equations twice.
    let (multipliers, ..) = least(&slope.transpose(), &-(matrix * &accelerations + bias));
    let greatest = multipliers.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let alone = equations.stands_alone();
    let multipliers = multipliers.iter().zip(alone).map(|(x, alone)| alone.then_some(*x)).collect();
    let accelerations = accelerations.iter().copied().collect();
    Some(Closed { accelerations, equations, multipliers, greatest, rank, ratio })
}

/// Where something touches, in world axes: what its outputs are.
pub struct Touching {
    /// The point.
    pub place: V3,
    /// The material's velocity there, against the plane's.
    pub slip: V3,
    /// Of the equations.
    pub directions: Vec<V3>,
}

/// A wheel's or blade's contact.
pub fn touching(of: &Mechanism, plain: &Plain<'_>, number: usize, at: &Point) -> Option<Touching> {
    let held = &of.held[number];
    let [what, on] = held.frames()?.map(|frame| plain.frame(frame));
    let contact = Contact::new(held, &Relative::new(&on, &what), at)?;
    let out = |x: V3| apply(&on.rotation, x);
    Some(Touching {
        place: plus(what.place, out(contact.low)),
        slip: out(contact.slip),
        directions: contact.directions.iter().map(|&n| out(n)).collect(),
    })
}
