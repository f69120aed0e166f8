//! Mutated models thrown at the whole engine: nothing panics, and everything ends.
//!
//! Tokens are dropped, swapped, doubled, retyped and moved, by a seeded generator. `FUZZ_CASES` sets the number of cases.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

use multibody_engine::diagnostics::Diagnostics;
use multibody_engine::{expand, syntax};
use multibody_tests::support::engine::calls;
use multibody_tests::support::random::Random;
use proc_macro2::{Delimiter, Group, Ident, Literal, Punct, Spacing, Span, TokenStream, TokenTree};

/// Words that a mutation puts where another word was.
const WORDS: [&str; 44] = [
    "body",
    "joint",
    "force",
    "param",
    "const",
    "input",
    "let",
    "output",
    "emit",
    "world",
    "part",
    "port",
    "state",
    "mass",
    "com",
    "inertia",
    "parent",
    "child",
    "axis",
    "axes",
    "value",
    "Revolute",
    "Ball",
    "Free",
    "Universal",
    "Fixed",
    "Planar",
    "Screw",
    "RollPitchYaw",
    "ground",
    "X",
    "Z",
    "t",
    "PI",
    "sin",
    "norm",
    "select",
    "kinetic",
    "diag",
    "rod",
    "position",
    "rate",
    "jacobian",
    "reaction",
];

const NUMBERS: [&str; 12] =
    ["0", "1", "0.0", "-1.0", "1e308", "1e-308", "2.5f32", "99999999999999999999", "1_0", "0x10", "3i", "1e400"];

const PUNCTUATION: [char; 14] = ['.', ',', ';', ':', '+', '-', '*', '/', '=', '<', '>', '!', '#', '|'];

/// Small models with everything in them; the mutations are many, and derivation is the slow part.
const SEEDS: [&str; 5] = [
    "pub mod a { param m = 1.0; world { gravity: -9.81 * Y } body b { mass: m, com: -0.5 * Y, inertia: rod(m, 1.0, Y) }
     joint j: Revolute { parent: ground, child: b, axis: Z } output e = kinetic() + potential();
     emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy; }",
    "mod a { input u: Vec3; state s: rate = u.x - s, start: 0.5; body b { mass: 2.0, inertia: diag(1.0, 1.5, 2.0) }
     joint j: Free { parent: ground.at(X), child: b.rotated(Z, 0.3), coordinates: RollPitchYaw }
     force f: Force { at: b.at(Y), value: [s, u.y, select(t > 1.0, 1.0, 2.0)], axes: b }
     output p: Pose = b.pose; output r = j.reaction.force; output c: Jacobian = b.jacobian; }",
    "mod l { port base: Frame; param k: [Scalar; 2] = [1.0, 2.0]; body b { mass: k[0], com: 0.1 * X }
     joint j: Prismatic { parent: base, child: b, axis: [1.0, 1.0, 0.0], armature: 0.1 }
     force s: SpringDamper { joint: j, stiffness: k[1], damping: 0.1, rest: 0.2 } }
     mod a { const P: [Vec3; 2] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
     part ls: [l; 2] = |i| l { base: ground.at(P[i]).rotated(Z, 0.5 * i) };
     output d = norm(ls[0].b.position - ls[1].b.position); output w = ls[1].s.power; }",
    "mod a { body b { mass: 1.0, com: 0.2 * X, inertia: cuboid(1.0, [0.1, 0.2, 0.3]) } body c { mass: 0.5 }
     joint j: Universal { parent: ground, child: b, axes: [X, Y] }
     joint k: Planar { parent: b.at(X), child: c, axis: Z }
     joint w: Fixed { parent: c, child: d } #[allow(unphysical_inertia)]
     body d { mass: 0.1, inertia: inertia(1.0, 1.0, 3.0, 0.1, 0.0, 0.0) }
     force e: Effort { joint: j.first, value: -0.1 * j.first.rate + sin(3.0 * t) }
     force f: Spring { between: [b.at(Y), ground.at(2.0 * Y)], stiffness: 5.0, length: 0.5 }
     output r = w.reaction.moment; output a = c.acceleration; emit forward_dynamics, mass_matrix; }",
    "mod a { body b { mass: 1.0, com: -0.9 * Z, inertia: sphere(1.0, 0.1) } world { gravity: [0.0, 0.0, -9.81] }
     joint j: Ball { parent: ground.oriented([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]), child: b }
     body c { mass: 0.3, com: [0.1, 0.0, 0.0] } joint s: Screw { parent: b, child: c, axis: Y, pitch: 0.1 }
     let reach = b.express(c.position); output h = hypot(reach.x, powi(reach.y, 2)) / max(1.0, exp(s.angle)); }",
];

struct Mutator {
    random: Random,
    /// Words of the model at hand.
    words: Vec<String>,
}

fn words(tokens: TokenStream, into: &mut Vec<String>) {
    for token in tokens {
        match token {
            TokenTree::Ident(word) => into.push(word.to_string()),
            TokenTree::Group(group) => words(group.stream(), into),
            _ => {}
        }
    }
}

impl Mutator {
    fn new(seed: u64) -> Self {
        Self { random: Random::new(seed), words: Vec::new() }
    }

    /// One mutation, often two.
    fn case(&mut self, tokens: TokenStream) -> TokenStream {
        self.words.clear();
        words(tokens.clone(), &mut self.words);
        let once = self.mutate(tokens);
        if self.random.below(3) == 0 { self.mutate(once) } else { once }
    }

    /// The tokens with one mutation somewhere, in any depth.
    fn mutate(&mut self, tokens: TokenStream) -> TokenStream {
        let mut list: Vec<TokenTree> = tokens.into_iter().collect();
        if list.is_empty() {
            return std::iter::once(self.any()).collect();
        }
        let groups: Vec<usize> = (0..list.len()).filter(|k| matches!(list[*k], TokenTree::Group(_))).collect();
        // Most tokens stand deep inside.
        if !groups.is_empty() && self.random.below(8) > 0 {
            let at = groups[self.random.below(groups.len())];
            if let TokenTree::Group(group) = &list[at] {
                let inner = self.mutate(group.stream());
                let delimiter = if self.random.below(200) == 0 { self.delimiter() } else { group.delimiter() };
                list[at] = TokenTree::Group(Group::new(delimiter, inner));
            }
            return list.into_iter().collect();
        }
        let at = self.random.below(list.len());
        let other = self.random.below(list.len());
        match self.random.below(14) {
            0 => drop(list.remove(at)),
            1 => list.swap(at, other),
            2 => list.insert(at, list[other].clone()),
            3 => list[at] = list[other].clone(),
            4 => list.insert(at, self.any()),
            5 => list[at] = self.any(),
            _ => list[at] = self.alike(&list[at].clone()),
        }
        list.into_iter().collect()
    }

    /// A token of the same kind.
    fn alike(&mut self, token: &TokenTree) -> TokenTree {
        match token {
            TokenTree::Ident(_) => self.word(),
            TokenTree::Literal(_) => self.number(),
            TokenTree::Punct(_) => self.punctuation(),
            TokenTree::Group(group) => TokenTree::Group(Group::new(self.delimiter(), group.stream())),
        }
    }

    fn any(&mut self) -> TokenTree {
        match self.random.below(5) {
            0 | 1 => self.word(),
            2 => self.number(),
            3 => self.punctuation(),
            _ => TokenTree::Group(Group::new(self.delimiter(), std::iter::once(self.word()).collect())),
        }
    }

    fn word(&mut self) -> TokenTree {
        let own = !self.words.is_empty() && self.random.below(3) > 0;
        let word =
            if own { &self.words[self.random.below(self.words.len())] } else { WORDS[self.random.below(WORDS.len())] };
        TokenTree::Ident(Ident::new(word, Span::call_site()))
    }

    fn number(&mut self) -> TokenTree {
        let text = NUMBERS[self.random.below(NUMBERS.len())];
        let text = text.strip_prefix('-').unwrap_or(text);
        text.parse::<Literal>().map_or_else(|_| TokenTree::Literal(Literal::f64_unsuffixed(1.5)), TokenTree::Literal)
    }

    fn punctuation(&mut self) -> TokenTree {
        let spacing = if self.random.below(4) == 0 { Spacing::Joint } else { Spacing::Alone };
        TokenTree::Punct(Punct::new(PUNCTUATION[self.random.below(PUNCTUATION.len())], spacing))
    }

    fn delimiter(&mut self) -> Delimiter {
        [Delimiter::Brace, Delimiter::Bracket, Delimiter::Parenthesis, Delimiter::None][self.random.below(4)]
    }
}

/// Whether the grammar finds nothing to say.
fn parses(tokens: &TokenStream) -> bool {
    let mut diagnostics = Diagnostics::default();
    syntax::parse(tokens.clone(), &mut diagnostics);
    diagnostics.is_empty()
}

/// Characters that 64 KiB may become: modules of one body each come to 27 million.
const MOST: usize = 40_000_000;

/// What the engine makes of the tokens, which must be Rust: whether it is a model, and its size.
fn survives(tokens: &TokenStream) -> Result<(bool, usize), String> {
    let output = catch_unwind(AssertUnwindSafe(|| expand(tokens.clone())));
    let output = output.map_err(|_| format!("panic at:\n{tokens}"))?;
    let text = output.to_string();
    let error = text.contains("compile_error");
    if text.contains(" has failed for ") {
        return Err(format!("a fault at:\n{tokens}\n{text}"));
    }
    match syn::parse2::<syn::File>(output) {
        Ok(_) => Ok((!error, text.len())),
        Err(e) => Err(format!("no Rust ({e}) for:\n{tokens}")),
    }
}

fn cases() -> usize {
    std::env::var("FUZZ_CASES").ok().and_then(|text| text.parse().ok()).unwrap_or(4000)
}

#[test]
fn mutated_models() {
    let mut mutator = Mutator::new(20);
    let (mut parsed, mut valid) = (0, 0);
    let mut slowest = Duration::ZERO;
    for case in 0..cases() {
        let tokens = mutator.case(SEEDS[case % SEEDS.len()].parse().unwrap());
        parsed += usize::from(parses(&tokens));
        let start = Instant::now();
        match survives(&tokens) {
            Ok((compiled, _)) => valid += usize::from(compiled),
            Err(text) => panic!("case {case}: {text}"),
        }
        slowest = slowest.max(start.elapsed());
    }
    println!("{} cases, {parsed} parse, {valid} compile, slowest {slowest:?}", cases());
    assert!(3 * parsed >= cases(), "only {parsed} get past the parser");
    assert!(20 * valid >= cases(), "only {valid} compile");
}

#[test]
fn seeds_are_valid() {
    for seed in SEEDS {
        assert!(survives(&seed.parse().unwrap()).is_ok_and(|(compiled, _)| compiled), "{seed}");
    }
}

/// A few mutations of the larger models of other tests.
#[test]
fn mutated_large_models() {
    let mut mutator = Mutator::new(21);
    for file in ["models/small.rs", "models/laws.rs"] {
        for call in calls(file) {
            for _ in 0..3 {
                let tokens = mutator.case(call.clone());
                survives(&tokens).unwrap_or_else(|text| panic!("{text}"));
            }
        }
    }
}

/// It ends, and what comes out is no more than what comes of the greatest models that are accepted.
fn ends(what: &str, text: &str) {
    assert!(text.len() <= 64 * 1024, "{what}: {} bytes", text.len());
    let Ok(tokens) = text.parse::<TokenStream>() else { panic!("{what}: no tokens") };
    let start = Instant::now();
    let (compiled, size) = survives(&tokens).unwrap_or_else(|text| panic!("{what}: {text:.200}"));
    println!("{what}: compiles {compiled}, {size} characters, {:?}", start.elapsed());
    assert!(size <= MOST, "{what}: {size} characters");
}

/// As much of one thing as 64 KiB hold.
fn filled(head: &str, item: impl Fn(usize) -> String, tail: &str) -> String {
    let mut text = head.to_owned();
    for k in 0.. {
        let next = item(k);
        if text.len() + next.len() + tail.len() > 64 * 1024 {
            break;
        }
        text += &next;
    }
    text + tail
}

#[test]
fn sixty_four_kilobytes() {
    ends("bodies", &filled("mod m {", |k| format!("body b{k} {{ mass: 1.0 }}"), "}"));
    let chain = |k: usize| {
        let parent = if k == 0 { "ground".to_owned() } else { format!("b{}.at(X)", k - 1) };
        format!(
            "body b{k} {{ mass: 1.0, com: X, inertia: diag(1.0, 1.5, 2.0) }}
             joint j{k}: Revolute {{ parent: {parent}, child: b{k}, axis: [1.0, {k}.0, 2.0] }}"
        )
    };
    ends("chain", &filled("mod m { world { gravity: -9.81 * Z }", chain, "}"));
    ends("params", &filled("mod m {", |k| format!("param p{k} = 1.0;"), "}"));
    ends("sum", &filled("mod m { output a = 0.0", |k| format!(" + sin({k}.0 * t)"), "; }"));
    let hinge = "mod m { body b { mass: 1.0, com: X, inertia: diag(1.0, 1.0, 1.0) }
                  joint j: Revolute { parent: ground, child: b, axis: Z }";
    ends("sines", &filled(hinge, |k| format!("output o{k} = sin(j.angle + {k}.5);"), "}"));
    let fan = |count: usize| {
        format!(
            "mod arm {{ port base: Frame; body b {{ mass: 1.0, com: X, inertia: diag(1.0, 1.0, 1.0) }}
             joint j: Revolute {{ parent: base, child: b, axis: Z }} }}
             mod m {{ part arms: [arm; {count}] = |i| arm {{ base: ground }};
             emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy; }}"
        )
    };
    ends("fan", &fan(200));
    ends("wide fan", &fan(3000));
    ends("nest", &format!("mod m {{ output a = {}1.0{}; }}", "(".repeat(30_000), ")".repeat(30_000)));
    ends("minus", &filled("mod m { output a = ", |_| "-".to_owned(), "1.0; }"));
    ends("lets", &filled("mod m { let a0 = t;", |k| format!("let a{} = a{k} * a{k};", k + 1), "output o = a9; }"));
    ends("braces", &filled("mod m {", |_| "{} ".to_owned(), "}"));
    ends("modules", &filled("", |k| format!("mod m{k} {{ body b {{ mass: 1.0 }} }}"), ""));
    ends("emit", &filled("mod m { emit energy", |_| ", energy".to_owned(), "; }"));
    ends("frames", &filled("mod m { output a = ground", |_| ".at(X)".to_owned(), ".position; }"));
}
