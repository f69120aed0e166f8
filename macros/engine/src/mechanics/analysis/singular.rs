//! Stage `mechanics`: singular values, and the rank that they tell.
//!
//! In: a dense matrix, row by row. Out: its singular values in falling order, by one-sided Jacobi rotations (Hestenes 1958;
//! Demmel and Veselic 1992), which find small ones to high relative accuracy. They run on the triangle of a factorisation
//! with pivoting, which leaves little to rotate (Drmac and Veselic 2008).

/// Most sweeps: convergence is quadratic, and five are usual.
const SWEEPS: usize = 30;

/// A pair this near to perpendicular counts as such.
const PERPENDICULAR: f64 = 1e-14;

/// Singular values in falling order, as many as rows or columns, whichever are fewer.
pub fn singular_values(matrix: &[Vec<f64>]) -> Vec<f64> {
    let mut vectors = triangle(matrix);
    let count = vectors.len();
    for _ in 0..SWEEPS {
        let mut squares: Vec<f64> = vectors.iter().map(|v| dot(v, v)).collect();
        let mut turned = false;
        for i in 0..count {
            for j in i + 1..count {
                let product = dot(&vectors[i], &vectors[j]);
                let scale = (squares[i] * squares[j]).sqrt();
                if product.abs() <= PERPENDICULAR * scale || scale == 0.0 {
                    continue;
                }
                turned = true;
                // The turn that makes them perpendicular: tan(2 phi) = 2 product / (a - b).
                let zeta = (squares[j] - squares[i]) / (2.0 * product);
                let t = zeta.signum() / (zeta.abs() + (1.0 + zeta * zeta).sqrt());
                let t = if zeta == 0.0 { 1.0 } else { t };
                let c = 1.0 / (1.0 + t * t).sqrt();
                let s = c * t;
                let (left, right) = vectors.split_at_mut(j);
                turn(&mut left[i], &mut right[0], c, s);
                squares[i] -= t * product;
                squares[j] += t * product;
            }
        }
        if !turned {
            break;
        }
    }
    let mut values: Vec<f64> = vectors.iter().map(|v| dot(v, v).sqrt()).collect();
    values.sort_by(|a, b| b.total_cmp(a));
    values
}

/// The rank, if there is a clear gap behind it: nothing between `SMALL` and `LARGE` times the greatest value.
pub fn clear_rank(values: &[f64]) -> Option<usize> {
    const LARGE: f64 = 1e-5;
    const SMALL: f64 = 1e-8;
    let greatest = values.first().copied().unwrap_or(0.0);
    if !greatest.is_finite() {
        return None;
    }
    let rank = values.iter().take_while(|&&x| x > LARGE * greatest).count();
    let clear = values.get(rank).is_none_or(|&x| x <= SMALL * greatest);
    clear.then_some(rank)
}

/// A matrix with the same singular values: the triangle of Householder's factorisation of the shorter side's vectors,
/// the longest remaining one first.
fn triangle(matrix: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let (rows, columns) = (matrix.len(), matrix.first().map_or(0, Vec::len));
    let mut vectors: Vec<Vec<f64>> = if rows <= columns {
        matrix.to_vec()
    } else {
        (0..columns).map(|j| matrix.iter().map(|row| row[j]).collect()).collect()
    };
    let count = vectors.len();
    let length = vectors.first().map_or(0, Vec::len);
    let mut squares: Vec<f64> = vectors.iter().map(|v| dot(v, v)).collect();
    for k in 0..count.min(length) {
        let Some(pivot) = (k..count).max_by(|&a, &b| squares[a].total_cmp(&squares[b])) else { break };
        vectors.swap(k, pivot);
        squares.swap(k, pivot);
        let norm = dot(&vectors[k][k..], &vectors[k][k..]).sqrt();
        if norm == 0.0 {
            break;
        }
        let alpha = if vectors[k][k] > 0.0 { -norm } else { norm };
        let mut mirror = vectors[k][k..].to_vec();
        mirror[0] -= alpha;
        let factor = 2.0 / dot(&mirror, &mirror);
        for (other, vector) in vectors.iter_mut().enumerate().skip(k) {
            let tail = &mut vector[k..];
            let scale = factor * dot(&mirror, tail);
            add(tail, -scale, &mirror);
            squares[other] -= tail[0] * tail[0];
            if squares[other] < 1e-8 * tail[0] * tail[0] {
                squares[other] = dot(&tail[1..], &tail[1..]);
            }
        }
    }
    // Vectors are columns of a lower triangle by now; its rows, which share the singular values, are nearer to
    // perpendicular.
    (0..count).map(|i| vectors.iter().map(|v| v.get(i).copied().unwrap_or(0.0)).collect()).collect()
}

/// Plain loops: iterators cost several times as much in an unoptimised build.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let count = a.len().min(b.len());
    let (a, b) = (&a[..count], &b[..count]);
    let (mut sum, mut k) = (0.0, 0);
    while k < count {
        sum += a[k] * b[k];
        k += 1;
    }
    sum
}

/// a += factor * b
pub(super) fn add(a: &mut [f64], factor: f64, b: &[f64]) {
    let count = a.len().min(b.len());
    let mut k = 0;
    while k < count {
        a[k] += factor * b[k];
        k += 1;
    }
}

fn turn(a: &mut [f64], b: &mut [f64], c: f64, s: f64) {
    let count = a.len().min(b.len());
    let mut k = 0;
    while k < count {
        let (x, y) = (a[k], b[k]);
        a[k] = c * x - s * y;
        b[k] = s * x + c * y;
        k += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::{clear_rank, singular_values};

    /// U diag(values) V^T with U, V products of plane turns.
    fn made(rows: usize, columns: usize, values: &[f64]) -> Vec<Vec<f64>> {
        let mut m = vec![vec![0.0; columns]; rows];
        for (k, &value) in values.iter().enumerate() {
            m[k][k] = value;
        }
        let mut angle = 0.3_f64;
        for i in 0..rows {
            for j in 0..i {
                angle += 1.7;
                let (s, c) = angle.sin_cos();
                let (above, below) = m.split_at_mut(i);
                for (x, y) in below[0].iter_mut().zip(&mut above[j]) {
                    (*x, *y) = (c * *x - s * *y, s * *x + c * *y);
                }
            }
        }
        for i in 0..columns {
            for j in 0..i {
                angle += 0.9;
                let (s, c) = angle.sin_cos();
                for row in &mut m {
                    let (x, y) = (row[i], row[j]);
                    (row[i], row[j]) = (c * x - s * y, s * x + c * y);
                }
            }
        }
        m
    }

    #[test]
    fn values_come_back() {
        for (rows, columns) in [(4, 4), (4, 7), (7, 4), (1, 3), (3, 1)] {
            let wanted: Vec<f64> = [3.0, 2.0, 2.0, 1e-3].into_iter().take(rows.min(columns)).collect();
            let found = singular_values(&made(rows, columns, &wanted));
            assert_eq!(found.len(), wanted.len());
            for (x, y) in found.iter().zip(&wanted) {
                assert!((x - y).abs() < 1e-13, "{found:?}");
            }
        }
    }

    #[test]
    fn rank_needs_a_gap() {
        let full = made(5, 8, &[4.0, 3.0, 1.0, 0.1, 1e-3]);
        assert_eq!(clear_rank(&singular_values(&full)), Some(5));
        let poor = made(6, 8, &[4.0, 3.0, 1.0, 0.1]);
        assert_eq!(clear_rank(&singular_values(&poor)), Some(4));
        let unclear = made(5, 8, &[4.0, 3.0, 1.0, 0.1, 1e-6]);
        assert_eq!(clear_rank(&singular_values(&unclear)), None);
        assert_eq!(clear_rank(&singular_values(&[])), Some(0));
        assert_eq!(clear_rank(&singular_values(&[vec![0.0; 3]])), Some(0));
    }
}
