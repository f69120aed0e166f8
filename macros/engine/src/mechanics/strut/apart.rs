//! Stage `mechanics`: struts whose numbers are symbols, so that no two of them share work.
//!
//! In: a body on struts. Out: the same with each literal by which its struts differ as a symbol, and what these stand for. Literals
//! invite the optimiser to share between two struts what a third one has otherwise: a coordinate that two pins have in common, a
//! zero. That is less work for scalars; but then the struts are no longer alike, and nothing of them goes into packs. Numbers that all
//! struts have in common stay what they are, and so do parameters, which share nothing.

use crate::symbolic::graph::{Graph, Scalar};

use super::carrier::{Carrier, Leg};

/// A number of a strut.
type Place = fn(&mut Leg) -> &mut Scalar;

const PLACES: [Place; 9] = [
    |leg| &mut leg.foot[0],
    |leg| &mut leg.foot[1],
    |leg| &mut leg.foot[2],
    |leg| &mut leg.pin[0],
    |leg| &mut leg.pin[1],
    |leg| &mut leg.pin[2],
    |leg| &mut leg.strut.first,
    |leg| &mut leg.strut.tail,
    |leg| &mut leg.strut.second,
];

/// With symbols for numbers, which are told in pairs of symbol and literal.
pub fn apart(g: &mut Graph, carrier: &Carrier, numbers: &mut Vec<(Scalar, Scalar)>) -> Carrier {
    let mut carrier = carrier.clone();
    for place in PLACES {
        let values: Vec<Scalar> = carrier.legs.iter_mut().map(|leg| *place(leg)).collect();
        let differ = values.iter().any(|value| Some(value) != values.first());
        if !differ || !values.iter().all(|&value| g.literal(value).is_some()) {
            continue;
        }
        for (leg, value) in carrier.legs.iter_mut().zip(values) {
            let symbol = g.symbol();
            *place(leg) = symbol;
            numbers.push((symbol, value));
        }
    }
    carrier
}
