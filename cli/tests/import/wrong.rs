//! Files with one mistake each: what is said, and where.

use super::{run, written};

/// `cases.txt`: files and messages, `----` between them, `====` behind each.
#[test]
fn every_mistake_has_its_message_and_its_place() {
    let cases = include_str!("cases.txt");
    let mut count = 0;
    let mut told = String::new();
    for case in cases.split("====\n").filter(|case| !case.trim().is_empty()) {
        let (text, _) = case.split_once("----\n").unwrap();
        let file = written("robot.urdf", text);
        let (output, messages, code) = run(&["import", &file]);
        assert_eq!((output.as_str(), code), ("", 1), "{text}");
        let lines = messages.lines().filter(|line| {
            let words = line.trim_start();
            ["error: ", "help: ", "--> "].iter().any(|start| words.starts_with(start))
        });
        let lines: String = lines.map(|line| format!("{}\n", line.trim_start().replace(&file, "robot.urdf"))).collect();
        told += &format!("{text}----\n{lines}====\n");
        count += 1;
    }
    assert!(count >= 30, "{count}");
    let file = written("cases.txt", &told);
    assert!(told == cases, "what is told now is in {file}");
}

#[test]
fn files_that_would_never_end_are_refused() {
    let refused = |text: &str| {
        let (output, messages, code) = run(&["import", &written("large.urdf", text)]);
        assert_eq!((output.as_str(), code), ("", 1));
        messages
    };
    let large = format!("<robot name=\"r\">{}</robot>", " ".repeat(17 << 20));
    assert!(refused(&large).contains("bytes; 16777216 are read"));
    let deep = "<a>".repeat(100_000);
    assert!(refused(&deep).starts_with("error: "));
    let links: String = (0..10_001).map(|k| format!("<link name=\"l{k}\"/>")).collect();
    assert!(refused(&format!("<robot name=\"r\">{links}</robot>")).contains("10001 links; 10000 are read"));
}

#[test]
fn the_choices_are_checked() {
    let (_, messages, code) = run(&["import", "panda.urdf", "--base", "held"]);
    assert_eq!((messages.as_str(), code), ("error: `--base` is `fixed` or `floating`, and not `held`\n", 2));
    let (_, messages, code) = run(&["import", "panda.urdf", "--allow-unphysical", "link9"]);
    assert!(messages.starts_with("error: there is no link `link9` with an inertia"), "{messages}");
    assert_eq!(code, 1);
    assert_eq!(run(&["import"]).2, 2);
    assert_eq!(run(&["import", "nowhere.urdf"]).2, 2);
}
