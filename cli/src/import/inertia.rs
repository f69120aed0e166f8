//! Inertias of one frame in the axes of another.

use super::number::{Number, sin_cos};

type Matrix = [[f64; 3]; 3];

/// `R I R^T` for the rotation R = Rz(yaw) Ry(pitch) Rx(roll) of the frame in which the entries xx, yy, zz, xy, xz, yz stand.
pub(super) fn turned(entries: &[Number; 6], rpy: &[Number; 3]) -> [Number; 6] {
    let [xx, yy, zz, xy, xz, yz] = [0, 1, 2, 3, 4, 5].map(|k| entries[k].value);
    let inertia = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
    let rotation = rotation(rpy);
    let half = product(&rotation, &inertia);
    let turned = product(&half, &transposed(&rotation));
    [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].map(|(i, j)| Number::of(turned[i][j]))
}

fn rotation([roll, pitch, yaw]: &[Number; 3]) -> Matrix {
    let ((sr, cr), (sp, cp), (sy, cy)) = (sin_cos(roll), sin_cos(pitch), sin_cos(yaw));
    let x = [[1.0, 0.0, 0.0], [0.0, cr, -sr], [0.0, sr, cr]];
    let y = [[cp, 0.0, sp], [0.0, 1.0, 0.0], [-sp, 0.0, cp]];
    let z = [[cy, -sy, 0.0], [sy, cy, 0.0], [0.0, 0.0, 1.0]];
    product(&product(&z, &y), &x)
}

fn product(a: &Matrix, b: &Matrix) -> Matrix {
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| (0..3).map(|k| a[i][k] * b[k][j]).sum()))
}

fn transposed(a: &Matrix) -> Matrix {
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| a[j][i]))
}
