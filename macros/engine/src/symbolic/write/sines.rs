//! Stage `symbolic`, writing: products of sines as sines of sums, where that is shorter.
//!
//! In: a polynomial. Out: the same, in which terms that differ in their sines and cosines alone are written by the angles of
//! their products wherever that takes fewer terms: `cos a cos b - sin a sin b` is `cos (a + b)`. As a sum of sines and cosines
//! of distinct angles such a factor has one form only, so whatever can cancel does.

use std::collections::BTreeMap;

use crate::symbolic::number::Number;

use super::polynomial::{Atom, AtomId, Atoms, Head, Monomial, Polynomial};

/// Products of more sines than this are left as they are: each doubles the terms.
const MOST_FACTORS: i32 = 6;

/// The polynomial with the fewer terms.
pub(super) fn shortened(atoms: &mut Atoms, p: &Polynomial) -> Polynomial {
    let mut groups: BTreeMap<Monomial, Vec<(Monomial, Number)>> = BTreeMap::new();
    for (monomial, &n) in &p.terms {
        let (sines, rest): (Monomial, Monomial) =
            monomial.iter().partition(|factor| angle(atoms, factor.0).is_some() && factor.1 > 0);
        groups.entry(rest).or_default().push((sines, n));
    }
    let mut result = Polynomial::default();
    for (rest, group) in groups {
        let as_it_is = group.len();
        let factors = group.iter().map(|(sines, _)| sines.iter().map(|factor| factor.1).sum::<i32>()).max();
        let summed = (as_it_is > 1 && factors.is_some_and(|n| n <= MOST_FACTORS)).then(|| in_sums(atoms, &group));
        match summed.filter(|summed| summed.terms.len() < as_it_is) {
            Some(summed) => {
                for (sines, n) in summed.terms {
                    result.add_term(super::polynomial::times(&rest, &sines), n);
                }
            }
            None => {
                for (sines, n) in group {
                    result.add_term(super::polynomial::times(&rest, &sines), n);
                }
            }
        }
    }
    result
}

fn angle(atoms: &Atoms, atom: AtomId) -> Option<(Head, &Polynomial)> {
    match atoms.get(atom) {
        Atom::Of(head @ (Head::Sine | Head::Cosine), arguments) => arguments.first().map(|angle| (*head, angle)),
        _ => None,
    }
}

/// As a sum of single sines and cosines.
fn in_sums(atoms: &mut Atoms, group: &[(Monomial, Number)]) -> Polynomial {
    let mut result = Polynomial::default();
    let half = Number::ratio(1, 2);
    for (sines, n) in group {
        // Cosines and sines of angles, with factors: at first n cos 0.
        let mut list = vec![(Head::Cosine, Polynomial::default(), *n)];
        for &(atom, exponent) in sines {
            let Some((head, b)) = angle(atoms, atom).map(|(head, angle)| (head, angle.clone())) else { continue };
            for _ in 0..exponent {
                list = list
                    .into_iter()
                    .flat_map(|(kind, a, n)| {
                        let (mut sum, mut difference) = (a.clone(), a);
                        sum.add(&b, Number::ONE);
                        difference.add(&b, -Number::ONE);
                        let n = n * half;
                        match (kind, head) {
                            // cos a cos b, cos a sin b, sin a cos b, sin a sin b.
                            (Head::Cosine, Head::Cosine) => [(Head::Cosine, sum, n), (Head::Cosine, difference, n)],
                            (Head::Cosine, _) => [(Head::Sine, sum, n), (Head::Sine, difference, -n)],
                            (_, Head::Cosine) => [(Head::Sine, sum, n), (Head::Sine, difference, n)],
                            _ => [(Head::Cosine, difference, n), (Head::Cosine, sum, -n)],
                        }
                    })
                    .collect();
            }
        }
        for (kind, angle, n) in list {
            let value = atoms.trigonometric(kind, &angle);
            result.add(&value, n);
        }
    }
    result
}
