//! `report`: a page about each model, for people.

use std::collections::HashMap;
use std::fs;
use std::path::Path;

use crate::Stop;
use crate::arguments::Subject;
use crate::build;
use crate::report::report;

/// Where pages are written unless the user says so.
const FOLDER: &str = "target/multibody";

/// Writes the pages, and says where.
pub(crate) fn run(subject: &Subject, folder: Option<&Path>, markdown: bool) -> Result<String, Stop> {
    let folder = folder.unwrap_or(Path::new(FOLDER));
    let file = subject.file.display().to_string();
    let reports = build::each(subject, "reporting on", |model| report(model, &file))?;
    let write = |path: &Path, text: &str| {
        let refused = |error: std::io::Error| Stop::Usage(format!("{}: {error}", path.display()));
        fs::create_dir_all(folder).map_err(refused)?;
        fs::write(path, text).map_err(refused)
    };
    let mut written = String::new();
    let mut names: HashMap<String, usize> = HashMap::new();
    for (model, report) in &reports {
        let name = model.name.to_string();
        let name = name.strip_prefix("r#").unwrap_or(&name);
        // Models of one name stand in different modules of the file.
        let number = names.entry(name.to_owned()).or_default();
        *number += 1;
        let stem = if *number == 1 { name.to_owned() } else { format!("{name}-{number}") };
        let mut pages = vec![("html", &report.html)];
        pages.extend(markdown.then_some(("md", &report.markdown)));
        for (extension, text) in pages {
            let path = folder.join(format!("{stem}.{extension}"));
            write(&path, text)?;
            written.push_str(&format!("{}\n", path.display()));
        }
    }
    Ok(written)
}
