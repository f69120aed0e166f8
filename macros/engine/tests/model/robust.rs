//! Whatever the tokens: an answer, in good time, on a small stack.

use std::fmt::Write;
use std::time::{Duration, Instant};

use crate::support::{check, said};

const BODY: &str = "body b { mass: 1.0 } joint j: Prismatic { parent: ground, child: b, axis: Z }";

/// Runs on the stack that rustc gives to no thread: its own are larger. Seconds on a quiet machine; what grows with a power of
/// its size would take hours.
fn quickly<T: Send + 'static>(run: impl FnOnce() -> T + Send + 'static) -> T {
    let start = Instant::now();
    let thread = std::thread::Builder::new().stack_size(1 << 20);
    let result = thread.spawn(run).expect("a thread").join().expect("no panic");
    assert!(start.elapsed() < Duration::from_secs(120), "{:?}", start.elapsed());
    result
}

#[test]
fn long_sums_are_flat() {
    let sum: String = (0..120).map(|_| " + j - 1.0").collect();
    let said = quickly(move || said(&format!("mod m {{ {BODY} output x = 1.0{sum}; output y = X{sum}; }}")));
    assert_eq!(said.len(), 1, "{said:?}");
    assert!(said[0].contains("expected a Vec3, found a scalar"), "{said:?}");
}

#[test]
fn deep_chains_end() {
    let forward: String = (1..1000).map(|k| format!("let a{k} = sin(a{}) + j;", k - 1)).collect();
    let text = format!("mod m {{ {BODY} let a0 = 1.0; {forward} output x = a999; }}");
    let first = quickly(move || said(&text));
    assert_eq!(first.len(), 1);
    assert!(first[0].contains("nested more than"), "{first:?}");

    let backward: String = (1..1000).map(|k| format!("let a{} = sin(a{k});", k - 1)).collect();
    let text = format!("mod m {{ {BODY} {backward} let a999 = j; output x = a0; }}");
    let second = quickly(move || said(&text));
    assert!(second.iter().any(|s| s.contains("nested too deeply")), "{second:?}");

    let nested = format!("{}j{}", "sin(norm([".repeat(60), ", 1.0, 2.0]))".repeat(60));
    let text = format!("mod m {{ {BODY} output x = {nested}; }}");
    quickly(move || check(&text).1.errors().len());

    let product: String = (0..250).map(|_| " * j").collect();
    let text = format!("mod m {{ {BODY} output x = 1.0{product}; }}");
    let third = quickly(move || said(&text));
    assert_eq!(third, Vec::<String>::new());
}

/// No text in brackets does harm, whether it is a unit or nearly one.
#[test]
fn any_brackets_are_read() {
    let pieces = [
        "m", "kg", "N", "rad", "1", "2", "-", "^", "*", "/", "(", ")", " ", ".", "·", "²", "⁻", "%", "°", "e9", "µ",
        "k",
    ];
    let mut state = 1_u64;
    let mut next = |count: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % count
    };
    let mut params = String::new();
    for k in 0..3000 {
        let text: String = (0..next(9)).map(|_| pieces[next(pieces.len())]).collect();
        write!(
            params,
            "#[doc = \"[{text}]\"] param p{k} = 1.0; output o{k} = p{k} + powi(p{k}, 9) / sqrt(p{k}) - powi(p{k}, 1000) * p{k};"
        )
        .expect("a string");
    }
    let said = quickly(move || said(&format!("mod m {{ {BODY} {params} }}")));
    assert!(said.len() > 10 && said.iter().all(|line| line.contains("a sum needs one unit")), "{said:?}");
}

#[test]
fn doubling_stays_small() {
    let doubled: String = (1..60).map(|k| format!("let a{k} = a{0} * a{0};", k - 1)).collect();
    let text = format!("mod m {{ {BODY} param p = 1.0; let a0 = p; {doubled} output x = a59; param q = a59; }}");
    assert_eq!(quickly(move || said(&text)), Vec::<String>::new());

    let arrays: String = (1..60).map(|k| format!("const A{k} = [A{0}, A{0}];", k - 1)).collect();
    let text = format!("mod m {{ {BODY} const A0 = 1.0; {arrays} output x = A59; }}");
    let said = quickly(move || said(&text));
    assert_eq!(said.len(), 1);
    assert!(said[0].contains("at most 10000 numbers"), "{said:?}");
}

/// Calls within calls, values that call twice, and circles of many: an answer, whatever they come to.
#[test]
fn functions_stay_bounded() {
    let nested = format!("{}j{}", "f(".repeat(24), ")".repeat(24));
    let text = format!("mod m {{ {BODY} let f(x) = x * x + sin(x); output x = {nested}; }}");
    assert_eq!(quickly(move || said(&text)), Vec::<String>::new());

    let twice = |count: usize| -> String {
        (1..count).map(|k| format!("let f{k}(x) = f{0}(x) * f{0}(x + 1.0);", k - 1)).collect()
    };
    let text = format!("mod m {{ {BODY} let f0(x) = x; {} output x = f10(j); }}", twice(11));
    assert_eq!(quickly(move || said(&text)), Vec::<String>::new());
    let text = format!("mod m {{ {BODY} let f0(x) = x; {} output x = f23(j); }}", twice(24));
    let doubled = quickly(move || said(&text));
    assert_eq!(doubled.len(), 1, "{doubled:?}");
    assert!(doubled[0].contains("more than 10000 calls"), "{doubled:?}");

    let all: String = (0..20).map(|k| format!(" + f{k}(x)")).collect();
    let circles: String = (0..20).map(|k| format!("let f{k}(x) = x{all};")).collect();
    let text = format!("mod m {{ {BODY} {circles} output x = f0(j); output y = f19(j); }}");
    let circles = quickly(move || said(&text));
    assert!(
        !circles.is_empty() && circles.iter().all(|line| line.contains("is defined through itself")),
        "{circles:?}"
    );
}

#[test]
fn parts_stay_bounded() {
    let mut text = String::from("mod p0 { port a: Frame; body b { mass: 1.0 } }");
    for k in 1..20 {
        write!(text, "mod p{k} {{ port a: Frame; part x: [p{}; 9] = |i| p{} {{ a: a }}; }}", k - 1, k - 1).unwrap();
    }
    text += "mod m { part x: p19 { a: ground }; }";
    let many = quickly(move || said(&text));
    assert!(many.iter().any(|s| s.contains("more than 10000 items")), "{many:?}");

    let mut text = String::from("mod p0 { port a: Frame; body b { mass: 1.0 } }");
    for k in 1..500 {
        write!(text, "mod p{k} {{ port a: Frame; part x: p{} {{ a: a }}; }}", k - 1).unwrap();
    }
    text += "mod m { part x: p499 { a: ground }; }";
    let deep = quickly(move || said(&text));
    assert!(deep.iter().any(|s| s.contains("nested more than 24 deep")), "{deep:?}");

    let sum: String = (0..250).map(|_| " + 1.0").collect();
    let text = format!(
        "mod p {{ port a: Frame; param m = 1.0; body b {{ mass: m }} joint j: Prismatic {{ parent: a, child: b, axis: X }} }}
         mod m {{ part x: [p; 2400] = |i| p {{ a: ground, m: max(1.0{sum}, 1.0{sum}) }}; }}"
    );
    let large = quickly(move || said(&text));
    assert!(large[0].contains("too large once all parts"), "{large:?}");
}

#[test]
fn large_models_are_checked_in_time() {
    let mut text = String::from(
        "mod m { body b0 { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) } joint j0: Free { parent: ground, child: b0 }",
    );
    for k in 1..600 {
        write!(
            text,
            "body b{k} {{ mass: 1.0, com: X }} joint j{k}: Revolute {{ parent: b{}.at(X), child: b{k}, axis: Z }}",
            k - 1
        )
        .unwrap();
    }
    text += "}";
    assert_eq!(quickly(move || said(&text)), Vec::<String>::new());

    let unknown: String = (0..4000).map(|k| format!("let abc{k} = xyz{k};")).collect();
    let text = format!("mod m {{ {BODY} {unknown} }}");
    assert_eq!(quickly(move || said(&text)).len(), 4000);
}

/// Tokens dropped, doubled, swapped and replaced by others of the same text.
#[test]
fn mutated_samples() {
    let samples = [
        include_str!("../syntax/samples/double_pendulum.txt"),
        include_str!("../syntax/samples/stewart.txt"),
        "mod foot { port on: Frame; param m = 0.1; body pad { mass: m, inertia: cylinder(m, 0.1, 0.2, X + Y) }
             joint slide: Prismatic { parent: on, child: pad, axis: Z, armature: 0.1 } output height = pad.position.z; }
         mod m { const P = [X, [0.0, 1.0, 0.0]]; param k = 1.0; input u: Vec3; state s: rate = u.x - s, start: 0.0;
             part feet: [foot; 2] = |i| foot { on: trunk.at(P[i]).rotated(Z, PI * i), m: 0.1 * k };
             body trunk { mass: k, inertia: cuboid(k, [1.0, 2.0, 3.0]) }
             joint free: Free { parent: ground.oriented([X, Y, Z]), child: trunk, coordinates: RollPitchYaw }
             force f: SpringDamper { between: [feet[0].pad, ground.at(X)], stiffness: 1.0, damping: select(t > 1.0, 1.0, 2.0), length: 0.0 }
             force g: Torque { at: trunk, value: u, axes: trunk }
             output r: Wrench = free.reaction.express(trunk); output p = f.power + free.yaw.rate; }",
    ];
    let mut random = 0x2545_f491_4f6c_dd1d_u64;
    let mut next = move |bound: usize| {
        random ^= random << 13;
        random ^= random >> 7;
        random ^= random << 17;
        (random >> 20) as usize % bound
    };
    let mut clean = 0;
    for round in 0..1500 {
        let text = samples[round % samples.len()];
        let mut words = words(text);
        for _ in 0..1 + next(3) {
            let (a, b) = (next(words.len()), next(words.len()));
            match next(4) {
                0 => drop(words.remove(a)),
                1 => words.insert(b, words[a].clone()),
                2 => words.swap(a, b),
                _ => words[a] = words[b].clone(),
            }
        }
        let text = words.join(" ");
        if text.parse::<proc_macro2::TokenStream>().is_ok() {
            clean += usize::from(check(&text).1.is_empty());
        }
    }
    assert!(clean > 0, "{clean} mutants are without a mistake");
}

/// Words, numbers and single signs; comments dropped.
fn words(text: &str) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    for line in text.lines() {
        let line = line.split("//").next().unwrap_or_default();
        let line = line.replace("/* .. */", "");
        let mut word = String::new();
        for c in line.chars() {
            if c.is_alphanumeric() || c == '_' || (c == '.' && word.parse::<f64>().is_ok()) {
                word.push(c);
                continue;
            }
            if !word.is_empty() {
                words.push(std::mem::take(&mut word));
            }
            if !c.is_whitespace() {
                words.push(c.to_string());
            }
        }
        if !word.is_empty() {
            words.push(word);
        }
    }
    words
}
