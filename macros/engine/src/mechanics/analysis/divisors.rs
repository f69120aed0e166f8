//! Stage `mechanics`: quotients by what is zero wherever loops are closed.
//!
//! In: quotients of the user's expressions, closed configurations. Out: complaints about those whose divisor vanishes at all of them,
//! beside what it is at random poses, such as the length of a direction that a blade does not have since couplings keep it on end. What couplings
//! and loops make of a quotient may be zero by zero on the graph, which would say nothing.

use crate::mechanics::loops::structure::Structure;
use crate::mechanics::translate::division::{is_of_positions, poles, told};
use crate::model::types::Model;
use crate::symbolic::graph::Scalar;
use crate::symbolic::lower::Lowering;

use super::super::equations::Equations;
use super::Complaint;
use super::problem::{Point, Problem, Random};
use super::tape::{Tape, Values};

/// Poses that are looked at where no loop says which there are.
const POSES: usize = 9;
/// What rounding leaves of a root, beside what it is at random poses.
const NOTHING: f64 = 1e-7;
/// Sizes of what rounding leaves are farther apart.
const SAME: f64 = 1.001;

pub(super) fn complaints(model: &Model, problem: &Problem, structure: &Structure) -> Vec<Complaint> {
    let poles = poles(model, is_of_positions);
    if poles.is_empty() || structure.closed.len() < 2 {
        return Vec::new();
    }
    let mut e = Equations::plain(model);
    let roots: Vec<Scalar> = poles.iter().map(|pole| e.scalar(pole.divisor)).collect();
    let mut lowering = Lowering::new(&e.g);
    let roots = lowering.run(&roots);
    let tape = Tape::new(&lowering.to, &roots);
    let mut values = Values::default();
    // Of each divisor the least and the greatest size.
    let mut sizes = |points: &[Point]| {
        let mut sizes = vec![(f64::INFINITY, 0.0_f64); roots.len()];
        for point in points {
            tape.run(&mut values, &point.0);
            for (root, (least, most)) in sizes.iter_mut().enumerate() {
                let size = tape.value(&values, root).abs();
                (*least, *most) = (least.min(size), most.max(size));
            }
        }
        sizes
    };
    let closed: Vec<Point> = structure.closed.iter().map(|closed| problem.at(&closed.positions)).collect();
    let mut random = Random(0xD1_0150);
    let anywhere: Vec<Point> = (0..POSES).map(|_| problem.start(&mut random, 1.0)).collect();
    let (closed, anywhere) = (sizes(&closed), sizes(&anywhere));
    // What is small and the same everywhere, as `max(length, 1e-9)`, is meant.
    let is_meant = |(least, most): (f64, f64)| least > 0.0 && most <= SAME * least;
    let vanishes = |k: &usize| {
        let most = anywhere[*k].1;
        most > 0.0 && closed[*k].1 <= NOTHING * most && !is_meant(closed[*k])
    };
    let found = (0..poles.len()).filter(vanishes);
    told(found.map(|k| poles[k].complaint("wherever loops are closed")))
}
