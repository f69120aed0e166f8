//! True motions: 25 digits and more, at one time each (`data/references.txt`, written by `tests/scripts/tradeoff.py`).

use std::f64::consts::PI;

/// Positions and velocities of a mechanism in the coordinates of its reference.
pub(crate) struct Motion {
    pub(crate) q: Vec<f64>,
    pub(crate) v: Vec<f64>,
}

/// What is true at the end of a scene.
pub(crate) struct Truth {
    /// `[s]`
    pub(crate) end: f64,
    motion: Motion,
    /// Whether the position is a unit quaternion, of which q and -q are the same.
    attitude: bool,
}

impl Truth {
    /// That of a scene.
    pub(crate) fn of(scene: &str) -> Self {
        let text = include_str!("data/references.txt");
        let line =
            text.lines().find(|line| line.split(' ').next() == Some(scene)).expect("every scene has a reference");
        let mut parts =
            line.split('|').map(|part| part.split_whitespace().filter_map(|word| word.parse().ok()).collect());
        let mut next = || -> Vec<f64> { parts.next().unwrap_or_default() };
        let (end, q, v) = (next()[0], next(), next());
        let attitude = q.len() == 4 && v.len() == 3;
        Self { end, motion: Motion { q, v }, attitude }
    }

    /// How far a motion is from this one: the greatest difference of positions or velocities, each relative to one more
    /// than the greatest of them. Full turns do not count.
    pub(crate) fn error(&self, motion: &Motion) -> f64 {
        let differences = self.differences(motion);
        differences.into_iter().fold(0.0, |worst, d| if d.abs() <= worst { worst } else { d.abs() })
    }

    /// These differences one by one, positions first.
    pub(crate) fn differences(&self, motion: &Motion) -> Vec<f64> {
        let sign = if self.attitude { dot(&self.motion.q, &motion.q).signum() } else { 1.0 };
        let (scale_q, scale_v) = self.scales();
        let q = self.motion.q.iter().zip(&motion.q).map(|(truth, q)| turn(sign * q - truth) / scale_q);
        let v = self.motion.v.iter().zip(&motion.v).map(|(truth, v)| (v - truth) / scale_v);
        q.chain(v).collect()
    }

    /// What errors of positions and of velocities are relative to.
    fn scales(&self) -> (f64, f64) {
        let greatest = |list: &[f64]| list.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        (1.0 + greatest(&self.motion.q), 1.0 + greatest(&self.motion.v))
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// A difference of angles without full turns.
fn turn(d: f64) -> f64 {
    if d.abs() < PI { d } else { d - 2.0 * PI * (d / (2.0 * PI)).round() }
}
