//! A file with one to three changes.

use std::ops::Range;

use crate::random::Random;

/// What stands where a number stood.
const NUMBERS: [&str; 16] = [
    "nan", "inf", "-inf", "1e400", "", "1e308", "-1e308", "1e-320", "-0", "0", "--1", "1,5", "0x10", "1e", "1 2",
    "\u{663}",
];

/// What stands where any text may.
const PIECES: [&str; 12] = [
    "<",
    ">",
    "\"",
    "&",
    "&lt;",
    "<!--",
    "-->",
    "<![CDATA[",
    "<!DOCTYPE a [<!ENTITY b \"bb\">]>",
    "<?xml version=\"1.0\"?>",
    "\u{0}",
    "\u{1d54f}",
];

/// The text, and what has been done to it.
pub(super) fn mutated(random: &mut Random, text: &str) -> (String, Vec<&'static str>) {
    let mut text = text.to_owned();
    let mut changes = Vec::new();
    for _ in 0..1 + random.below(3) {
        changes.push(change(random, &mut text));
    }
    (text, changes)
}

fn change(random: &mut Random, text: &mut String) -> &'static str {
    let elements = elements(text);
    let values = values(text);
    if elements.is_empty() || values.is_empty() {
        return "nothing";
    }
    let element = random.pick(&elements).clone();
    let value = random.pick(&values).clone();
    match random.below(10) {
        0 => {
            let mut bytes = text.clone().into_bytes();
            let at = random.below(bytes.len());
            bytes[at] ^= 1 << random.below(8);
            *text = String::from_utf8_lossy(&bytes).into_owned();
            "a bit"
        }
        1 => {
            text.replace_range(element, "");
            "an element dropped"
        }
        2 => {
            let copy = text[element.clone()].to_owned();
            text.insert_str(element.end, &copy);
            "an element doubled"
        }
        3 => {
            let copy = text[element].to_owned();
            let other = random.pick(&elements).start;
            text.insert_str(other, &copy);
            "an element elsewhere"
        }
        4 | 5 => {
            let words: Vec<Range<usize>> = values.iter().flat_map(|value| numbers(text, value)).collect();
            if !words.is_empty() {
                let word = random.pick(&words).clone();
                let number = *random.pick(&NUMBERS);
                text.replace_range(word, number);
            }
            "a number"
        }
        6 | 7 => {
            let other = text[random.pick(&values).clone()].to_owned();
            text.replace_range(value, &other);
            "a value for another"
        }
        8 => {
            let piece = *random.pick(&PIECES);
            text.insert_str(element.start, piece);
            "a piece"
        }
        _ => {
            let (start, count) = (element.start, [2, 60, 70, 5000][random.below(4)]);
            let name: String = text[start + 1..].chars().take_while(char::is_ascii_alphanumeric).collect();
            text.insert_str(element.end, &format!("</{name}>").repeat(count));
            text.insert_str(start, &format!("<{name}>").repeat(count));
            "a nest"
        }
    }
}

/// From `<name` to its end.
fn elements(text: &str) -> Vec<Range<usize>> {
    let (mut open, mut found) = (Vec::new(), Vec::new());
    for (start, _) in text.match_indices('<') {
        let Some(end) = text[start..].find('>').map(|at| start + at + 1) else { break };
        let tag = &text[start..end];
        if tag.starts_with("</") {
            found.extend(open.pop().map(|start| start..end));
        } else if tag.ends_with("/>") {
            found.push(start..end);
        } else if !tag.starts_with("<?") && !tag.starts_with("<!") {
            open.push(start);
        }
    }
    found
}

/// Between quotation marks.
fn values(text: &str) -> Vec<Range<usize>> {
    let quotes: Vec<usize> = text.match_indices('"').map(|(at, _)| at).collect();
    quotes.chunks_exact(2).map(|pair| pair[0] + 1..pair[1]).collect()
}

/// The words of a value that begin as a number does.
fn numbers(text: &str, value: &Range<usize>) -> Vec<Range<usize>> {
    let words = text[value.clone()].split(' ').scan(value.start, |at, word| {
        let start = *at;
        *at += word.len() + 1;
        Some(start..start + word.len())
    });
    let begins =
        |word: &Range<usize>| text[word.clone()].starts_with(|c: char| c.is_ascii_digit() || "-.+".contains(c));
    words.filter(begins).collect()
}
