//! Stage `optimize`: what values without a name are part of.
//!
//! In: a DAG, some of whose values have names. Out: for every value the name that it serves: of the value which it goes
//! into, and where it goes into several, what their names have in common, words before and words behind:
//! `legs_0_thrust` and `legs_1_thrust` share a `legs_thrust`.

use std::collections::HashMap;
use std::sync::Arc;

use crate::symbolic::graph::BlockKind;

use super::dag::{Dag, Id, Kind};

/// Names that values serve; nothing for those which no named value needs.
pub(super) fn hints(dag: &Dag) -> Vec<Option<String>> {
    let mut words = Words::default();
    let mut hints: Vec<Option<usize>> = vec![None; dag.nodes.len()];
    for &id in dag.order().iter().rev() {
        let node = &dag.nodes[id];
        if let Some(name) = node.name.as_ref().map(|name| &name.text).or(node.part_of.as_ref()) {
            hints[id] = Some(words.number(name.clone()));
        }
        // What goes into a linear system is no part of its rank.
        let Some(hint) = hints[id].filter(|_| !is_rank(dag, id)) else { continue };
        for operand in dag.operands(&dag.nodes[id].kind) {
            hints[operand] = Some(hints[operand].map_or(hint, |known| words.common(known, hint)));
        }
    }
    hints.into_iter().map(|hint| hint.map(|number| words.texts[number].clone())).collect()
}

fn is_rank(dag: &Dag, id: Id) -> bool {
    let Kind::Output { block, index } = dag.nodes[id].kind else { return false };
    matches!(dag.blocks[block].kind, BlockKind::Solve { size, .. } if index == size)
}

/// Headings of values: their own, or that of the first value which they go into.
pub(super) fn headings(dag: &Dag) -> Vec<Option<Arc<str>>> {
    let mut headings: Vec<Option<Arc<str>>> = vec![None; dag.nodes.len()];
    for &id in dag.order().iter().rev() {
        if let Some(own) = dag.nodes[id].name.as_ref().and_then(|name| name.heading.as_ref()) {
            headings[id] = Some(Arc::clone(own));
        }
        if let Some(heading) = headings[id].clone() {
            dag.operands(&dag.nodes[id].kind).for_each(|operand| headings[operand] = Some(Arc::clone(&heading)));
        }
    }
    headings
}

/// Names by number, and what pairs of them have in common.
#[derive(Default)]
struct Words {
    texts: Vec<String>,
    numbers: HashMap<String, usize>,
    pairs: HashMap<(usize, usize), usize>,
}

impl Words {
    fn number(&mut self, text: String) -> usize {
        let next = self.texts.len();
        let number = *self.numbers.entry(text.clone()).or_insert(next);
        if number == next {
            self.texts.push(text);
        }
        number
    }

    /// The first of two that have nothing in common.
    fn common(&mut self, a: usize, b: usize) -> usize {
        if a == b {
            return a;
        }
        if let Some(&known) = self.pairs.get(&(a, b)) {
            return known;
        }
        let shared = shared(&self.texts[a], &self.texts[b]);
        let number = shared.map_or(a, |text| self.number(text));
        self.pairs.insert((a, b), number);
        number
    }
}

/// The words with which both begin, and those with which what is left of both ends.
fn shared(a: &str, b: &str) -> Option<String> {
    let (a, b): (Vec<&str>, Vec<&str>) = (a.split('_').collect(), b.split('_').collect());
    let before = a.iter().zip(&b).take_while(|(x, y)| x == y).count();
    let (left, right) = (&a[before..], &b[before..]);
    let behind = left.iter().rev().zip(right.iter().rev()).take_while(|(x, y)| x == y).count();
    let text = a[..before].iter().chain(&left[left.len() - behind..]).copied().collect::<Vec<&str>>().join("_");
    // An index or an axis says nothing alone.
    text.split('_').any(|word| word.len() > 1 && !word.starts_with(|c: char| c.is_ascii_digit())).then_some(text)
}

#[cfg(test)]
mod tests {
    use super::shared;

    #[test]
    fn names_have_words_in_common() {
        assert_eq!(shared("legs_0_thrust", "legs_1_thrust").as_deref(), Some("legs_thrust"));
        assert_eq!(shared("f_knee_x", "f_knee_y").as_deref(), Some("f_knee"));
        assert_eq!(shared("knee_b", "knee_b_b").as_deref(), Some("knee_b"));
        assert_eq!(shared("w_lower_z", "f_upper_z").as_deref(), None);
        assert_eq!(shared("elbow", "wrist"), None);
    }
}
