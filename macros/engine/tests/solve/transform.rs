//! Rigid motions in plain arithmetic, and a least-squares step.

pub(crate) type Matrix = [[f64; 3]; 3];

#[derive(Clone, Copy, Debug)]
pub(crate) struct Transform {
    pub(crate) rotation: Matrix,
    pub(crate) offset: [f64; 3],
}

pub(crate) const IDENTITY: Transform =
    Transform { rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], offset: [0.0; 3] };

pub(crate) fn apply(m: &Matrix, v: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| (0..3).map(|j| m[i][j] * v[j]).sum())
}

pub(crate) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3])
}

/// About a unit vector (Rodrigues).
pub(crate) fn turn(axis: [f64; 3], angle: f64) -> Matrix {
    let (s, c) = angle.sin_cos();
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let skew = cross(axis, std::array::from_fn(|k| f64::from(u8::from(k == j))))[i];
            axis[i] * axis[j] * (1.0 - c) + skew * s + if i == j { c } else { 0.0 }
        })
    })
}

impl Transform {
    pub(crate) fn then(&self, next: &Transform) -> Transform {
        let rotation = std::array::from_fn(|i| {
            std::array::from_fn(|j| (0..3).map(|k| self.rotation[i][k] * next.rotation[k][j]).sum())
        });
        let moved = apply(&self.rotation, next.offset);
        Transform { rotation, offset: std::array::from_fn(|i| self.offset[i] + moved[i]) }
    }

    pub(crate) fn inverse(&self) -> Transform {
        let rotation: Matrix = std::array::from_fn(|i| std::array::from_fn(|j| self.rotation[j][i]));
        Transform { rotation, offset: apply(&rotation, self.offset).map(|x| -x) }
    }

    pub(crate) fn axis(&self, k: usize) -> [f64; 3] {
        std::array::from_fn(|i| self.rotation[i][k])
    }

    /// How far from the identity: half the skew part, the offset, and what is left of a half turn.
    pub(crate) fn residual(&self) -> [f64; 6] {
        let (r, o) = (&self.rotation, self.offset);
        let half = |i: usize, j: usize| 0.5 * (r[i][j] - r[j][i]);
        [half(2, 1), half(0, 2), half(1, 0), o[0], o[1], o[2]]
    }

    /// Largest entry of the difference from the identity.
    pub(crate) fn error(&self) -> f64 {
        let turned = (0..9).map(|k| self.rotation[k / 3][k % 3] - IDENTITY.rotation[k / 3][k % 3]);
        turned.chain(self.offset).map(f64::abs).fold(0.0, f64::max)
    }
}

/// Least squares of J x = r with a little damping.
pub(crate) fn least_squares(columns: &[[f64; 6]], residual: &[f64; 6], damping: f64) -> Vec<f64> {
    let n = columns.len();
    let dot = |a: &[f64; 6], b: &[f64; 6]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let mut a: Vec<Vec<f64>> =
        columns.iter().map(|c| columns.iter().map(|d| dot(c, d)).chain([dot(c, residual)]).collect()).collect();
    for (k, row) in a.iter_mut().enumerate() {
        row[k] += damping;
    }
    for k in 0..n {
        let pivot = (k..n).max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs())).unwrap();
        a.swap(k, pivot);
        for i in 0..n {
            if i != k && a[k][k] != 0.0 {
                let factor = a[i][k] / a[k][k];
                let row = a[k].clone();
                a[i].iter_mut().zip(row).for_each(|(x, y)| *x -= factor * y);
            }
        }
    }
    (0..n).map(|k| a[k][n] / a[k][k]).collect()
}
