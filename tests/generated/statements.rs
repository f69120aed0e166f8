//! A generated function of ten thousand statements compiles with full debug information, unoptimised and optimised, in
//! plain rustc stacks: no lexical nest is deeper than a few hundred `let`s.

use std::path::Path;
use std::process::Command;

use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::emit::{emit, source};
use multibody_engine::optimize::program::{Expression, Local, Program, Statement};
use multibody_engine::{mechanics, optimize};
use multibody_tests::support::data::path;
use multibody_tests::support::engine::model_of;

use crate::cargo;

const STATEMENTS: usize = 10_000;

/// x[k] = 0.75 x[k - 1] - 0.5 x[far], with an angle among them now and then; and what it comes to.
fn program(angle: Symbol, start: f64) -> (Program, f64) {
    let mut program = Program::default();
    let mut values: Vec<f64> = Vec::new();
    let local = |k: usize| Box::new(Expression::Local(Local(k)));
    for k in 0..STATEMENTS {
        program.locals.push(format!("x_{k}"));
        let (value, number) = if k % 100 == 0 {
            // Everything reaches far back, so that many values are alive between blocks.
            let far = values.get(k / 2).copied().unwrap_or(0.0);
            let terms = vec![
                (false, Expression::Symbol(angle)),
                (true, if k == 0 { Expression::Literal(0.0) } else { *local(k / 2) }),
            ];
            (Expression::Sum(terms), start - far)
        } else {
            let far = k - k.min(700);
            let products = [(0.75, k - 1), (0.5, far)]
                .map(|(c, of)| Expression::Product(vec![Expression::Literal(c), *local(of)]));
            let [near, away] = products;
            (Expression::Sum(vec![(false, near), (true, away)]), 0.75 * values[k - 1] - 0.5 * values[far])
        };
        program.statements.push(Statement::Let { local: Local(k), value });
        values.push(number);
    }
    program.results = vec![*local(STATEMENTS - 1)];
    (program, values[STATEMENTS - 1])
}

fn write(file: &Path, text: &str) {
    std::fs::create_dir_all(file.parent().unwrap()).unwrap();
    // Untouched files are not compiled again.
    if std::fs::read_to_string(file).ok().as_deref() != Some(text) {
        std::fs::write(file, text).unwrap();
    }
}

#[test]
fn ten_thousand_statements() {
    let model =
        model_of("pub mod model { body b { mass: 1.0 } joint rail: Prismatic { parent: ground, child: b, axis: X } }");
    let derivation = mechanics::of(&model).unwrap_or_else(|_| panic!("mechanics")).1;
    let mut compiled = optimize::compile(&derivation).unwrap_or_else(|_| panic!("too large"));
    let angle = derivation.symbols.iter().copied().find(|s| matches!(s, Symbol::Position { .. })).unwrap();
    let (program, expected) = program(angle, 0.3);
    compiled.functions[0].program = program;
    let module = source(&emit(&model, &mechanics::loops::structure::Structure::open(&model), &compiled));

    let root = Path::new(env!("CARGO_TARGET_TMPDIR")).join("statements");
    write(
        &root.join("Cargo.toml"),
        "[workspace]\nmembers = [\"level0\", \"level3\"]\nresolver = \"3\"\n\n\
         [profile.dev]\nopt-level = 0\ndebug = \"full\"\n\n\
         [profile.dev.package.level3]\nopt-level = 3\ndebug = \"full\"\n",
    );
    let lock = path("../Cargo.lock");
    if !root.join("Cargo.lock").exists() {
        std::fs::copy(lock, root.join("Cargo.lock")).unwrap();
    }
    let main = format!(
        "//! Generated.\n{module}\nfn main() {{\n    let model = model::Model::<f64>::new(&model::Params::default());\n    \
         let mut x = model::State::default();\n    x.q.rail = 0.3;\n    \
         println!(\"{{:e}}\", model.forward_dynamics(0.0, &x, &()).rail);\n}}\n"
    );
    let runtime = path("../runtime").display().to_string();
    for level in ["level0", "level3"] {
        write(&root.join(level).join("src/main.rs"), &main);
        let manifest = format!(
            "[package]\nname = \"{level}\"\nversion = \"0.1.0\"\nedition = \"2024\"\n\n\
             [dependencies]\nmultibody = {{ path = {runtime:?} }}\n"
        );
        write(&root.join(level).join("Cargo.toml"), &manifest);
    }
    let run = |command: &mut Command| {
        // Stack in the compiler is what this is about: with debug information, whatever else is built without.
        let output = command.args(["--offline", "--quiet"]).env_remove("CARGO_PROFILE_DEV_DEBUG").output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).unwrap()
    };
    run(&mut cargo("build", &root));
    for level in ["level0", "level3"] {
        let printed: f64 = run(cargo("run", &root).args(["--package", level])).trim().parse().unwrap();
        // The same operations in the same order, unless sums are contracted; they are not.
        assert_eq!(printed, expected, "{level}");
    }
}
