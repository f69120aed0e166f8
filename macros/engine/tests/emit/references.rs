//! What editors follow: each word of the user's that stands for something stands once in what is emitted for them.

use std::collections::{BTreeMap, BTreeSet};

use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::model::references::{self, words};
use multibody_engine::{emit, expand, model, syntax};
use proc_macro2::{LineColumn, TokenStream, TokenTree};

use crate::corpus;

/// Identifiers by place, where they stand several times several times.
type Words = BTreeMap<Place, Vec<String>>;
type Place = [(usize, usize); 2];

/// Words of the language that lead nowhere: keywords, values, functions, and what is taken of joints, frames and values.
const LANGUAGE: &[&str] = &[
    "mod",
    "pub",
    "crate",
    "krate",
    "const",
    "param",
    "input",
    "let",
    "extern",
    "output",
    "speed",
    "state",
    "port",
    "world",
    "formulation",
    "body",
    "joint",
    "force",
    "part",
    "constraint",
    "drive",
    "solve",
    "from",
    "assume",
    "simplify",
    "emit",
    "rate",
    "start",
    "small",
    "mass_matrix",
    "mass_matrix_lower",
    "forward_dynamics",
    "inverse_dynamics",
    "outputs",
    "bias",
    "constraint",
    "jacobian",
    "ground",
    "X",
    "Y",
    "Z",
    "PI",
    "t",
    "cut",
    "allow",
    "unphysical_inertia",
    "doc",
    "cfg",
    "test",
    "feature",
    "not",
    "all",
    "any",
];

fn place(start: LineColumn, end: LineColumn) -> Place {
    [(start.line, start.column), (end.line, end.column)]
}

/// Identifiers of a stream; `is_call` and `is_member` are told of each: whether brackets follow, whether a dot comes before.
fn each_word(tokens: TokenStream, f: &mut impl FnMut(&proc_macro2::Ident, bool, bool)) {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    for (k, token) in tokens.iter().enumerate() {
        match token {
            TokenTree::Group(group) => each_word(group.stream(), f),
            TokenTree::Ident(word) => {
                let called = matches!(tokens.get(k + 1), Some(TokenTree::Group(group))
                    if group.delimiter() == proc_macro2::Delimiter::Parenthesis);
                let before = k.checked_sub(1).and_then(|before| tokens.get(before));
                let member = matches!(before, Some(TokenTree::Punct(punct)) if punct.as_char() == '.');
                f(word, called, member);
            }
            _ => {}
        }
    }
}

/// Identifiers that stand at a place of the user's.
fn words_of(tokens: TokenStream) -> Words {
    let mut words = Words::new();
    each_word(tokens, &mut |word, _, _| {
        let span = word.span();
        if span.source_text().is_some() {
            words.entry(place(span.start(), span.end())).or_default().push(word.to_string());
        }
    });
    words
}

fn names_of(call: TokenStream, all: bool) -> TokenStream {
    let source = syntax::parse(call, &mut Diagnostics::default());
    emit::references::names(&references::of(&source), all)
}

/// In every call without mistakes of the project.
#[test]
fn every_word_that_stands_for_something_leads_there() {
    let mut followed = 0;
    for (file, call) in corpus::calls() {
        let mut diagnostics = Diagnostics::default();
        let source = syntax::parse(call.clone(), &mut diagnostics);
        model::check(&source, &mut diagnostics);
        // A call that uses parts of others is followed once rustc has put them in.
        if !diagnostics.is_empty() || source.pending.is_some() {
            continue;
        }
        let tokens = names_of(call.clone(), false);
        // No name leads nowhere.
        assert_eq!(tokens.to_string(), names_of(call.clone(), true).to_string(), "{file}");
        let emitted = words_of(tokens);
        // Of two models of one name, between which `cfg` chooses, the first is there.
        let models: BTreeSet<String> = source.modules.iter().map(|module| module.name.to_string()).collect();
        let runtime = source.krate.iter().flat_map(|path| &path.segments).map(|segment| segment.ident.to_string());
        // Paths of functions of Rust are followed as Rust, and names of their arguments stand for nothing.
        let of_rust = source.externals().flat_map(|function| {
            let path = function.path.clone().into_iter().map(|token| token.to_string());
            function.parameters.iter().map(ToString::to_string).chain(path)
        });
        let runtime: BTreeSet<String> = runtime.chain(of_rust).collect();
        let mut strange = BTreeSet::new();
        each_word(call, &mut |word, called, member| {
            let span = word.span();
            let text = word.to_string();
            if runtime.contains(&text) {
                return;
            }
            match emitted.get(&place(span.start(), span.end())).map(Vec::as_slice) {
                Some([one]) => {
                    assert_eq!(*one, text, "{file}: {:?}", span.start());
                    followed += 1;
                }
                Some(several) => panic!("{file}: {:?}: {several:?}", span.start()),
                None if called || member || LANGUAGE.contains(&text.as_str()) || models.contains(&text) => {}
                None => {
                    strange.insert(text);
                }
            }
        });
        assert!(strange.is_empty(), "{file}: {strange:?} lead nowhere");
    }
    assert!(followed > 5_000, "{followed}");
}

const WALKER: &str = "
mod leg {
    port hip: Frame;
    param length = 1.0;
    body shank { mass: 1.0, com: length * X }
    joint knee: Revolute { parent: hip, child: shank, axis: Z }
    output foot = shank.at(length * X).position;
}
pub mod walker {
    const N = 2;
    body trunk { mass: 3.0, inertia: sphere(3.0, 0.2) }
    joint float: Planar { parent: ground, child: trunk, axis: Z }
    part legs: [leg; N] = |i| leg { hip: trunk.at(0.1 * i * X), length: 2.0 };
    part tail: leg { hip: trunk, length: 1.0 };
    let first = legs[0];
    let again = first;
    output knee = again.knee.rate + float.angle + N;
    output trunk = norm(tail.foot) + norm(trunk.position);
    emit forward_dynamics, kinematics { given: legs.knee, find: tail.knee };
}";

/// Words that lead somewhere, in the order of the text.
fn followed(call: &str) -> Vec<String> {
    let words = words_of(names_of(call.parse().unwrap(), true));
    words.into_values().flatten().collect()
}

/// Behind a part stand names of its module; an index, and an output of another's name, are what they should be.
#[test]
fn names_of_parts_lead_into_them() {
    let want = "leg hip Frame length shank mass com length knee Revolute parent hip child shank axis foot shank length
        walker N trunk mass inertia float Planar parent child trunk axis
        legs leg N i leg hip trunk i length tail leg hip trunk length first legs again first
        knee again knee float N trunk tail foot trunk
        forward_dynamics kinematics given legs knee find tail knee";
    assert_eq!(followed(WALKER), want.split_whitespace().collect::<Vec<_>>());
    let text = names_of(WALKER.parse().unwrap(), false).to_string().replace(' ', "");
    for piece in [
        "let_=NamesOf1::again;let_=NamesOf0::knee;",
        "let_=NamesOf1::tail;let_=NamesOf0::foot;",
        "enumOutputsOf1{",
        "{leti:::multibody::words::name::Index=A::any();",
    ] {
        assert!(text.contains(piece), "{piece}: {text}");
    }
}

/// A model that is asked for a formula, and what it is asked for and given.
#[test]
fn a_formula_leads_into_its_model() {
    let call = "mod swing {
        param length = 1.0;
        body rod { mass: 1.0, com: length * X }
        joint hinge: Revolute { parent: ground, child: rod, axis: Z }
    }
    mod drive {
        param length = 2.0;
        body rod { mass: 1.0 }
        joint slide: Prismatic { parent: ground, child: rod, axis: X }
        output at = swing(rod.position.x, hinge = slide, length = length);
    }";
    let text = names_of(call.parse().unwrap(), false).to_string().replace(' ', "");
    let want = "let_=Modules::swing;let_=NamesOf0::rod;let_=NamesOf0::hinge;let_=NamesOf1::slide;let_=NamesOf0::length;\
                let_=NamesOf1::length;";
    assert!(text.contains(want), "{text}");
}

/// Arguments mean something in their function's value; functions, those of parts too, lead to their items.
#[test]
fn functions_and_their_arguments_lead_somewhere() {
    let call = "mod leg {
        port hip: Frame;
        body shank { mass: 1.0 }
        joint knee: Revolute { parent: hip, child: shank, axis: Z }
        let reach(x) = x * knee;
    }
    mod m {
        body b { mass: 1.0 }
        joint j: Prismatic { parent: ground, child: b, axis: Z }
        part legs: [leg; 2] = |i| leg { hip: b.at(far(i, j) * X) };
        let far(u, v) = u + sin(v) * u;
        let closed(w) = far(w, w);
        output y = closed(legs[0].reach(j)) + far(legs[1].knee, 2.0);
    }";
    let want = "leg hip Frame shank mass knee Revolute parent hip child shank axis reach x x knee
        m b mass j Prismatic parent child b axis legs leg i leg hip b far i j far u v u v u closed w far w w
        y closed legs reach j far legs knee";
    assert_eq!(followed(call), want.split_whitespace().collect::<Vec<_>>());
    let text = names_of(call.parse().unwrap(), false).to_string().replace(' ', "");
    let inside = "{letu:::multibody::words::name::Argument=A::any();{letv:::multibody::words::name::Argument=A::any();\
                  let_=u;let_=v;let_=u;}}";
    assert!(text.contains(inside), "{text}");
}

/// `r#arm` is `arm`: one name of the module's, to which both lead. A keyword is a name as a raw one alone.
#[test]
fn raw_names_are_names() {
    let call = "mod r#swing {
        param r#arm = 1.0;
        param r#type = 2.0;
        body rod { mass: r#type, com: arm * X }
        joint hinge: Revolute { parent: ground, child: r#rod, axis: Z }
        output reach = r#arm * cos(hinge);
    }";
    let tokens = names_of(call.parse().unwrap(), false);
    syn::parse2::<syn::File>(tokens.clone()).expect("items");
    let text = tokens.to_string().replace(' ', "");
    assert_eq!(text.matches("let_=NamesOf0::arm;").count(), 2, "{text}");
    assert_eq!(text.matches("let_=NamesOf0::rod;").count(), 1, "{text}");
    assert!(text.contains("let_=NamesOf0::r#type;") && !text.contains("r#arm") && !text.contains("r#swing"), "{text}");
    assert!(!expand(call.parse().unwrap()).to_string().contains("compile_error"));
    // Two of one name are a mistake, and no two names of one enum.
    let twice = call.replace("param r#type", "param arm = 1.0; param r#type");
    let text = names_of(twice.parse().unwrap(), true).to_string();
    assert!(syn::parse_str::<syn::File>(&text).is_ok() && !text.contains("r#arm"), "{text}");
    assert!(expand(twice.parse().unwrap()).to_string().contains("the name `arm` is taken"));
}

/// A model with mistakes has references for editors, which complete what is unknown, and none for a compiler, to which each
/// would be one more error.
#[test]
fn a_mistake_leads_nowhere_but_stands_where_it_is_completed() {
    let call = "mod broken {
        param length = 1.0;
        body rod { mass: 2.0 * lengt, c: X }
        joint hinge: Revolut { parent: ground, child: rod, axi: Z }
        part legs: le { hip: rod };
        emit forw;
    }";
    let want = "broken length rod mass lengt c hinge Revolut parent child rod axi legs le rod forw";
    assert_eq!(followed(call), want.split_whitespace().collect::<Vec<_>>());
    let tokens = names_of(call.parse().unwrap(), true);
    syn::parse2::<syn::File>(tokens).expect("items");
    let compiled = expand(call.parse().unwrap()).to_string();
    assert!(compiled.contains("compile_error") && !compiled.contains("NamesOf"));
}

/// The methods that a word in `emit` asks for stand at that word.
#[test]
fn methods_stand_at_their_words() {
    let call = "mod pendulum {
        input push;
        body rod { mass: 2.0, com: X }
        joint hinge: Revolute { parent: ground, child: rod, axis: Z }
        force motor: Effort { joint: hinge, value: push }
        emit forward_dynamics, energy, kinematics { given: hinge, find: hinge };
    }";
    let call = call.replace(", kinematics { given: hinge, find: hinge }", "");
    let output: TokenStream = expand(call.parse().unwrap());
    for (method, word) in
        [("forward_dynamics", "forward_dynamics"), ("kinetic_energy", "energy"), ("potential_energy", "energy")]
    {
        let mut at = BTreeSet::new();
        each_word(output.clone(), &mut |name, _, member| {
            if name == method && !member {
                at.extend(name.span().source_text());
            }
        });
        assert!(at.contains(word), "{method}: {at:?}");
    }
}

/// Each word that editors are told of is an item of the runtime, documented, with these fields.
#[test]
fn the_runtime_has_all_words() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../runtime/src/words.rs");
    let file: syn::File = syn::parse_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let documented = |attrs: &[syn::Attribute]| attrs.iter().any(|attr| attr.path().is_ident("doc"));
    let mut found = BTreeMap::new();
    for item in file.items {
        let syn::Item::Mod(room) = item else { continue };
        for item in room.content.map_or_else(Vec::new, |content| content.1) {
            let syn::Item::Struct(word) = item else { continue };
            let fields: Vec<String> = word.fields.iter().map(|f| f.ident.as_ref().unwrap().to_string()).collect();
            assert!(documented(&word.attrs) && word.fields.iter().all(|field| documented(&field.attrs)));
            found.insert((room.ident.to_string(), word.ident.to_string()), fields.into_iter().collect::<BTreeSet<_>>());
        }
    }
    for (room, word, fields) in words::all() {
        let fields: BTreeSet<String> = fields.into_iter().map(str::to_owned).collect();
        let has = found.remove(&(room.to_owned(), word.to_owned()));
        assert_eq!(has, Some(fields), "{room}::{word}");
    }
    // What is left are types of fields.
    found.retain(|(room, _), _| room != "ty");
    assert!(found.is_empty(), "{found:?}");
}
