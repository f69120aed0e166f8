//! Stage `mechanics`: how large equations are, and what of them is rounding.
//!
//! In: a [`Problem`]. Out: the mechanism's size, a scale for each equation, and gaps in words. An equation is judged
//! against the rounding of what it is made of, never against itself: cosines are products of unit vectors, lengths sums of
//! the mechanism's offsets, half squares of rods products of these, and a user's expression is bounded on the tape. Slopes
//! that stay below this rounding at random points are none, and the equation is constant: it holds, or nothing can make
//! it. So a frame that was typed to sixteen digits is as good as an exact one.

use std::ops::Range;

use super::problem::{Point, Problem, Random};
use super::tape::Values;

/// Slopes up to this share of what they are made of are rounding: of the typed digits, and of the sums and products since.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Lengths up to this share of the size of bodies are the rounding of an offset.
const NO_LENGTH: f64 = 1e-9;

/// And so are lengths below this (m), whatever the bodies.
const LEAST_LENGTH: f64 = 1e-12;

/// What a residual is; what a rod's length is, is `R`.
#[derive(Clone, Copy, Debug)]
pub(super) enum Measure<R = usize> {
    /// m
    Length,
    Cosine,
    /// (d . d - length^2) / 2, with the number of the length's root.
    Rod(R),
    /// A user's expression.
    Value,
}

impl<R> Measure<R> {
    pub(super) fn map<S>(self, rod: impl FnOnce(R) -> S) -> Measure<S> {
        match self {
            Measure::Length => Measure::Length,
            Measure::Cosine => Measure::Cosine,
            Measure::Rod(length) => Measure::Rod(rod(length)),
            Measure::Value => Measure::Value,
        }
    }
}

/// How far a loop is from being closed.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Gap {
    /// m, squared
    square: f64,
    cosine: f64,
    value: f64,
}

impl Gap {
    pub(super) fn widen(&mut self, other: &Gap) {
        self.square += other.square;
        self.cosine = self.cosine.max(other.cosine);
        self.value = self.value.max(other.value);
    }

    pub(super) fn is_open(&self, size: f64) -> bool {
        self.square.sqrt() > 1e-9 * size || self.cosine > 1e-9 || self.value > 1e-9
    }

    pub(super) fn text(&self, size: f64) -> String {
        let length = self.square.sqrt();
        if length > 1e-7 * size {
            format!("the smallest gap found is {} m", short(length))
        } else if self.cosine > 1e-7 {
            let angle = self.cosine.min(1.0).asin();
            format!("its axes miss each other by {} rad at least", short(angle))
        } else if self.value > 1e-7 {
            format!("the smallest value found is {}", short(self.value))
        } else if self.is_open(size) {
            let gap = (length / size).max(self.cosine).max(self.value);
            format!("it misses by {gap:.1e}: are frames and lengths typed to all digits?")
        } else {
            "only with axes that point the wrong way does it".to_owned()
        }
    }
}

/// Three digits.
fn short(x: f64) -> String {
    let digits = (2.0 - x.abs().log10().floor()).clamp(0.0, 12.0) as usize;
    let text = format!("{x:.digits$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

impl Problem {
    /// The mechanism's size (of constant lengths, compared with masses and second moments) and scales of its equations.
    pub(super) fn measure(&mut self, lengths: Range<usize>, spans: Range<usize>) {
        let mut values = Values::default();
        self.tape.run(&mut values, &self.defaults);
        let greatest = |all: &mut dyn Iterator<Item = f64>| all.filter(|x| x.is_finite()).fold(0.0, f64::max);
        let size = greatest(&mut lengths.map(|root| self.tape.value(&values, root).abs()));
        let spans = spans.step_by(2).map(|root| {
            let (mass, second) = (self.tape.value(&values, root), self.tape.value(&values, root + 1));
            (second / mass).sqrt()
        });
        let bodies = greatest(&mut spans.into_iter());
        self.size = if size > LEAST_LENGTH && size > NO_LENGTH * bodies { size } else { 1.0 };
        for column in &mut self.columns {
            column.unit *= if column.unit < 0.0 { -self.size } else { 1.0 };
        }
        let count = self.equations.len();
        let (mut scales, mut roundings) = (vec![0.0_f64; count], vec![0.0_f64; count]);
        let mut random = Random(7);
        for _ in 0..3 {
            let point = self.start(&mut random, 0.7);
            self.tape.run(&mut values, &point.0);
            for k in 0..count {
                let row = self.gradient(&point, self.equations[k].root, 1.0, &mut values);
                let square: f64 = row.iter().map(|entry| entry.1 * entry.1).sum();
                if square.is_finite() {
                    scales[k] = scales[k].max(square.sqrt());
                }
                roundings[k] = roundings[k].max(ROUNDING * self.natural(k, &values));
            }
        }
        let natural: Vec<f64> = roundings.into_iter().map(|x| x / ROUNDING).collect();
        for ((equation, scale), natural) in self.equations.iter_mut().zip(scales).zip(natural) {
            let moves = scale > ROUNDING * natural;
            let usual = if natural > 0.0 { natural } else { 1.0 };
            equation.scale = if moves { scale } else { usual };
            // With other parameters it may well move.
            if !moves && !equation.adjustable {
                equation.constant = !equation.columns.is_empty();
                equation.columns.clear();
            }
        }
    }

    /// The size of what an equation's slopes are made of, after an evaluation.
    fn natural(&self, equation: usize, values: &Values) -> f64 {
        let equation = &self.equations[equation];
        match equation.measure {
            Measure::Cosine => 1.0,
            Measure::Length => self.size,
            Measure::Rod(_) => self.size * self.size,
            Measure::Value => {
                let bound = self.tape.slope_bound(values, equation.root, |symbol| self.unit_of(symbol));
                // What turns is made of unit vectors and offsets, however small a factor stands before it.
                if self.tape.turns(equation.root) { bound.max(1.0).max(self.size) } else { bound }
            }
        }
    }

    /// What is left of some equations at a point.
    pub(super) fn gap_at(&self, point: &Point, equations: &[usize], values: &mut Values) -> Gap {
        self.tape.run(values, &point.0);
        self.gap(values, equations)
    }

    /// The same after an evaluation of everything.
    pub(super) fn gap(&self, values: &Values, equations: &[usize]) -> Gap {
        let mut gap = Gap::default();
        for equation in equations.iter().map(|&k| &self.equations[k]) {
            let residual = self.tape.value(values, equation.root).abs();
            match equation.measure {
                Measure::Length => gap.square += residual * residual,
                Measure::Cosine => gap.cosine = gap.cosine.max(residual),
                Measure::Value => gap.value = gap.value.max(residual),
                Measure::Rod(root) => {
                    let length = self.tape.value(values, root).abs();
                    let signed = self.tape.value(values, equation.root);
                    let way = (length * length + 2.0 * signed).max(0.0).sqrt();
                    gap.square += (way - length) * (way - length);
                }
            }
        }
        gap
    }
}
