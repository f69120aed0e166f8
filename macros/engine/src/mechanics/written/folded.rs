//! Room `written`: equations of identical parts once, with an index.
//!
//! In: lines of a section. Out: the same, in which lines that differ in the number of an element alone, one for every element, are
//! one with a letter in its place, and a sentence that says for which numbers it holds. Nothing but what is written decides: with each number put in again
//! these are the very lines that were there, so what is said of a page holds for its folded form.

use std::collections::{BTreeMap, BTreeSet};

use crate::symbolic::write::formula::{Equation, Formula, Identifier};
use crate::symbolic::write::text;

use super::{Line, Page, Section};

/// Letters for an index, the first that is no name of the page.
const LETTERS: [&str; 8] = ["i", "j", "k", "n", "p", "r", "s", "v"];

/// A line as pages show it.
#[derive(Clone, Debug)]
pub struct Folded {
    pub line: Line,
    /// The letter that stands for a number, and the numbers for which the line holds; none where it is one line alone.
    pub index: Option<(String, Vec<usize>)>,
}

impl Folded {
    /// One line of plain text, with what it holds for.
    pub fn text(&self) -> String {
        let equation = text::equation(&self.line.equation);
        match &self.index {
            Some((letter, numbers)) => format!("{equation}    ({})", holds(letter, numbers).replace('`', "")),
            None => equation,
        }
    }
}

/// The numbers for which a line holds, in Markdown.
fn holds(letter: &str, numbers: &[usize]) -> String {
    let in_a_row = numbers.windows(2).all(|pair| pair[0] + 1 == pair[1]);
    let list = match numbers {
        [first, .., last] if in_a_row && numbers.len() > 2 => format!("{first} to {last}"),
        all => all.iter().map(ToString::to_string).collect::<Vec<_>>().join(", "),
    };
    format!("for `{letter}` = {list}")
}

impl Page {
    /// The letter that stands for the number of an element: no word of any name, and of no index.
    fn letter(&self) -> Option<&'static str> {
        let mut words: BTreeSet<String> = BTreeSet::new();
        let mut copy = self.clone();
        copy.each_name(&mut |name| {
            for text in [Some(&name.text), name.index.as_ref()].into_iter().flatten() {
                words.extend(text.split(|c: char| !c.is_alphanumeric() && c != '_').map(str::to_owned));
            }
        });
        LETTERS.into_iter().find(|letter| !words.contains(*letter))
    }

    /// The lines of a section with those that are alike once, each behind what it reads.
    pub fn folded(&self, section: &Section) -> Vec<Folded> {
        let alone = |line: &Line| Folded { line: line.clone(), index: None };
        let Some(letter) = self.letter() else { return section.lines.iter().map(alone).collect() };
        let opened: Vec<Option<Opened>> = section.lines.iter().map(|line| open(line, letter)).collect();
        let mut alike: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
        for (at, opened) in opened.iter().enumerate() {
            if let Some(opened) = opened {
                alike.entry(&opened.key).or_default().push(at);
            }
        }
        let mut elements: BTreeMap<&str, BTreeSet<usize>> = BTreeMap::new();
        for opened in opened.iter().flatten() {
            elements.entry(&opened.array).or_default().insert(opened.number);
        }
        let is_whole = |opened: &Opened, members: &[usize]| {
            members.len() > 1 && members.len() == elements[opened.array.as_str()].len()
        };
        // What is shown, and the lines that it stands for.
        let mut shown: Vec<(Vec<usize>, Folded)> = Vec::new();
        for (at, line) in section.lines.iter().enumerate() {
            let members = opened[at].as_ref().map_or(&[][..], |opened| &alike[opened.key.as_str()]);
            match &opened[at] {
                Some(one) if is_whole(one, members) => {
                    if members.first() == Some(&at) {
                        let numbers: Vec<usize> =
                            members.iter().filter_map(|&at| opened[at].as_ref()).map(|opened| opened.number).collect();
                        shown.push((members.to_vec(), one.said_for(letter, numbers)));
                    }
                }
                _ => shown.push((vec![at], alone(line))),
            }
        }
        in_order(shown, &section.lines)
    }
}

/// Each as early as it can stand behind what any of its lines reads.
fn in_order(shown: Vec<(Vec<usize>, Folded)>, lines: &[Line]) -> Vec<Folded> {
    if shown.len() == lines.len() {
        return shown.into_iter().map(|entry| entry.1).collect();
    }
    let mut tells: BTreeMap<&Identifier, usize> = BTreeMap::new();
    for (entry, (members, _)) in shown.iter().enumerate() {
        for &at in members {
            let left = &lines[at].equation.left;
            let name = match left {
                Formula::Apply(_, angle) => angle.first(),
                other => Some(other),
            };
            if let Some(Formula::Name(name)) = name {
                tells.insert(name, entry);
            }
        }
    }
    let needs: Vec<BTreeSet<usize>> = shown
        .iter()
        .enumerate()
        .map(|(entry, (members, _))| {
            let mut needs = BTreeSet::new();
            for &at in members {
                each_name(&lines[at].equation.right, &mut |name| needs.extend(tells.get(name)));
            }
            needs.remove(&entry);
            needs
        })
        .collect();
    let mut left: BTreeMap<usize, Folded> = shown.into_iter().map(|entry| entry.1).enumerate().collect();
    let mut ordered = Vec::with_capacity(left.len());
    while let Some((&first, _)) = left.first_key_value() {
        // Where two read each other, the first stands first.
        let ready = left.keys().copied().find(|&entry| needs[entry].iter().all(|need| !left.contains_key(need)));
        ordered.extend(left.remove(&ready.unwrap_or(first)));
    }
    ordered
}

fn each_name<'f>(formula: &'f Formula, visit: &mut dyn FnMut(&'f Identifier)) {
    if let Formula::Name(name) = formula {
        visit(name);
    }
    formula.each_part(&mut |part| each_name(part, visit));
}

/// A line with a letter for its number.
struct Opened {
    line: Line,
    array: String,
    number: usize,
    /// All that is written.
    key: String,
}

impl Opened {
    fn said_for(&self, letter: &str, mut numbers: Vec<usize>) -> Folded {
        numbers.sort_unstable();
        let holds = holds(letter, &numbers);
        let mut line = self.line.clone();
        line.says = Some(match line.says {
            Some(says) => format!("{holds}; {says}"),
            None => holds,
        });
        Folded { line, index: Some((letter.to_owned(), numbers)) }
    }
}

/// With a letter in place of the first number of an element that the line names, wherever it names that number.
fn open(line: &Line, letter: &str) -> Option<Opened> {
    let mut names: Vec<Identifier> = Vec::new();
    let mut equation = line.equation.clone();
    let each = |equation: &mut Equation, visit: &mut dyn FnMut(&mut Identifier)| {
        equation.left.each_name_mut(visit);
        equation.right.each_name_mut(visit);
    };
    each(&mut equation, &mut |name| names.push(name.clone()));
    let texts = names.iter().flat_map(|name| [Some(&name.text), name.index.as_ref()]).flatten();
    let (array, number) = texts.clone().find_map(|text| first_element(text))?;
    let (from, to) = (format!("[{number}]"), format!("[{letter}]"));
    each(&mut equation, &mut |name| {
        name.text = name.text.replace(&from, &to);
        name.index = name.index.as_ref().map(|index| index.replace(&from, &to));
    });
    let says = line.says.as_ref().map(|says| says.replace(&from, &to));
    let key = format!("{equation:?} {says:?}");
    Some(Opened { line: Line { equation, says, ..line.clone() }, array, number, key })
}

/// The first array of which an element is named, and its number.
fn first_element(text: &str) -> Option<(String, usize)> {
    text.match_indices('[').find_map(|(at, _)| {
        let number = text[at + 1..].split_once(']')?.0.parse().ok()?;
        let name = text[..at].rsplit(' ').next().unwrap_or_default();
        Some((name.to_owned(), number))
    })
}
