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
    let complaints: Vec<&str> =
        messages.lines().filter(|line| !line.starts_with("deriving `") && !line.starts_with("writing `")).collect();
    assert_eq!((complaints.as_slice(), code), (&[][..], 0));
    output
}

#[test]
fn check_has_a_line_for_each_model() {
    let expected = "pendulum: 1 body, 1 coordinate, 0 equations with multipliers; forward_dynamics, mass_matrix\n\
                    slider: 3 bodies, 1 coordinate, 0 equations with multipliers; forward_dynamics, dead_centres, margins\n  \
                    left out, since they follow from the other equations: `wrist.z`, `wrist.turn_y`, `wrist.turn_x`\n  \
                    forward dynamics takes 34 add, 62 mul, 2 div, 1 sqrt, 1 sincos, 2 other in closed form, work 193; \
                    53 add, 59 mul, 5 div, 2 sincos with multipliers, work 343\n";
    assert_eq!(quiet(&["check", "pendulum.rs"]), expected);
    // As cargo calls it.
    assert_eq!(quiet(&["multibody", "check", "pendulum.rs"]), expected);
    let one = quiet(&["check", "pendulum.rs", "--model", "slider"]);
    assert!(one.starts_with("slider") && one.lines().count() == 3, "{one}");
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

/// Errors of the project's own tests of messages: places and words are those that rustc prints. What rustc says beyond them is
/// about the user's code beside the model.
#[test]
fn mistakes_are_those_of_the_compiler() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/ui/fail");
    let mut count = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let file = entry.unwrap().path();
        // Of paths to parts rustc speaks alone.
        if file.extension().is_none_or(|extension| extension != "rs") || file.ends_with("parts.rs") {
            continue;
        }
        let compiler = std::fs::read_to_string(file.with_extension("stderr")).unwrap();
        let name = format!("../../../tests/ui/fail/{}", file.file_name().unwrap().to_str().unwrap());
        let (_, messages, _) = run(&["check", &name]);
        for line in messages.lines() {
            let words = line.trim_start();
            if let Some(place) = words.strip_prefix(&format!("--> {name}")) {
                count += 1;
                assert!(compiler.contains(&format!(".rs{place}\n")), "{name}{place}");
            } else if words.starts_with("error: ") || words.starts_with("help: ") {
                assert!(compiler.contains(words), "{name}: {words}");
            }
        }
    }
    assert!(count >= 30, "{count}");
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
  - 2 length² hinge¨ / 3 + 9.81 length sin(hinge) = 0
  - M[hinge, hinge] = 2 length² / 3
  + M[hinge, hinge] = 0.3 + length² / 2
  + hinge¨ (0.3 + length² / 2) + 9.81 length sin(hinge) = 0
slider: is gone
";
    assert_eq!(quiet(&["diff", "pendulum.rs", "changed.rs"]), expected);
    assert_eq!(quiet(&["diff", "changed.rs", "changed.rs"]), "pendulum: the same operations\n");
}

/// Cells of the rows of a comparison, without the time.
fn cells(output: &str) -> Vec<Vec<&str>> {
    let rows = output.lines().filter(|line| line.starts_with("  ") && !line.starts_with("   "));
    let rows = rows.map(|line| line.split("  ").map(str::trim).filter(|cell| !cell.is_empty()).collect());
    rows.filter(|cells: &Vec<&str>| cells.len() > 2 && cells[0] != "coordinates").collect()
}

/// Coordinates, constraints, sizes of the rows of a comparison that are not refused.
fn sizes(output: &str) -> Vec<String> {
    cells(output).iter().filter(|cells| cells.len() > 3).map(|cells| cells[..5].join(" ")).collect()
}

#[test]
fn choices_are_compared() {
    let output = quiet(&["compare", "pendulum.rs"]);
    let expected = [
        "Joint* no equations 1 0 1",
        "Absolute(RollPitchYaw) Multipliers 6 5 11",
        "Absolute(RollPitchYaw) Reduced 1 0 1",
        "Absolute(Quaternion) Multipliers 6 5 11",
        "Joint Multipliers 3 2 5",
        "Joint* Reduced 1 0 1",
        "Absolute(RollPitchYaw) Multipliers 18 17 35",
        "Absolute(RollPitchYaw) Reduced 1 0 1",
        "Absolute(Quaternion) Multipliers 18 17 35",
    ];
    assert_eq!(sizes(&output), expected, "{output}");
    assert!(output.contains(
        "\n  coordinates Absolute(Quaternion), constraints Reduced is refused: the loop that `hinge` closes"
    ));
    assert!(output.contains(
        "\n  recommended: coordinates Joint, as it is written\n    since forward_dynamics takes least work, 37; next"
    ));
    assert!(output.contains("\n  recommended: coordinates Joint, constraints Reduced, as it is written\n"), "{output}");
    let next =
        "Multipliers with 1.78 times as much (51 percent of its work in linear systems, the largest of 2 unknowns)\n";
    assert!(output.contains(next), "{output}");
    // The counts are those of the model as it is written.
    let row = cells(&output).into_iter().find(|row| row[..2] == ["Joint*", "Reduced"]).unwrap();
    assert_eq!(row[5..12], ["34", "62", "2", "1", "1", "2", "193"]);
}

/// What is left to the compiler is marked where that has put it, and every command speaks of that.
#[test]
fn what_is_left_to_the_compiler() {
    let output = quiet(&["compare", "automatic.rs"]);
    let found = sizes(&output);
    assert!(found.contains(&"Joint* Multipliers 3 2 5".to_owned()), "{output}");
    assert!(found.contains(&"Joint Reduced 1 0 1".to_owned()), "{output}");
    assert!(output.contains("\n  * as it is written: what `constraints: Auto` stands for\n"), "{output}");
    // What becomes of the equations, in each choice that has some: the two of a planar loop share no coordinate that takes one.
    let left = "  coordinates Joint, constraints Multipliers: limbs absorb 0 of 2 equations, 2 are solved with pivots, in systems of 2 at most\n";
    assert!(output.contains(left), "{output}");
    assert_eq!(output.matches(": limbs absorb ").count(), 3, "{output}");
    let checked = quiet(&["check", "automatic.rs"]);
    let lines: Vec<&str> = checked.lines().collect();
    assert!(lines[0].starts_with("automatic: 3 bodies, 3 coordinates, 2 equations with multipliers; "), "{checked}");
    let said = "  left out, since they follow from the other equations: `pin.z`, `pin.turn_y`, `pin.turn_x`";
    assert_eq!(lines[1], said);
    let said = "  `constraints: Auto` is `Multipliers`: forward dynamics takes ";
    assert!(
        lines[2].starts_with(said) && lines[2].contains(" by Newton's method with all its rounds, work "),
        "{checked}"
    );
    let said = "  none of the 2 equations with multipliers is absorbed by coordinates of its limb; 2 are left to pivoted solutions";
    assert!(lines.len() == 5 && lines[3].starts_with(said), "{checked}");
    let said = "`solve (knee, pivot) from pin { sin(shaft + knee - pivot) > 0.0 }` leaves nothing to Newton's method: ";
    assert!(lines[4].contains(said), "{checked}");
    assert!(lines[4].ends_with("; `constraints: Auto` would be `Reduced` with that"), "{checked}");
    // The work of both, as it is compared.
    for constraints in ["Multipliers", "Reduced"] {
        let row = cells(&output).into_iter().find(|row| row[0].starts_with("Joint") && row[1] == constraints).unwrap();
        assert!(
            lines[2].split([';', ',']).any(|part| part.trim() == format!("work {}", row[11])),
            "{checked} {output}"
        );
    }
    assert!(quiet(&["equations", "automatic.rs"]).contains("Constraints"));
}

/// A model that asks another one for a formula is compared with that one as it is written.
#[test]
fn models_that_ask_others_are_compared() {
    let output = quiet(&["compare", "formulas.rs", "--model", "shaker"]);
    assert!(sizes(&output).contains(&"Joint* no equations 1 0 1".to_owned()), "{output}");
}

/// Outputs are left out, but for those that something else reads.
#[test]
fn outputs_that_forces_read_stay() {
    let output = quiet(&["compare", "read_outputs.rs"]);
    let rows = ["Joint* no equations 1 0 1", "Absolute(RollPitchYaw) Multipliers 6 5 11"];
    assert!(rows.iter().all(|row| sizes(&output).contains(&(*row).to_owned())), "{output}");
    assert!(!output.contains("unknown name"), "{output}");
}

/// Of two models of one name each is compared, and has its own mark.
#[test]
fn models_of_one_name_are_compared() {
    let output = quiet(&["compare", "twins.rs"]);
    let (first, second) = output.split_once("\narm where ").expect("two models");
    assert!(first.starts_with("arm where not (feature = \"absolute\")\n"), "{output}");
    assert!(second.starts_with("feature = \"absolute\"\n"), "{output}");
    assert!(sizes(first).contains(&"Joint* no equations 1 0 1".to_owned()), "{output}");
    assert!(sizes(second).contains(&"Joint no equations 2 0 2".to_owned()), "{output}");
    assert!(sizes(second).contains(&"Absolute(Quaternion)* Multipliers 12 10 22".to_owned()), "{output}");
}

/// An iteration counts with all its rounds.
#[test]
fn rounds_count() {
    let output = quiet(&["compare", "iteration.rs"]);
    let work = |row: &Vec<&str>| row[11].parse::<u32>().unwrap();
    let rows = cells(&output);
    let reduced = rows.iter().find(|row| row[..2] == ["Joint*", "Reduced"]).unwrap();
    let [add, mul, div, sqrt, sincos, other] = [5, 6, 7, 8, 9, 10].map(|cell| reduced[cell].parse::<u32>().unwrap());
    // What is other here are comparisons of pivots.
    assert!(work(reduced) > 2 * (add + mul + 20 * (div + sqrt) + 35 * sincos + other), "{output}");
}

/// The numbers of equations of the README.
#[test]
fn the_platform_in_all_coordinates() {
    let output = quiet(&["compare", "../../../tests/models/stewart.rs", "--model", "reduced"]);
    let found = sizes(&output);
    for row in [
        "as declared Multipliers 24 18 42",
        "as declared* Reduced 6 0 6",
        "Joint Multipliers 21 15 36",
        "Absolute(RollPitchYaw) Multipliers 78 72 150",
    ] {
        assert!(found.iter().any(|other| other == row), "{row} of\n{output}");
    }
    assert!(
        output.contains("recommended: coordinates as declared, constraints Reduced, as it is written\n"),
        "{output}"
    );
}

#[test]
fn equations_in_three_languages() {
    let of = |form: &str| quiet(&["equations", "pendulum.rs", "--model", "pendulum", form]);
    assert!(
        of("--text").starts_with(
            "pendulum\n\n  Equations of motion\n\n    2 length² hinge¨ / 3 + 9.81 length sin(hinge) = 0\n"
        )
    );
    assert_eq!(of("--text"), quiet(&["equations", "pendulum.rs", "--model", "pendulum"]));
    assert!(
        of("--latex")
            .contains("\\begin{gather*}\nM_{\\mathrm{hinge, hinge}} = \\frac{2\\,\\mathrm{length}^{2}}{3} \\\\\n")
    );
    assert!(of("--mathml").contains("<h3>Equations of motion</h3>\n<div><math display=\"block\""));
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

/// rustc brings a part to the call that uses it in a build; here the file is named.
#[test]
fn parts_of_another_file_are_named() {
    let (output, messages, code) = run(&["check", "walking.rs"]);
    assert_eq!((output.as_str(), code), ("", 1));
    let expected = "\
error: no file that is read here declares the part `leg`
  help: name the file: `--parts FILE`
 --> walking.rs:4:23
  |
4 |     use crate::shelf::leg;
  |                       ^^^

1 error
";
    assert_eq!(messages, expected);
    let expected = quiet(&["expand", "shelf.rs"]);
    assert_eq!(quiet(&["expand", "walking.rs", "--parts", "shelf.rs"]), expected);
}

/// What such a part calls is named as in its own crate.
#[test]
fn parts_of_another_file_call_functions_of_rust() {
    let code = quiet(&["expand", "braking.rs", "--parts", "brakes.rs"]);
    let words: String = code.split_whitespace().collect();
    assert!(words.contains("<crate::brakes::Padas::multibody::Function<T,1"), "{code}");
    let equations = quiet(&["equations", "braking.rs", "--parts", "brakes.rs"]);
    assert!(equations.contains("friction(turn"), "{equations}");
}

/// What is imported is a model of the language, and the one that the file is.
#[test]
fn robots_are_imported_as_text() {
    let arm = "../../../tests/data/robots/double_pendulum.urdf";
    let text = quiet(&["import", arm]);
    assert!(
        text.contains("joint joint2: Revolute { parent: link1.at([0.023, 0.0, 0.1]), child: link2, axis: X }\n"),
        "{text}"
    );
    let file = std::env::temp_dir().join(format!("imported-{}.rs", std::process::id()));
    std::fs::write(&file, text).unwrap();
    let checked = quiet(&["check", file.to_str().unwrap()]);
    let expected = "model: 2 bodies, 2 coordinates, 0 equations with multipliers; forward_dynamics, inverse_dynamics\n";
    assert_eq!(checked, expected);
    let (_, messages, code) = run(&["import", "pendulum.rs"]);
    assert_eq!(code, 2);
    assert!(messages.starts_with("error: pendulum.rs:1:1: no XML"), "{messages}");
    // Beside the file that calls.
    let call = "multibody! { mod model { part r: Urdf { file: \"imported.urdf\", base: ground }; emit forward_dynamics, inverse_dynamics; } }";
    std::fs::write(&file, call.replace("imported", &format!("imported-{}", std::process::id()))).unwrap();
    let beside = file.with_extension("urdf");
    std::fs::copy(concat!(env!("CARGO_MANIFEST_DIR"), "/../tests/data/robots/double_pendulum.urdf"), &beside).unwrap();
    assert_eq!(quiet(&["check", file.to_str().unwrap()]), expected);
    let _ = std::fs::remove_file(file);
    let _ = std::fs::remove_file(beside);
}
