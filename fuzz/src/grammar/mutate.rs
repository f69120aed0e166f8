//! Broken models: a token or a line of a good one dropped, doubled, moved or replaced, with spans that remain the user's.

use crate::random::Random;

const WORDS: [&str; 44] = [
    "body",
    "joint",
    "force",
    "ground",
    "X",
    "t",
    "0",
    "-1",
    "1e308",
    "(",
    ")",
    "}",
    "{",
    "[",
    ",",
    ";",
    ":",
    "=",
    ".at(X)",
    "mass",
    "axis",
    "Revolute",
    "Vec3",
    "sin",
    "norm",
    "emit",
    "unknown",
    "#[cut]",
    "\"text\"",
    "2.5f32",
    "diff",
    "substitute",
    "mass_matrix[",
    "bias[",
    "jacobian[",
    "constraint[",
    "closed(",
    "simplify",
    "small(",
    "== 0",
    ".rate",
    "aid2",
    "let",
    "solve",
];

/// Words, numbers and signs of a line, blanks kept.
fn tokens(line: &str) -> Vec<String> {
    let mut list: Vec<String> = Vec::new();
    for c in line.chars() {
        let word = c.is_alphanumeric() || c == '_' || c == '#';
        match list.last_mut() {
            Some(last) if word && last.ends_with(|b: char| b.is_alphanumeric() || b == '_') => last.push(c),
            _ => list.push(c.to_string()),
        }
    }
    list
}

/// One mistake, at times two.
pub fn mutated(random: &mut Random, mut lines: Vec<String>) -> Vec<String> {
    for _ in 0..1 + random.below(2) {
        if lines.is_empty() {
            break;
        }
        let (at, other) = (random.below(lines.len()), random.below(lines.len()));
        match random.below(10) {
            0 => drop(lines.remove(at)),
            1 => lines.insert(at, lines[other].clone()),
            2 => lines.swap(at, other),
            _ => {
                let (mut here, there) = (tokens(&lines[at]), tokens(&lines[other]));
                if here.is_empty() || there.is_empty() {
                    continue;
                }
                let (k, l) = (random.below(here.len()), random.below(there.len()));
                match random.below(5) {
                    0 => drop(here.remove(k)),
                    1 => here[k] = there[l].clone(),
                    2 => here.insert(k, here[k].clone()),
                    3 => here.insert(k, format!(" {} ", random.pick(&WORDS))),
                    _ => here[k] = (*random.pick(&WORDS)).to_owned(),
                }
                lines[at] = here.concat();
            }
        }
    }
    lines
}
