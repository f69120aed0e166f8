//! "One line changes the coordinates of a whole model": every model of the examples and of the tests, in every formulation.
//! What is refused has a reason that the mechanism itself gives; run with `--nocapture` for the table.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::mechanics::{MOST_FREEDOMS, analysis, freedoms};
use multibody_engine::model::check;
use multibody_engine::syntax::parse;
use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};

const FORMULATIONS: [&str; 4] = [
    "constraints: Multipliers",
    "constraints: Reduced",
    "coordinates: Absolute(RollPitchYaw)",
    "coordinates: Absolute(Quaternion)",
];

/// Larger models are left to the tests that they belong to.
const MOST: usize = 90;

/// Why a formulation may be refused.
const REASONS: [&str; 5] = [
    // `emit kinematics` names coordinates that are no coordinates any more.
    "closes a loop and has no coordinates",
    // A measured angle as a factor, or with a parameter as its ratio.
    "known up to whole turns",
    // Quaternions leave the state whole or not at all, and have no angles to write formulas for.
    "and it is a quaternion",
    "a frame has no ",
    // Kinematics by Newton's method begins where the state stands, and all of it is in the state with multipliers alone.
    "is given, and follows from other coordinates of the state",
];

#[test]
fn every_model_in_every_formulation() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut files = Vec::new();
    for folder in ["examples", "tests"] {
        sources(&root.join(folder), &mut files);
    }
    files.sort();
    let mut counts: BTreeMap<&str, [usize; 2]> = BTreeMap::new();
    let mut unexplained = Vec::new();
    for file in files {
        let Ok(text) = std::fs::read_to_string(&file) else { continue };
        let Ok(tokens) = text.parse::<TokenStream>() else { continue };
        let mut calls = Vec::new();
        find(tokens, &mut calls);
        for call in calls {
            let name = file.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
            for (formulation, model, refusals) in refused(&call) {
                let count = counts.entry(formulation).or_default();
                count[usize::from(!refusals.is_empty())] += 1;
                for refusal in refusals {
                    println!("{name} | {model} | {formulation} | {refusal}");
                    if !REASONS.iter().any(|reason| refusal.contains(reason)) {
                        unexplained.push(format!("{name}, {model}, {formulation}: {refusal}"));
                    }
                }
            }
        }
    }
    println!("taken, refused: {counts:?}");
    assert!(unexplained.is_empty(), "{unexplained:#?}");
}

fn sources(folder: &Path, files: &mut Vec<PathBuf>) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for path in entries.filter_map(Result::ok).map(|entry| entry.path()) {
        let skipped = ["ui", "target", "expansions"].iter().any(|name| path.ends_with(name));
        if path.is_dir() && !skipped {
            sources(&path, files);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
}

/// What stands in calls of the macro, but for those that macros of the tests make.
fn find(tokens: TokenStream, calls: &mut Vec<TokenStream>) {
    let list: Vec<TokenTree> = tokens.into_iter().collect();
    for (at, token) in list.iter().enumerate() {
        let TokenTree::Group(group) = token else { continue };
        let before = at.checked_sub(2).map(|first| (list[first].to_string(), list[first + 1].to_string()));
        if before == Some(("multibody".to_owned(), "!".to_owned())) {
            if !group.stream().to_string().contains('$') {
                calls.push(group.stream());
            }
        } else {
            find(group.stream(), calls);
        }
    }
}

/// The models of a call in all formulations, with what is wrong with them.
fn refused(call: &TokenStream) -> Vec<(&'static str, String, Vec<String>)> {
    let mut diagnostics = Diagnostics::default();
    let models = check(&parse(call.clone(), &mut diagnostics), &mut diagnostics);
    if !diagnostics.is_empty() {
        return Vec::new();
    }
    let names: Vec<String> = models.iter().map(|model| model.name.to_string()).collect();
    let mut found = Vec::new();
    for name in &names {
        for formulation in FORMULATIONS {
            let mut diagnostics = Diagnostics::default();
            let models = check(&parse(changed(call, name, formulation), &mut diagnostics), &mut diagnostics);
            let mut refusals: Vec<String> = diagnostics.errors().iter().map(|error| error.message.clone()).collect();
            for model in models.iter().filter(|model| model.name == name.as_str()) {
                let size = freedoms(model);
                if size > MOST.min(MOST_FREEDOMS) {
                    continue;
                }
                if let Err(complaints) = analysis::analyse(model) {
                    refusals.extend(complaints.into_iter().map(|complaint| complaint.message));
                }
            }
            refusals.dedup();
            found.push((formulation, name.clone(), refusals));
        }
    }
    found
}

/// The call with another formulation of one model.
fn changed(call: &TokenStream, model: &str, formulation: &str) -> TokenStream {
    let mut last = [String::new(), String::new()];
    let tokens = call.clone().into_iter().map(|token| {
        let token = match token {
            TokenTree::Group(group) if last == ["mod", model] => {
                let mut items = without_formulation(group.stream());
                items.extend(format!("formulation {{ {formulation} }}").parse::<TokenStream>());
                TokenTree::Group(Group::new(Delimiter::Brace, items))
            }
            other => other,
        };
        last.rotate_left(1);
        last[1] = match &token {
            TokenTree::Ident(ident) => ident.to_string(),
            _ => String::new(),
        };
        token
    });
    tokens.collect()
}

fn without_formulation(items: TokenStream) -> TokenStream {
    let mut skip = false;
    let keep = items.into_iter().filter(|token| {
        let starts = matches!(token, TokenTree::Ident(ident) if ident == "formulation");
        let drop = starts || skip;
        skip = starts;
        !drop
    });
    keep.collect()
}

/// Nothing is free where a drive moves the crank of a four-bar; in absolute coordinates it is an equation like the others.
#[test]
fn what_time_prescribes_is_generated() {
    for formulation in FORMULATIONS {
        let text = format!(
            "pub mod m {{
                world {{ gravity: -9.81 * Y }} formulation {{ {formulation} }}
                body arm {{ mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }}
                body link {{ mass: 3.5, com: 1.7 * X, inertia: diag(0.1, 3.0, 3.1) }}
                body lever {{ mass: 3.0, com: 1.5 * X, inertia: rod(3.0, 3.0, X) }}
                joint crank: Revolute {{ parent: ground, child: arm, axis: Z }}
                joint coupler: Revolute {{ parent: arm.at(X), child: link, axis: Z }}
                joint rocker: Revolute {{ parent: ground.at(4.0 * X), child: lever, axis: Z }}
                #[cut] joint pin: Revolute {{ parent: link.at(3.5 * X), child: lever.at(3.0 * X), axis: Z }}
                drive crank.angle = 0.4 + 1.5 * t;
                emit forward_dynamics;
            }}"
        );
        let tokens: TokenStream = text.parse().expect("tokens");
        let output = multibody_engine::expand(tokens).to_string();
        assert!(!output.contains("compile_error"), "{formulation}: {}", &output[..output.len().min(600)]);
        assert!(output.contains("fn forward_dynamics"), "{formulation}");
    }
}
