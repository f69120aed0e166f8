//! Stage `dynamics`: rotations and places of all links in the axes of one of them.
//!
//! In: a tree, a link at the root (or the ground). Out: per link the three columns of its rotation to the root's axes and
//! its origin there; going outwards by R_k = R_p R_joint, inwards by the transpose. The turn about a link's own axis is
//! kept apart until its columns are wanted: turns about parallel axes add their angles there.

use std::collections::HashMap;

use crate::symbolic::graph::{Graph, Rotation, Scalar, Vector};
use crate::symbolic::rotations;

use super::tree::{Link, Motion, Tree};

/// R = base * turn about a coordinate axis.
#[derive(Clone, Copy, Debug)]
struct Turned {
    base: [Vector; 3],
    axis: usize,
    angle: Scalar,
    origin: Vector,
}

/// Rotations as columns, made on demand.
#[derive(Clone)]
pub(crate) struct Columns {
    root: Option<usize>,
    /// From the root link's axes to the wanted ones.
    turn: Rotation,
    known: HashMap<Option<usize>, Turned>,
}

impl Default for Columns {
    /// In world axes.
    fn default() -> Self {
        Columns::new(None, Rotation::IDENTITY)
    }
}

impl Columns {
    /// In the axes of a link.
    pub(crate) fn at(root: usize) -> Self {
        Columns::new(Some(root), Rotation::IDENTITY)
    }

    pub(crate) fn new(root: Option<usize>, turn: Rotation) -> Self {
        Columns { root, turn, known: HashMap::new() }
    }

    /// Images of a link's axes.
    pub(crate) fn of(&mut self, g: &mut Graph, tree: &Tree, link: Option<usize>) -> [Vector; 3] {
        let turned = self.get(g, tree, link);
        turned.columns(g)
    }

    /// The link's origin, from the root's.
    pub(crate) fn origin(&mut self, g: &mut Graph, tree: &Tree, link: Option<usize>) -> Vector {
        self.get(g, tree, link).origin
    }

    /// Root components of a vector given in a link's axes.
    pub(crate) fn rotate(&mut self, g: &mut Graph, tree: &Tree, link: Option<usize>, v: Vector) -> Vector {
        if v == Vector::ZERO {
            return v;
        }
        let columns = self.of(g, tree, link);
        combine(g, &columns, v)
    }

    /// A point of a link, from the root's origin.
    pub(crate) fn point(&mut self, g: &mut Graph, tree: &Tree, link: Option<usize>, point: Vector) -> Vector {
        let turned = self.rotate(g, tree, link, point);
        let origin = self.origin(g, tree, link);
        g.add_vectors(origin, turned)
    }

    fn get(&mut self, g: &mut Graph, tree: &Tree, link: Option<usize>) -> Turned {
        let mut path = vec![link];
        let mut state = loop {
            let at = path.last().copied().flatten();
            if let Some(&state) = self.known.get(&at) {
                break state;
            }
            if at == self.root {
                let r = rotations::rows(g, self.turn);
                let base = [0, 1, 2].map(|j| g.vector([r[0][j], r[1][j], r[2][j]]));
                let state = Turned { base, axis: 2, angle: Scalar::ZERO, origin: Vector::ZERO };
                self.known.insert(at, state);
                break state;
            }
            path.push(self.towards_root(tree, at));
        };
        for pair in path.windows(2).rev() {
            let (to, from) = (pair[0], pair[1]);
            state = match (to, from) {
                (Some(to), _) if tree.links[to].parent == from => state.outwards(g, tree, &tree.links[to]),
                (_, Some(from)) => state.inwards(g, tree, &tree.links[from]),
                _ => state,
            };
            self.known.insert(to, state);
        }
        state
    }

    /// The next link on the way to the root: outwards where the root lies beyond.
    fn towards_root(&self, tree: &Tree, link: Option<usize>) -> Option<usize> {
        let outwards = tree.support(self.root).find(|&index| tree.links[index].parent == link);
        outwards.or_else(|| link.and_then(|index| tree.links[index].parent))
    }
}

impl Turned {
    fn columns(&self, g: &mut Graph) -> [Vector; 3] {
        if self.angle == Scalar::ZERO {
            return self.base;
        }
        let (s, c) = (g.sin(self.angle), g.cos(self.angle));
        let (j, k) = ((self.axis + 1) % 3, (self.axis + 2) % 3);
        let mut columns = self.base;
        let (cj, sk) = (g.scale(c, self.base[j]), g.scale(s, self.base[k]));
        let (sj, ck) = (g.scale(s, self.base[j]), g.scale(c, self.base[k]));
        columns[j] = g.add_vectors(cj, sk);
        columns[k] = g.sub_vectors(ck, sj);
        columns
    }

    fn outwards(&self, g: &mut Graph, tree: &Tree, link: &Link) -> Turned {
        let origin = tree.origin(g, link);
        let columns = if origin == Vector::ZERO { self.base } else { self.columns(g) };
        let moved = combine(g, &columns, origin);
        let mut next = self.placed(g, link.rotation);
        match link.motion {
            Motion::Revolute(axis) | Motion::Screw(axis, _) => next = next.about(g, axis, link.q),
            Motion::Prismatic(_) => {}
            Motion::Ball(orientation) => {
                let r = orientation.rotation(g);
                next = next.placed(g, r);
            }
        }
        next.origin = g.add_vectors(self.origin, moved);
        next
    }

    fn inwards(&self, g: &mut Graph, tree: &Tree, link: &Link) -> Turned {
        let unturned = match link.motion {
            Motion::Revolute(axis) | Motion::Screw(axis, _) => self.about(g, axis, -link.q),
            Motion::Prismatic(_) => *self,
            Motion::Ball(orientation) => {
                let r = orientation.rotation(g);
                self.placed(g, r.transpose())
            }
        };
        let mut next = unturned.placed(g, link.rotation.transpose());
        let origin = tree.origin(g, link);
        let columns = next.columns(g);
        let moved = combine(g, &columns, origin);
        next.origin = g.sub_vectors(self.origin, moved);
        next
    }

    fn about(&self, g: &mut Graph, axis: usize, angle: Scalar) -> Turned {
        if axis == self.axis {
            return Turned { angle: g.add(self.angle, angle), ..*self };
        }
        Turned { base: self.columns(g), axis, angle, origin: self.origin }
    }

    /// With another rotation inside. One that keeps the axis of the turn in place changes its order with the turn.
    fn placed(&self, g: &mut Graph, r: Rotation) -> Turned {
        if r == Rotation::IDENTITY {
            return *self;
        }
        let rows = rotations::rows(g, r);
        let keeps_axis = rows[self.axis][self.axis] == Scalar::ONE;
        let (columns, angle) = if keeps_axis { (self.base, self.angle) } else { (self.columns(g), Scalar::ZERO) };
        let turned = rotations::transpose(&rows).map(|column| {
            let column = g.vector(column);
            combine(g, &columns, column)
        });
        Turned { base: turned, axis: self.axis, angle, origin: self.origin }
    }
}

/// The sum of columns times components.
fn combine(g: &mut Graph, columns: &[Vector; 3], v: Vector) -> Vector {
    let v = g.components(v);
    let terms = [0, 1, 2].map(|k| g.scale(v[k], columns[k]));
    g.sum_vectors(&terms)
}
