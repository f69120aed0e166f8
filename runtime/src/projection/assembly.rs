//! Closes the loops of a mechanism from a rough guess: [`assemble`].
//!
//! A damped Gauss-Newton method: the least displacement that closes the linearised loops, limited to about one radian,
//! halved until the sum of squares falls. Where it doesn't fall any more the ends of the loops have come as near as
//! they can, or the guess is one from which no direction leads (all bars in one line, say, the state of zeros that
//! many start from); which of the two it is shows when the coordinates are shaken a little, by numbers that are the
//! same in every run. All counts are bounded, and lanes go on alone.

use super::{AssemblyError, Mask, Motion, SeparateWeights, at_rounding, closeness, finite, greatest, negative, never};
use crate::shake::shaking;
use crate::{
    Configuration, Constrained, DisplacementOf, Real, SecondOrder, StateSpace, System, Tangent, VelocityOf, all, any,
};

/// Residual at which a loop is closed, unless rounding is greater.
const TOLERANCE: f64 = 1e-12;
/// Greatest number of displacements, those by shaking among them.
const ITERATIONS: u32 = 100;
/// Greatest number of halvings of one displacement: half a thousandth of it can't gain what is asked for.
const HALVINGS: u32 = 11;
/// A step has to reduce the sum of squares at least by this share: at less it would never arrive..
const LEAST_GAIN: f64 = 1e-3;
/// ..and by this share of what it promises.
const GAIN: f64 = 0.1;
/// Greatest number of shakings..
const SHAKES: f64 = 4.0;
/// ..the first by up to this much (m or rad), the others by four times the one before.
const SHAKE: f64 = 0.02;

/// A state in which all loops are closed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Assembled<Z, T = f64> {
    /// The state.
    pub state: Z,
    /// How many of the equations are independent at this position for the coordinates that are free, in each lane.
    pub rank: T,
    /// `[m]` or `[rad]` greatest component of what is left of the residual, in each lane.
    pub residual: T,
    /// Displacements made, of the lane that took most.
    pub iterations: u32,
}

/// A state near `guess` in which the loops are closed at the time `t` `[s]`, and velocities that keep them closed.
///
/// `free` says which coordinates may change: one where they may, zero where they are held, in position and in velocity;
/// other positive numbers make them change more or less willingly. Nothing beyond the constraints is asked for: of all
/// states the nearest is taken, roughly for positions, exactly for velocities. Loops have several ways to close; the
/// guess decides which one is found. See the [module](super) for an example. Where velocities are not the rates of
/// coordinates, take [`assemble_by`].
///
/// # Errors
/// See [`AssemblyError`]; one is given if any lane fails.
pub fn assemble<S: Constrained + SecondOrder>(
    system: &S,
    t: S::Scalar,
    guess: &S::State,
    free: &VelocityOf<S>,
) -> Result<Assembled<S::State, S::Scalar>, AssemblyError> {
    assemble_by(system, t, guess, &SeparateWeights { position: S::as_displacement(*free), velocity: *free })
}

/// The same where velocities are not the rates of coordinates: with what may change in a displacement of the position, and
/// what in the velocities.
///
/// # Errors
/// See [`AssemblyError`]; one is given if any lane fails.
pub fn assemble_by<S: Constrained>(
    system: &S,
    t: S::Scalar,
    guess: &S::State,
    free: &SeparateWeights<DisplacementOf<S>, VelocityOf<S>>,
) -> Result<Assembled<S::State, S::Scalar>, AssemblyError> {
    let weight = greatest(&free.velocity);
    let mut search = Search::new(system, t, guess, &free.position)?;
    if !all(Real::is_finite(weight)) {
        return Err(AssemblyError::NotFinite);
    }
    while search.iterations < ITERATIONS && search.advance() {}
    search.check()?;

    let motion = Motion::of(free, system, t, &search.state, TOLERANCE);
    if !all(finite::<S>(&motion.state)) {
        return Err(AssemblyError::NotFinite);
    }
    if !all(motion.consistent) {
        let equations = search.residual.len();
        let rank = least::<S>(motion.consistent, motion.rank, equations);
        let (equation, rate) = motion.worst_equation(&system.constraint_rate(t, &motion.state));
        return Err(AssemblyError::CannotMove { rate, equation, rank, equations });
    }
    let residual = greatest(&search.residual);
    Ok(Assembled { state: motion.state, rank: motion.rank, residual, iterations: search.iterations })
}

/// Where the search for a position stands, in each lane.
struct Search<'a, S: Constrained> {
    system: &'a S,
    t: S::Scalar,
    free: &'a DisplacementOf<S>,
    state: S::State,
    residual: S::Residual,
    closed: Mask<S>,
    given_up: Mask<S>,
    /// Shakings so far, and the size of the next one.
    shakes: S::Scalar,
    shake: S::Scalar,
    /// The least residual met, and the rank there.
    best: S::Scalar,
    rank: S::Scalar,
    /// Whether the last correction was finite.
    finite: Mask<S>,
    iterations: u32,
    random: u32,
}

impl<'a, S: Constrained> Search<'a, S> {
    fn new(system: &'a S, t: S::Scalar, guess: &S::State, free: &'a DisplacementOf<S>) -> Result<Self, AssemblyError> {
        let (q, _, _) = guess.split();
        let residual = system.constraints(t, &q);
        let (size, weight) = (greatest(&residual), greatest(free));
        if !all(finite::<S>(guess) & Real::is_finite(size) & Real::is_finite(weight)) {
            return Err(AssemblyError::NotFinite);
        }
        let zero = S::Scalar::lit(0.0);
        Ok(Self {
            system,
            t,
            free,
            state: *guess,
            residual,
            closed: never::<S>(),
            given_up: never::<S>(),
            shakes: zero,
            shake: S::Scalar::lit(SHAKE),
            best: S::Scalar::lit(f64::INFINITY),
            rank: zero,
            finite: !never::<S>(),
            iterations: 0,
            random: 1,
        })
    }

    /// One displacement; false if none is needed any more, in no lane.
    fn advance(&mut self) -> bool {
        let (zero, one) = (S::Scalar::lit(0.0), S::Scalar::lit(1.0));
        let (q, v, x) = self.state.split();
        let size = greatest(&self.residual);
        self.closed = self.closed | Real::le(size, closeness::<S>(TOLERANCE, &q));
        let active = !(self.closed | self.given_up);
        if !any(active) {
            return false;
        }

        let (d, rank) = self.system.correction(self.t, &self.state, &negative(&self.residual), self.free);
        let better = Real::lt(size, self.best);
        self.best = Real::select(better, size, self.best);
        self.rank = Real::select(better, rank, self.rank);
        self.finite = Real::is_finite(greatest(&d)) | !active;

        // Not farther than a radian or, for travels, than they are long.
        let reach = greatest(&d.zip(&q.magnitude(), &mut |d, q| d / (one + Real::abs(q))));
        let d = d.scale(one / Real::max(one, reach));
        let (factor, stalled) = self.damping(&d, active);

        let rounding = stalled
            & at_rounding::<S>(&q, &d, &self.residual, || self.system.constraints_along(self.t, &self.state, &d));
        self.closed = self.closed | rounding;
        let stalled = stalled & !rounding;
        self.given_up = self.given_up | (stalled & Real::ge(self.shakes, S::Scalar::lit(SHAKES)));
        let shaken = stalled & !self.given_up;
        let moved = d.map(&mut |d| Real::select(Real::eq(factor, zero), zero, factor * d));
        let shaking = shaking(self.free, &mut self.random, self.shake);
        let moved = moved.zip(&shaking, &mut |d, shaking| Real::select(shaken, shaking, d));
        self.shakes += Real::select(shaken, one, zero);
        self.shake *= Real::select(shaken, S::Scalar::lit(4.0), one);

        let q = q.displace(&moved);
        self.state = self.state.join(q, v, x);
        self.residual = self.system.constraints(self.t, &q);
        self.iterations += 1;
        true
    }

    /// The share of the displacement `d` to take in each active lane, and the lanes in which there is none.
    fn damping(&self, d: &DisplacementOf<S>, active: Mask<S>) -> (S::Scalar, Mask<S>) {
        let (zero, one) = (S::Scalar::lit(0.0), S::Scalar::lit(1.0));
        let (q, _, _) = self.state.split();
        let now = squares(&self.residual);
        let (mut taken, mut factor, mut open) = (zero, one, active);
        for _ in 0..=HALVINGS {
            let then = squares(&self.system.constraints(self.t, &q.displace(&d.scale(factor))));
            let gain = Real::max(S::Scalar::lit(LEAST_GAIN), S::Scalar::lit(GAIN) * factor);
            let good = open & Real::lt(then, now * (one - gain));
            taken = Real::select(good, factor, taken);
            open = open & !good;
            if !any(open) {
                break;
            }
            factor *= S::Scalar::lit(0.5);
        }
        (taken, open)
    }

    /// Why there is a lane without a position, if there is one.
    fn check(&self) -> Result<(), AssemblyError> {
        let (q, _, _) = self.state.split();
        let size = greatest(&self.residual);
        let closed = self.closed | Real::le(size, closeness::<S>(TOLERANCE, &q));
        if all(closed) {
            return Ok(());
        }
        if !all(self.finite) {
            return Err(AssemblyError::NotFinite);
        }
        let best = Real::select(Real::lt(size, self.best), size, self.best);
        let residual = Real::select(closed, S::Scalar::lit(0.0), best).greatest();
        if any(!closed & Real::gt(self.shakes, S::Scalar::lit(0.0))) {
            let equations = self.residual.len();
            let rank = least::<S>(closed, self.rank, equations);
            return Err(AssemblyError::CannotClose { residual, rank, equations });
        }
        Err(AssemblyError::NoConvergence { residual, iterations: self.iterations })
    }
}

/// The sum of squares in each lane.
fn squares<T: Real, V: Tangent<T>>(v: &V) -> T {
    v.fold(T::lit(0.0), &mut |sum, x| sum + x * x)
}

/// The least rank of the lanes that are not among `good`, of `equations`; counted in the scalar's own arithmetic.
fn least<S: System>(good: Mask<S>, rank: S::Scalar, equations: usize) -> usize {
    let mut counted = S::Scalar::lit(0.0);
    let more = |_: &usize| {
        let more = good | Real::gt(rank, counted);
        counted += S::Scalar::lit(1.0);
        all(more)
    };
    (0..equations).take_while(more).count()
}
