//! The program on small files: what it prints, where it puts mistakes, how it ends.

use std::process::Command;

/// Output, messages, exit code.
fn run(words: &[&str]) -> (String, String, i32) {
    let output = Command::new(env!("CARGO_BIN_EXE_cargo-multibody"))
        .args(words)
        .current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data"))
        .output()
        .unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (text(output.stdout), text(output.stderr), output.status.code().unwrap())
}

/// The output of a command that has nothing to complain of; on a slow machine there may be progress.
fn quiet(words: &[&str]) -> String {
    let (output, messages, code) = run(words);
    let complaints: Vec<&str> = messages.lines().filter(|line| !line.starts_with("deriving `")).collect();
    assert_eq!((complaints.as_slice(), code), (&[][..], 0));
    output
}

#[test]
fn check_has_a_line_for_each_model() {
    let expected = "pendulum: 1 body, 1 coordinate, 0 equations with multipliers; forward_dynamics, mass_matrix\n\
                    slider: 3 bodies, 1 coordinate, 0 equations with multipliers; forward_dynamics, dead_centres, margins\n";
    assert_eq!(quiet(&["check", "pendulum.rs"]), expected);
    // As cargo calls it.
    assert_eq!(quiet(&["multibody", "check", "pendulum.rs"]), expected);
    let one = quiet(&["check", "pendulum.rs", "--model", "slider"]);
    assert!(one.starts_with("slider") && one.lines().count() == 1, "{one}");
}

#[test]
fn mistakes_are_told_where_they_are() {
    let (output, messages, code) = run(&["check", "mistakes.rs"]);
    assert_eq!((output.as_str(), code), ("", 1));
    let expected = "\
error: unknown name `lenght`
  help: did you mean `length`?
 --> mistakes.rs:7:43
  |
7 |         body rod { mass: 2.0, com: -0.5 * lenght * Y, inertia: rod(2.0, length, Y) }
  |                                           ^^^^^^

error: unknown kind of joint `Revolut`
  help: did you mean `Revolute`?
 --> mistakes.rs:8:22
  |
8 |         joint hinge: Revolut { parent: ground, child: rod, axis: Z }
  |                      ^^^^^^^

error: the mass matrix is singular by structure: nothing resists the coordinate `hinge`
  help: give the bodies beyond it inertia in this direction, or the joint an `armature`
  --> mistakes.rs:16:15
   |
16 |         joint hinge: Revolute { parent: ground, child: bead, axis: Z }
   |               ^^^^^

3 errors
";
    assert_eq!(messages, expected);
}

#[test]
fn places_in_a_page_are_those_of_the_page() {
    let (_, messages, code) = run(&["check", "page.md"]);
    assert_eq!(code, 1);
    assert!(
        messages.starts_with("error: unknown name `rodd`\n  help: did you mean `rod`?\n  --> page.md:14:56\n"),
        "{messages}"
    );
}

#[test]
fn calls_in_declarative_macros_are_left_out_with_a_word() {
    let (output, messages, code) = run(&["check", "template.rs"]);
    assert_eq!((output.as_str(), code), ("", 2));
    assert!(
        messages.starts_with("note: template.rs:3:9 is left out: a declarative macro writes this call"),
        "{messages}"
    );
}

#[test]
fn counts_are_those_of_the_generated_constants() {
    let counts = quiet(&["counts", "pendulum.rs"]);
    let expected = "\
pendulum
                    as derived                          as emitted
  function          add  mul  div  sqrt  sincos  other  add  mul  div  sqrt  sincos  other
  new                                                     0    2    1     0       0      0
  forward_dynamics    1    7    1     0       1      0    0    2    0     0       1      0
  mass_matrix         1    4    0     0       0      0    0    0    0     0       0      0

slider
";
    assert!(counts.starts_with(expected), "{counts}");
    // All numbers of the table, in the constants.
    let code: String = quiet(&["expand", "pendulum.rs"]).split_whitespace().collect();
    let rows =
        counts.lines().filter(|line| line.starts_with("  ") && !line.starts_with("   ") && !line.contains("add"));
    for row in rows {
        let cells: Vec<&str> = row.split_whitespace().collect();
        for six in cells[1..].chunks(6) {
            let [add, mul, div, sqrt, sincos, other] = six else { panic!("{row}") };
            let cost = format!(
                "Cost{{function:\"{}\",add:{add},mul:{mul},div:{div},sqrt:{sqrt},sincos:{sincos},other:{other},}}",
                cells[0]
            );
            assert!(code.contains(&cost), "{cost} of\n{counts}");
        }
    }
}

#[test]
fn expanded_code_is_rust_with_headings() {
    let code = quiet(&["expand", "pendulum.rs"]);
    let file = syn::parse_file(&code).unwrap();
    let modules = file.items.iter().filter(|item| matches!(item, syn::Item::Mod(_)));
    assert_eq!(modules.count(), 2);
    assert!(code.contains("\n            // Closed form of guide.\n"), "{code}");
    assert!(!code.contains("doc = \"//"));
}

#[test]
fn diff_has_what_has_changed() {
    let expected = "\
pendulum
  function             add     mul  div  sqrt  sincos  other     work
  new               0 -> 1  2 -> 3    1     0       0      0  +20.0 %
  mass_matrix       is gone
  kinetic_energy    is new
  potential_energy  is new
slider: is gone
";
    assert_eq!(quiet(&["diff", "pendulum.rs", "changed.rs"]), expected);
    assert_eq!(quiet(&["diff", "changed.rs", "changed.rs"]), "pendulum: the same operations\n");
}

#[test]
fn the_command_line_is_checked() {
    assert!(quiet(&["--help"]).contains("cargo multibody COMMAND FILE"));
    let refused = |words: &[&str]| {
        let (output, messages, code) = run(words);
        assert_eq!((output.as_str(), code), ("", 2));
        messages
    };
    assert_eq!(refused(&["chek", "a.rs"]), "error: unknown command `chek`; `cargo multibody --help` lists them\n");
    assert_eq!(refused(&["check"]), "error: `check` takes one file, and not 0\n");
    assert!(refused(&["check", "nowhere.rs"]).starts_with("error: nowhere.rs: "));
    assert_eq!(refused(&["check", "pendulum.rs", "--model", "arm"]), "error: pendulum.rs has no model `arm`\n");
    assert!(refused(&["check", "--fast", "pendulum.rs"]).contains("--fast"));
}
