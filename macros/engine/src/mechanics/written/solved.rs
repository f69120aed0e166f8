//! Room `written`: what closed forms are made of, by names that say so.
//!
//! In: labels that the solution of loops gives to coefficients. Out: for each label the letter that its equation has in books, with
//! the coordinate that it gives for an index, and a sentence that says which equation.

use std::collections::HashMap;

use crate::mechanics::loops::constraints::coordinate_name;
use crate::mechanics::loops::reduction::Reduction;
use crate::model::types::Model;
use crate::symbolic::write::formula::Identifier;

use super::letters::Letters;

/// Names and sentences by label. Each is given away once.
pub(super) type Solved = HashMap<String, (Identifier, String)>;

pub(super) fn solved(model: &Model, reduction: &Reduction, letters: &Letters) -> Solved {
    let named = reduction.parts.iter().filter_map(|part| {
        let coordinate = coordinate_name(model, part.coordinate);
        let (letter, says) = match together(part.word) {
            Some((letter, what)) => (letter, format!("{}, which `{coordinate}` has a part in", letters.sentence(what))),
            None => {
                let (letter, what) = meaning(part.word, part.is_angle)?;
                (letter, format!("{}, where x is `{coordinate}`", letters.sentence(what)))
            }
        };
        Some((part.label.clone(), (letters.entry(letter, coordinate), says)))
    });
    named.collect()
}

/// The letter of what unknowns are found from together, see [`crate::solve`], and what it is.
fn together(word: &str) -> Option<(&'static str, &'static str)> {
    Some(match word {
        "product" => ("kappa", "e^2 k - (c . e) (d . u), of an orientation R with R e = d and u . R c = k"),
        "area" => ("N", "(d x u)^2, of an orientation R with R e = d and u . R c = k"),
        "normal" => ("N", "(n1 x n2)^2, of a point on two planes n1 . x = h1 and n2 . x = h2 and on a sphere |x| = r"),
        _ => return None,
    })
}

/// The letter of a part, and the equation that has it.
fn meaning(word: &str, is_angle: bool) -> Option<(&'static str, &'static str)> {
    const TURN: &str = "of (r cos x, r sin x) = (u, v)";
    const ROOT: &str = "of A cos x + B sin x = C";
    const TRAVEL: &str = "of A x^2 + 2 B x + C = 0";
    Some(match (word, is_angle) {
        ("u", _) => ("u", TURN),
        ("v", _) => ("v", TURN),
        ("radius", _) => ("r", TURN),
        ("a", _) => ("A", ROOT),
        ("b", _) => ("B", ROOT),
        ("c", _) => ("C", ROOT),
        ("d", _) => ("D", "A^2 + B^2, of A cos x + B sin x = C"),
        ("discriminant", true) => ("Delta", "A^2 + B^2 - C^2, of A cos x + B sin x = C"),
        ("square", _) => ("A", TRAVEL),
        ("half", _) => ("B", TRAVEL),
        ("constant", _) => ("C", TRAVEL),
        ("discriminant", false) => ("Delta", "B^2 - A C, of A x^2 + 2 B x + C = 0"),
        _ => return None,
    })
}
