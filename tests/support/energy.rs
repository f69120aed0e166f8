//! The energy of a long motion: how far it strays, and whether it drifts.

use multibody::{Integrator, Method, System};
use std::fmt;

/// Parts whose means are fitted.
const PARTS: usize = 100;

/// What became of an energy, relative to what it was at the start.
#[derive(Clone, Copy, Debug, Default)]
pub struct Drift {
    /// Greatest distance from the start.
    pub worst: f64,
    /// Mean distance over the first and over the last tenth of the motion.
    pub tenths: [f64; 2],
    /// Slope of the line fitted to all of it, times its length.
    pub rise: f64,
    /// Standard error of that, by what the line leaves of means over hundredths of the motion, and by how much each of these
    /// has to do with the one before: rounding adds up as a random walk does.
    pub error: f64,
    /// Evaluations of the system for each step.
    pub evaluations: f64,
}

impl Drift {
    /// Whether the line that was fitted rises by no more than four of its errors: by chance one in ten thousand does.
    pub fn is_flat(&self) -> bool {
        self.rise.abs() <= 4.0 * self.error
    }
}

impl fmt::Display for Drift {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { worst, tenths: [first, last], rise, error, evaluations } = self;
        write!(
            f,
            "worst {worst:.2e}, fitted line rises by {rise:.1e} with an error of {error:.1e}, first tenth {first:.2e}, last \
             {last:.2e}, {evaluations:.2} evaluations a step"
        )
    }
}

/// Follows a motion over `steps` steps of `dt` `[s]`; `energy` is relative to the start's. Reads it after every step.
pub fn drift<S, M>(
    integrator: &Integrator<M>,
    system: &S,
    start: &S::State,
    (dt, steps): (f64, u32),
    energy: impl Fn(&S::State) -> f64,
) -> Drift
where
    S: System<Input = ()>,
    M: Method<S>,
{
    let n = f64::from(steps);
    let (mut worst, mut sums, mut count) = (0.0_f64, [[0.0; 2]; PARTS], 0.0);
    let run = integrator.integrate(system, 0.0, dt * n, start, &(), |_, state| {
        let e = energy(state);
        worst = worst.max(e.abs());
        let place = (count + 0.5) / n * PARTS as f64;
        let part = place as usize;
        // Weights that rise and fall smoothly: where a part begins and ends within a swing does not show.
        let weight = (std::f64::consts::PI * (place - part as f64)).sin().powi(4);
        if let Some([sum, weights]) = sums.get_mut(part) {
            *sum += weight * e;
            *weights += weight;
        }
        count += 1.0;
    });
    let (_, statistics) = run.unwrap();
    assert_eq!(count, n);

    let means = sums.map(|[sum, weights]| sum / weights);
    let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
    // Times are counted from the middle of the motion in halves of it, so that the line's two sums do not mix.
    let places: [f64; PARTS] = std::array::from_fn(|k| (2 * k + 1) as f64 / PARTS as f64 - 1.0);
    let squares: f64 = places.iter().map(|x| x * x).sum();
    let slope = places.iter().zip(&means).map(|(x, e)| x * e).sum::<f64>() / squares;
    let level = mean(&means);
    let left: [f64; PARTS] = std::array::from_fn(|k| means[k] - level - slope * places[k]);
    let variance: f64 = left.iter().map(|r| r * r).sum();
    let correlation = left.windows(2).map(|pair| pair[0] * pair[1]).sum::<f64>() / variance;
    // Of a line through numbers of which each remembers a share of the one before.
    let inflation = (1.0 + correlation.max(0.0)) / (1.0 - correlation.max(0.0));
    Drift {
        worst,
        tenths: [mean(&means[..PARTS / 10]), mean(&means[PARTS - PARTS / 10..])],
        rise: 2.0 * slope,
        error: 2.0 * (variance * inflation / (PARTS - 2) as f64 / squares).sqrt(),
        evaluations: f64::from(statistics.evaluations) / n,
    }
}
