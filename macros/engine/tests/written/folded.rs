//! Equations of identical parts stand once on a page: with each number put in again they are the lines that were there.

use std::collections::{HashMap, HashSet};

use multibody_engine::mechanics;
use multibody_engine::mechanics::freedoms;
use multibody_engine::mechanics::written::{Line, Page, Section, Subject};
use multibody_engine::symbolic::write::formula::{Equation, Formula};
use multibody_engine::symbolic::write::{latex, mathml, text};

use crate::corpus;

/// Larger models are left out.
const MOST_FREEDOMS: usize = 12;

fn pages() -> Vec<(String, Page)> {
    let mut pages = Vec::new();
    for (file, call) in corpus::calls() {
        for model in corpus::models(call) {
            // Of models without arrays of parts no line is alike another.
            let has_arrays = model.instances.iter().any(|instance| instance.index.is_some());
            if !has_arrays || freedoms(&model) > MOST_FREEDOMS {
                continue;
            }
            if let Ok(structure) = mechanics::analysis::analyse(&model)
                && let Ok(page) = mechanics::page(&model, &structure)
            {
                pages.push((format!("{file}: {}", model.name), page));
            }
        }
    }
    pages
}

fn each_name(formula: &Formula, visit: &mut dyn FnMut(String)) {
    if let Formula::Name(name) = formula {
        visit(text::name(name));
    }
    formula.each_part(&mut |part| each_name(part, visit));
}

/// Definitions that a line reads before they are told, of lines with all that each stands for.
fn late(lines: &[Vec<(String, &Equation)>]) -> Vec<String> {
    let all: HashSet<&String> = lines.iter().flatten().map(|line| &line.0).collect();
    let (mut told, mut late) = (HashSet::new(), Vec::new());
    for lines in lines {
        for (_, equation) in lines {
            each_name(&equation.right, &mut |name| {
                if all.contains(&name) && !told.contains(&name) {
                    late.push(name);
                }
            });
        }
        told.extend(lines.iter().map(|line| line.0.clone()));
    }
    late
}

fn told_late_as_they_are(section: &Section) -> Vec<String> {
    let lines = section.lines.iter().map(|line| vec![(text::formula(&line.equation.left), &line.equation)]);
    late(&lines.collect::<Vec<_>>())
}

fn told_late(page: &Page, section: &Section) -> Vec<String> {
    let by_left: HashMap<String, &Equation> =
        section.lines.iter().map(|line| (text::formula(&line.equation.left), &line.equation)).collect();
    let folded = page.folded(section).into_iter().map(|folded| {
        let left = text::formula(&folded.line.equation.left);
        let lefts = match &folded.index {
            Some((letter, numbers)) => {
                numbers.iter().map(|k| left.replace(&format!("[{letter}]"), &format!("[{k}]"))).collect()
            }
            None => vec![left],
        };
        lefts.into_iter().map(|left| (left.clone(), by_left[&left])).collect()
    });
    late(&folded.collect::<Vec<_>>())
}

#[test]
fn folded_lines_are_the_lines() {
    let mut with_index = 0;
    for (label, page) in pages() {
        for section in &page.sections {
            let line =
                |equation: &Equation| [text::equation(equation), latex::equation(equation), mathml::equation(equation)];
            let mut all: Vec<String> = section.lines.iter().map(|line| text::equation(&line.equation)).collect();
            let mut found = Vec::new();
            for folded in page.folded(section) {
                let Some((letter, numbers)) = &folded.index else {
                    found.push(text::equation(&folded.line.equation));
                    continue;
                };
                with_index += 1;
                assert!(numbers.len() > 1, "{label}");
                // What is printed has nothing but the letter in place of the number.
                let printed = text::equation(&folded.line.equation);
                found.extend(numbers.iter().map(|k| printed.replace(&format!("[{letter}]"), &format!("[{k}]"))));
                let says = folded.line.says.as_deref().unwrap_or_default();
                assert!(says.starts_with(&format!("for `{letter}` = {}", numbers[0])), "{label}: {says}");
                assert!(line(&folded.line.equation).iter().all(|form| form.contains(letter.as_str())), "{label}");
            }
            assert_eq!(told_late(&page, section), told_late_as_they_are(section), "{label}, {}", section.title);
            all.sort();
            found.sort();
            assert_eq!(all, found, "{label}, {}", section.title);
        }
    }
    assert!(with_index > 20, "{with_index}");
}

/// Springs between masses in a row: equations of each alike, but for those at the ends.
#[test]
fn a_folded_line_says_for_which_parts_it_holds() {
    let model = corpus::model(
        "mod pendulum {
            port top: Frame;
            param m = 1.0;
            param l = 1.0;
            body bob { mass: m, com: -l * Y }
            joint phi: Revolute { parent: top, child: bob, axis: Z }
            force friction: Damper { joint: phi, damping: 0.1 }
        }
        pub mod row {
            param g = 9.81;
            world { gravity: -g * Y }
            part rods: [pendulum; 4] = |i| pendulum { top: ground.at([0.0, 0.0, 0.3 * i]) };
            emit forward_dynamics;
        }",
    );
    let structure = mechanics::analysis::analyse(&model).ok().unwrap();
    let page = mechanics::page(&model, &structure).ok().unwrap();
    let motion = page.sections.iter().find(|section| section.title == "Equations of motion").unwrap();
    let found: Vec<String> = page.folded(motion).iter().map(|folded| folded.text()).collect();
    assert_eq!(
        found,
        [
            "rods[i].m rods[i].l² rods[i].phi¨ + g rods[i].m rods[i].l sin(rods[i].phi) = -0.1 rods[i].phi˙    (for i = 0 to 3)"
        ]
    );
}

/// A letter that stands in an index alone is no letter for a number: the second component of a quaternion is called i.
#[test]
fn the_letter_of_a_number_is_no_index() {
    let model = corpus::model(
        "mod top {
            port base: Frame;
            body spinner { mass: 1.0, com: 0.1 * Z, inertia: diag(0.1, 0.1, 0.2) }
            joint ball: Ball { parent: base, child: spinner }
        }
        pub mod tops {
            world { gravity: -9.81 * Z }
            part all: [top; 3] = |k| top { base: ground.at(0.3 * k * X) };
            emit forward_dynamics;
        }",
    );
    let structure = mechanics::analysis::analyse(&model).ok().unwrap();
    let page = mechanics::page(&model, &structure).ok().unwrap();
    let folded: Vec<_> = page.sections.iter().flat_map(|section| page.folded(section)).collect();
    let letters: HashSet<String> = folded.iter().filter_map(|one| Some(one.index.clone()?.0)).collect();
    assert_eq!(letters, HashSet::from(["n".to_owned()]));
}

/// `FORMULAS` says of itself that each equation stands after those that it reads, but for equations of motion in the names of
/// their parts.
#[test]
fn equations_stand_after_those_that_they_read() {
    let mut by_name = 0;
    for (label, page) in pages() {
        let lines: Vec<_> = page.sections.iter().flat_map(|section| page.folded(section)).map(|one| one.line).collect();
        let left = |line: &Line| text::formula(&line.equation.left);
        let told_at: HashMap<String, usize> = lines.iter().enumerate().map(|(at, line)| (left(line), at)).collect();
        for (at, line) in lines.iter().enumerate() {
            let mut late = false;
            let mut look = |name: String| late |= told_at.get(&name).is_some_and(|&told| told > at);
            each_name(&line.equation.right, &mut look);
            if let Subject::Motion(_) = line.subject {
                each_name(&line.equation.left, &mut look);
                by_name += usize::from(late);
            } else {
                assert!(!late, "{label}: {}", text::equation(&line.equation));
            }
        }
    }
    assert!(by_name > 0);
}
