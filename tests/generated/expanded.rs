//! What the macro writes for some models, formatted and committed in `expansions`: a reader sees what they get, and a
//! change of the emitter is seen in review. `UPDATE_EXPANSIONS=1` writes the files anew.

use multibody_engine::{commented, expand};
use multibody_tests::support::data::path;
use multibody_tests::support::engine::calls;
use proc_macro2::{TokenStream, TokenTree};

/// The model of this name and the parts of its call, without other models.
fn alone(call: TokenStream, name: &str) -> TokenStream {
    let mut kept: Vec<TokenTree> = Vec::new();
    // From attributes to the braces of a module; a part has no `pub`.
    let mut item: Vec<TokenTree> = Vec::new();
    for token in call {
        let ends = matches!(&token, TokenTree::Group(group) if group.delimiter() == proc_macro2::Delimiter::Brace);
        item.push(token);
        if ends {
            let words: Vec<String> = item.iter().map(ToString::to_string).collect();
            if !words.contains(&"pub".to_owned()) || words.iter().any(|word| word == name) {
                kept.append(&mut item);
            }
            item.clear();
        }
    }
    kept.into_iter().collect()
}

/// The formatted expansion of this model of `file`.
fn expansion(file: &str, name: &str) -> String {
    let marker = format!("mod {name} ");
    let call = calls(file).into_iter().find(|call| call.to_string().contains(&marker));
    let call = alone(call.unwrap_or_else(|| panic!("no model {name}")), name);
    let once = expand(call.clone()).to_string();
    assert_eq!(once, expand(call.clone()).to_string(), "the same tokens give the same code");
    // What the compiler gets has no headings.
    let text = prettyplease::unparse(&syn::parse2(commented(call)).unwrap());
    let lines = text.lines().map(|line| match line.split_once("#[doc = \"// ") {
        Some((indent, heading)) => format!("{indent}// {}\n", heading.trim_end_matches("\"]")),
        None => format!("{line}\n"),
    });
    lines.collect()
}

fn check(file: &str, name: &str) {
    let now = expansion(file, name);
    let committed = path(&format!("expansions/{name}.rs"));
    if std::env::var_os("UPDATE_EXPANSIONS").is_some() {
        std::fs::write(committed, now).unwrap();
        return;
    }
    let committed = std::fs::read_to_string(committed).unwrap();
    let changed = committed.lines().zip(now.lines()).enumerate().find(|(_, (was, is))| was != is);
    assert!(
        now == committed,
        "the expansion of {name} has changed, first at {changed:#?}; if that is meant, UPDATE_EXPANSIONS=1"
    );
}

#[test]
fn pendulum() {
    check("models/small.rs", "pendulum");
}

#[test]
fn cart_pole() {
    check("models/small.rs", "cart_pole");
}

#[test]
fn free_body() {
    check("models/motion.rs", "free_body");
}

#[test]
fn stewart_level() {
    check("models/stewart.rs", "level");
}

#[test]
fn four_bar() {
    check("models/mechanisms.rs", "four_bar");
}

#[test]
fn slider_crank() {
    check("../examples/models/slider_crank.rs", "engine");
}

/// Locals say what they are: of at most one in twenty only a number tells it from others, wherever in its name that
/// stands.
#[test]
fn locals_have_names() {
    for entry in std::fs::read_dir(path("expansions")).unwrap() {
        let file = entry.unwrap().path();
        let text = std::fs::read_to_string(&file).unwrap();
        let text = text.replace("let mut ", "let ");
        let mut locals: Vec<&str> = Vec::new();
        for rest in text.split("let ").skip(1) {
            let bound = rest.split(" = ").next().unwrap_or_default();
            let words = bound.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
            locals.extend(words.filter(|word| !word.is_empty() && *word != "_"));
        }
        let number = |word: &str| word.strip_prefix('v').is_some_and(|n| n.parse::<u32>().is_ok());
        let says_nothing = |name: &str| matches!(name, "value" | "value_part" | "constant" | "unknown" | "solution");
        let numbered = |name: &str| name.split('_').any(number) || says_nothing(name);
        let nameless = locals.iter().filter(|name| numbered(name));
        let (count, nameless) = (locals.len(), nameless.count());
        assert!(20 * nameless <= count, "{}: {nameless} of {count} locals have no name", file.display());
    }
}
