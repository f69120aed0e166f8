//! Stage `solve`: what is measured between two groups of joints.
//!
//! In: features of a group on the left (far) and of one on the right (near), in the frames on either side of at most one
//! unknown motion between them. Out: [`Form`]s, one for each thing that the two groups leave free: product of
//! directions, distance of points, distance of a point from a plane, moment of two lines, distance of a point from a
//! line. All but the last are linear in cosine and sine of a turning motion.

use crate::dynamics::tree::Motion;
use crate::symbolic::graph::{Graph, Scalar, Vector};

use super::chain::{Kind, Link, Side};
use super::elements::{Features, Seen};

/// one + cos * cos(x) + sin * sin(x) + travel * x + square * x^2
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Form {
    pub(super) one: Scalar,
    pub(super) cos: Scalar,
    pub(super) sin: Scalar,
    pub(super) travel: Scalar,
    pub(super) square: Scalar,
}

impl Form {
    pub(super) fn constant(one: Scalar) -> Form {
        let zero = Scalar::ZERO;
        Form { one, cos: zero, sin: zero, travel: zero, square: zero }
    }

    fn zip(self, other: Form, mut f: impl FnMut(Scalar, Scalar) -> Scalar) -> Form {
        Form {
            one: f(self.one, other.one),
            cos: f(self.cos, other.cos),
            sin: f(self.sin, other.sin),
            travel: f(self.travel, other.travel),
            square: f(self.square, other.square),
        }
    }

    pub(super) fn sub(self, g: &mut Graph, other: Form) -> Form {
        self.zip(other, |a, b| g.sub(a, b))
    }

    /// Whether the unknown doesn't occur.
    pub(super) fn is_constant(&self) -> bool {
        [self.cos, self.sin, self.travel, self.square] == [Scalar::ZERO; 4]
    }

    pub(super) fn turns(&self) -> bool {
        [self.cos, self.sin] != [Scalar::ZERO; 2]
    }
}

/// Features in the coordinates of one frame; what didn't get there is missing.
#[derive(Clone, Debug)]
pub(super) struct View {
    point: Option<Vector>,
    lines: Vec<Option<(Vector, Vector)>>,
    planes: Vec<Option<(Vector, Vector)>>,
    directions: Vec<Option<Vector>>,
}

impl View {
    /// On one side of the group.
    pub(super) fn new(features: &Features, side: Side) -> View {
        let pick = |seen: Seen| if side == Side::Left { seen.left } else { seen.right };
        let flat = |&(p, d): &super::elements::Flat| Some((pick(p), pick(d)));
        View {
            point: features.point.map(pick),
            lines: features.lines.iter().map(flat).collect(),
            planes: features.planes.iter().map(flat).collect(),
            directions: features.directions.iter().map(|&d| Some(pick(d))).collect(),
        }
    }

    /// On the other side of a link.
    pub(super) fn carry(&self, g: &mut Graph, link: Link, way: Side) -> View {
        let mut flat = |item: &Option<(Vector, Vector)>| {
            let (p, d) = (*item)?;
            Some((link.carry(g, way, Kind::Point, p)?, link.carry(g, way, Kind::Direction, d)?))
        };
        let lines = self.lines.iter().map(&mut flat).collect();
        let planes = self.planes.iter().map(flat).collect();
        let point = self.point.and_then(|p| link.carry(g, way, Kind::Point, p));
        let directions = &self.directions;
        let directions = directions.iter().map(|&d| link.carry(g, way, Kind::Direction, d?)).collect();
        View { point, lines, planes, directions }
    }

    /// Through several links, given from left to right.
    pub(super) fn carry_all(&self, g: &mut Graph, links: &[Link], way: Side) -> View {
        let step = |view: View, link: &Link| view.carry(g, *link, way);
        match way {
            Side::Left => links.iter().rev().fold(self.clone(), step),
            Side::Right => links.iter().fold(self.clone(), step),
        }
    }

    /// Whether nothing has got here.
    pub(super) fn is_empty(&self) -> bool {
        self.point.is_none()
            && self.lines.iter().chain(&self.planes).all(Option::is_none)
            && self.directions.iter().all(Option::is_none)
    }

    /// Points and directions with their numbers.
    pub(super) fn point(&self) -> Option<Vector> {
        self.point
    }

    pub(super) fn directions(&self) -> &[Option<Vector>] {
        &self.directions
    }
}

/// far . R near + rest, with an orientation R between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Product {
    pub(super) far: Vector,
    pub(super) near: Vector,
    pub(super) rest: Scalar,
}

/// Something measured, by the numbers of the features on the far and on the near side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Measure {
    Directions(usize, usize),
    Points,
    /// The plane belongs to the far side.
    FarPlane(usize),
    NearPlane(usize),
    /// A plane of the far side and a flat of the near side that it holds.
    PlanePlane(usize, usize),
    FarPlaneLine(usize, usize),
    NearPlaneLine(usize, usize),
    Lines(usize, usize),
    /// The line belongs to the far side.
    FarLine(usize),
    NearLine(usize),
    ParallelLines(usize, usize),
}

impl Measure {
    /// What two groups have between them.
    pub(super) fn all(far: &Features, near: &Features) -> Vec<Measure> {
        let mut list = Vec::new();
        let pairs = |a: usize, b: usize| (0..a).flat_map(move |i| (0..b).map(move |j| (i, j)));
        list.extend(pairs(far.directions.len(), near.directions.len()).map(|(i, j)| Measure::Directions(i, j)));
        if near.point.is_some() {
            list.extend((0..far.planes.len()).map(Measure::FarPlane));
        }
        if far.point.is_some() {
            list.extend((0..near.planes.len()).map(Measure::NearPlane));
        }
        if far.point.is_none() && near.point.is_none() {
            list.extend(pairs(far.planes.len(), near.planes.len()).map(|(i, j)| Measure::PlanePlane(i, j)));
            list.extend(pairs(far.planes.len(), near.lines.len()).map(|(i, j)| Measure::FarPlaneLine(i, j)));
            list.extend(pairs(far.lines.len(), near.planes.len()).map(|(i, j)| Measure::NearPlaneLine(i, j)));
            list.extend(pairs(far.lines.len(), near.lines.len()).map(|(i, j)| Measure::ParallelLines(i, j)));
        }
        list.extend(pairs(far.lines.len(), near.lines.len()).map(|(i, j)| Measure::Lines(i, j)));
        match (far.point, near.point) {
            (Some(_), Some(_)) => list.push(Measure::Points),
            (None, Some(_)) => list.extend((0..far.lines.len()).map(Measure::FarLine)),
            (Some(_), None) => list.extend((0..near.lines.len()).map(Measure::NearLine)),
            (None, None) => {}
        }
        list
    }

    /// What it is, for the report.
    pub(super) fn describe(self) -> &'static str {
        match self {
            Measure::Directions(..) => "angle of two directions",
            Measure::Points => "distance of two points",
            Measure::FarPlane(_) | Measure::NearPlane(_) => "distance of a point from a plane",
            Measure::PlanePlane(..) | Measure::FarPlaneLine(..) | Measure::NearPlaneLine(..) => {
                "distance along a common normal"
            }
            Measure::Lines(..) => "moment of two lines",
            Measure::FarLine(_) | Measure::NearLine(_) => "distance of a point from a line",
            Measure::ParallelLines(..) => "distance of two parallel lines",
        }
    }

    /// Its value across an orientation about a point, where that is one product.
    pub(super) fn product(self, g: &mut Graph, far: &View, centre: Seen, near: &View) -> Option<Product> {
        let product = match self {
            Measure::Directions(i, j) => {
                Product { far: far.directions[i]?, near: near.directions[j]?, rest: Scalar::ZERO }
            }
            Measure::Points => {
                let (v, w) = (g.sub_vectors(far.point?, centre.left), g.sub_vectors(near.point?, centre.right));
                let half = g.decimal(0.5);
                let squares = [v, w].map(|v| g.dot(v, v));
                let sum = g.sum(&squares);
                Product { far: -v, near: w, rest: g.mul(half, sum) }
            }
            Measure::FarPlane(i) => {
                let (p, n) = far.planes[i]?;
                let (p, w) = (g.sub_vectors(p, centre.left), g.sub_vectors(near.point?, centre.right));
                Product { far: n, near: w, rest: -g.dot(n, p) }
            }
            Measure::NearPlane(j) => {
                let (p, n) = near.planes[j]?;
                let (v, p) = (g.sub_vectors(far.point?, centre.left), g.sub_vectors(p, centre.right));
                Product { far: -v, near: n, rest: g.dot(n, p) }
            }
            _ => return None,
        };
        (product.far != Vector::ZERO && product.near != Vector::ZERO).then_some(product)
    }

    /// Its value across a motion, or across none.
    pub(super) fn value(self, g: &mut Graph, far: &View, motion: Option<Motion>, near: &View) -> Option<Form> {
        let across = Across { motion };
        match self {
            Measure::Directions(i, j) => Some(across.turned(g, far.directions[i]?, near.directions[j]?)),
            Measure::Points => across.distance(g, far.point?, near.point?),
            Measure::FarPlane(i) => {
                let (p, n) = far.planes[i]?;
                Some(across.along_far(g, n, p, near.point?))
            }
            Measure::NearPlane(j) => {
                let (p, n) = near.planes[j]?;
                Some(across.along_near(g, n, far.point?, p))
            }
            Measure::PlanePlane(i, j) => {
                let ((p, n), (q, m)) = (far.planes[i]?, near.planes[j]?);
                across.agree(g, n, m)?;
                Some(across.along_far(g, n, p, q))
            }
            Measure::FarPlaneLine(i, j) => {
                let ((p, n), (q, d)) = (far.planes[i]?, near.lines[j]?);
                (across.turned(g, n, d) == Form::constant(Scalar::ZERO)).then(|| across.along_far(g, n, p, q))
            }
            Measure::NearPlaneLine(i, j) => {
                let ((p, d), (q, n)) = (far.lines[i]?, near.planes[j]?);
                (across.turned(g, d, n) == Form::constant(Scalar::ZERO)).then(|| across.along_near(g, n, p, q))
            }
            Measure::Lines(i, j) => across.moment(g, far.lines[i]?, near.lines[j]?),
            Measure::FarLine(i) => {
                let (p, d) = far.lines[i]?;
                let along = across.along_far(g, d, p, near.point?);
                across.beside(g, p, near.point?, d, along)
            }
            Measure::NearLine(j) => {
                let (p, d) = near.lines[j]?;
                let along = across.along_near(g, d, far.point?, p);
                across.beside(g, far.point?, p, d, along)
            }
            Measure::ParallelLines(i, j) => {
                let ((p, d), (q, e)) = (far.lines[i]?, near.lines[j]?);
                across.agree(g, d, e)?;
                let along = across.along_far(g, d, p, q);
                across.beside(g, p, q, d, along)
            }
        }
    }
}

/// A motion between the far frame (left) and the near frame (right).
pub(super) struct Across {
    pub(super) motion: Option<Motion>,
}

impl Across {
    /// far . R near
    pub(super) fn turned(&self, g: &mut Graph, far: Vector, near: Vector) -> Form {
        let axis = match self.motion {
            Some(Motion::Revolute(axis) | Motion::Screw(axis, _)) => axis,
            _ => return Form::constant(g.dot(far, near)),
        };
        let (u, w) = (g.components(far), g.components(near));
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut product = |a: usize, b: usize| g.mul(u[a], w[b]);
        let (one, ii, jj, ji, ij) = (product(axis, axis), product(i, i), product(j, j), product(j, i), product(i, j));
        Form { one, cos: g.add(ii, jj), sin: g.sub(ji, ij), travel: Scalar::ZERO, square: Scalar::ZERO }
    }

    /// Component along the motion's axis of a direction, times the travel of one unit of the coordinate.
    fn travel(&self, g: &mut Graph, d: Vector) -> Scalar {
        match self.motion {
            Some(Motion::Prismatic(axis)) => g.component(d, axis),
            Some(Motion::Screw(axis, pitch)) => {
                let along = g.component(d, axis);
                g.mul(pitch, along)
            }
            Some(Motion::Revolute(_) | Motion::Ball(_)) | None => Scalar::ZERO,
        }
    }

    /// n . (near - far) with n known on the far side.
    pub(super) fn along_far(&self, g: &mut Graph, n: Vector, far: Vector, near: Vector) -> Form {
        let mut form = self.turned(g, n, near);
        form.travel = self.travel(g, n);
        let back = g.dot(n, far);
        form.one = g.sub(form.one, back);
        form
    }

    /// n . (near - far) with n known on the near side.
    pub(super) fn along_near(&self, g: &mut Graph, n: Vector, far: Vector, near: Vector) -> Form {
        let mut form = Form::constant(g.dot(n, near));
        let back = self.turned(g, far, n);
        form = form.sub(g, back);
        form.travel = self.travel(g, n);
        form
    }

    /// Half the square of the distance, since it is the products that one half leaves without a factor.
    fn distance(&self, g: &mut Graph, far: Vector, near: Vector) -> Option<Form> {
        let half = g.decimal(0.5);
        if self.motion.is_none() {
            let apart = g.sub_vectors(near, far);
            let square = g.dot(apart, apart);
            return Some(Form::constant(g.mul(half, square)));
        }
        if let Some(Motion::Prismatic(axis)) = self.motion {
            let apart = g.sub_vectors(near, far);
            let square = square(g, apart);
            let one = g.mul(half, square);
            return Some(Form { travel: g.component(apart, axis), square: half, ..Form::constant(one) });
        }
        let squares = [far, near].map(|v| {
            let square = square(g, v);
            g.mul(half, square)
        });
        let together = Form::constant(g.sum(&squares));
        let product = self.turned(g, far, near);
        let mut form = together.sub(g, product);
        if let Some(Motion::Screw(_, pitch)) = self.motion {
            let apart = g.sub_vectors(near, far);
            form.travel = self.travel(g, apart);
            form.square = g.product(&[half, pitch, pitch]);
        }
        Some(form)
    }

    /// Half the square of what is left of the distance without its part along a unit vector.
    fn beside(&self, g: &mut Graph, far: Vector, near: Vector, d: Vector, along: Form) -> Option<Form> {
        if along.turns() || along.square != Scalar::ZERO {
            return None;
        }
        let whole = self.distance(g, far, near)?;
        let half = g.decimal(0.5);
        let unit = g.dot(d, d);
        let scale = g.reciprocal(unit);
        let mut term = |factors: &[Scalar]| {
            let product = g.product(factors);
            g.mul(product, scale)
        };
        let mut part = Form::constant(term(&[half, along.one, along.one]));
        part.travel = term(&[along.one, along.travel]);
        part.square = term(&[half, along.travel, along.travel]);
        Some(whole.sub(g, part))
    }

    /// (near - far) . (far direction x near direction): what stays when the points slide along the lines.
    fn moment(&self, g: &mut Graph, far: (Vector, Vector), near: (Vector, Vector)) -> Option<Form> {
        let ((p, d), (q, e)) = (far, near);
        let (lever, other) = (g.cross(e, q), g.cross(p, d));
        let first = self.turned(g, d, lever);
        let second = self.turned(g, other, e);
        let mut form = first.sub(g, second);
        // axis . (d x R e) = (axis x d) . R e
        let (axis, scale) = match self.motion {
            Some(Motion::Prismatic(axis)) => (axis, Scalar::ONE),
            Some(Motion::Screw(axis, pitch)) => (axis, pitch),
            _ => return Some(form),
        };
        let unit = super::chain::unit(g, axis);
        let across = g.cross(unit, d);
        let rate = self.turned(g, across, e);
        if rate.turns() {
            return None;
        }
        form.travel = g.mul(scale, rate.one);
        Some(form)
    }

    /// Whether a direction of the far side is one of the near side too, whatever the motion does.
    fn agree(&self, g: &mut Graph, far: Vector, near: Vector) -> Option<()> {
        let same = match self.motion {
            Some(Motion::Revolute(axis) | Motion::Screw(axis, _)) => {
                super::chain::is_along(g, far, axis) && super::chain::is_along(g, near, axis)
            }
            _ => super::elements::parallel(g, far, near),
        };
        same.then_some(())
    }
}

/// Of a vector of which components are asked for beside it: a product of vectors may be taken in other axes, and would need those there too.
fn square(g: &mut Graph, v: Vector) -> Scalar {
    let squares = g.components(v).map(|x| g.mul(x, x));
    g.sum(&squares)
}

#[cfg(test)]
mod tests {
    use super::Across;
    use crate::dynamics::tree::Motion;
    use crate::symbolic::graph::{Graph, Scalar};

    /// A turn about an axis keeps a direction if it is the axis, on both sides.
    #[test]
    fn directions_agree_across_a_turn_where_both_are_its_axis() {
        let mut g = Graph::new();
        let [x, z] = [[1, 0, 0], [0, 0, 1]].map(|v| {
            let v = v.map(|n| g.integer(n));
            g.vector(v)
        });
        let agree = |g: &mut Graph, motion, far, near| Across { motion }.agree(g, far, near).is_some();
        for motion in [Motion::Revolute(2), Motion::Screw(2, Scalar::ONE)].map(Some) {
            assert!(agree(&mut g, motion, z, z));
            assert!(!agree(&mut g, motion, z, x) && !agree(&mut g, motion, x, z) && !agree(&mut g, motion, x, x));
        }
        assert!(agree(&mut g, None, x, x) && !agree(&mut g, None, x, z));
    }
}
