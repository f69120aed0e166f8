//! Stage `solve`: cycles with unknowns in common.
//!
//! In: cycles as they are given. Out: a [`System`]: their links, with the unknowns numbered once for all of them, opened at
//! one unknown, or with what was solved counted among the known. An unknown that several cycles hold can be found from
//! any of them.

use crate::dynamics::tree::Motion;
use crate::invariant::fault::OrFault;
use crate::symbolic::graph::{Graph, Scalar};

use super::chain::Link;
use super::pairs::{Opened, Winding};
use super::primitives::Known;
use super::{KinematicLoop, Segment};

/// An unknown as the procedure sees it.
#[derive(Clone, Copy)]
pub(super) struct Unknown {
    pub(super) motion: Motion,
    pub(super) symbol: Scalar,
    pub(super) wanted: bool,
}

/// One cycle. Its links compose to the identity.
#[derive(Clone)]
pub(super) struct Cycle {
    pub(super) links: Vec<Link>,
    pub(super) winding: Option<Scalar>,
}

/// Neighbouring unknowns of a cycle.
pub(super) struct Part {
    /// In the order in which the cycle meets them.
    pub(super) unknowns: Vec<usize>,
    /// From the first of them to the last.
    pub(super) links: Vec<Link>,
    /// From their right side round to their left.
    pub(super) rest: Vec<Link>,
}

#[derive(Clone)]
pub(super) struct System {
    pub(super) cycles: Vec<Cycle>,
    pub(super) unknowns: Vec<Unknown>,
    pub(super) known: Known,
}

impl Cycle {
    /// Places of what is open, with the numbers of the unknowns.
    pub(super) fn free(&self) -> Vec<(usize, usize)> {
        let links = self.links.iter().enumerate();
        let free = links.filter_map(|(at, link)| match link {
            Link::Free { unknown, .. } => Some((at, *unknown)),
            Link::Known { .. } => None,
        });
        free.collect()
    }

    /// These unknowns, where nothing else is open between them: in more than one way where nothing else is open at all.
    pub(super) fn parts(&self, unknowns: &[usize]) -> impl Iterator<Item = Part> {
        let free = self.free();
        let starts = if free.len() < unknowns.len() { 0 } else { free.len() };
        (0..starts).filter_map(move |start| {
            let own: Vec<(usize, usize)> = (0..unknowns.len()).map(|k| free[(start + k) % free.len()]).collect();
            let same = unknowns.iter().all(|&number| own.iter().any(|one| one.1 == number));
            let (&(first, _), &(last, _)) = (own.first()?, own.last()?);
            let round = |from: usize, to: usize| -> Vec<Link> {
                match from <= to {
                    true => self.links[from..to].to_vec(),
                    false => [&self.links[from..], &self.links[..to]].concat(),
                }
            };
            let unknowns = own.into_iter().map(|one| one.1).collect();
            same.then(|| Part { unknowns, links: round(first, last + 1), rest: round(last + 1, first) })
        })
    }
}

impl System {
    pub(super) fn new(cycles: &[KinematicLoop]) -> System {
        let mut unknowns: Vec<Unknown> = Vec::new();
        let mut link = |segment: Segment| match segment {
            Segment::Fixed { rotation, offset } => Link::Known { rotation, offset },
            Segment::Unknown { motion, symbol, wanted } => {
                let known = unknowns.iter().position(|other| wanted && other.symbol == symbol);
                let unknown = known.unwrap_or(unknowns.len());
                if known.is_none() {
                    unknowns.push(Unknown { motion, symbol, wanted });
                }
                Link::Free { motion, unknown }
            }
        };
        let cycles = cycles.iter().map(|cycle| {
            let links = cycle.segments.iter().map(|&segment| link(segment)).collect();
            Cycle { links, winding: cycle.winding }
        });
        let cycles = cycles.collect();
        System { cycles, unknowns, known: Known::default() }
    }

    /// One cycle by its links.
    pub(super) fn alone(cycle: Cycle, unknowns: Vec<Unknown>) -> System {
        System { cycles: vec![cycle], unknowns, known: Known::default() }
    }

    /// Cycles in which an unknown is open.
    pub(super) fn cycles_with(&self, number: usize) -> impl Iterator<Item = usize> {
        (0..self.cycles.len()).filter(move |&cycle| self.cycles[cycle].links.iter().any(|link| link.is_open(number)))
    }

    /// A cycle without one unknown, from its right side round to its left.
    pub(super) fn rest(&self, cycle: usize, number: usize) -> Vec<Link> {
        let links = &self.cycles[cycle].links;
        let at = links.iter().position(|link| link.is_open(number));
        let at = at.or_fault("an open unknown stands in its cycle");
        links[at + 1..].iter().chain(&links[..at]).copied().collect()
    }

    /// A cycle opened at one unknown.
    pub(super) fn opened<'r>(&self, g: &mut Graph, cycle: usize, number: usize, rest: &'r [Link]) -> Opened<'r> {
        let winding = self.winding(g, cycle, number);
        let counted = self.counts_turns(g, number);
        Opened { motion: self.unknowns[number].motion, rest, winding, counted }
    }

    /// Whether one turn more of an unknown is another solution.
    pub(super) fn counts_turns(&self, g: &Graph, number: usize) -> bool {
        let Unknown { motion, symbol, .. } = self.unknowns[number];
        let summed = |cycle: &Cycle| cycle.winding.is_some_and(|sum| g.depends_on(sum, &[symbol]));
        matches!(motion, Motion::Screw(..)) || self.cycles.iter().any(summed)
    }

    /// What a cycle's sum of angles says about one unknown: its slope and the rest; the rest may hold no other open unknown.
    fn winding(&self, g: &mut Graph, cycle: usize, number: usize) -> Option<Winding> {
        let (sum, symbol) = (self.cycles[cycle].winding?, self.unknowns[number].symbol);
        if !g.depends_on(sum, &[symbol]) {
            return None;
        }
        let others = (0..self.unknowns.len()).filter(|&k| k != number && self.cycles_with(k).next().is_some());
        let others: Vec<Scalar> = others.map(|k| self.unknowns[k].symbol).collect();
        if g.depends_on(sum, &others) {
            return Some(Winding::Open);
        }
        let slope = g.derivative(sum, &[(symbol, Scalar::ONE)]);
        // With the unknown at zero, and not by a difference in which it would stand and cancel.
        let still = g.symbol_id(symbol).map(|id| (id, Scalar::ZERO)).into_iter().collect();
        Some(Winding::Known { slope, rest: g.substitute(&[sum], &still)[0] })
    }

    /// A solved unknown is known from here on.
    pub(super) fn settle(&mut self, g: &mut Graph, number: usize) {
        let Unknown { motion, symbol, .. } = self.unknowns[number];
        for link in self.cycles.iter_mut().flat_map(|cycle| &mut cycle.links) {
            if link.is_open(number) {
                *link = Link::moved(g, motion, symbol);
            }
        }
    }
}

impl Link {
    /// The same with what has a coordinate moved by it.
    pub(super) fn settled(self, g: &mut Graph, system: &System) -> Link {
        match self {
            Link::Free { motion, unknown } => Link::moved(g, motion, system.unknowns[unknown].symbol),
            link => link,
        }
    }
}
