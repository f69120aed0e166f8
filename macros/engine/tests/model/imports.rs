//! Parts of other calls: what is handed on, what names mean there, and what is said of mistakes. rustc brings the tokens from one
//! call to the other; here this file does.

use std::collections::BTreeMap;

use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::model::types::{Model, PartTypeId};
use multibody_engine::model::{self, exports};
use multibody_engine::syntax::{self, tree::Source};
use proc_macro2::TokenStream;

use crate::support::Writer;

/// Parts by their names.
type Shelf = BTreeMap<String, TokenStream>;

/// Reads a call with parts from the shelf.
fn read(text: &str, shelf: &Shelf) -> (Source, Diagnostics) {
    let mut tokens: TokenStream = format!("@runtime(::multibody) {text}").parse().expect("tokens");
    loop {
        let mut diagnostics = Diagnostics::default();
        let source = syntax::parse(tokens.clone(), &mut diagnostics);
        let Some(pending) = &source.pending else { return (source, diagnostics) };
        assert!(diagnostics.is_empty(), "{:?}", diagnostics.errors());
        let path = pending.uses[0].path.to_string();
        let name = path.rsplit([':', ' ']).next().expect("a name");
        tokens = pending.resolved(&shelf[name]);
    }
}

/// Puts the parts of a call on the shelf.
fn shelve(text: &str, shelf: &mut Shelf) {
    let (source, diagnostics) = read(text, shelf);
    assert!(diagnostics.is_empty(), "{:?}", diagnostics.errors());
    shelf.extend(exports::of(&source, false).into_iter().map(|export| (export.name.to_string(), export.tokens)));
}

fn checked(text: &str, shelf: &Shelf) -> (Vec<Model>, Vec<String>) {
    let (source, mut diagnostics) = read(text, shelf);
    let models = model::check(&source, &mut diagnostics);
    let said = diagnostics.errors().iter().map(|error| {
        let token = error.span.source_text().unwrap_or_default();
        let help = error.help.as_deref().map(|help| format!(" | {help}")).unwrap_or_default();
        format!("{token} | {}{help}", error.message)
    });
    (models, said.collect())
}

const LEGS: &str = "
    pub mod leg {
        port hip: Frame;
        param length = 0.4;
        body shank { mass: 1.5, com: -0.5 * length * Z, inertia: rod(1.5, length, Z) }
        joint knee: Revolute { parent: hip, child: shank, axis: Y }
        part end: foot { ankle: shank.at(-length * Z) };
    }
    pub(crate) mod foot {
        port ankle: Frame;
        body pad { mass: 0.25, inertia: sphere(0.25, 0.05) }
        joint hinge: Revolute { parent: ankle, child: pad, axis: X }
    }
    mod hidden { port p: Frame; body b { mass: 1.0 } joint j: Revolute { parent: p, child: b, axis: X } }";

const ROBOT: &str = "
    pub mod robot {
        body hull { mass: 10.0, inertia: sphere(10.0, 0.2) }
        joint float: Free { parent: ground, child: hull }
        part legs: [leg; 2] = |i| leg { hip: hull.at((i - 0.5) * Y), length: 0.5 };
        part tail: hoof { ankle: hull.at(0.3 * X) };
    }";

fn shelf() -> Shelf {
    let mut shelf = Shelf::new();
    shelve(LEGS, &mut shelf);
    shelf
}

#[test]
fn private_parts_are_not_handed_on() {
    assert_eq!(shelf().keys().collect::<Vec<_>>(), ["foot", "leg"]);
}

/// The model is that of a call with the parts in it, a module of the call may have the name of a part's part, and the same part by
/// two ways is one.
#[test]
fn a_model_is_what_it_is_in_one_call() {
    let shelf = shelf();
    let alone = format!("{LEGS} {}", ROBOT.replace("hoof", "foot"));
    let (mut expected, said) = checked(&alone, &Shelf::new());
    assert!(said.is_empty(), "{said:?}");
    let (mut found, said) = checked(&format!("use a::{{leg, b::foot as hoof}}; {ROBOT}"), &shelf);
    assert!(said.is_empty(), "{said:?}");
    let (expected, found) = (expected.remove(0), found.remove(0));
    let (one, other) = (Writer(&expected), Writer(&found));
    let joints =
        |w: &Writer<'_>| w.0.joints.iter().map(|j| (w.place(&j.place), w.frame(&j.parent))).collect::<Vec<_>>();
    assert_eq!(joints(&one), joints(&other));
    let masses = |w: &Writer<'_>| w.0.bodies.iter().map(|b| (w.place(&b.place), w.expr(&b.mass))).collect::<Vec<_>>();
    assert_eq!(masses(&one), masses(&other));
    let types = |m: &Model| m.part_types.iter().map(|t| t.name.to_string()).collect::<Vec<_>>();
    assert_eq!(types(&found), ["leg", "foot"], "the foot of a leg and the tail are one part");
    assert_eq!(found.instances.iter().filter(|i| i.part_type == Some(PartTypeId(1))).count(), 3);

    let own = "mod foot { port p: Frame; body b { mass: 1.0 } joint j: Prismatic { parent: p, child: b, axis: X } }";
    let text = format!("use a::leg; {} {own}", ROBOT.replace("hoof { ankle", "foot { p"));
    let (models, said) = checked(&text, &shelf);
    assert!(said.is_empty(), "{said:?}");
    assert_eq!(types(&models[0]), ["leg", "leg_foot", "foot"]);
}

/// Parts of parts of parts, by way of three calls, where one name means another part in each.
#[test]
fn names_mean_what_they_meant_where_they_were_written() {
    let mut shelf = shelf();
    let link = |name: &str, mass: f64, more: &str| {
        format!(
            "pub mod {name} {{ port p: Frame; body b {{ mass: {mass:?} }} joint j: Prismatic {{ parent: p, child: b, axis: X }} {more} }}"
        )
    };
    shelve(&link("a", 1.0, ""), &mut shelf);
    let call =
        format!("use x::a as b; {} {}", link("a", 2.0, "part q: b { p: b };"), link("c", 3.0, "part q: a { p: b };"));
    shelve(&call, &mut shelf);
    // `a` is the second one now, and the first one within it.
    let text = "use x::{c, a as first};
        mod m { part one: c { p: ground }; part two: first { p: one.b }; part three: second { p: ground }; }
        mod second { port p: Frame; body b { mass: 7.0 } joint j: Prismatic { parent: p, child: b, axis: X } }";
    let (models, said) = checked(text, &shelf);
    assert!(said.is_empty(), "{said:?}");
    let w = Writer(&models[0]);
    let masses: Vec<String> =
        models[0].bodies.iter().map(|b| format!("{} {}", w.place(&b.place), w.expr(&b.mass))).collect();
    let expected = ["one.b 3", "one.q.b 2", "one.q.q.b 1", "two.b 2", "two.q.b 1", "three.b 7"];
    assert_eq!(masses, expected);
}

#[test]
fn mistakes_stand_at_the_tokens_of_the_call() {
    let shelf = shelf();
    let body = "body hull { mass: 1.0 } joint j: Prismatic { parent: ground, child: hull, axis: X }";
    let cases = [
        (
            format!("use a::leg; mod m {{ {body} part l: leg {{ hipp: hull }}; }}"),
            "hipp | the part `leg` has no port or param `hipp` | did you mean `hip`?",
        ),
        (
            format!("use a::leg; mod m {{ {body} part l: lge {{ hip: hull }}; }}"),
            "lge | unknown part `lge` | did you mean `leg`?",
        ),
        // Parts of parts are not the model's.
        (
            format!("use a::leg; mod m {{ {body} part l: foot {{ ankle: hull }}; }}"),
            "foot | unknown part `foot` | declare it in this call, or write `use path::of::it;` at its head",
        ),
        (
            format!("use a::leg; mod m {{ {body} part l: leg {{ hip: hull }}; output y = l.end.pod.position; }}"),
            "pod | the part `l.end` has no `pod` | did you mean `pad`?",
        ),
        (
            format!("use a::leg; mod leg {{ {body} }}"),
            "leg | the name `leg` is taken: a module of this call has it | write `use .. as other_leg;`",
        ),
        (
            format!("use a::leg; use b::foot as leg; mod m {{ {body} }}"),
            "leg | the name `leg` is taken: another `use` has it | write `use .. as other_leg;`",
        ),
    ];
    for (text, expected) in cases {
        let (_, said) = checked(&text, &shelf);
        assert_eq!(said.first().map(String::as_str), Some(expected), "{text}");
    }
}

/// A part with a mistake, which its own call tells, and one that means a model: no second error, or a reason.
#[test]
fn parts_that_cannot_be_handed_on() {
    let body = "body b { mass: 1.0 } joint j: Prismatic { parent: p, child: b, axis: X }";
    let model =
        "mod other { body b { mass: 1.0 } joint j: Prismatic { parent: ground, child: b, axis: X } output x = 1.0; }";
    let (source, diagnostics) =
        read(&format!("pub mod broken {{ port p: Frame; body c {{ mass: 1^2 }} {body} }}"), &Shelf::new());
    assert!(!diagnostics.is_empty());
    let withheld = exports::of(&source, true).into_iter().map(|export| (export.name.to_string(), export.tokens));
    let mut shelf: Shelf = withheld.collect();
    shelve(&format!("{model} pub mod asking {{ port p: Frame; {body} output y = other(x); }}"), &mut shelf);
    let (_, said) = checked("use a::broken; mod m { part l: broken { p: ground }; }", &shelf);
    assert_eq!(said, Vec::<String>::new());
    let (_, said) = checked("use a::asking; mod m { part l: asking { p: ground }; }", &shelf);
    assert_eq!(
        said,
        ["asking | the part `asking` can't be used in another call: it asks the model `other` of its own call"]
    );
    shelve("pub mod arm { port p: Frame; part r: Urdf { file: \"a.urdf\", base: p }; }", &mut shelf);
    let (_, said) = checked("use a::arm; mod m { part l: arm { p: ground }; }", &shelf);
    let expected = "arm | the part `arm` can't be used in another call: it holds a robot, whose file is read in the part's own call";
    assert_eq!(said, [expected]);
    let newer: Shelf = [("leg".to_owned(), "99 leg mod leg { port p: Frame; }".parse().expect("tokens"))].into();
    let (_, said) = checked("use a::leg; mod m { part l: leg { p: ground }; }", &newer);
    let expected = "leg | the part `leg` is written in version 99 of the language, this call in version 1 | let both crates depend on one version of multibody";
    assert_eq!(said, [expected]);
}

/// Functions of two crates may have one text, so parts that call those of their own crate are never taken for one.
#[test]
fn functions_of_a_crate_go_with_its_parts() {
    let brake = |path: &str| {
        format!(
            "pub mod brake {{
                extern friction(rate) = {path}::Pad;
                port hinge: Joint;
                force drag: Effort {{ joint: hinge, value: friction(hinge.rate) }}
            }}"
        )
    };
    let pair = "pub mod pair { port hinge: Joint; part inner: brake { hinge: hinge }; }";
    let model = "mod m {
        body a { mass: 1.0, inertia: sphere(1.0, 0.1) }
        joint j: Revolute { parent: ground, child: a, axis: Z }
        part first: one { hinge: j };
        part second: other { hinge: j };
    }";
    let paths = |crate_path: &str| {
        let mut shelf = Shelf::new();
        shelve(&format!("{} {pair}", brake(crate_path)), &mut shelf);
        let handed = shelf["brake"].to_string();
        // What another crate has written in the same words.
        shelf.insert("theirs".to_owned(), shelf["brake"].clone());
        let (models, said) = checked(&format!("use a::brake as one; use b::theirs as other; {model}"), &shelf);
        assert!(said.is_empty(), "{said:?}");
        let functions: Vec<String> = models[0].externals.iter().map(|f| f.path.to_string().replace(' ', "")).collect();
        let (nested, said) = checked(&format!("use a::brake as one; use b::pair as other; {model}"), &shelf);
        assert!(said.is_empty(), "{said:?}");
        (handed, functions, nested[0].externals.len())
    };
    let (handed, functions, nested) = paths("crate::brakes");
    assert!(handed.contains("= $ crate") || handed.contains("= $crate"), "{handed}");
    assert_eq!(functions, ["$crate::brakes::Pad"; 2]);
    assert_eq!(nested, 2);
    let (handed, functions, nested) = paths("::brakes");
    assert!(!handed.contains('$'), "{handed}");
    assert_eq!(functions, ["::brakes::Pad"], "a path from outside says all");
    assert_eq!(nested, 1);
    let (_, functions, nested) = paths("::brakes::Of::<crate::Kind, crate::Size>");
    assert_eq!(functions, ["::brakes::Of::<$crate::Kind,$crate::Size>::Pad"; 2], "but for its arguments");
    assert_eq!(nested, 2);
}
