//! Where a mechanism is looked at from.
//!
//! In: its points, axes of its joints, which way is up. Out: an orthographic view: across the plane in which the points
//! stand, if they do; across the line, so that hinges are seen as circles; else, and where all is one point, from the front, the right and above.

use super::space::{AXES, Point, cross, dot, principal, scale, sub, unit};

/// A part of the largest extent that is nothing.
const FLAT: f64 = 0.02;

/// Unit vectors of the paper, and the one from it to the reader.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    pub(super) right: Point,
    pub(super) up: Point,
    pub(super) towards: Point,
}

impl View {
    /// Where points stand in a plane or in space.
    pub(super) fn of(points: &[Point], up: Point) -> Option<View> {
        let [(most, _), (middle, _), (least, normal)] = principal(points);
        let is_nothing = |extent: f64| extent <= FLAT * most;
        if !is_nothing(least) {
            return Some(View::spatial(up));
        }
        (!is_nothing(middle)).then(|| View::across(normal, up))
    }

    /// Of any points. Of axes those of turns, then those of slides.
    pub(super) fn new(points: &[Point], [turns, slides]: [&[Point]; 2], up: Point) -> View {
        if let Some(view) = View::of(points, up) {
            return view;
        }
        let [(most, along), ..] = principal(points);
        if most == 0.0 {
            return View::spatial(up);
        }
        // All stand on a line.
        let score = |n: &Point| {
            let seen = |axes: &[Point]| axes.iter().map(|&axis| dot(axis, *n).abs()).sum::<f64>();
            seen(turns) - seen(slides)
        };
        let mut candidates: Vec<Point> = AXES.into_iter().filter(|&n| dot(n, along).abs() < 0.9).collect();
        // Of equal ones the front, which is the last axis but the one that points up.
        candidates.sort_by(|a, b| score(b).total_cmp(&score(a)));
        let best = candidates.first().copied().unwrap_or(AXES[2]);
        let front = front(up);
        let is_as_good = dot(front, along).abs() < 0.9 && score(&front) >= score(&best) - 1e-9;
        View::across(if is_as_good { front } else { best }, up)
    }

    /// A plane as it is on paper: upwards what is up, its coordinates to the right.
    fn across(normal: Point, up: Point) -> View {
        let upright = |up: Point| {
            let rest = sub(up, scale(dot(up, normal), normal));
            if dot(rest, rest) > 0.1 { unit(rest) } else { None }
        };
        let [x, y, z] = AXES;
        let up = [up, y, z, x].into_iter().find_map(upright).unwrap_or(up);
        let mut towards = normal;
        let mut right = cross(up, towards);
        let largest = right.into_iter().max_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap_or(1.0);
        if largest < 0.0 {
            (towards, right) = (scale(-1.0, towards), scale(-1.0, right));
        }
        View { right, up, towards }
    }

    /// From the front, the right and above; no symmetry of usual mechanisms puts two points onto each other.
    fn spatial(up: Point) -> View {
        let front = front(up);
        let side = cross(up, front);
        let towards = [0, 1, 2].map(|k| 0.8 * front[k] + 0.45 * side[k] + 0.4 * up[k]);
        let towards = unit(towards).unwrap_or(front);
        let up = unit(sub(up, scale(dot(up, towards), towards))).unwrap_or(up);
        View { right: cross(up, towards), up, towards }
    }

    /// On paper, in metres, and towards the reader.
    pub(super) fn project(&self, p: Point) -> [f64; 2] {
        [dot(self.right, p), dot(self.up, p)]
    }

    /// `+z`, or components.
    pub(super) fn from(&self) -> String {
        for (axis, name) in AXES.into_iter().zip(["x", "y", "z"]) {
            let along = dot(axis, self.towards);
            if along.abs() > 1.0 - 1e-9 {
                return format!("`{}{name}`", if along > 0.0 { '+' } else { '-' });
            }
        }
        let [x, y, z] = self.towards.map(|x| format!("{:.2}", if x.abs() < 0.005 { 0.0 } else { x }));
        format!("({x}, {y}, {z})")
    }
}

/// The side from which x points to the right.
fn front(up: Point) -> Point {
    let [x, y, _] = AXES;
    let right = if dot(up, x).abs() < 0.9 { x } else { y };
    unit(cross(right, up)).unwrap_or(AXES[2])
}

#[cfg(test)]
mod tests {
    use super::View;
    use crate::report::space::{AXES, Point, cross, dot};

    const X: Point = AXES[0];
    const Y: Point = AXES[1];
    const Z: Point = AXES[2];

    fn is_right_handed(view: &View) {
        assert!(dot(cross(view.right, view.up), view.towards) > 1.0 - 1e-12, "{view:?}");
    }

    #[test]
    fn planes_are_seen_as_on_paper() {
        let in_plane = |a: [f64; 3], b: [f64; 3], up| {
            let at = |s: f64, t: f64| [0, 1, 2].map(|k| s * a[k] + t * b[k]);
            let view = View::new(&[at(0.0, 0.0), at(3.0, 0.0), at(1.0, 1.0)], [&[], &[]], up);
            is_right_handed(&view);
            [view.project(a), view.project(b)].map(|p| p.map(f64::round))
        };
        let as_on_paper = [[1.0, 0.0], [0.0, 1.0]];
        assert_eq!(in_plane(X, Y, Y), as_on_paper);
        assert_eq!(in_plane(X, Z, Z), as_on_paper);
        assert_eq!(in_plane(Y, Z, Z), as_on_paper);
        // Seen from above.
        assert_eq!(in_plane(X, Y, Z), as_on_paper);
    }

    #[test]
    fn hinges_of_a_line_are_seen_as_circles() {
        let view = View::new(&[[0.0; 3], Y], [&[Z], &[X]], Y);
        assert_eq!((view.towards, view.right, view.up), (Z, X, Y));
        let view = View::new(&[[0.0; 3], Z], [&[X], &[]], Z);
        assert_eq!((view.towards, view.right), (X, Y));
    }

    #[test]
    fn space_is_seen_from_above() {
        for up in [X, Y, Z] {
            let view = View::new(&[[0.0; 3], X, Y, Z], [&[], &[]], up);
            is_right_handed(&view);
            assert!(dot(view.towards, up) > 0.2 && dot(view.up, up) > 0.5, "{view:?}");
        }
    }
}
