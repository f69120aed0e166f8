//! Stage `symbolic`: what is known before run time.
//!
//! In: expressions; which symbols are parameters. Out: whether a scalar is made of parameters and literals alone. Results of
//! blocks are not looked into.

use super::graph::{AnyNode, Graph, RotationNode, Scalar, ScalarNode, SymbolId, Vector, VectorNode};

/// Which expressions are constants, found once for all that these are made of.
pub(super) struct Constants(Vec<bool>);

impl Constants {
    pub(super) fn of(g: &Graph, parameter: &dyn Fn(SymbolId) -> bool, roots: &[Scalar]) -> Constants {
        let mut scalars = vec![false; g.scalars.len()];
        let mut vectors = vec![false; g.vectors.len()];
        let mut rotations = vec![false; g.rotations.len()];
        for node in g.reachable(roots) {
            match node {
                AnyNode::Scalar(at) => {
                    let scalar = |s: &Scalar| scalars[s.index()];
                    let vector = |v: &Vector| vectors[v.index()];
                    scalars[at] = match &g.scalars[at] {
                        ScalarNode::Symbol(id) => parameter(*id),
                        ScalarNode::Component(v, _) => vector(v),
                        ScalarNode::Dot(a, b) => vector(a) && vector(b),
                        other => operands(other).is_some_and(|list| list.iter().all(scalar)),
                    };
                }
                AnyNode::Vector(at) => {
                    let scalar = |s: &Scalar| scalars[s.index()];
                    let vector = |v: &Vector| vectors[v.index()];
                    vectors[at] = match &g.vectors[at] {
                        VectorNode::Triple(list) => list.iter().all(scalar),
                        VectorNode::Sum(list) => list.iter().all(vector),
                        VectorNode::Scale(s, v) => scalar(s) && vector(v),
                        VectorNode::Cross(a, b) => vector(a) && vector(b),
                        VectorNode::Rotate(r, v) => rotations[r.index()] && vector(v),
                    };
                }
                AnyNode::Rotation(at) => {
                    let scalar = |s: &Scalar| scalars[s.index()];
                    rotations[at] = match &g.rotations[at] {
                        RotationNode::Identity => true,
                        RotationNode::Axis(_, angle) => scalar(angle),
                        RotationNode::Matrix(rows) => rows.iter().flatten().all(scalar),
                        RotationNode::Quaternion(list) => list.iter().all(scalar),
                        RotationNode::Product(a, b) => rotations[a.index()] && rotations[b.index()],
                    };
                }
            }
        }
        Constants(scalars)
    }

    /// Nodes that were made since are sums and products of those, and few.
    pub(super) fn holds(&self, g: &Graph, s: Scalar) -> bool {
        match self.0.get(s.index()) {
            Some(true) => true,
            Some(false) => matches!(g.node(s), ScalarNode::Literal(_)),
            None => operands(g.node(s)).is_some_and(|list| list.iter().all(|&s| self.holds(g, s))),
        }
    }
}

/// Scalars that a formula reads; nothing for symbols, vectors and blocks.
fn operands(node: &ScalarNode) -> Option<&[Scalar]> {
    match node {
        ScalarNode::Literal(_) => Some(&[]),
        ScalarNode::Sum(list) | ScalarNode::Product(list) | ScalarNode::Call(_, list) => Some(list),
        ScalarNode::Reciprocal(x) | ScalarNode::Sqrt(x) | ScalarNode::Sin(x) | ScalarNode::Cos(x) => {
            Some(std::slice::from_ref(x))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::Constants;
    use crate::symbolic::graph::{Graph, Scalar};

    #[test]
    fn vectors_are_constant_where_all_of_them_is() {
        let mut g = Graph::new();
        let [p, x] = [(); 2].map(|()| g.symbol());
        let parameter = g.symbol_id(p).unwrap();
        let fixed = g.vector([p, Scalar::ONE, p]);
        let about = |g: &mut Graph, angle| g.axis_rotation(2, angle);
        let (swing, turn) = (about(&mut g, x), about(&mut g, p));
        let (swung, turned) = (g.rotate(swing, fixed), g.rotate(turn, fixed));
        let mut rows = [[p; 3]; 3];
        rows[1][2] = x;
        let matrix = g.matrix_rotation(rows);
        let vectors = [g.scale(x, turned), g.scale(p, swung), g.cross(turned, swung), g.rotate(matrix, turned)];
        let mut moving = vectors.map(|v| g.component(v, 0)).to_vec();
        moving.push(g.dot(turned, swung));
        let vectors = [g.scale(p, turned), g.cross(turned, fixed)];
        let mut constant = vectors.map(|v| g.component(v, 0)).to_vec();
        constant.push(g.dot(turned, fixed));
        let constants = Constants::of(&g, &|id| id == parameter, &[moving.clone(), constant.clone()].concat());
        let holds = |list: &[Scalar]| list.iter().map(|&s| constants.holds(&g, s)).collect::<Vec<_>>();
        assert_eq!((holds(&moving), holds(&constant)), (vec![false; 5], vec![true; 3]));
    }
}
