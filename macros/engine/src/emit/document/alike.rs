//! Stage `emit`: lines of the report that say the same of every element of an array, said once.
//!
//! In: lines. Out: the same in order, with `legs[_]` in place of `legs[0]`, `legs[1]`, .. where a line stands there for
//! each of the elements that any line names, and differs in their number alone.

use std::collections::BTreeSet;

/// Lines that are alike once each; nested arrays are opened one after the other.
pub fn once(lines: Vec<String>) -> Vec<String> {
    let (mut lines, mut opened): (Vec<String>, Vec<String>) = (lines, Vec::new());
    // An array within one that has been opened has a new name.
    while let Some(array) =
        lines.iter().flat_map(|line| elements(line)).map(|one| one.0).find(|name| !opened.contains(name))
    {
        lines = folded(&lines, &array);
        opened.push(array);
    }
    let mut unique: Vec<String> = Vec::new();
    lines.into_iter().for_each(|line| {
        if !unique.contains(&line) {
            unique.push(line);
        }
    });
    unique
}

/// With one array opened.
fn folded(lines: &[String], array: &str) -> Vec<String> {
    let indices = |line: &String| -> BTreeSet<usize> {
        elements(line).into_iter().filter(|(name, _)| name == array).map(|(_, index)| index).collect()
    };
    let all: BTreeSet<usize> = lines.iter().flat_map(indices).collect();
    // A line about one element alone, with its number left open.
    let open = |line: &String| -> Option<(usize, String)> {
        let own = indices(line);
        let index = own.first().copied().filter(|_| own.len() == 1)?;
        Some((index, line.replace(&format!("{array}[{index}]"), &format!("{array}[_]"))))
    };
    let opened: Vec<Option<(usize, String)>> = lines.iter().map(open).collect();
    let is_whole = |text: &String| {
        let same = opened.iter().flatten().filter(|(_, other)| other == text);
        all.len() > 1 && same.map(|(index, _)| *index).collect::<BTreeSet<usize>>() == all
    };
    let fold = |(line, open): (&String, &Option<(usize, String)>)| match open {
        Some((_, text)) if is_whole(text) => text.clone(),
        _ => line.clone(),
    };
    lines.iter().zip(&opened).map(fold).collect()
}

/// Arrays with the indices at which a line names them: `legs` with 2 of `legs[2].stroke`.
fn elements(line: &str) -> Vec<(String, usize)> {
    let mut found = Vec::new();
    for (at, _) in line.match_indices('[') {
        let is_name = |c: char| c.is_alphanumeric() || matches!(c, '_' | '.' | '[' | ']');
        let before = line[..at]
            .rfind(|c: char| !is_name(c))
            .map_or(0, |end| end + line[end..].chars().next().map_or(1, char::len_utf8));
        let index = line[at + 1..].split(']').next().and_then(|digits| digits.parse().ok());
        if let (Some(index), false) = (index, before == at) {
            found.push((line[before..at].to_string(), index));
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::once;

    fn lines(list: &[&str]) -> Vec<String> {
        list.iter().map(|line| (*line).to_string()).collect()
    }

    #[test]
    fn what_is_alike_stands_once() {
        let all = lines(&["`legs[0].a` of `legs[0].b`", "`x`", "`legs[1].a` of `legs[1].b`", "`x`"]);
        assert_eq!(once(all), lines(&["`legs[_].a` of `legs[_].b`", "`x`"]));
        let nested = lines(&["`a[0].b[0]`", "`a[0].b[1]`", "`a[1].b[0]`", "`a[1].b[1]`"]);
        assert_eq!(once(nested), lines(&["`a[_].b[_]`"]));
    }

    #[test]
    fn what_differs_stands_as_it_is() {
        for all in [
            // One element is missing.
            lines(&["`a[0]` 1", "`a[1]` 1", "`a[2]` 2"]),
            // Each on the one before.
            lines(&["`a[1]` on `a[0]`", "`a[2]` on `a[1]`"]),
            // Elements of a list, and not of an array of parts.
            lines(&["[1.0, 2.0]", "[2]"]),
        ] {
            assert_eq!(once(all.clone()), all);
        }
    }
}
