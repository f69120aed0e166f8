//! Stage `mechanics`: springs and dampers.
//!
//! In: a stretch and its rate. Out: force, power put into the mechanism, energy k x^2 / 2. Along a line of length
//! L = |d| the force on the far end is -(k (L - L0) + c L') d / L with L' = d . d' / L. With natural length zero it is
//! -(k + c L' / L) d, which needs no root, and no quotient either without a damper. Elsewhere L = 0 is a singular point:
//! the line has no direction there, and the force is not a number. Points that are one point in every position, or
//! wherever loops are closed (`analysis/springs`), have no line: nothing acts between them, and what is stored stays k L0^2 / 2.

use crate::mechanics::equations::Equations;
use crate::model::types::{Expr, ForceId};
use crate::symbolic::graph::{Graph, Scalar, Vector};

use super::build::FixedFrame;
use super::functions::length;

/// On one coordinate.
pub(in crate::mechanics) struct JointSpring {
    pub stiffness: Scalar,
    pub damping: Scalar,
    pub stretch: Scalar,
    pub rate: Scalar,
}

impl JointSpring {
    pub(in crate::mechanics) fn effort(&self, g: &mut Graph) -> Scalar {
        let (elastic, viscous) = (g.mul(self.stiffness, self.stretch), g.mul(self.damping, self.rate));
        -g.add(elastic, viscous)
    }

    pub(in crate::mechanics) fn energy(&self, g: &mut Graph) -> Scalar {
        let half = g.decimal(0.5);
        g.product(&[half, self.stiffness, self.stretch, self.stretch])
    }
}

/// Between two points.
pub(in crate::mechanics) struct LineSpring {
    stiffness: Scalar,
    damping: Scalar,
    natural: Scalar,
    /// From the first end to the second.
    way: Vector,
    /// Zero without a damper.
    way_rate: Vector,
    /// The link whose axes these are in.
    pub axes: Option<usize>,
}

impl Equations<'_> {
    /// `data`: stiffness, damping, natural length.
    pub(in crate::mechanics) fn line_spring(
        &mut self,
        id: ForceId,
        ends: &[FixedFrame; 2],
        data: [&Option<Expr>; 3],
    ) -> LineSpring {
        let [stiffness, damping, natural] = self.optional(data);
        let ([way, way_rate], axes) = match self.scene.structure.meeting.contains(&id) {
            true => ([Vector::ZERO; 2], None),
            false => self.way(&ends[0], &ends[1], 1),
        };
        LineSpring { stiffness, damping, natural, way, way_rate, axes }
    }
}

impl LineSpring {
    /// L^2 and d . d'
    fn products(&self, g: &mut Graph) -> (Scalar, Scalar) {
        (g.dot(self.way, self.way), g.dot(self.way, self.way_rate))
    }

    /// On the second end; the first feels the opposite.
    pub(in crate::mechanics) fn force(&self, g: &mut Graph) -> Vector {
        let coefficient = self.coefficient(g);
        -g.scale(coefficient, self.way)
    }

    /// Force per vector d.
    fn coefficient(&self, g: &mut Graph) -> Scalar {
        if self.way == Vector::ZERO {
            return Scalar::ZERO;
        }
        if self.damping == Scalar::ZERO && self.natural == Scalar::ZERO {
            return self.stiffness;
        }
        let (square, product) = self.products(g);
        if self.natural == Scalar::ZERO || self.stiffness == Scalar::ZERO {
            let viscous = g.mul(self.damping, product);
            let viscous = g.div(viscous, square);
            return g.add(self.stiffness, viscous);
        }
        let root = length(g, square);
        let inverse = g.reciprocal(root);
        let stretch = g.sub(root, self.natural);
        let elastic = g.mul(self.stiffness, stretch);
        let viscous = g.product(&[self.damping, product, inverse]);
        let tension = g.add(elastic, viscous);
        g.mul(tension, inverse)
    }

    pub(super) fn power(&self, g: &mut Graph) -> Scalar {
        let coefficient = self.coefficient(g);
        let (_, product) = self.products(g);
        -g.mul(coefficient, product)
    }

    pub(in crate::mechanics) fn energy(&self, g: &mut Graph) -> Scalar {
        if self.stiffness == Scalar::ZERO {
            return Scalar::ZERO;
        }
        let half = g.decimal(0.5);
        let square = g.dot(self.way, self.way);
        if self.natural == Scalar::ZERO {
            return g.product(&[half, self.stiffness, square]);
        }
        let root = length(g, square);
        let stretch = g.sub(root, self.natural);
        g.product(&[half, self.stiffness, stretch, stretch])
    }
}
