//! Nothing stops the parser: mutated models, deep nesting, long chains, on a small stack and in little time.

use std::time::{Duration, Instant};

use proc_macro2::{Delimiter, Group, Literal, Punct, Spacing, Span, TokenStream, TokenTree};

use crate::{DOUBLE_PENDULUM, OTHERS, STEWART, parse_text, parse_tokens};

/// SplitMix64: the same cases on every machine.
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Random {
        Random(seed)
    }

    pub(crate) fn below(&mut self, bound: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) % bound.max(1) as u64) as usize
    }
}

/// All tokens of all levels, for replacing one by another.
fn flatten(stream: TokenStream, all: &mut Vec<TokenTree>) {
    for token in stream {
        if let TokenTree::Group(group) = &token {
            flatten(group.stream(), all);
        }
        all.push(token);
    }
}

/// One random change somewhere: inside a group as likely as on its own level.
fn mutate(stream: TokenStream, pool: &[TokenTree], random: &mut Random) -> TokenStream {
    let mut tokens: Vec<TokenTree> = stream.into_iter().collect();
    if tokens.is_empty() {
        return tokens.into_iter().collect();
    }
    let at = random.below(tokens.len());
    // The only group of a level holds nearly everything: go in more often than not.
    let groups: Vec<usize> = (0..tokens.len()).filter(|&i| matches!(tokens[i], TokenTree::Group(_))).collect();
    if !groups.is_empty() && random.below(4) != 0 {
        let at = groups[random.below(groups.len())];
        if let TokenTree::Group(group) = &tokens[at] {
            let mut changed = Group::new(group.delimiter(), mutate(group.stream(), pool, random));
            changed.set_span(group.span());
            tokens[at] = TokenTree::Group(changed);
        }
        return tokens.into_iter().collect();
    }
    let other = random.below(tokens.len());
    match random.below(7) {
        0 => drop(tokens.remove(at)),
        1 => tokens.swap(at, other),
        2 => tokens.insert(at, tokens[other].clone()),
        3 => tokens[at] = pool[random.below(pool.len())].clone(),
        4 => tokens.insert(at, pool[random.below(pool.len())].clone()),
        5 => {
            let delimiters = [Delimiter::Brace, Delimiter::Bracket, Delimiter::Parenthesis, Delimiter::None];
            let end = at + random.below(tokens.len() - at);
            let inner: TokenStream = tokens.drain(at..=end).collect();
            tokens.insert(at, TokenTree::Group(Group::new(delimiters[random.below(4)], inner)));
        }
        _ => tokens.truncate(at),
    }
    tokens.into_iter().collect()
}

#[test]
fn mutated_models() {
    let samples = [DOUBLE_PENDULUM.to_owned(), STEWART.to_owned(), format!("#![krate(::mb)] mod m {{ {OTHERS} }}")];
    let samples: Vec<TokenStream> = samples.iter().map(|text| text.parse().expect("a sample")).collect();
    let mut pool = Vec::new();
    for sample in &samples {
        flatten(sample.clone(), &mut pool);
    }
    let odd =
        "$crate r#fn 'a' b\"x\" 1f32 0x 999999999999999999999999 \u{e9} # ! ? @ ~ % ^ & | :: .. => -> \\u _ if mod pub";
    pool.extend(odd.split(' ').filter_map(|text| text.parse::<TokenStream>().ok()).flatten());
    pool.push(TokenTree::Literal(Literal::f64_unsuffixed(-1.5)));
    pool.push(TokenTree::Punct(Punct::new('\'', Spacing::Joint)));
    let mut random = Random::new(1);
    let mut accepted = 0;
    for case in 0..6_000 {
        let mut tokens = samples[case % samples.len()].clone();
        for _ in 0..1 + random.below(3) {
            tokens = mutate(tokens, &pool, &mut random);
        }
        let (source, diagnostics) = parse_tokens(tokens.clone());
        accepted += usize::from(diagnostics.is_empty());
        // What is lost has been reported.
        let broken = source.modules.iter().any(|module| module.broken);
        assert!(!broken || !diagnostics.is_empty(), "lost without a word in {tokens}");
        for error in diagnostics.errors() {
            let lower = !error.message.starts_with(char::is_uppercase) && !error.message.ends_with('.');
            assert!(lower, "style of {}", error.message);
        }
        drop(diagnostics.to_tokens());
    }
    assert!(accepted > 500, "{accepted} cases are valid");
}

/// One mistake causes one error, or few.
#[test]
fn one_mistake_few_errors() {
    let tokens: TokenStream = DOUBLE_PENDULUM.parse().expect("a sample");
    let mut pool = Vec::new();
    flatten(tokens.clone(), &mut pool);
    let mut random = Random::new(3);
    let (mut worst, mut sum) = (0, 0);
    for _ in 0..1_500 {
        let changed = mutate(tokens.clone(), &pool, &mut random);
        let (_, diagnostics) = parse_tokens(changed);
        sum += diagnostics.errors().len();
        worst = worst.max(diagnostics.errors().len());
    }
    assert!(worst <= 16 && sum <= 1_800, "worst {worst}, sum {sum}");
}

/// Runs on half of the stack that a test has, so that the later stages have theirs too.
fn bounded(name: &str, text: String) {
    assert!(text.len() <= 66_000, "{name}: {}", text.len());
    let run = move || {
        let start = Instant::now();
        let (source, diagnostics) = parse_text(&text);
        let errors = diagnostics.errors().len();
        drop(diagnostics.to_tokens());
        drop(source);
        (start.elapsed(), errors)
    };
    let thread = std::thread::Builder::new().stack_size(1 << 20).spawn(run).expect("a thread");
    let (time, _) = thread.join().unwrap_or_else(|_| panic!("{name} panics"));
    assert!(time < Duration::from_secs(20), "{name} takes {time:?}");
}

const SIZE: usize = 64 << 10;

/// `open` and `close` around each other, as many as fit, where a value stands.
fn nested(open: &str, close: &str) -> String {
    let times = SIZE / (open.len() + close.len());
    format!("mod m {{ let a = {}x{}; }}", open.repeat(times), close.repeat(times))
}

fn repeated(size: usize, start: &str, piece: &str, end: &str) -> String {
    format!("mod m {{ {start}{}{end} }}", piece.repeat(size / piece.len()))
}

#[test]
fn deep_nesting_ends() {
    for (open, close) in [
        ("(", ")"),
        ("[", "]"),
        ("{", "}"),
        ("f(", ")"),
        ("a.b(", ")"),
        ("a[", "]"),
        ("-(", ")"),
        ("a + (b * ", ")"),
        ("a||b&&c<d+e*(", ")"),
        ("-!a.b[0].f(1, [2, ", "])"),
        ("f {x: ", "}"),
        ("|x| ", ""),
        ("if a {", "}"),
    ] {
        bounded(open, nested(open, close));
    }
    let types = SIZE / 4;
    bounded(
        "types",
        format!(
            "mod m {{ param a: {}Scalar{} = 1; }}",
            "[".repeat(types),
            "; 1]".repeat(SIZE / 8) + &"]".repeat(types - SIZE / 8)
        ),
    );
    bounded("models", "mod a {".repeat(SIZE / 8) + &"}".repeat(SIZE / 8));
    bounded("bodies", format!("mod m {{ {}{} }}", "body a { b: ".repeat(5_000), "}".repeat(5_000)));
    bounded("attributes", format!("#[a{}{}] mod m {{}}", "(".repeat(SIZE / 2), ")".repeat(SIZE / 2)));
    bounded("values", format!("#[a = {}{}] mod m {{}}", "(".repeat(SIZE / 2), ")".repeat(SIZE / 2)));
    bounded("visibility", format!("pub({}{}) mod m {{}}", "(".repeat(SIZE / 2), ")".repeat(SIZE / 2)));
    bounded("krate", format!("#![krate{}{}] mod m {{}}", "(".repeat(SIZE / 2), ")".repeat(SIZE / 2)));
}

/// Pieces between spaces; `_` stands for a space.
const PIECES: &str = "- ! * & -_! a. .b .b() [0] (0) +a *a <a =a &&a ||a = ? .. a:: as_b_ ::< | |x| return_ if_ \
    move_ 'a: 1_ a_ \"x\" # #[x] !x , ; {} () [] a! for<'a> fn()-> &'a_ let_ param_ mod_ pub_ emit_a, \
    param_x_=_1_ body_b_ body_b_{}; joint_j: jiont_j:K{} part_p:[a;1]=|i|";

#[test]
fn long_chains_end() {
    for piece in PIECES.split_whitespace() {
        let piece = piece.replace('_', " ");
        bounded(&piece, repeated(SIZE, "let a = x", &piece, ";"));
        // Shorter, only to be quicker: in other places the same happens.
        let others = [
            ("", ""),
            ("let a = ", "x;"),
            ("param a: ", ";"),
            ("world { a: x", "}"),
            ("emit ", ";"),
            ("#[x = ", "] world {}"),
            ("assume f(a, ", ");"),
            ("part p: [leg; 2] = ", ";"),
        ];
        for (start, end) in others {
            bounded(&piece, repeated(SIZE / 32, start, &piece, end));
        }
    }
}

#[test]
fn long_words_and_numbers_end() {
    for digit in ["9", "0", "1_", "a"] {
        for start in ["", "0x", "0b1", "1.", "1e"] {
            let text = repeated(SIZE, &format!("let a = {start}"), digit, ";");
            if text.parse::<TokenStream>().is_ok() {
                bounded(start, text);
            }
        }
    }
    let word = "x".repeat(SIZE);
    bounded("word", format!("mod m {{ {word} {word} = 1; }}").chars().take(66_000 - 3).collect::<String>() + " }");
    bounded("doc", format!("/// {word}\nmod m {{}}"));
}

/// Invisible groups can only come from other macros.
#[test]
fn invisible_groups_end() {
    let run = || {
        for wide in [false, true] {
            let mut tokens: TokenStream = "x".parse().expect("a name");
            for _ in 0..20_000 {
                if wide {
                    tokens.extend("+ x".parse::<TokenStream>().expect("a sum"));
                }
                tokens = TokenTree::Group(Group::new(Delimiter::None, tokens)).into();
            }
            let mut model: TokenStream = "let a =".parse().expect("a start");
            model.extend([tokens]);
            let model = TokenTree::Group(Group::new(Delimiter::Brace, model));
            let mut call: TokenStream = "mod m".parse().expect("a start");
            call.extend([model]);
            let (_, diagnostics) = parse_tokens(call);
            assert!(!diagnostics.is_empty());
        }
    };
    std::thread::Builder::new().stack_size(1 << 20).spawn(run).expect("a thread").join().expect("no panic");
}

/// Deepest legal expressions: other stages recurse into them.
#[test]
fn limits_are_generous() {
    let brackets = 60;
    crate::valid(&format!("mod m {{ let a = {}x{}; }}", "(".repeat(brackets), ")".repeat(brackets)));
    crate::valid(&format!("mod m {{ let a = x{}; }}", " + x".repeat(250)));
    crate::valid(&format!("mod m {{ let a = [{}]; }}", "1.0, ".repeat(10_000)));
    assert!(Span::call_site().source_text().is_none());
}
