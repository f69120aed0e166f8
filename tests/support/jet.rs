//! Numbers that change in time: value, rate and second rate, and vectors and matrices of them.

use std::ops::{Add, Mul, Neg, Sub};

/// Value, first and second derivative by time.
#[derive(Clone, Copy, Debug)]
pub struct Jet(pub [f64; 3]);

/// Three components.
pub type Vector = [Jet; 3];
/// Row by row.
pub type Matrix = [[Jet; 3]; 3];

impl Jet {
    /// A number that does not change.
    pub const fn fixed(x: f64) -> Jet {
        Jet([x, 0.0, 0.0])
    }

    /// The pair, by the chain rule.
    pub fn sin_cos(self) -> (Jet, Jet) {
        let [x, v, a] = self.0;
        let (s, c) = x.sin_cos();
        (Jet([s, c * v, c * a - s * v * v]), Jet([c, -s * v, -s * a - c * v * v]))
    }
}

impl Add for Jet {
    type Output = Jet;
    fn add(self, other: Jet) -> Jet {
        Jet([0, 1, 2].map(|k| self.0[k] + other.0[k]))
    }
}

impl Sub for Jet {
    type Output = Jet;
    fn sub(self, other: Jet) -> Jet {
        self + -other
    }
}

impl Neg for Jet {
    type Output = Jet;
    fn neg(self) -> Jet {
        Jet(self.0.map(|x| -x))
    }
}

impl Mul for Jet {
    type Output = Jet;
    fn mul(self, other: Jet) -> Jet {
        let ([x, v, a], [y, w, b]) = (self.0, other.0);
        Jet([x * y, v * y + x * w, a * y + 2.0 * v * w + x * b])
    }
}

/// A matrix of numbers that do not change.
pub fn fixed(matrix: [[f64; 3]; 3]) -> Matrix {
    matrix.map(|row| row.map(Jet::fixed))
}

/// A sum of vectors.
pub fn plus(a: Vector, b: Vector) -> Vector {
    [0, 1, 2].map(|k| a[k] + b[k])
}

/// A matrix by a vector.
pub fn apply(m: &Matrix, v: Vector) -> Vector {
    [0, 1, 2].map(|i| m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2])
}

/// A matrix by a matrix.
pub fn times(a: &Matrix, b: &Matrix) -> Matrix {
    let entry = |i: usize, j: usize| a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(i, j)))
}

/// A matrix with rows and columns exchanged.
pub fn transpose(m: &Matrix) -> Matrix {
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| m[j][i]))
}

/// A turn about an axis of unit length, by Rodrigues' formula.
pub fn about(n: [f64; 3], angle: Jet) -> Matrix {
    let (s, c) = angle.sin_cos();
    let cross = [[0.0, -n[2], n[1]], [n[2], 0.0, -n[0]], [-n[1], n[0], 0.0]];
    let one = Jet::fixed(1.0);
    [0, 1, 2].map(|i| {
        [0, 1, 2].map(|j| {
            let diagonal = if i == j { c } else { Jet::fixed(0.0) };
            diagonal + (one - c) * Jet::fixed(n[i] * n[j]) + s * Jet::fixed(cross[i][j])
        })
    })
}

/// The turn of a unit quaternion w, i, j, k with the angular velocity and acceleration `w`, `a` in turned axes:
/// q' = q (0, w) / 2.
pub fn turning(q: [f64; 4], w: [f64; 3], a: [f64; 3]) -> Matrix {
    let half = |q: [f64; 4], w: [f64; 3]| {
        [
            -0.5 * (q[1] * w[0] + q[2] * w[1] + q[3] * w[2]),
            0.5 * (q[0] * w[0] + q[2] * w[2] - q[3] * w[1]),
            0.5 * (q[0] * w[1] + q[3] * w[0] - q[1] * w[2]),
            0.5 * (q[0] * w[2] + q[1] * w[1] - q[2] * w[0]),
        ]
    };
    let rate = half(q, w);
    let (of_rate, of_w) = (half(rate, w), half(q, a));
    let [w, x, y, z] = [0, 1, 2, 3].map(|k| Jet([q[k], rate[k], of_rate[k] + of_w[k]]));
    let two = Jet::fixed(2.0);
    let one = Jet::fixed(1.0);
    [
        [one - two * (y * y + z * z), two * (x * y - w * z), two * (x * z + w * y)],
        [two * (x * y + w * z), one - two * (x * x + z * z), two * (y * z - w * x)],
        [two * (x * z - w * y), two * (y * z + w * x), one - two * (x * x + y * y)],
    ]
}
