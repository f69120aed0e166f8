//! Stage `symbolic`, writing: sums of products of atoms.
//!
//! In: numbers and atoms. Out: polynomials, in which terms meet and cancel. An *atom* is what arithmetic does not look into: a
//! symbol, a sine of an angle, a root, the inverse of a sum, a value with an equation of its own. Exponents may be negative,
//! so a quotient by one product is a term like others. Atoms are equal if their arguments are the same polynomial.

use std::collections::{BTreeMap, HashMap};

use crate::contracts::call::Call;
use crate::symbolic::fingerprint::Print;
use crate::symbolic::graph::SymbolId;
use crate::symbolic::number::Number;

/// Number of an atom.
pub(super) type AtomId = u32;

/// Atoms with their exponents, in the order of their numbers; none is zero.
pub(super) type Monomial = Vec<(AtomId, i32)>;

/// What an atom with arguments does to them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Head {
    Sine,
    Cosine,
    Root,
    /// One over a sum.
    Inverse,
    /// A sum that is not multiplied out.
    Bracket,
    Call(Call),
}

#[derive(Clone, Debug)]
pub(super) enum Atom {
    Symbol(SymbolId),
    /// By its number among the definitions.
    Defined(usize),
    Of(Head, Vec<Polynomial>),
}

/// Terms, none of them zero.
#[derive(Clone, Debug, Default)]
pub(super) struct Polynomial {
    pub terms: BTreeMap<Monomial, Number>,
}

type Key = Vec<(Monomial, Print)>;

/// Atoms by number, each once.
#[derive(Default)]
pub(super) struct Atoms {
    list: Vec<Atom>,
    symbols: HashMap<SymbolId, AtomId>,
    applied: HashMap<(Head, Vec<Key>), AtomId>,
}

impl Polynomial {
    pub(super) fn number(n: Number) -> Polynomial {
        let mut result = Polynomial::default();
        result.add_term(Vec::new(), n);
        result
    }

    pub(super) fn atom(atom: AtomId, exponent: i32) -> Polynomial {
        let mut result = Polynomial::default();
        result.add_term(vec![(atom, exponent)], Number::ONE);
        result
    }

    pub(super) fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    pub(super) fn add_term(&mut self, monomial: Monomial, coefficient: Number) {
        let sum = match self.terms.get(&monomial) {
            Some(&known) => known + coefficient,
            None => coefficient,
        };
        if sum.is_zero() {
            self.terms.remove(&monomial);
        } else {
            self.terms.insert(monomial, sum);
        }
    }

    pub(super) fn add(&mut self, other: &Polynomial, scale: Number) {
        for (monomial, &coefficient) in &other.terms {
            self.add_term(monomial.clone(), coefficient * scale);
        }
    }

    pub(super) fn scaled(&self, scale: Number) -> Polynomial {
        let mut result = Polynomial::default();
        result.add(self, scale);
        result
    }

    /// The only term.
    pub(super) fn single(&self) -> Option<(&Monomial, Number)> {
        let mut terms = self.terms.iter();
        let (monomial, &coefficient) = terms.next()?;
        terms.next().is_none().then_some((monomial, coefficient))
    }

    /// Whether a reader would write minus before it: the sign of the term that stands first.
    pub(super) fn leads_negative(&self) -> bool {
        // Pure numbers come first in the order of monomials, and a reader looks at what varies.
        let first = self.terms.iter().find(|(monomial, _)| !monomial.is_empty()).or_else(|| self.terms.iter().next());
        first.is_some_and(|(_, n)| n.is_negative())
    }

    fn key(&self) -> Key {
        self.terms.iter().map(|(monomial, n)| (monomial.clone(), n.residue)).collect()
    }
}

/// Product of monomials.
pub(super) fn times(a: &Monomial, b: &Monomial) -> Monomial {
    let mut result = Monomial::with_capacity(a.len() + b.len());
    let (mut i, mut j) = (0, 0);
    while i < a.len() || j < b.len() {
        let left = a.get(i).map_or(AtomId::MAX, |x| x.0);
        let right = b.get(j).map_or(AtomId::MAX, |x| x.0);
        let at = left.min(right);
        let mut exponent = 0;
        if left == at {
            exponent += a[i].1;
            i += 1;
        }
        if right == at {
            exponent += b[j].1;
            j += 1;
        }
        if exponent != 0 {
            result.push((at, exponent));
        }
    }
    result
}

impl Atoms {
    pub(super) fn get(&self, id: AtomId) -> &Atom {
        &self.list[id as usize]
    }

    fn push(&mut self, atom: Atom) -> AtomId {
        self.list.push(atom);
        (self.list.len() - 1) as AtomId
    }

    pub(super) fn symbol(&mut self, id: SymbolId) -> AtomId {
        if let Some(&known) = self.symbols.get(&id) {
            return known;
        }
        let atom = self.push(Atom::Symbol(id));
        self.symbols.insert(id, atom);
        atom
    }

    pub(super) fn defined(&mut self, number: usize) -> AtomId {
        self.push(Atom::Defined(number))
    }

    pub(super) fn of(&mut self, head: Head, arguments: Vec<Polynomial>) -> AtomId {
        let key = (head, arguments.iter().map(Polynomial::key).collect());
        if let Some(&known) = self.applied.get(&key) {
            return known;
        }
        let atom = self.push(Atom::Of(head, arguments));
        self.applied.insert(key, atom);
        atom
    }

    /// Sine or cosine of an angle, which is even or odd in it.
    pub(super) fn trigonometric(&mut self, head: Head, angle: &Polynomial) -> Polynomial {
        if angle.is_zero() {
            return Polynomial::number(if head == Head::Sine { Number::ZERO } else { Number::ONE });
        }
        let flip = angle.leads_negative();
        let angle = if flip { angle.scaled(-Number::ONE) } else { angle.clone() };
        let atom = Polynomial::atom(self.of(head, vec![angle]), 1);
        if flip && head == Head::Sine { atom.scaled(-Number::ONE) } else { atom }
    }

    /// Product; none if it has more terms than `most` before they meet.
    pub(super) fn product(&self, a: &Polynomial, b: &Polynomial, most: usize) -> Option<Polynomial> {
        if a.terms.len().saturating_mul(b.terms.len()) > most.max(a.terms.len()).max(b.terms.len()) {
            return None;
        }
        let mut result = Polynomial::default();
        for (left, &m) in &a.terms {
            for (right, &n) in &b.terms {
                let (monomial, squares) = self.without_squares(times(left, right));
                let mut term = Polynomial::default();
                term.add_term(monomial, m * n);
                for square in squares {
                    term = self.product(&term, square, usize::MAX)?;
                }
                result.add(&term, Number::ONE);
            }
        }
        self.meet(&mut result);
        Some(result)
    }

    /// Takes squares of roots apart: what is left, and their radicands.
    fn without_squares(&self, monomial: Monomial) -> (Monomial, Vec<&Polynomial>) {
        let mut squares = Vec::new();
        let mut rest = Monomial::with_capacity(monomial.len());
        for (atom, exponent) in monomial {
            match self.get(atom) {
                Atom::Of(Head::Root, radicand) if exponent > 1 => {
                    squares.extend((0..exponent / 2).flat_map(|_| radicand));
                    if exponent % 2 == 1 {
                        rest.push((atom, 1));
                    }
                }
                _ => rest.push((atom, exponent)),
            }
        }
        (rest, squares)
    }

    /// The atom's partner in sin^2 + cos^2 = 1.
    fn cosine_of(&self, atom: AtomId) -> Option<AtomId> {
        let Atom::Of(Head::Sine, angle) = self.get(atom) else { return None };
        let key = (Head::Cosine, angle.iter().map(Polynomial::key).collect());
        self.applied.get(&key).copied()
    }

    /// c x cos^2 - c x = -c x sin^2, and the same of the sine, wherever two terms are one then.
    pub(super) fn complement(&mut self, p: &mut Polynomial) {
        loop {
            let found = p.terms.iter().find_map(|(monomial, &c)| {
                monomial.iter().filter(|factor| factor.1 >= 2).find_map(|&(atom, _)| {
                    let (head, angle) = match self.get(atom) {
                        Atom::Of(Head::Sine, angle) => (Head::Cosine, angle),
                        Atom::Of(Head::Cosine, angle) => (Head::Sine, angle),
                        _ => return None,
                    };
                    let base = times(monomial, &vec![(atom, -2)]);
                    let d = *p.terms.get(&base)?;
                    (d == -c).then(|| (monomial.clone(), base, head, angle.clone(), c))
                })
            });
            let Some((monomial, base, head, angle, c)) = found else { return };
            let partner = self.of(head, angle);
            p.terms.remove(&monomial);
            p.terms.remove(&base);
            p.add_term(times(&base, &vec![(partner, 2)]), -c);
        }
    }

    /// c x sin^2 + c x cos^2 = c x, wherever that takes two terms together.
    pub(super) fn meet(&self, p: &mut Polynomial) {
        loop {
            let found = p.terms.iter().find_map(|(monomial, &c)| {
                monomial.iter().filter(|factor| factor.1 >= 2).find_map(|&(sine, _)| {
                    let cosine = self.cosine_of(sine)?;
                    let base = times(monomial, &vec![(sine, -2)]);
                    let partner = times(&base, &vec![(cosine, 2)]);
                    let d = *p.terms.get(&partner)?;
                    (d == c).then_some((monomial.clone(), partner, base, c))
                })
            });
            let Some((one, other, base, c)) = found else { return };
            p.terms.remove(&one);
            p.terms.remove(&other);
            p.add_term(base, c);
        }
    }
}
