//! Reports: pages that parse, say everything that the model declares, and draw what stands where it should.

use std::path::{Path, PathBuf};
use std::process::Command;

use roxmltree::{Document, Node, ParsingOptions};

const DATA: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data");

/// A folder of its own for each test.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("report").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    folder
}

/// Writes reports, and gives the paths that the command prints.
fn written(file: &str, folder: &Path, more: &[&str]) -> Vec<PathBuf> {
    let output = Command::new(env!("CARGO_BIN_EXE_cargo-multibody"))
        .args(["report", file, "--out"])
        .arg(folder)
        .args(more)
        .current_dir(DATA)
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap().lines().map(PathBuf::from).collect()
}

/// The page of the only model that is asked for.
fn page(file: &str, name: &str, more: &[&str]) -> String {
    let paths = written(file, &folder(name), more);
    std::fs::read_to_string(&paths[0]).unwrap()
}

fn parsed(html: &str) -> Document<'_> {
    let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
    Document::parse_with_options(html, options).unwrap_or_else(|error| panic!("{error}"))
}

/// All letters inside an element.
fn letters(node: Node<'_, '_>) -> String {
    node.descendants().filter(Node::is_text).filter_map(|text| text.text()).collect()
}

fn has_class(node: &Node<'_, '_>, class: &str) -> bool {
    node.attribute("class").is_some_and(|classes| classes.split(' ').any(|one| one == class))
}

fn number(node: &Node<'_, '_>, name: &str) -> f64 {
    node.attribute(name).unwrap_or_else(|| panic!("{name}")).parse().unwrap()
}

/// The text of the section with this heading.
fn section(html: &Document<'_>, heading: &str) -> String {
    let heads = html.descendants().find(|node| node.has_tag_name("h2") && letters(*node) == heading);
    letters(heads.unwrap_or_else(|| panic!("{heading}")).parent().unwrap())
}

#[test]
fn pages_parse_and_name_everything_that_is_declared() {
    let declared: [(&str, &str, &[&str]); 4] = [
        (
            "four_bar.rs",
            "four_bar",
            &[
                "crank",
                "coupler",
                "rocker",
                "drive_shaft",
                "knee",
                "pivot",
                "pin",
                "crank_length",
                "friction",
                "ballast",
                "torque",
                "motor",
                "bearing",
                "rocker_angle",
                "energy",
                "N m s/rad",
            ],
        ),
        ("pendulum.rs", "slider", &["crank", "rod", "piston", "shaft", "pin", "guide", "wrist", "length"]),
        (
            "../../../examples/models/double_pendulum.rs",
            "double_pendulum",
            &["upper", "lower", "shoulder", "elbow", "m1", "m2", "l1", "l2", "friction", "heat", "tip"],
        ),
        ("oblique.rs", "oblique", &["first", "second", "hull", "anchor", "strap", "mooring", "rope", "x < y & \"z\""]),
    ];
    for (file, model, names) in declared {
        let text = page(file, &format!("declared-{model}"), &["--model", model]);
        let html = parsed(&text);
        let said = letters(html.root_element());
        for name in names {
            assert!(said.contains(name), "{name} in the report of {model}");
        }
        // Alone, it needs nothing from elsewhere.
        for tag in ["script", "link", "img", "iframe", "object"] {
            assert!(!html.descendants().any(|node| node.has_tag_name(tag)), "{tag} in the report of {model}");
        }
        let links = html.descendants().filter_map(|node| node.attribute("href"));
        let ids: Vec<&str> = html.descendants().filter_map(|node| node.attribute("id")).collect();
        for link in links {
            assert!(link.strip_prefix('#').is_some_and(|id| ids.contains(&id)), "{link}");
        }
        // A class without a rule would be black on black.
        let style = letters(html.descendants().find(|node| node.has_tag_name("style")).unwrap());
        for class in html.descendants().filter_map(|node| node.attribute("class")).flat_map(str::split_whitespace) {
            let known =
                style.contains(&format!(".{class}")) || ["follows", "holds", "turns", "slides"].contains(&class);
            assert!(known, "no rule for {class}");
        }
    }
}

#[test]
fn what_is_unused_is_listed() {
    let text = page("four_bar.rs", "unused", &[]);
    let html = parsed(&text);
    let said = section(&html, "Parameters, inputs, outputs");
    let unused = said.split("Unused parameters").nth(1).unwrap().split("Inputs").next().unwrap();
    assert!(unused.contains("ballast") && !unused.contains("friction") && !unused.contains("crank_length"), "{unused}");
    // Where everything is read nothing is said.
    assert!(!page("../../../examples/models/cart_pole.rs", "used", &[]).contains("Unused parameters"));
}

#[test]
fn losers_are_told_with_what_they_cost() {
    let text = page("../../../examples/models/double_pendulum.rs", "losers", &[]);
    let html = parsed(&text);
    let costs = section(&html, "Costs");
    let candidates = costs.split("Candidates").nth(1).unwrap();
    assert!(
        candidates.contains("articulated body") && candidates.contains("composite rigid body, LDL^T"),
        "{candidates}"
    );
    // In each function none costs less than the one that was taken.
    let table =
        html.descendants().filter(|node| node.has_tag_name("table")).find(|table| letters(*table).contains("taken"));
    let mut taken = 0;
    let mut others = 0;
    for row in table.unwrap().descendants().filter(|node| node.has_tag_name("tr")).skip(1) {
        let cells: Vec<String> = row.children().filter(Node::is_element).map(letters).collect();
        let work: u32 = cells[2].parse().unwrap();
        if cells[3] == "taken" {
            taken = work;
            continue;
        }
        others += 1;
        let expected = match work - taken {
            0 => "as much".to_owned(),
            more => format!("+{more}, +{:.0} %", 100.0 * f64::from(more) / f64::from(taken)),
        };
        assert_eq!(cells[3], expected, "{cells:?}");
    }
    assert!(others >= 4, "{others}");
}

/// In packs what is taken may be dearer on scalars than what has lost.
#[test]
fn losers_that_packs_would_save_less_of() {
    let text = page("../../../benches/peers/ours/src/loops.rs", "packs", &["--model", "stewart_packed"]);
    assert!(text.contains(", and more in packs"));
}

/// By its rows the classes of a matrix's squares.
fn squares(html: &Document<'_>, number: usize) -> Vec<String> {
    let matrix = html.descendants().filter(|node| has_class(node, "matrix")).nth(number).unwrap();
    let squares = matrix.descendants().filter(|node| has_class(node, "entry"));
    squares.map(|node| node.attribute("class").unwrap().trim_start_matches("entry ").to_owned()).collect()
}

#[test]
fn matrices_are_told_by_what_they_depend_on() {
    // M = (cart + pole, -m l cos / 2; .., m l^2 / 3).
    let text = page("../../../examples/models/cart_pole.rs", "mass", &[]);
    assert_eq!(squares(&parsed(&text), 0), ["parameters", "varying", "varying", "parameters"]);
    let text = page("oblique.rs", "masses", &[]);
    // A turn about one axis and a slide along it: (inertia of literals, 0; 0, mass).
    let html = parsed(&text);
    let found = squares(&html, 0);
    assert_eq!((found[0].as_str(), found[1].as_str()), ("constant", "zero"), "{found:?}");
    // The Jacobian of a rod between two points that it holds: one row.
    assert_eq!(squares(&html, 1).len() * squares(&html, 1).len(), found.len());
}

/// Places of the joints' marks by name, and pixels per metre by the scale bar.
fn drawn(html: &Document<'_>) -> (Vec<(String, [f64; 2])>, f64) {
    let drawing = html.descendants().find(|node| has_class(node, "drawing")).unwrap();
    let marks = drawing.descendants().filter(|node| has_class(node, "mark"));
    let marks = marks.map(|mark| {
        let at = match mark.tag_name().name() {
            "circle" => [number(&mark, "cx"), number(&mark, "cy")],
            _ => match mark.attribute("transform") {
                Some(moved) => {
                    let (x, y) =
                        moved.split_once("translate(").unwrap().1.split_once(')').unwrap().0.split_once(' ').unwrap();
                    [x.parse().unwrap(), y.parse().unwrap()]
                }
                None => [number(&mark, "x") + 3.5, number(&mark, "y") + 3.5],
            },
        };
        (letters(mark), at)
    });
    let marks = marks.collect();
    let bar = drawing.descendants().find(|node| has_class(node, "bar")).unwrap();
    let label =
        drawing.descendants().filter(|node| has_class(node, "world")).map(letters).find(|text| text.ends_with(" m"));
    let metres: f64 = label.unwrap().trim_end_matches(" m").parse().unwrap();
    (marks, (number(&bar, "x2") - number(&bar, "x1")) / metres)
}

/// The model's frames stand at oblique places that are worked out by hand here, and on paper they are where the view that
/// the caption names puts them.
#[test]
fn frames_stand_where_they_are() {
    let text = page("oblique.rs", "drawing", &[]);
    let html = parsed(&text);
    let place = section(&html, "Default position");
    // 0.6 turns the frame by arctan(3/4) about z: x' = (0.8, 0.6, 0), y' = (-0.6, 0.8, 0).
    let known = [
        // ground.at(X).rotated(Z, ..)
        ("first", [1.0, 0.0, 0.0]),
        // 0.5 along x', then 0.25 along z.
        ("second", [1.4, 0.3, 0.25]),
        // 1 further along y'.
        ("mooring", [0.8, 1.1, 0.25]),
    ];
    let rows: Vec<Vec<String>> = html
        .descendants()
        .filter(|node| node.has_tag_name("tr"))
        .map(|row| row.children().filter(Node::is_element).map(letters).collect())
        .collect();
    for (name, at) in known {
        let row = rows.iter().find(|row| row.len() == 5 && row[0] == name && row[1] == "joint").unwrap();
        let told: Vec<f64> = row[2..].iter().map(|x| x.parse().unwrap()).collect();
        assert!(told.iter().zip(at).all(|(a, b)| (a - b).abs() < 1e-3), "{name}: {told:?}");
    }
    // The view: an orthonormal basis whose last vector is told.
    let from: Vec<f64> = place
        .split("seen from (")
        .nth(1)
        .unwrap()
        .split(')')
        .next()
        .unwrap()
        .split(", ")
        .map(|x| x.parse().unwrap())
        .collect();
    let (marks, scale) = drawn(&html);
    let at = |name: &str| marks.iter().find(|mark| mark.0 == name).unwrap_or_else(|| panic!("{name} in {marks:?}")).1;
    // Upwards is the part of z across the view, to the right what is across both.
    let along = |p: [f64; 3]| -> [f64; 2] {
        let height = from[2];
        let up = [-height * from[0], -height * from[1], 1.0 - height * height];
        let length = up.iter().map(|x| x * x).sum::<f64>().sqrt();
        let up = up.map(|x| x / length);
        let right =
            [up[1] * from[2] - up[2] * from[1], up[2] * from[0] - up[0] * from[2], up[0] * from[1] - up[1] * from[0]];
        [0, 1].map(|k| (0..3).map(|j| p[j] * [right, up][k][j]).sum())
    };
    let [origin, rest @ ..] = known;
    for (name, p) in rest {
        let way = along([0, 1, 2].map(|k| p[k] - origin.1[k]));
        let found = [at(name)[0] - at(origin.0)[0], at(origin.0)[1] - at(name)[1]].map(|x| x / scale);
        // Components of the view are told to a hundredth.
        assert!((0..2).all(|k| (found[k] - way[k]).abs() < 0.02), "{name}: {found:?}, {way:?}");
    }
}

/// A closed loop is drawn closed, and on the branch that its conditions choose, whatever holds it.
#[test]
fn loops_are_drawn_closed() {
    let reduced = std::fs::read_to_string(Path::new(DATA).join("four_bar.rs")).unwrap();
    let held =
        reduced.replace("constraints: Reduced", "constraints: Multipliers").replace(" { solve_for: torque }", "");
    for (name, source) in [("reduced", &reduced), ("held", &held)] {
        let folder = folder(&format!("closed-{name}"));
        std::fs::create_dir_all(&folder).unwrap();
        let file = folder.join("four_bar.rs");
        std::fs::write(&file, source).unwrap();
        let paths = written(file.to_str().unwrap(), &folder, &[]);
        let text = std::fs::read_to_string(&paths[0]).unwrap();
        let html = parsed(&text);
        assert_eq!(letters(html.root_element()).contains("Constraint Jacobian"), name == "held");
        let (marks, scale) = drawn(&html);
        let at = |name: &str| marks.iter().find(|mark| mark.0 == name).unwrap().1;
        let length = |a: &str, b: &str| (at(a)[0] - at(b)[0]).hypot(at(a)[1] - at(b)[1]) / scale;
        for (a, b, expected) in
            [("drive_shaft", "knee", 1.0), ("knee", "pin", 3.5), ("pivot", "pin", 3.0), ("drive_shaft", "pivot", 4.0)]
        {
            assert!((length(a, b) - expected).abs() < 0.01, "{name}, {a} to {b}: {}", length(a, b));
        }
        // sin(pivot - drive_shaft - knee) > 0: above the base; pictures grow downwards.
        assert!(at("pin")[1] < at("pivot")[1] - 100.0, "{name}");
    }
}

#[test]
fn two_runs_are_one() {
    let bytes = |name: &str| -> Vec<Vec<u8>> {
        let paths = written("four_bar.rs", &folder(name), &["--markdown"]);
        paths.iter().map(|path| std::fs::read(path).unwrap()).collect()
    };
    let first = bytes("one");
    assert_eq!(first.len(), 2);
    assert_eq!(first, bytes("other"));
}

#[test]
fn markdown_has_the_same() {
    let paths = written("four_bar.rs", &folder("markdown"), &["--markdown"]);
    let names: Vec<&str> = paths.iter().map(|path| path.file_name().unwrap().to_str().unwrap()).collect();
    assert_eq!(names, ["four_bar.html", "four_bar.md"]);
    let text = std::fs::read_to_string(&paths[1]).unwrap();
    for piece in [
        "# four_bar\n\nA planar four-bar linkage",
        "\n```text\nground\n  drive_shaft (revolute)\n    crank\n      knee (revolute)\n        coupler\n",
        "\npin (revolute) closes: coupler - rocker\n",
        "\n| `friction` | `N m s/rad` | `0.1` |",
        "\n- `ballast`\n",
        "\n```math\n",
    ] {
        assert!(text.contains(piece), "{piece} of\n{text}");
    }
    assert!(!text.contains("<svg") && !text.contains("<math"));
}

#[test]
fn what_cannot_be_written_is_told() {
    // A file is no folder.
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.toml");
    let output = Command::new(env!("CARGO_BIN_EXE_cargo-multibody"))
        .args(["report", "pendulum.rs", "--out", file])
        .current_dir(DATA)
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("Cargo.toml"));
}
