//! Stage `symbolic`: expressions whose values turn with everything else.
//!
//! In: a graph, scalars that are wanted of it, and a [`Turn`]: an angle, and pairs of symbols that are components of vectors in the
//! plane of that angle. Out: the same scalars, lowered, without the angle wherever they don't need it.
//!
//! What moves on a plane is the same wherever it heads: with R the turn by the angle psi, and w the vectors that are given,
//! f(psi, w) = f(0, R^T w) for what is no vector, and (f, g)(psi, w) = R (f, g)(0, R^T w) for components of one. So the
//! equations are written in axes that head along with the mechanism, in which the angle doesn't stand, and what has to be a vector of the
//! world is turned at the end. Whether that holds nobody needs to know beforehand: the values at both sides are compared, print by
//! print, and where they differ (a wall, a wind from the west) the expression stays as it was.

use std::collections::HashMap;

use super::fingerprint::Print;
use super::graph::{AnyNode, Graph, Scalar, SymbolId};
use super::lower::Lowering;
use super::rotations::turn_pair;

/// Everything that is carried turns by an angle.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Turn {
    pub angle: SymbolId,
    /// Components along two axes at right angles of vectors that are given in axes which don't turn; the angle turns the first
    /// axis to the second.
    pub vectors: Vec<[SymbolId; 2]>,
}

/// These scalars lowered with the angle of the turn at zero; nothing where none of them gets rid of it.
pub fn lower_turned(from: &Graph, roots: &[Scalar], turn: &Turn) -> Option<(Graph, Vec<Scalar>)> {
    let angle = from.symbol_handle(turn.angle)?;
    let depends = from.depending(&from.reachable(roots), [angle]);
    let turning: Vec<bool> = roots.iter().map(|root| depends.has(AnyNode::Scalar(root.index()))).collect();
    if !turning.contains(&true) {
        return None;
    }
    let mut ahead = from.empty_copy();
    let angle = ahead.symbol_handle(turn.angle)?;
    let (cos, sin) = (ahead.cos(angle), ahead.sin(angle));
    let put = in_axes_ahead(&mut ahead, turn, [cos, sin]);
    // As it was derived: there a linear system is solved by nobody yet, and is told by its coefficients.
    let at_zero = ahead.transplant(from, roots, &put, Some("ahead"));
    let prints = |graph: &Graph, list: &[Scalar]| list.iter().map(|&root| graph.print(root)).collect::<Vec<Print>>();
    let (zero, plain) = (prints(&ahead, &at_zero), prints(from, roots));
    // What doesn't read the angle stays as it is.
    let open: Vec<usize> = (0..roots.len()).filter(|&k| turning[k] && zero[k] != plain[k]).collect();
    let mut found: Vec<Option<Scalar>> =
        (0..roots.len()).map(|k| (turning[k] && zero[k] == plain[k]).then_some(at_zero[k])).collect();
    for [first, second] in vectors(&open, &zero, &plain, [cos, sin].map(|s| ahead.print(s))) {
        let turned = turn_pair(&mut ahead, [cos, sin], [at_zero[first], at_zero[second]]);
        [found[first], found[second]] = turned.map(Some);
    }
    if found.iter().all(Option::is_none) {
        return None;
    }
    let turned: Vec<Scalar> = found.iter().flatten().copied().collect();
    let mut lowering = Lowering::new(&ahead);
    let mut turned = lowering.run(&turned).into_iter();
    let mut lowering = Lowering::onto(from, lowering.to);
    let rest: Vec<Scalar> =
        roots.iter().zip(&found).filter(|(_, found)| found.is_none()).map(|(&root, _)| root).collect();
    let mut rest = lowering.run(&rest).into_iter();
    let all: Option<Vec<Scalar>> =
        found.iter().map(|found| if found.is_some() { turned.next() } else { rest.next() }).collect();
    let (to, all) = (lowering.to, all?);
    // Components that cancel in a sum may have brought others in, which are no arguments of the function.
    let components = |g: &Graph| -> Vec<Scalar> { turn.vectors.iter().flatten().map(|id| g.symbols[id.0]).collect() };
    let (before, now) = (from.read_by(roots, &components(from)), to.read_by(&all, &components(&to)));
    let same = before.iter().zip(now).all(|(&before, now)| before || !now);
    (same && !ahead.is_full() && !to.is_full()).then_some((to, all))
}

/// What symbols stand for in axes that head along: the angle is zero, and R^T takes vectors there.
fn in_axes_ahead(g: &mut Graph, turn: &Turn, [cos, sin]: [Scalar; 2]) -> HashMap<SymbolId, Scalar> {
    let mut put: HashMap<SymbolId, Scalar> = (0..g.symbols.len()).map(|k| (SymbolId(k), g.symbols[k])).collect();
    put.insert(turn.angle, Scalar::ZERO);
    for pair in &turn.vectors {
        let [a, b] = pair.map(|id| g.symbols[id.0]);
        put.extend(pair.iter().copied().zip(turn_pair(g, [cos, -sin], [a, b])));
    }
    put
}

/// Pairs of values, of those in these places, that are components of one vector: it is the one at zero, turned.
fn vectors(open: &[usize], at_zero: &[Print], plain: &[Print], [cos, sin]: [Print; 2]) -> Vec<[usize; 2]> {
    let mut places: HashMap<Print, Vec<usize>> = HashMap::new();
    for &k in open {
        places.entry(at_zero[k]).or_default().push(k);
    }
    let (inverse, mut taken) = (sin.inverse(), vec![false; plain.len()]);
    let mut pairs = Vec::new();
    for &first in open {
        // a = cos a0 - sin b0
        let wanted = (cos * at_zero[first] - plain[first]) * inverse;
        let second = places.get(&wanted).into_iter().flatten().copied().find(|&second| {
            second != first && !taken[second] && plain[second] == sin * at_zero[first] + cos * at_zero[second]
        });
        if let Some(second) = second.filter(|_| !taken[first]) {
            (taken[first], taken[second]) = (true, true);
            pairs.push([first, second]);
        }
    }
    pairs
}
