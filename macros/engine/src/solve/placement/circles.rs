//! Stage `solve`: a body three points of which have two distances each, and therefore lie on circles.
//!
//! The point on circle j is V_j = m_j + r_j (e_j cos + f_j sin), so the distance of two of them is bilinear in their points z = (cos, sin,
//! 1). With the first point z_1 given, as a symbol, the distance from the second leaves a line A cos + B sin + C = 0 for z_2, and the one
//! from the third a line for z_3, whose coefficients are linear in z_1. The distance of the second and the third is another line for z_3, with coefficients
//! linear in z_2. Both lines for z_3 meet on the circle where X^2 + Y^2 = D^2 (Cramer), which is a conic G(z_2) = 0, quadratic in z_1 too.
//!
//! The condition is that one of the two points where the line of z_2 meets the circle lies on the conic: the product of G at both. With z
//! = cos + i sin, a = A + i B and W = A^2 + B^2 these points are a (-C +- i sqrt(W - C^2)) / W; with G = g0 + 2 Re(g1 z + g2 z^2), h1 = g1 a
//! and h2 = g2 a^2 the product times W^2 is
//!
//! (g0 W - 2 C Re h1 - 2 Re h2)^2 - 4 (W - C^2) (Im h1)^2 + 16 C Im h1 Im h2 + 8 C^2 g0 Re h2 - 16 C^3 Re(conj(g1) g2 a) - 16 C^2 (W - C^2) |g2|^2,
//!
//! in which all divisions have cancelled: of degree 8 in cosine and sine of z_1, as the robot has 16 modes. The points z_2 and z_3 of a mode lie where their
//! lines meet the circle, on one side or on the other: in a symmetric robot several modes have the same z_1.

use crate::contracts::call::Call;
use crate::symbolic::graph::{Graph, Scalar, Vector};

use super::spheres::plane;
use super::{Alternative, Distance, Pose, beside, unit_of};

/// Where two distances leave a point.
struct Circle {
    centre: Vector,
    radius: Scalar,
    square: Scalar,
    axes: [Vector; 2],
}

/// a cos + b sin + c = 0
pub(super) type Line = [Scalar; 3];

pub(super) fn pose(g: &mut Graph, groups: &[Vec<Distance>], at: &Alternative) -> Option<Pose> {
    let [first, second, third] = groups else { return None };
    let body = [first, second, third].map(|group| group[0].body);
    let [one, two, three] = [first, second, third].map(|group| Circle::new(g, group));
    let (one, two, three) = (one?, two?, three?);
    let apart = |g: &mut Graph, a: usize, b: usize| {
        let between = g.sub_vectors(body[a], body[b]);
        g.dot(between, between)
    };
    let there = one.point(g, at.point);
    let [own, across, last] = [(0, 1), (0, 2), (1, 2)].map(|(a, b)| apart(g, a, b));
    let line = two.line(g, there, own);
    let near = three.line(g, there, across);
    // The line for z_3 from z_2, as three vectors: by cosine, by sine, and alone.
    let far = three.line_from(g, &two, last);
    // X, Y and D, linear in z_2.
    let minor = |g: &mut Graph, i: usize, j: usize| {
        far.map(|far| {
            let (x, y) = (g.mul(near[i], far[j]), g.mul(near[j], far[i]));
            g.sub(x, y)
        })
    };
    let [x, y, d] = [minor(g, 1, 2), minor(g, 2, 0), minor(g, 0, 1)];
    // The conic's matrix.
    let entry = |g: &mut Graph, i: usize, j: usize| {
        let terms = [g.mul(x[i], x[j]), g.mul(y[i], y[j]), -g.mul(d[i], d[j])];
        g.sum(&terms)
    };
    let [m00, m01, m02, m11, m12, m22] = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)].map(|(i, j)| entry(g, i, j));
    let [half, quarter] = [0.5, 0.25].map(|x| g.decimal(x));
    let (sum, difference) = (g.add(m00, m11), g.sub(m00, m11));
    let mean = g.mul(half, sum);
    let g0 = g.add(mean, m22);
    let g1 = [m02, -m12];
    let g2 = [g.mul(quarter, difference), -g.mul(half, m01)];
    let a = [line[0], line[1]];
    let c = line[2];
    let w = length(g, a);
    let h1 = product(g, g1, a);
    let turned = product(g, g2, a);
    let h2 = product(g, turned, a);
    let cross = product(g, [g1[0], -g1[1]], turned)[0];
    let c2 = g.mul(c, c);
    let gap = g.sub(w, c2);
    let condition = {
        let [two, four, eight, sixteen] = [2, 4, 8, 16].map(|n| g.integer(n));
        let terms = [g.mul(g0, w), -g.product(&[two, c, h1[0]]), -g.mul(two, h2[0])];
        let whole = g.sum(&terms);
        let size = length(g, g2);
        let terms = [
            g.mul(whole, whole),
            -g.product(&[four, gap, h1[1], h1[1]]),
            g.product(&[sixteen, c, h1[1], h2[1]]),
            g.product(&[eight, c2, g0, h2[0]]),
            -g.product(&[sixteen, c2, c, cross]),
            -g.product(&[sixteen, c2, gap, size]),
        ];
        g.sum(&terms)
    };
    let z2 = meeting(g, line, at.sides[0]);
    // Two lines for z_3, of which one may say nothing.
    let far = [0, 1, 2].map(|k| {
        let terms = [g.mul(far[0][k], z2[0]), g.mul(far[1][k], z2[1]), far[2][k]];
        g.sum(&terms)
    });
    let line = clearer(g, near, far);
    let z3 = meeting(g, line, at.sides[1]);
    let points = [there, two.point(g, z2), three.point(g, z3)];
    Some(Pose::of_points(g, body, points, Some(condition)))
}

impl Circle {
    /// About the line through both centres. Its angle begins anywhere.
    fn new(g: &mut Graph, pair: &[Distance]) -> Option<Circle> {
        let [a, b] = pair else { return None };
        let (axis, place) = plane(g, (a.base, a.square), (b.base, b.square));
        let length = g.dot(axis, axis);
        let inverse = g.reciprocal(length);
        let share = g.mul(place, inverse);
        let way = g.scale(share, axis);
        let part = g.mul(place, share);
        let square = g.sub(a.square, part);
        let (along, _) = unit_of(g, axis);
        let normal = beside(g, along);
        let (first, _) = unit_of(g, normal);
        let axes = [first, g.cross(along, first)];
        Some(Circle { centre: g.add_vectors(a.base, way), radius: g.sqrt(square), square, axes })
    }

    fn point(&self, g: &mut Graph, [cos, sin]: [Scalar; 2]) -> Vector {
        let [x, y] = [cos, sin].map(|s| g.mul(self.radius, s));
        let [x, y] = [(x, self.axes[0]), (y, self.axes[1])].map(|(s, v)| g.scale(s, v));
        g.sum_vectors(&[self.centre, x, y])
    }

    /// Points of the circle at a distance from one that is known.
    fn line(&self, g: &mut Graph, from: Vector, square: Scalar) -> Line {
        let way = g.sub_vectors(from, self.centre);
        let scale = g.integer(2);
        let scale = g.mul(scale, self.radius);
        let [a, b] = self.axes.map(|axis| {
            let along = g.dot(way, axis);
            g.mul(scale, along)
        });
        let far = g.dot(way, way);
        [a, b, g.sum(&[square, -self.square, -far])]
    }

    /// The same from a point of another circle, linear in its place there: coefficients of its cosine, of its sine, and alone.
    fn line_from(&self, g: &mut Graph, other: &Circle, square: Scalar) -> [Line; 3] {
        let way = g.sub_vectors(other.centre, self.centre);
        let two = g.integer(2);
        let scale = g.mul(two, self.radius);
        let both = g.mul(scale, other.radius);
        let moved = other.axes.map(|axis| {
            let [a, b] = self.axes.map(|own| {
                let along = g.dot(axis, own);
                g.mul(both, along)
            });
            let along = g.dot(way, axis);
            [a, b, -g.product(&[two, other.radius, along])]
        });
        let [a, b] = self.axes.map(|own| {
            let along = g.dot(way, own);
            g.mul(scale, along)
        });
        let far = g.dot(way, way);
        let alone = [a, b, g.sum(&[square, -self.square, -other.square, -far])];
        [moved[0], moved[1], alone]
    }
}

/// Where a line meets the unit circle. Rounding leaves less than nothing of the root where it touches.
pub(super) fn meeting(g: &mut Graph, [a, b, c]: Line, side: Scalar) -> [Scalar; 2] {
    let w = length(g, [a, b]);
    let square = g.mul(c, c);
    let gap = g.sub(w, square);
    let gap = g.call(Call::Max, &[gap, Scalar::ZERO]);
    let root = g.sqrt(gap);
    let root = g.mul(side, root);
    let inverse = g.reciprocal(w);
    product(g, [a, b], [-c, root]).map(|x| g.mul(x, inverse))
}

/// Of two lines the one with the greater coefficients of cosine and sine.
pub(super) fn clearer(g: &mut Graph, one: Line, other: Line) -> Line {
    let [size, its] = [one, other].map(|line| length(g, [line[0], line[1]]));
    let less = g.call(Call::Less, &[size, its]);
    [0, 1, 2].map(|k| g.call(Call::Select, &[less, other[k], one[k]]))
}

/// The product of two complex numbers.
fn product(g: &mut Graph, [a, b]: [Scalar; 2], [c, d]: [Scalar; 2]) -> [Scalar; 2] {
    let (ac, bd, bc, ad) = (g.mul(a, c), g.mul(b, d), g.mul(b, c), g.mul(a, d));
    [g.sub(ac, bd), g.add(bc, ad)]
}

/// The square of its size.
fn length(g: &mut Graph, z: [Scalar; 2]) -> Scalar {
    let squares = z.map(|x| g.mul(x, x));
    g.sum(&squares)
}
