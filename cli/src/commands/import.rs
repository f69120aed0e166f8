//! `import`: a robot's file as text of the language.

use multibody_engine::robots;

use crate::Stop;
use crate::arguments::Subject;
use crate::source::File;

pub(crate) fn run(subject: &Subject) -> Result<String, Stop> {
    let file = File::read(&subject.file).map_err(Stop::Usage)?;
    let name = subject.file.file_name().map_or_else(|| file.name.clone(), |name| name.to_string_lossy().into_owned());
    robots::import(&file.text, &name).map_err(Stop::Usage)
}
