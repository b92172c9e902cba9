//! The teacher's own mistakes: `mistakes/TASK.txt` in the folder of a term, in the form of
//! `grader/mutants/TASK.txt`.
//!
//! The list is appended to that of First Light. What the grader learns of it, the answers that each
//! mistake makes wrong, is stored beside it in `mistakes/TASK.bin`, so that it is learnt once and
//! another machine need not compile the mistakes.

use super::settings::Changes;
use crate::mutants::corpus::{BEGINNINGS, Corpus, Mutant};
use crate::mutants::run;
use base::{GraderError, VERSION, Workspace, term, write_whole};
use files::file_tree::Files;
use grader::course::packed::binary;
use grader::course::{Course, Task};
use grader::diagnosis::{self, Known, diagnose};
use grader::signature::Signature;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::path::{Path, PathBuf};

/// What stands behind the words of a mistake, so that reports tell it apart from First Light's.
const MARK: &str = " (a mistake of this course)";

/// The mistakes of one task.
#[derive(Clone, Debug)]
pub struct OwnMistakes {
    /// The teacher's list.
    list: String,
    /// The mutants of the list.
    mutants: Vec<Mutant>,
    /// What was learnt of this list with this version of First Light.
    learnt: Option<Vec<Known>>,
}

/// The file of what was learnt.
#[derive(Serialize, Deserialize)]
struct Learnt {
    /// The version of First Light whose cases were asked.
    version: String,
    /// The list that it was learnt of.
    list: String,
    /// The packed signatures.
    known: Vec<u8>,
}

impl Learnt {
    /// The signatures, if they are those of `list` in this version.
    fn of(bytes: &[u8], list: &str) -> Option<Vec<Known>> {
        let learnt: Learnt = binary::from_bytes(bytes).ok()?;
        let is_of_list = learnt.version == VERSION && learnt.list == list;
        is_of_list.then(|| diagnosis::from_bytes(&learnt.known).ok())?
    }
}

/// Reads the lists among the teacher's files in `folder`, by the keys of their tasks.
pub(super) fn read(
    inputs: &BTreeMap<PathBuf, Vec<u8>>,
    folder: &Path,
) -> Result<BTreeMap<String, OwnMistakes>, GraderError> {
    let mut all = BTreeMap::new();
    for (path, contents) in inputs {
        let Ok(file) = path.strip_prefix(term::MISTAKES) else {
            continue;
        };
        let failed =
            |why: &str| GraderError::new(format!("{}: {why}", folder.join(path).display()));
        let task = match file.extension().and_then(|extension| extension.to_str()) {
            Some("txt") => file.with_extension("").display().to_string(),
            Some("bin") => continue,
            _ => {
                return Err(failed(
                    "expected mistakes/TASK.txt, such as mistakes/part1.task3.txt",
                ));
            }
        };
        let list = std::str::from_utf8(contents).map_err(|_| failed("it is not UTF-8 text"))?;
        // Notepad writes this mark before a text.
        let list = list.strip_prefix('\u{feff}').unwrap_or(list);
        let corpus = Corpus::of_text(list).map_err(|e| failed(&e))?;
        let learnt = inputs.get(&path.with_extension("bin"));
        let mistakes = OwnMistakes {
            list: list.to_string(),
            mutants: corpus.mutants,
            learnt: learnt.and_then(|bytes| Learnt::of(bytes, list)),
        };
        all.insert(task, mistakes);
    }
    Ok(all)
}

impl OwnMistakes {
    /// The files of First Light that change: its list for `task`, and its signatures if those of
    /// the teacher's mistakes are learnt.
    pub(super) fn applied(
        &self,
        task: &str,
        files: &Files,
    ) -> Result<Vec<(PathBuf, Vec<u8>)>, GraderError> {
        let failed = |why: &str| GraderError::new(format!("mistakes/{task}.txt: {why}"));
        let path = PathBuf::from(format!("grader/mutants/{task}.txt"));
        let original = files.get(&path).ok_or_else(|| {
            failed("First Light has no such task: expected the key of one, such as part1.task3")
        })?;
        let original = String::from_utf8_lossy(original);
        let list = format!(
            "{original}\n# Mistakes of this course.\n\n{}",
            self.marked()
        );
        Corpus::of_text(&list)
            .and_then(|corpus| corpus.check())
            .map_err(|why| failed(&format!("together with First Light's mistakes, {why}")))?;
        let mut applied = vec![(path, list.into_bytes())];
        if let Some(learnt) = &self.learnt {
            let path = diagnosis::file_of(task);
            let mut known = match files.get(&path) {
                Some(bytes) => diagnosis::from_bytes(bytes).map_err(|why| failed(&why))?,
                None => Vec::new(),
            };
            known.extend(learnt.iter().cloned());
            let bytes = diagnosis::to_bytes(&known).map_err(|why| failed(&why))?;
            applied.push((path, bytes));
        }
        Ok(applied)
    }

    /// The list with [`MARK`] behind the words of each mistake.
    fn marked(&self) -> String {
        // Lines of code are indented by four spaces, those that begin a mistake need not stand at
        // the left edge.
        let begins_mistake = |line: &str| {
            let content = line.trim_start();
            let mut words = BEGINNINGS.iter();
            line.len() < content.len() + 4 && words.any(|word| content.starts_with(word))
        };
        let lines = self.list.lines().map(|line| match begins_mistake(line) {
            true => format!("{}{MARK}\n", line.trim_end()),
            false => format!("{line}\n"),
        });
        lines.collect()
    }
}

/// What came of learning the mistakes of a term.
#[derive(Clone, Debug, Default)]
pub struct Learning {
    /// What is wrong with the lists, as sentences.
    pub problems: Vec<String>,
    /// Whether a list was learnt, which is not applied yet.
    pub is_new: bool,
}

/// Learns the mistakes of the term in `folder` that are not learnt yet, in its copy `workspace`. A
/// list without a problem is stored as learnt.
pub fn learn(workspace: &Workspace, folder: &Path) -> Result<Learning, GraderError> {
    let course = Course::read(workspace)?;
    let changes = Changes::read(folder)?;
    let mut learning = Learning::default();
    for (task, mistakes) in &changes.mistakes {
        // The mistakes of a task that the course leaves out are nobody's.
        let task = course.tasks().find(|other| other.key == *task);
        let Some(task) = task.filter(|_| mistakes.learnt.is_none()) else {
            continue;
        };
        let in_list = |why: &dyn fmt::Display| format!("mistakes/{}.txt: {why}", task.key);
        let (known, found) = learn_task(workspace, &course, task, mistakes)
            .map_err(|e| GraderError::new(in_list(&e)))?;
        if !found.is_empty() {
            let found = found.iter().map(|why| in_list(why));
            learning.problems.extend(found);
            continue;
        }
        let path = folder
            .join(term::MISTAKES)
            .join(format!("{}.bin", task.key));
        let failed = |why: String| GraderError::file("write", &path, why);
        let bytes = learnt(&mistakes.list, &known).map_err(failed)?;
        write_whole(&path, &bytes)?;
        learning.is_new = true;
    }
    Ok(learning)
}

/// The contents of `mistakes/TASK.bin`: what was learnt of `list`.
pub fn learnt(list: &str, known: &[Known]) -> Result<Vec<u8>, String> {
    binary::to_bytes(&Learnt {
        version: VERSION.into(),
        list: list.into(),
        known: diagnosis::to_bytes(known)?,
    })
}

/// The signatures of the mistakes of one task, and what is wrong with these mistakes.
fn learn_task(
    workspace: &Workspace,
    course: &Course,
    task: &Task,
    mistakes: &OwnMistakes,
) -> Result<(Vec<Known>, Vec<String>), GraderError> {
    let mutants = mistakes.mutants.clone();
    let bases: BTreeSet<String> = mutants.iter().map(|mutant| mutant.on.clone()).collect();
    let (graded, broken) = run::those_that_compile(workspace, course, task, mutants, &bases)?;
    let broken = broken
        .iter()
        .map(|name| format!("`{name}` does not compile"));
    let mut problems: Vec<String> = broken.collect();
    let (known, _) = run::known(&Corpus::read(workspace, task)?, &graded);
    let mut all = diagnosis::known(workspace, &task.key)?;
    all.extend(known.iter().cloned());
    for graded in &graded {
        let run::Kind::Mutant(mutant) = &graded.kind else {
            continue;
        };
        let name = &graded.name;
        let result = &graded.result;
        let lost = result.max_score + result.robust_max_score - result.score - result.robust_score;
        if lost == 0.0 {
            problems.push(format!(
                "`{name}` loses no points: no case of {} sees it. Add one (`cargo grader course case`), or leave it out",
                task.key
            ));
            continue;
        }
        let named = diagnose(&all, &Signature::of(&graded.result.cases))
            .map_or(Vec::new(), |diagnosis| diagnosis.mistakes);
        if !mutant.mistakes.iter().all(|made| named.contains(made)) {
            let named = match named.is_empty() {
                true => "not named at all".to_string(),
                false => format!("named `{}`", named.join("`, `")),
            };
            problems.push(format!("`{name}` is {named} by its answers"));
        }
    }
    Ok((known, problems))
}
