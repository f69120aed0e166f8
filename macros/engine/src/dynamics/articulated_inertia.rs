//! Stage `dynamics`: what a body with others hinged to it feels like (Featherstone 2008, chapter 7).
//!
//! In: rigid inertias, eliminated freedoms. Out: an [`ArticulatedInertia`], the symmetric 6x6 matrix that maps the
//! acceleration (angular, linear) of a frame's origin to the moment and the force that cause it, in blocks
//! (J, H; H^T, M). Eliminating a freedom empties a row and a column; the graph knows that, so that planar mechanisms
//! never have more than three rows.

use crate::symbolic::graph::{Graph, Rotation, RotationNode, Scalar};

use super::inertia::{Inertia, entry};

/// J and M stand as xx, yy, zz, xy, xz, yz.
#[derive(Clone, Copy, Debug)]
pub struct ArticulatedInertia {
    /// Angular acceleration to moment.
    angular: [Scalar; 6],
    /// Linear acceleration to moment, row by row.
    mixed: [[Scalar; 3]; 3],
    /// Linear acceleration to force.
    linear: [Scalar; 6],
}

impl ArticulatedInertia {
    pub const ZERO: ArticulatedInertia =
        ArticulatedInertia { angular: [Scalar::ZERO; 6], mixed: [[Scalar::ZERO; 3]; 3], linear: [Scalar::ZERO; 6] };

    /// Of a body alone: J = tr(D) 1 - D, H = [m c x], M = m 1.
    pub fn rigid(g: &mut Graph, inertia: &Inertia) -> Self {
        let mut result = ArticulatedInertia::ZERO;
        for i in 0..3 {
            for j in i..3 {
                result.angular[entry(i, j)] = inertia.tensor(g, i, j);
            }
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            result.mixed[j][k] = -inertia.first[i];
            result.mixed[k][j] = inertia.first[i];
            result.linear[i] = inertia.mass;
        }
        result
    }

    /// From the 21 independent entries: J, H row by row, M.
    pub fn from_entries(entries: [Scalar; 21]) -> Self {
        ArticulatedInertia {
            angular: std::array::from_fn(|k| entries[k]),
            mixed: std::array::from_fn(|i| std::array::from_fn(|j| entries[6 + 3 * i + j])),
            linear: std::array::from_fn(|k| entries[15 + k]),
        }
    }

    /// In the order of [`Self::from_entries`].
    pub fn entries(&self) -> Vec<Scalar> {
        self.angular.iter().chain(self.mixed.iter().flatten()).chain(&self.linear).copied().collect()
    }

    fn combine(&self, other: &Self, mut f: impl FnMut(Scalar, Scalar) -> Scalar) -> Self {
        ArticulatedInertia {
            angular: std::array::from_fn(|k| f(self.angular[k], other.angular[k])),
            mixed: std::array::from_fn(|i| std::array::from_fn(|j| f(self.mixed[i][j], other.mixed[i][j]))),
            linear: std::array::from_fn(|k| f(self.linear[k], other.linear[k])),
        }
    }

    pub fn add(&self, g: &mut Graph, other: &Self) -> Self {
        self.combine(other, |a, b| g.add(a, b))
    }

    /// Moment and force for an acceleration.
    pub fn apply(&self, g: &mut Graph, twist: &[Scalar; 6]) -> [Scalar; 6] {
        std::array::from_fn(|row| {
            let terms: [Scalar; 6] = std::array::from_fn(|column| {
                let e = self.at(row, column);
                g.mul(e, twist[column])
            });
            g.sum(&terms)
        })
    }

    /// Entry of the 6x6 matrix.
    fn at(&self, row: usize, column: usize) -> Scalar {
        match (row < 3, column < 3) {
            (true, true) => self.angular[entry(row, column)],
            (true, false) => self.mixed[row][column - 3],
            (false, true) => self.mixed[column][row - 3],
            (false, false) => self.linear[entry(row - 3, column - 3)],
        }
    }

    /// Minus the symmetric product of a column and the same column over its pivot.
    pub fn less(&self, g: &mut Graph, column: &[Scalar; 6], gain: &[Scalar; 6]) -> Self {
        let mut product = |i: usize, j: usize| g.mul(column[i], gain[j]);
        let mut felt = ArticulatedInertia {
            angular: [Scalar::ZERO; 6],
            mixed: std::array::from_fn(|i| std::array::from_fn(|j| product(i, j + 3))),
            linear: [Scalar::ZERO; 6],
        };
        for i in 0..3 {
            for j in i..3 {
                felt.angular[entry(i, j)] = product(i, j);
                felt.linear[entry(i, j)] = product(i + 3, j + 3);
            }
        }
        self.combine(&felt, |a, b| g.sub(a, b))
    }

    /// Components in a frame that sees this one turned about a coordinate axis.
    pub fn turn(&self, g: &mut Graph, axis: usize, cos: Scalar, sin: Scalar) -> Self {
        let turn = Turn { axis, cos, sin };
        ArticulatedInertia {
            angular: turn.symmetric(g, &self.angular),
            mixed: turn.general(g, &self.mixed),
            linear: turn.symmetric(g, &self.linear),
        }
    }

    /// Components in a frame that sees this one turned. Most placements map a coordinate axis to a coordinate axis: they
    /// exchange and turn, which costs half of the two matrix products.
    pub fn rotate(&self, g: &mut Graph, r: Rotation) -> Self {
        if r == Rotation::IDENTITY {
            return *self;
        }
        if let &RotationNode::Product(a, b) = g.rotation_node(r) {
            let (first, second) = if r.is_transposed() { (a.transpose(), b.transpose()) } else { (b, a) };
            return self.rotate(g, first).rotate(g, second);
        }
        let rows = g.rotation_rows(r);
        for a in 0..3 {
            for b in 0..3 {
                if rows[b][a].positive() == Scalar::ONE {
                    let (a1, b1, b2) = ((a + 1) % 3, (b + 1) % 3, (b + 2) % 3);
                    let exchanged = self.exchange((a + 3 - b) % 3, b, rows[b][a].is_negative());
                    return exchanged.turn(g, b, rows[b1][a1], rows[b2][a1]);
                }
            }
        }
        ArticulatedInertia {
            angular: congruence_symmetric(g, r, &self.angular),
            mixed: congruence(g, r, &self.mixed),
            linear: congruence_symmetric(g, r, &self.linear),
        }
    }

    /// Axis i + step becomes axis i; with `mirrored`, `axis` and the one before it (cyclically) change sign.
    fn exchange(&self, step: usize, axis: usize, mirrored: bool) -> Self {
        let flipped = |i: usize| mirrored && (i == axis || i == (axis + 2) % 3);
        let sign = |i: usize, j: usize, s: Scalar| if flipped(i) == flipped(j) { s } else { -s };
        let from = |i: usize| (i + step) % 3;
        let mut result = *self;
        for i in 0..3 {
            for j in 0..3 {
                result.mixed[i][j] = sign(i, j, self.mixed[from(i)][from(j)]);
                result.angular[entry(i, j)] = sign(i, j, self.angular[entry(from(i), from(j))]);
                result.linear[entry(i, j)] = sign(i, j, self.linear[entry(from(i), from(j))]);
            }
        }
        result
    }

    /// About a point from which this frame's origin is at `p`: H' = H + [p x] M and J' = J + ([p x] H^T) + H' [p x]^T.
    pub fn shift(&self, g: &mut Graph, p: [Scalar; 3]) -> Self {
        let mut result = *self;
        for column in 0..3 {
            for i in 0..3 {
                let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                let plus = g.mul(p[j], self.linear[entry(k, column)]);
                let minus = g.mul(p[k], self.linear[entry(j, column)]);
                result.mixed[i][column] = g.sum(&[self.mixed[i][column], plus, -minus]);
            }
        }
        let (h, moved) = (&self.mixed, &result.mixed);
        for i in 0..3 {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            // The two halves of an entry share their factor.
            let (a, b) = (g.add(h[i][k], moved[i][k]), g.add(h[i][j], moved[i][j]));
            let (plus, minus) = (g.mul(p[j], a), g.mul(p[k], b));
            result.angular[i] = g.sum(&[self.angular[i], plus, -minus]);
            let across = g.sub(moved[i][i], h[j][j]);
            let terms = [g.mul(p[k], across), g.mul(p[j], h[j][k]), -g.mul(p[i], moved[i][k])];
            let e = entry(i, j);
            result.angular[e] = g.sum(&[self.angular[e], terms[0], terms[1], terms[2]]);
        }
        result
    }
}

/// Turning about a coordinate axis. In the turned plane the sum of a block's diagonal and the difference of its other two
/// entries stay; u = c (A - C) - s (B + B') serves all four: A and C become C + c u and A - c u, s u is added to B and B'.
struct Turn {
    axis: usize,
    cos: Scalar,
    sin: Scalar,
}

impl Turn {
    fn pair(&self, g: &mut Graph, x: Scalar, y: Scalar) -> (Scalar, Scalar) {
        let (cx, sy) = (g.mul(self.cos, x), g.mul(self.sin, y));
        let (sx, cy) = (g.mul(self.sin, x), g.mul(self.cos, y));
        (g.sub(cx, sy), g.add(sx, cy))
    }

    /// c u and s u
    fn change(&self, g: &mut Graph, difference: Scalar, sum: Scalar) -> (Scalar, Scalar) {
        let (cd, sb) = (g.mul(self.cos, difference), g.mul(self.sin, sum));
        let u = g.sub(cd, sb);
        (g.mul(self.cos, u), g.mul(self.sin, u))
    }

    fn symmetric(&self, g: &mut Graph, m: &[Scalar; 6]) -> [Scalar; 6] {
        let (i, j, k) = (self.axis, (self.axis + 1) % 3, (self.axis + 2) % 3);
        let (ij, ik, jk) = (entry(i, j), entry(i, k), entry(j, k));
        let mut result = *m;
        (result[ij], result[ik]) = self.pair(g, m[ij], m[ik]);
        let (difference, sum) = (g.sub(m[j], m[k]), g.add(m[jk], m[jk]));
        let (cu, su) = self.change(g, difference, sum);
        (result[j], result[k], result[jk]) = (g.add(m[k], cu), g.sub(m[j], cu), g.add(m[jk], su));
        result
    }

    fn general(&self, g: &mut Graph, m: &[[Scalar; 3]; 3]) -> [[Scalar; 3]; 3] {
        let (i, j, k) = (self.axis, (self.axis + 1) % 3, (self.axis + 2) % 3);
        let mut result = *m;
        (result[i][j], result[i][k]) = self.pair(g, m[i][j], m[i][k]);
        (result[j][i], result[k][i]) = self.pair(g, m[j][i], m[k][i]);
        let (difference, sum) = (g.sub(m[j][j], m[k][k]), g.add(m[j][k], m[k][j]));
        let (cu, su) = self.change(g, difference, sum);
        (result[j][j], result[k][k]) = (g.add(m[k][k], cu), g.sub(m[j][j], cu));
        (result[j][k], result[k][j]) = (g.add(m[j][k], su), g.add(m[k][j], su));
        result
    }
}

/// R X R^T, column by column, then row by row.
fn congruence(g: &mut Graph, r: Rotation, m: &[[Scalar; 3]; 3]) -> [[Scalar; 3]; 3] {
    let columns: [[Scalar; 3]; 3] = std::array::from_fn(|j| {
        let column = g.vector([m[0][j], m[1][j], m[2][j]]);
        let column = g.rotate(r, column);
        g.components(column)
    });
    std::array::from_fn(|i| {
        let row = g.vector([columns[0][i], columns[1][i], columns[2][i]]);
        let row = g.rotate(r, row);
        g.components(row)
    })
}

fn congruence_symmetric(g: &mut Graph, r: Rotation, m: &[Scalar; 6]) -> [Scalar; 6] {
    let full = std::array::from_fn(|i| std::array::from_fn(|j| m[entry(i, j)]));
    let rows = congruence(g, r, &full);
    let mut result = *m;
    for i in 0..3 {
        for j in i..3 {
            result[entry(i, j)] = rows[i][j];
        }
    }
    result
}
