//! Files and fields with mistakes: one clear message each.

use std::fmt::Write;

use crate::support::checked;

const FILES: &str = include_str!("malformed.txt");

/// A case is the file in one line, or `fields:` with these fields for a file without mistakes; then what is said.
#[test]
fn every_mistake_is_told_once() {
    let mut wrong = String::new();
    let mut lines = FILES.lines().filter(|line| !line.is_empty() && !line.starts_with("# ")).peekable();
    let mut count = 0;
    while let Some(case) = lines.next() {
        let mut expected = Vec::new();
        while let Some(line) = lines.next_if(|line| line.starts_with("    ")) {
            expected.push(line.trim());
        }
        let good = "<robot name='r'><link name='a'/><link name='b'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link><joint name='j' type='revolute'><parent link='a'/><child link='b'/></joint></robot>";
        let (fields, file) = match case.strip_prefix("fields: ") {
            Some(fields) => (fields, good.to_owned()),
            None => ("file: \"r.urdf\", base: ground", file(case)),
        };
        let call = format!("mod m {{ part r: Urdf {{ {fields} }}; }}");
        let (_, said) = checked(call.parse().unwrap(), &file);
        if said != expected {
            let _ = write!(wrong, "{case}\n    {}\n", said.join("\n    "));
        }
        count += 1;
    }
    assert!(wrong.is_empty(), "said instead:\n{wrong}");
    assert!(count >= 60, "{count} cases are read");
}

/// `B` stands for a good inertial, `P` for the parent and child of a good joint.
fn file(case: &str) -> String {
    let inertial = "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>";
    case.replace("{B}", inertial)
        .replace("{P}", "<parent link='a'/><child link='b'/>")
        .replace("{A}", "<link name='a'/>")
        .replace("{L}", &format!("<link name='b'>{inertial}</link>"))
}

fn message(file: &str) -> String {
    let call = "mod m { part r: Urdf { file: \"r.urdf\", base: ground }; }";
    let (_, said) = checked(call.parse().unwrap(), file);
    assert_eq!(said.len(), 1, "{said:#?}");
    said[0].clone()
}

#[test]
fn large_files_end() {
    let deep = "<a>".repeat(1_000_000);
    assert_eq!(message(&deep), "r.urdf:1:193: elements are nested more than 64 deep");
    let many = format!("<robot>{}</robot>", "<gazebo/>".repeat(300_000));
    assert_eq!(message(&many), "r.urdf: the file has more than 200000 elements");
    let long = format!("<robot><!--{}--></robot>", "x".repeat(9 << 20));
    assert_eq!(message(&long), "r.urdf: the file has more than 8388608 bytes");
    // Half of a pair of quotation marks, many times.
    assert!(message(&"<a b='".repeat(100_000)).contains("no XML"));
    let links: String = (0..15_000).map(|k| format!("<link name='l{k}'/>")).collect();
    assert!(message(&format!("<robot>{links}</robot>")).contains("two links hang on no joint"));
}

/// Any part of a file, and a file with any one character of a few in place of another, is read or refused.
#[test]
fn broken_files_are_refused_without_a_panic() {
    let file = file(
        "<robot name='r'>{A}{L}<joint name='j' type='revolute'><origin rpy='1 2 3'/>{P}<dynamics damping='1'/><mimic joint='j'/></joint></robot>",
    );
    let call = || "mod m { part r: Urdf { file: \"r.urdf\", base: ground }; }".parse().unwrap();
    for at in 0..file.len() {
        checked(call(), &file[..at]);
        for other in ["<", ">", "'", "/", "-", "9", "é", "\u{0}"] {
            checked(call(), &format!("{}{other}{}", &file[..at], &file[at + 1..]));
        }
    }
}
