//! Equations in the README are those that the compiler prints of the models in it.

use std::path::Path;

use multibody_engine::mechanics;
use multibody_engine::symbolic::write::text;

use crate::corpus;

/// Lines of the first block of text behind a sentence.
fn block(page: &str, behind: &str) -> Vec<String> {
    let rest = page.split_once(behind).unwrap_or_else(|| panic!("no {behind:?}")).1;
    let block = rest.split_once("```text\n").unwrap().1.split_once("```").unwrap().0;
    block.lines().map(str::to_owned).collect()
}

/// Equations of a model as pages show them, and what is said of each.
fn printed(name: &str) -> Vec<(String, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let calls = corpus::calls_of(&root, "README.md");
    let mut models = calls.into_iter().flat_map(|(_, call)| corpus::models(call));
    let model = models.find(|model| model.name == name).unwrap_or_else(|| panic!("README has no {name}"));
    let structure = mechanics::analysis::analyse(&model).ok().unwrap();
    let page = mechanics::page(&model, &structure).ok().unwrap();
    let lines = page.sections.iter().flat_map(|section| page.folded(section)).map(|folded| folded.line);
    lines.map(|line| (text::equation(&line.equation), line.says.unwrap_or_default().replace('`', ""))).collect()
}

/// Equations stand at the margin, what is said of them behind a space.
#[test]
fn equations_are_those_that_are_printed() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../README.md");
    let page = std::fs::read_to_string(path).unwrap();
    for (model, behind, least) in
        [("cart_pole", "It prints its equations", 2), ("stewart", "**Loops are solved by formulas**", 5)]
    {
        let printed = printed(model);
        let (mut equations, mut said) = (0, None);
        for line in block(&page, behind) {
            if line.starts_with("after half a second") {
                continue;
            }
            if let Some(says) = line.strip_prefix("    ") {
                assert_eq!(said, Some(says.to_owned()), "{model}");
                continue;
            }
            let found = printed.iter().find(|(equation, _)| *equation == line);
            said = Some(found.unwrap_or_else(|| panic!("{model} prints no {line:?}")).1.clone());
            equations += 1;
        }
        assert_eq!(equations, least, "{model}");
    }
}
