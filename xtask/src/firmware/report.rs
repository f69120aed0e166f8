//! What a variant says of itself: scenes in brackets, and below each lines `what: how much`.

/// A line of a report.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Line {
    pub(crate) scene: String,
    pub(crate) key: String,
    pub(crate) value: String,
}

impl Line {
    /// The value as a count; text counts nothing.
    pub(crate) fn count(&self) -> u64 {
        self.value.parse().unwrap_or_default()
    }
}

/// Everything about one variant.
#[derive(Debug, Default)]
pub(crate) struct Report {
    pub(crate) scenes: Vec<String>,
    pub(crate) lines: Vec<Line>,
}

impl Report {
    pub(crate) fn parse(text: &str) -> Report {
        let mut report = Report::default();
        for line in text.lines() {
            if let Some(scene) = line.strip_prefix('[').and_then(|rest| rest.strip_suffix(']')) {
                report.scenes.push(scene.to_owned());
                continue;
            }
            let (key, value) = line.split_once(": ").unwrap_or((line, ""));
            let scene = report.scenes.last().cloned().unwrap_or_default();
            report.lines.push(Line { scene, key: key.to_owned(), value: value.to_owned() });
        }
        report
    }

    pub(crate) fn get(&self, scene: &str, key: &str) -> Option<&Line> {
        self.lines.iter().find(|line| line.scene == scene && line.key == key)
    }
}

#[cfg(test)]
mod tests {
    use super::Report;

    #[test]
    fn scenes_keys_and_values() {
        let report =
            Report::parse("[one]\nscene: a pendulum: RK4, f32\nstack bytes: 12\n[two]\nstack bytes: 13\nno value\n");
        assert_eq!(report.scenes, ["one", "two"]);
        assert_eq!(report.get("one", "scene").unwrap().value, "a pendulum: RK4, f32");
        assert_eq!(report.get("one", "scene").unwrap().count(), 0);
        assert_eq!(report.get("two", "stack bytes").unwrap().count(), 13);
        assert_eq!(report.get("two", "no value").unwrap().value, "");
        assert!(report.get("two", "scene").is_none());
    }
}
