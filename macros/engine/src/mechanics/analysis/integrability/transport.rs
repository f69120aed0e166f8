//! Stage `mechanics`: which combinations of equations of velocities stay rates of positions along a curve.
//!
//! In: a [`Place`], some of its equations, combinations to begin with. Out: those of them that may be dF for a function F of positions
//! and time. Where dF is a sum of c_i w_i, d(dF) = 0 says along any curve that obeys the equations, with velocity X, that the sum of
//! c_i' w_i + c_i dw_i(X, ..) vanishes: so c obeys a linear differential equation, and a linear condition at every moment. Only
//! first derivatives of the equations stand in it, whatever number of Lie brackets it takes to see that something is no rate. Curves
//! are driven by random velocities that change on the way, since steady ones see too little; what a curve in general position doesn't see none does
//! (Sussmann 1973; Sontag 1992). They are found by extrapolation (Gragg, Bulirsch and Stoer 1966), which tells its error.

use super::super::problem::Random;
use super::super::tape::Values;
use super::Place;
use super::frame::{Frame, Limits, vanishing};

/// Of one piece of the curve. [rad]
const LENGTH: f64 = 0.3;
/// The most pieces.
const PIECES: usize = 8;
/// Steps of the midpoint rule, from each of which to the next it is extrapolated.
const STEPS: [u32; 5] = [2, 4, 6, 8, 10];
/// The error that is granted to it.
const ERROR: f64 = 1e-9;
/// A deviation, beside the size of what it is a difference of.
const LIMITS: Limits = Limits { seen: 1e-6, nothing: 1e-8 };

/// A piece of a curve.
struct Piece<'a> {
    place: &'a Place<'a>,
    rates: &'a [usize],
    /// The velocity to come near, and how that changes.
    towards: [Vec<f64>; 2],
}

/// Those that stay, by equation; nothing where the curve comes to no clear end.
pub(super) fn staying(
    place: &Place<'_>,
    rates: &[usize],
    combinations: Vec<Vec<f64>>,
    random: &mut Random,
) -> Option<Vec<Vec<f64>>> {
    let dimension = place.problem.dimension();
    let count = combinations.len();
    let mut values = Values::default();
    let mut state: Vec<f64> = vec![0.0; dimension];
    state.extend(combinations.iter().flatten());
    let mut seen = Vec::new();
    let mut left: Vec<Vec<f64>> = Vec::new();
    for _ in 0..(count + 2).min(PIECES) {
        let mut direction = || (0..dimension).map(|_| random.next()).collect::<Vec<f64>>();
        let piece = Piece { place, rates, towards: [direction(), direction()] };
        state = piece.end(&state, &mut values)?;
        seen.extend(piece.deviations(&state, count, &mut values)?);
        left = vanishing(seen.clone(), count, LIMITS)?;
        if left.is_empty() {
            break;
        }
    }
    let combined = |shares: &Vec<f64>| {
        (0..rates.len()).map(|k| shares.iter().zip(&combinations).map(|(share, one)| share * one[k]).sum()).collect()
    };
    Some(left.iter().map(combined).collect())
}

/// Somewhere on a curve.
struct Moment {
    velocity: Vec<f64>,
    /// By equation what the velocity makes of its exterior derivative, as coefficients by equations, and the rest.
    changes: Vec<(Vec<f64>, Vec<f64>)>,
    /// Of what the rests are differences.
    size: f64,
}

impl Piece<'_> {
    /// The state: displacements from the place, combinations.
    fn end(&self, state: &[f64], values: &mut Values) -> Option<Vec<f64>> {
        let start = self.rate(0.0, state, values)?;
        let mut table: Vec<Vec<f64>> = Vec::new();
        let mut error = f64::INFINITY;
        for (row, &count) in STEPS.iter().enumerate() {
            let mut next = vec![self.midpoint(state, &start, count, values)?];
            for (column, before) in table.iter().enumerate() {
                let ratio = f64::from(count) / f64::from(STEPS[row - column - 1]);
                let share = 1.0 / (ratio * ratio - 1.0);
                let better = next[column].iter().zip(before).map(|(fine, coarse)| fine + share * (fine - coarse));
                next.push(better.collect());
            }
            if let [.., before, last] = next.as_slice() {
                error = last.iter().zip(before).fold(0.0, |most, (a, b)| most.max((a - b).abs()));
            }
            table = next;
        }
        let scale = state.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
        table.pop().filter(|_| error <= ERROR * scale)
    }

    /// Gragg's method, smoothed at its end.
    fn midpoint(&self, state: &[f64], start: &[f64], count: u32, values: &mut Values) -> Option<Vec<f64>> {
        let step = LENGTH / f64::from(count);
        let mut before = state.to_vec();
        let mut now = moved(state, step, start);
        for k in 1..count {
            let rate = self.rate(f64::from(k) * step, &now, values)?;
            let next = moved(&before, 2.0 * step, &rate);
            before = std::mem::replace(&mut now, next);
        }
        let rate = self.rate(LENGTH, &now, values)?;
        let last = moved(&before, step, &rate);
        Some(now.iter().zip(last).map(|(a, b)| 0.5 * (a + b)).collect())
    }

    fn rate(&self, at: f64, state: &[f64], values: &mut Values) -> Option<Vec<f64>> {
        let Moment { velocity, changes, .. } = self.moment(at, state, values)?;
        let dimension = velocity.len();
        let mut rate = velocity;
        self.place.problem.displacement_rate(&state[..dimension], &mut rate);
        for combination in state[dimension..].chunks(self.rates.len()) {
            let change = |k: usize| -combination.iter().zip(&changes).map(|(c, (along, _))| c * along[k]).sum::<f64>();
            rate.extend((0..self.rates.len()).map(change));
        }
        Some(rate)
    }

    /// Rows that vanish for what stays, by the combinations that were begun with.
    fn deviations(&self, state: &[f64], count: usize, values: &mut Values) -> Option<Vec<Vec<f64>>> {
        let Moment { velocity, changes, size, .. } = self.moment(LENGTH, state, values)?;
        let dimension = velocity.len();
        let mut rows = vec![vec![0.0; count]; dimension];
        for (number, combination) in state[dimension..].chunks(self.rates.len()).enumerate() {
            for (share, (_, rest)) in combination.iter().zip(&changes) {
                rows.iter_mut().zip(rest).for_each(|(row, x)| row[number] += share * x / size);
            }
        }
        Some(rows)
    }

    fn moment(&self, at: f64, state: &[f64], values: &mut Values) -> Option<Moment> {
        let Place { problem, point, .. } = self.place;
        let dimension = problem.dimension();
        let mut point = point.clone();
        problem.displace_in_time(&mut point, &state[..dimension]);
        let forms = self.place.forms(&point, self.rates, values);
        let frame = Frame::new(&forms.held, &forms.rates.iter().collect::<Vec<_>>())?;
        let [steady, changing] = &self.towards;
        let towards: Vec<f64> = steady.iter().zip(changing).map(|(a, b)| a + b * at / LENGTH).collect();
        let velocity = frame.allowed(&towards);
        let (mut changes, mut size) = (Vec::new(), 1.0_f64);
        for slopes in &forms.slopes {
            let mut change = vec![0.0; dimension];
            for (row, share) in slopes.iter().zip(&velocity) {
                change.iter_mut().zip(row).for_each(|(sum, slope)| *sum += share * slope);
            }
            size = change.iter().fold(size, |most, x| most.max(x.abs()));
            changes.push(frame.combination(&change));
        }
        size.is_finite().then_some(Moment { velocity, changes, size })
    }
}

fn moved(from: &[f64], step: f64, rate: &[f64]) -> Vec<f64> {
    from.iter().zip(rate).map(|(x, rate)| x + step * rate).collect()
}
