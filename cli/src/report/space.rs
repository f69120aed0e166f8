//! Arithmetic of 3-vectors.

pub(super) type Point = [f64; 3];

pub(super) const AXES: [Point; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

pub(super) fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(super) fn add(a: Point, b: Point) -> Point {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(super) fn sub(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) fn scale(s: f64, a: Point) -> Point {
    a.map(|x| s * x)
}

pub(super) fn norm(a: Point) -> f64 {
    dot(a, a).sqrt()
}

/// Of length one; nothing for what has no direction.
pub(super) fn unit(a: Point) -> Option<Point> {
    let length = norm(a);
    (length > 0.0 && length.is_finite()).then(|| scale(1.0 / length, a))
}

/// Principal axes of points about their mean, each with the root of its variance, largest first (Jacobi's rotations).
pub(super) fn principal(points: &[Point]) -> [(f64, Point); 3] {
    let count = points.len().max(1) as f64;
    let mean = scale(1.0 / count, points.iter().fold([0.0; 3], |sum, &p| add(sum, p)));
    let mut m = [[0.0; 3]; 3];
    for &p in points {
        let d = sub(p, mean);
        for (i, row) in m.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                *entry += d[i] * d[j] / count;
            }
        }
    }
    // Columns are the axes.
    let mut axes = AXES;
    for _ in 0..20 {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            if m[p][q] == 0.0 {
                continue;
            }
            let angle = 0.5 * (2.0 * m[p][q]).atan2(m[q][q] - m[p][p]);
            let (s, c) = angle.sin_cos();
            for row in &mut m {
                (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
            }
            let (first, second) = (m[p], m[q]);
            m[p] = sub(scale(c, first), scale(s, second));
            m[q] = add(scale(s, first), scale(c, second));
            for row in &mut axes {
                (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
            }
        }
    }
    let mut list = [0, 1, 2].map(|k| (m[k][k].max(0.0).sqrt(), [axes[0][k], axes[1][k], axes[2][k]]));
    list.sort_by(|a, b| b.0.total_cmp(&a.0));
    list
}

#[cfg(test)]
mod tests {
    use super::{Point, dot, principal};

    #[test]
    fn principal_axes_of_an_oblique_rectangle() {
        // 4 by 2, across (2, 2, 1) / 3.
        let (a, b): (Point, Point) = ([2.0 / 3.0, -1.0 / 3.0, -2.0 / 3.0], [1.0 / 3.0, -2.0 / 3.0, 2.0 / 3.0]);
        let corner = |s: f64, t: f64| [0, 1, 2].map(|k| 5.0 + 2.0 * s * a[k] + t * b[k]);
        let found = principal(&[corner(1.0, 1.0), corner(-1.0, 1.0), corner(-1.0, -1.0), corner(1.0, -1.0)]);
        let [(most, first), (_, second), (least, normal)] = found;
        assert!((most - 2.0).abs() < 1e-12 && least < 1e-7, "{found:?}");
        assert!(dot(first, a).abs() > 1.0 - 1e-12 && dot(second, b).abs() > 1.0 - 1e-12, "{found:?}");
        assert!(dot(normal, [2.0 / 3.0, 2.0 / 3.0, 1.0 / 3.0]).abs() > 1.0 - 1e-12, "{found:?}");
    }
}
