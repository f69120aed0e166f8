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

/// The solution of least squares and least length, the ratio of the least to the greatest singular value kept, and their number.
pub fn least(matrix: &DMatrix<f64>, rhs: &DVector<f64>) -> (DVector<f64>, f64, usize) {
    if matrix.is_empty() {
        return (DVector::zeros(matrix.ncols()), 1.0, 0);
    }
    let wide = matrix.ncols() > matrix.nrows();
    let (turned, axes) = orthogonal_columns(if wide { matrix.transpose() } else { matrix.clone() });
    let most = turned.column_iter().fold(0.0_f64, |most, column| most.max(column.norm()));
    let (mut x, mut smallest, mut rank) = (DVector::zeros(matrix.ncols()), f64::INFINITY, 0);
    for (scaled, axis) in turned.column_iter().zip(axes.column_iter()) {
        let size = scaled.norm();
        // Lengths here are about one: what is so small is what rounding has left of a place typed in digits.
        if size <= (1e-9 * most).max(1e-13) {
            continue;
        }
        let (from, to) = if wide { (axis, scaled) } else { (scaled, axis) };
        x += to * (from.dot(rhs) / (size * size));
        (smallest, rank) = (smallest.min(size), rank + 1);
    }
    // What holds nothing is not ill-conditioned.
    (x, if rank == 0 { 1.0 } else { smallest / most }, rank)
}

/// How many rows are independent.
pub fn rank(matrix: &DMatrix<f64>) -> usize {
    least(matrix, &DVector::zeros(matrix.nrows())).2
}

/// The least and the greatest of a matrix' singular values, as many as it has columns.
pub fn extremes(matrix: DMatrix<f64>) -> (f64, f64) {
    let (turned, _) = orthogonal_columns(matrix);
    turned
        .column_iter()
        .fold((f64::INFINITY, 0.0), |(least, most), column| (least.min(column.norm()), most.max(column.norm())))
}

/// A V with orthogonal columns, and V: the singular values are their lengths. By plane rotations of two columns at a time
/// (Hestenes 1958), which stay accurate where the matrix is of lesser rank.
fn orthogonal_columns(mut a: DMatrix<f64>) -> (DMatrix<f64>, DMatrix<f64>) {
    let count = a.ncols();
    let mut v = DMatrix::identity(count, count);
    for _ in 0..60 {
        let mut still = true;
        for (i, j) in (0..count).flat_map(|i| (i + 1..count).map(move |j| (i, j))) {
            let (p, q, mixed) = (a.column(i).norm(), a.column(j).norm(), a.column(i).dot(&a.column(j)));
            if mixed.abs() <= f64::EPSILON * p * q {
                continue;
            }
            still = false;
            let ratio = (q - p) * (q + p) / (2.0 * mixed);
            let tangent = ratio.signum() / (ratio.abs() + ratio.hypot(1.0));
            let cosine = 1.0 / tangent.hypot(1.0);
            let sine = cosine * tangent;
            for matrix in [&mut a, &mut v] {
                for row in 0..matrix.nrows() {
                    let (x, y) = (matrix[(row, i)], matrix[(row, j)]);
                    (matrix[(row, i)], matrix[(row, j)]) = (cosine * x - sine * y, sine * x + cosine * y);
                }
            }
        }
        if still {
            break;
        }
    }
    (a, v)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    /// Of every rank, tall and wide: the residual stands across all columns, and the solution across what moves nothing.
    #[test]
    fn least_squares_of_any_rank() {
        let mut random = Random::new(5);
        for (rows, columns, rank) in
            (1..7).flat_map(|m| (1..7).flat_map(move |n| (1..=m.min(n)).map(move |r| (m, n, r))))
        {
            let mut drawn = |m, n| DMatrix::from_fn(m, n, |_, _| random.unit());
            let matrix = drawn(rows, rank) * drawn(rank, columns);
            let rhs = drawn(rows, 1).column(0).into_owned();
            let (x, ratio, found) = least(&matrix, &rhs);
            assert_eq!(found, rank);
            let left = matrix.transpose() * (&matrix * &x - &rhs);
            let bound = 1e-13 / (ratio * ratio);
            assert!(left.amax() < bound, "{rows} by {columns} of rank {rank}: {:e}", left.amax());
            // Of least length: a combination of rows.
            let (back, ..) = least(&matrix.transpose(), &x);
            let beside = &matrix.transpose() * back - &x;
            assert!(beside.amax() < bound * x.amax(), "{rows} by {columns} of rank {rank}: {:e}", beside.amax());
        }
    }
}
