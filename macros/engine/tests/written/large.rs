//! Pages of large models: what is set, what is plain text, and how much of both.

use std::path::Path;

use multibody_engine::emit::{self, Form, Shown};
use multibody_engine::mechanics;
use multibody_engine::mechanics::written::{Page, Subject};
use multibody_engine::model::types::{Model, Request};
use multibody_engine::symbolic::write::text;

use crate::corpus;
use crate::documented::is_balanced;

/// Bytes of a page as Markdown. What rustdoc puts around it is some 20,000.
const MOST: usize = 250_000;

fn platforms() -> Vec<Model> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let calls = corpus::calls_of(&root, "tests/models/stewart.rs");
    calls.into_iter().flat_map(|(_, call)| corpus::models(call)).collect()
}

fn page(model: &Model) -> Page {
    let structure = mechanics::analysis::analyse(model).ok().unwrap();
    mechanics::page(model, &structure).ok().unwrap()
}

/// Every line stands somewhere, but for entries that are zero, and a sentence says so.
#[test]
fn platforms_in_all_coordinates_have_pages_that_people_load() {
    for model in platforms().iter().filter(|model| !model.name.to_string().starts_with("heavy")) {
        let page = page(model);
        let mut bytes = 0;
        for section in &page.sections {
            let label = format!("{}, {}", model.name, section.title);
            let shown = Shown::new(&page, section);
            let folded = page.folded(section);
            assert_eq!(shown.more, 0, "{label}");
            assert!(shown.is_sparse || shown.count() == folded.len(), "{label}");
            assert_eq!(shown.is_sparse, shown.says().is_some(), "{label}");
            let zero = |subject: Subject| {
                matches!(subject, Subject::Mass(..) | Subject::Inertial(_) | Subject::Gravity(_) | Subject::Force(_))
            };
            let kept = folded.iter().filter(|one| !zero(one.line.subject) || !one.line.equation.right.is_zero());
            let kept: Vec<String> = kept.map(|one| text::equation(&one.line.equation)).collect();
            let lines: Vec<String> = shown
                .lines
                .iter()
                .map(|form| match form {
                    Form::Set(_, line) => text::equation(&line.equation),
                    Form::Plain(text) => text.clone(),
                })
                .chain(shown.rest.iter().cloned())
                .collect();
            if shown.is_sparse {
                assert_eq!(lines.len(), kept.len(), "{label}");
                assert!(lines.iter().zip(&kept).all(|(line, kept)| line.starts_with(kept.as_str())), "{label}");
            }
            let set = shown.lines.iter().map(|form| match form {
                Form::Set(math, _) => math.len(),
                Form::Plain(text) => text.len(),
            });
            bytes += set.sum::<usize>() + shown.rest.iter().map(String::len).sum::<usize>();
        }
        assert!(bytes < MOST, "{}: {bytes}", model.name);
    }
}

/// What is missing is said to be zero only where nothing else is missing.
#[test]
fn lines_that_are_left_out_are_not_said_to_be_zero() {
    let sparse = platforms().iter().map(page).find_map(|page| {
        let section = page.sections.iter().find(|section| Shown::new(&page, section).is_sparse)?.clone();
        Some((page, section))
    });
    let (page, mut section) = sparse.unwrap();
    assert!(Shown::new(&page, &section).says().unwrap().contains("do not stand here are zero"));
    while Shown::new(&page, &section).more == 0 {
        section.lines.extend_from_within(..);
    }
    assert_eq!(Shown::new(&page, &section).says(), Some("Entries that are zero are left out."));
}

/// The whole page of the largest of them is HTML that Markdown leaves alone.
#[test]
fn the_page_of_a_platform_is_html() {
    let mut model = platforms().into_iter().find(|model| model.name == "reduced").unwrap();
    model.emit.push(Request::Report);
    let (structure, compiled) = multibody_engine::compile(&model).ok().unwrap();
    let page = emit::report(&model, &structure, &compiled);
    assert!(page.len() < MOST, "{}", page.len());
    assert!(page.contains("more equations, as plain text</summary>") && page.contains("<pre"));
    let starts = |line: &&str| line.starts_with('<');
    let mut lines = page.lines().peekable();
    while lines.by_ref().find(starts).is_some_and(|first| {
        // A block ends with an empty line.
        let block: Vec<&str> =
            std::iter::once(first).chain(lines.by_ref().take_while(|line| !line.is_empty())).collect();
        let html = block.join("\n");
        assert!(is_balanced(&html), "{html}");
        true
    }) {}
}
