//! Stage `mechanics`: components of vectors in axes of the caller's choice, added, multiplied, applied.
//!
//! In and out: scalars. Sums over many points stay open here, term by term, so that the optimiser finds what they
//! share.

use crate::symbolic::graph::{Graph, Scalar};

/// Components.
pub type Triple = [Scalar; 3];

pub const ZERO: Triple = [Scalar::ZERO; 3];

/// Coordinate axes.
pub const UNITS: [Triple; 3] = [
    [Scalar::ONE, Scalar::ZERO, Scalar::ZERO],
    [Scalar::ZERO, Scalar::ONE, Scalar::ZERO],
    [Scalar::ZERO, Scalar::ZERO, Scalar::ONE],
];

pub fn dot(g: &mut Graph, a: &Triple, b: &Triple) -> Scalar {
    let products = [0, 1, 2].map(|k| g.mul(a[k], b[k]));
    g.sum(&products)
}

pub fn cross(g: &mut Graph, a: &Triple, b: &Triple) -> Triple {
    [0, 1, 2].map(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let (plus, minus) = (g.mul(a[j], b[k]), g.mul(a[k], b[j]));
        g.sub(plus, minus)
    })
}

pub fn add(g: &mut Graph, a: &Triple, b: &Triple) -> Triple {
    [0, 1, 2].map(|k| g.add(a[k], b[k]))
}

pub fn sub(g: &mut Graph, a: &Triple, b: &Triple) -> Triple {
    [0, 1, 2].map(|k| g.sub(a[k], b[k]))
}

pub fn scale(g: &mut Graph, s: Scalar, a: &Triple) -> Triple {
    a.map(|c| g.mul(s, c))
}

pub fn total(g: &mut Graph, terms: &[Triple]) -> Triple {
    [0, 1, 2].map(|k| {
        let column: Vec<Scalar> = terms.iter().map(|t| t[k]).collect();
        g.sum(&column)
    })
}

pub fn minus(a: &Triple) -> Triple {
    a.map(|c| -c)
}

/// A matrix, row by row, times a vector.
pub fn apply(g: &mut Graph, rows: &[Triple; 3], v: &Triple) -> Triple {
    [0, 1, 2].map(|i| dot(g, &rows[i], v))
}

/// The transpose of a matrix, row by row, times a vector.
pub fn apply_transposed(g: &mut Graph, rows: &[Triple; 3], v: &Triple) -> Triple {
    combine(g, rows, v)
}

/// x a + y b + z c.
pub fn combine(g: &mut Graph, vectors: &[Triple; 3], factors: &Triple) -> Triple {
    let terms = [0, 1, 2].map(|k| scale(g, factors[k], &vectors[k]));
    total(g, &terms)
}

pub fn transposed(rows: &[Triple; 3]) -> [Triple; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| rows[j][i]))
}

/// Says what a vector is; its components get the name with `_x`, `_y`, `_z`.
pub fn label(g: &mut Graph, v: &Triple, name: &str) {
    for (&component, axis) in v.iter().zip(["x", "y", "z"]) {
        g.label(component, || format!("{name}_{axis}"));
    }
}
