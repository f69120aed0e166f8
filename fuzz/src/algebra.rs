//! Three by three, and systems of equations.

use nalgebra::{DMatrix, DVector};

/// Three numbers.
pub type V3 = [f64; 3];
/// Row by row.
pub type Matrix = [V3; 3];

/// Sum.
pub fn plus(a: V3, b: V3) -> V3 {
    [0, 1, 2].map(|k| a[k] + b[k])
}

/// Difference.
pub fn minus(a: V3, b: V3) -> V3 {
    [0, 1, 2].map(|k| a[k] - b[k])
}

/// A multiple.
pub fn scaled(k: f64, a: V3) -> V3 {
    a.map(|x| k * x)
}

/// Scalar product.
pub fn dot(a: V3, b: V3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Vector product.
pub fn cross(a: V3, b: V3) -> V3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Length.
pub fn norm(a: V3) -> f64 {
    dot(a, a).sqrt()
}

/// A matrix by a vector.
pub fn apply(m: &Matrix, v: V3) -> V3 {
    m.map(|row| dot(row, v))
}

/// Two matrices.
pub fn product(a: &Matrix, b: &Matrix) -> Matrix {
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
}

/// Mirrored at the diagonal.
pub fn transposed(m: &Matrix) -> Matrix {
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| m[j][i]))
}

/// No turn.
pub fn identity() -> Matrix {
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
}

/// The turn about an axis of any length.
pub fn about(axis: V3, angle: f64) -> Matrix {
    let n = scaled(1.0 / norm(axis), axis);
    let (s, c) = angle.sin_cos();
    let k = [[0.0, -n[2], n[1]], [n[2], 0.0, -n[0]], [-n[1], n[0], 0.0]];
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| c * f64::from(u8::from(i == j)) + s * k[i][j] + (1.0 - c) * n[i] * n[j]))
}

/// The turn of a unit quaternion, real part first.
pub fn of_quaternion([w, x, y, z]: [f64; 4]) -> Matrix {
    [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
    ]
}

/// The quaternion of a turn, by its greatest component.
pub fn quaternion(m: &Matrix) -> [f64; 4] {
    let squares = [
        1.0 + m[0][0] + m[1][1] + m[2][2],
        1.0 + m[0][0] - m[1][1] - m[2][2],
        1.0 - m[0][0] + m[1][1] - m[2][2],
        1.0 - m[0][0] - m[1][1] + m[2][2],
    ];
    let largest = (0..4).fold(0, |best, k| if squares[k] > squares[best] { k } else { best });
    let s = 0.5 * squares[largest].max(0.0).sqrt();
    let (f, d) = (0.25 / s, |i: usize, j: usize| m[i][j] - m[j][i]);
    let p = |i: usize, j: usize| m[i][j] + m[j][i];
    match largest {
        0 => [s, f * d(2, 1), f * d(0, 2), f * d(1, 0)],
        1 => [f * d(2, 1), s, f * p(0, 1), f * p(0, 2)],
        2 => [f * d(0, 2), f * p(0, 1), s, f * p(1, 2)],
        _ => [f * d(1, 0), f * p(0, 2), f * p(1, 2), s],
    }
}

/// Hamilton's product.
pub fn hamilton(a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
    [
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
        a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
    ]
}

/// The solution of least squares and least length, and the ratio of the least to the greatest singular value kept.
pub fn least(matrix: &DMatrix<f64>, rhs: &DVector<f64>) -> (DVector<f64>, f64, usize) {
    if matrix.is_empty() {
        return (DVector::zeros(matrix.ncols()), 1.0, 0);
    }
    let svd = matrix.clone().svd(true, true);
    let most = svd.singular_values.iter().fold(0.0_f64, |m, x| m.max(*x));
    let bound = 1e-9 * most;
    let kept: Vec<f64> = svd.singular_values.iter().copied().filter(|x| *x > bound).collect();
    let ratio = kept.iter().fold(f64::INFINITY, |m, x| m.min(*x)) / most.max(f64::MIN_POSITIVE);
    let x = svd.solve(rhs, bound.max(f64::MIN_POSITIVE)).expect("both factors were asked for");
    (x, ratio, kept.len())
}
