//! What the macro writes for three small models, formatted and committed in `expansions`: a reader sees what they get, and
//! a change of the emitter is seen in review. `UPDATE_EXPANSIONS=1` writes the files anew.

use multibody_engine::expand;
use multibody_tests::support::data::path;
use multibody_tests::support::engine::calls;

/// The formatted expansion of the call in `file` whose model has this name.
fn expansion(file: &str, name: &str) -> String {
    let marker = format!("pub mod {name} ");
    let call = calls(file).into_iter().find(|call| call.to_string().contains(&marker));
    let call = call.unwrap_or_else(|| panic!("no model {name}"));
    let once = expand(call.clone()).to_string();
    assert_eq!(once, expand(call.clone()).to_string(), "the same tokens give the same code");
    prettyplease::unparse(&syn::parse2(expand(call)).unwrap())
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
