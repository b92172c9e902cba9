//! The teacher's own cases: `cases/TASK/NAME.toml` in the folder of a term.

use base::{GraderError, term};
use judge::cases::{Spec, checked};
use judge::{Tier, own_cases};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use wire::Work;

/// The file of a case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OwnCase {
    /// What the case checks, in a sentence for students.
    pub about: String,
    /// Whether its points are core or robust points.
    pub tier: Tier,
    /// The points that it is worth, in quarters.
    pub points: f64,
    /// The question: a kind of work and its input.
    pub work: Work,
}

/// Reads the cases among the teacher's files in `folder`, by names such as `part1.task3/thin_door`.
pub(super) fn read(
    inputs: &BTreeMap<PathBuf, Vec<u8>>,
    folder: &Path,
) -> Result<BTreeMap<String, OwnCase>, GraderError> {
    let mut cases = BTreeMap::new();
    for (path, contents) in inputs {
        let Ok(inside) = path.strip_prefix(term::CASES) else {
            continue;
        };
        let failed = |why: &dyn std::fmt::Display| {
            GraderError::new(format!("{}: {why}", folder.join(path).display()))
        };
        let (task, name) = task_and_name(inside).ok_or_else(|| {
            failed(
                &"expected cases/TASK/NAME.toml, such as cases/part1.task3/thin_door.toml, with a name of small letters, digits and _",
            )
        })?;
        let text = std::str::from_utf8(contents).map_err(|_| failed(&"it is not UTF-8 text"))?;
        let case: OwnCase = toml::from_str(text).map_err(|e| failed(&e))?;
        if let Some(problem) = own_cases::problem(&judged(task, name, &case)) {
            return Err(failed(&problem));
        }
        cases.insert(format!("{task}/{name}"), case);
    }
    Ok(cases)
}

/// The task and the name of the case in the file `path` of the folder of cases.
fn task_and_name(path: &Path) -> Option<(&str, &str)> {
    let (task, file) = path.to_str()?.split_once('/')?;
    let name = file.strip_suffix(".toml")?;
    let is_plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
    let is_name = name.starts_with(|c: char| c.is_ascii_lowercase()) && name.chars().all(is_plain);
    is_name.then_some((task, name))
}

/// A case in the form in which the judge has it.
pub(super) fn judged(task: &str, name: &str, case: &OwnCase) -> own_cases::OwnCase {
    own_cases::OwnCase {
        task: task.into(),
        name: name.into(),
        about: case.about.clone(),
        work: case.work.clone(),
    }
}

/// The most lines of a file from which somebody starts.
const LONGEST: usize = 300;

/// The text of a file from which a teacher can start: the first call of the simplest question of
/// the same kind as that of the case `spec`, or of its own; the whole where calls depend on each
/// other. An error if that is too long to start from.
pub fn template(spec: &Spec, tier: Tier) -> Result<String, GraderError> {
    let simplest = spec.simple().into_iter().next();
    let question = simplest.as_ref().unwrap_or(spec);
    let first_call = question.only_call(0);
    let case = OwnCase {
        about: checked(spec.about).to_string(),
        tier,
        points: 1.0,
        work: first_call.as_ref().unwrap_or(question).work.clone(),
    };
    let (task, name) = (spec.task, spec.name);
    let case = toml::to_string(&case)
        .map_err(|e| GraderError::new(format!("{task}/{name} cannot be written as a file: {e}")))?;
    let lines = case.lines().count();
    if lines > LONGEST {
        return Err(GraderError::new(format!(
            "the question of {task}/{name} has {lines} lines, too many to start from. Take another case of {task} with fewer shapes or boxes"
        )));
    }
    Ok(format!(
        "# A question such as {task}/{name} asks. Change it, and store it as cases/{task}/NAME.toml in the folder of your\n\
         # term. .first-light/grader/wire/src says what each field means; a list, or a block `[[...]]` with what follows\n\
         # it, is copied for a further call. Core points are for textbook code.\n\
         {case}"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_case_whose_answers_are_judged_has_a_template() {
        let (mut timed, mut too_long) = (0, Vec::new());
        let mut seen = BTreeSet::new();
        for spec in judge::cases::all(0) {
            // One case of each kind in each task.
            if !seen.insert((spec.task, spec.work.kind())) {
                continue;
            }
            let text = match template(&spec, Tier::Core) {
                Ok(text) => text,
                Err(error) => {
                    assert!(
                        error.to_string().contains("too many to start from"),
                        "{error}"
                    );
                    too_long.push(format!("{}/{}", spec.task, spec.name));
                    continue;
                }
            };
            let lines = text.lines().count();
            let is_one_call = spec.only_call(0).is_some();
            assert!(
                lines < 60 || !is_one_call,
                "{} has {lines} lines",
                spec.name
            );
            let path = format!("cases/{}/our_case.toml", spec.task);
            let inputs = BTreeMap::from([(path.into(), text.into_bytes())]);
            match read(&inputs, Path::new("term")) {
                Ok(cases) => assert_eq!(cases.len(), 1),
                Err(error) => {
                    let error = error.to_string();
                    assert!(error.contains("measures times"), "{}: {error}", spec.name);
                    timed += 1;
                }
            }
        }
        assert_eq!(timed, 1);
        assert_eq!(too_long, ["part2.task3/mesh_in_cornell_box"]);
    }

    #[test]
    fn a_file_with_another_name_is_refused() {
        for path in ["part1.task3/Door.toml", "part1.task3/door.txt", "door.toml"] {
            let path = Path::new("cases").join(path);
            let inputs = BTreeMap::from([(path, Vec::new())]);
            let error = read(&inputs, Path::new("term"))
                .expect_err("no case")
                .to_string();
            assert!(error.contains("expected cases/TASK/NAME.toml"), "{error}");
        }
    }
}
