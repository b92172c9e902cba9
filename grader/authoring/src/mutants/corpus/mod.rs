//! Reads the corpus of mutants and variants: `grader/mutants/TASK.txt`, in the form that `text`
//! describes, and `grader/mutants/variants/STAGE/NAME.rs`.

mod function;
mod text;

pub(crate) use text::{BEGINNINGS, form_text};

use base::{GraderError, Workspace};
use grader::course::Task;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// The mistakes of one task and the mutants that make them.
#[derive(Clone, Debug, Default)]
pub struct Corpus {
    /// The listed mistakes.
    pub mistakes: Vec<Mistake>,
    /// The mutants.
    pub mutants: Vec<Mutant>,
}

/// A mistake that students make.
#[derive(Clone, Debug, Default)]
pub struct Mistake {
    /// Its name.
    pub id: String,
    /// The end of the sentence "your answers equal those of code that ...".
    pub description: String,
    /// Where to look, without revealing the solution.
    pub hint: String,
    /// Whether many mistakes have the same symptom: it is only named if every answer agrees.
    pub symptom: bool,
    /// Its numbers in the list of mistakes that students were observed to make, such as `P1T3-01`.
    pub references: Vec<String>,
}

/// Code that makes one mistake, or two at once: edits of a correct version, or code of its own.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Mutant {
    /// The name of the mistake, or the names of two that are made at once.
    pub mistakes: Vec<String>,
    /// The number of the line in which its form ends in the list of mistakes, from 1. 0 if it comes
    /// from no list.
    pub line: usize,
    /// The code that it changes: `reference` or the name of a variant.
    pub on: String,
    /// A name that distinguishes mutants with the same mistake in the same code.
    pub how: String,
    /// The edits to the code.
    pub edits: Vec<Edit>,
    /// Instead of edits: code as a student writes it, in the form of a variant's file.
    pub code: Option<String>,
    /// Whether it is left out of the signatures. It then tests whether the diagnosis recognises the
    /// mistake in code that it was not made from.
    pub held_out: bool,
}

/// One replacement. `find` must occur exactly once where it is looked for.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Edit {
    /// The function in which `find` is looked for. Empty: in all sources of the stage.
    pub within: String,
    /// The text to replace.
    pub find: String,
    /// The new text.
    pub replace: String,
}

/// The name of the reference, beside the names of variants.
pub const REFERENCE: &str = "reference";

/// The source files of a crate: their text, by their paths below `src`.
pub type Sources = BTreeMap<PathBuf, String>;

impl Corpus {
    /// The path of a task's list of mistakes and mutants.
    pub fn file(workspace: &Workspace, task: &Task) -> PathBuf {
        folder(workspace).join(format!("{}.txt", task.key))
    }

    /// Reads and checks the mistakes and mutants of a task.
    pub fn read(workspace: &Workspace, task: &Task) -> Result<Corpus, GraderError> {
        workspace.ensure_full("it does not contain the list of typical mistakes")?;
        let path = Corpus::file(workspace, task);
        let corpus = Corpus::parse(&path)?;
        corpus
            .check()
            .map_err(|message| GraderError::file("use", &path, message))?;
        Ok(corpus)
    }

    /// Reads a list of mistakes and mutants, without looking whether the parts fit together. The
    /// error names the line.
    pub fn of_text(text: &str) -> Result<Corpus, String> {
        text::read(text).map_err(|e| e.to_string())
    }

    /// Reads the mutants of a task from a file in `folder`. Their mistakes need not be listed.
    /// Returns no mutants if there is no such file.
    pub fn read_unlisted(folder: &Path, task: &Task) -> Result<Vec<Mutant>, GraderError> {
        let path = folder.join(format!("{}.txt", task.key));
        if !path.is_file() {
            return Ok(Vec::new());
        }
        Ok(Corpus::parse(&path)?.mutants)
    }

    fn parse(path: &Path) -> Result<Corpus, GraderError> {
        let text = std::fs::read_to_string(path).map_err(|e| GraderError::file("read", path, e))?;
        Corpus::of_text(&text).map_err(|e| GraderError::file("understand", path, e))
    }

    /// The mistake with this name.
    pub fn mistake(&self, id: &str) -> Option<&Mistake> {
        self.mistakes.iter().find(|mistake| mistake.id == id)
    }

    /// Returns an error if a mistake has no words, a name stands twice, or a mutant makes a mistake
    /// that is not listed.
    pub fn check(&self) -> Result<(), String> {
        let silent = |mistake: &&Mistake| mistake.description.is_empty() || mistake.hint.is_empty();
        if let Some(silent) = self.mistakes.iter().find(silent) {
            return Err(format!(
                "the mistake `{0}` needs `mistake {0}: what the code does`, and a line `hint: where to look`",
                silent.id
            ));
        }
        let mut ids = BTreeSet::new();
        if let Some(twice) = self
            .mistakes
            .iter()
            .find(|mistake| !ids.insert(&mistake.id))
        {
            return Err(format!(
                "two mistakes have the id `{}`: rename one",
                twice.id
            ));
        }
        let made: BTreeSet<&String> = self
            .mutants
            .iter()
            .flat_map(|form| &form.mistakes)
            .collect();
        if let Some(bare) = ids.iter().find(|id| !made.contains(*id)) {
            return Err(format!(
                "no form makes the mistake `{bare}`: add a line below its hint, such as `reference: OLD ~> NEW`"
            ));
        }
        let mut names = BTreeSet::new();
        if let Some(twice) = self
            .mutants
            .iter()
            .map(Mutant::name)
            .find(|name| !names.insert(name.clone()))
        {
            return Err(format!(
                "two mutants have the name `{twice}`: give one of them another name in quotes"
            ));
        }
        for mutant in &self.mutants {
            if let Some(unknown) = mutant.mistakes.iter().find(|id| !ids.contains(id)) {
                return Err(format!(
                    "`{}` makes the mistake `{unknown}`, which is not listed: add `mistake {unknown}: ...`",
                    mutant.name()
                ));
            }
        }
        Ok(())
    }
}

impl Mutant {
    /// Its name: its mistakes, the code that it changes, and `how`.
    pub fn name(&self) -> String {
        let mistakes = self.mistakes.join("+");
        match (self.on.as_str(), self.how.as_str()) {
            (REFERENCE, "") => mistakes,
            (on, "") => format!("{mistakes} on {on}"),
            (on, how) => format!("{mistakes} on {on}: {how}"),
        }
    }

    /// Applies the edits to `sources`. Each text to find must occur exactly once.
    pub fn apply(&self, sources: &Sources) -> Result<Sources, GraderError> {
        let mut sources = sources.clone();
        for edit in &self.edits {
            edit.apply(&mut sources).map_err(|why| {
                let (name, line) = (self.name(), self.line);
                GraderError::new(format!(
                    "the form of `{name}` that ends in line {line} of its list: {why}. Update it to match the code"
                ))
            })?;
        }
        Ok(sources)
    }
}

/// What an edit changes in a file, without the text that it finds and leaves as it is.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Change {
    path: PathBuf,
    at: Range<usize>,
    with: String,
}

/// The edits that make the changes of two mutants of the same `sources`, file by file. `None` if the
/// changes touch each other.
pub(super) fn merged([first, second]: [&Mutant; 2], sources: &Sources) -> Option<Vec<Edit>> {
    let edits = first.edits.iter().chain(&second.edits);
    let mut changes: Vec<Change> = edits
        .map(|edit| edit.change(sources))
        .collect::<Option<_>>()?;
    changes.sort_by(|a, b| (&a.path, a.at.start).cmp(&(&b.path, b.at.start)));
    let touches =
        |pair: &[Change]| pair[0].path == pair[1].path && pair[0].at.end >= pair[1].at.start;
    if changes.windows(2).any(touches) {
        return None;
    }
    let files = changes.chunk_by(|a, b| a.path == b.path).map(|changes| {
        let text = &sources[&changes[0].path];
        let mut replace = text.clone();
        for Change { at, with, .. } in changes.iter().rev() {
            replace.replace_range(at.clone(), with);
        }
        Edit {
            within: String::new(),
            find: text.clone(),
            replace,
        }
    });
    Some(files.collect())
}

impl Edit {
    /// What it changes. `None` if its text is not there exactly once.
    fn change(&self, sources: &Sources) -> Option<Change> {
        let Edit { find, replace, .. } = self;
        let scopes = sources.iter().filter_map(|(path, text)| {
            let scope = match self.within.as_str() {
                "" => 0..text.len(),
                function => function::range(text, function)?,
            };
            Some((path, text, scope))
        });
        let mut found = scopes.flat_map(|(path, text, scope)| {
            let places = text[scope.clone()].match_indices(find.as_str());
            places.map(move |(place, _)| (path, scope.start + place))
        });
        let (Some((path, start)), None) = (found.next(), found.next()) else {
            return None;
        };
        let before = common(find.chars(), replace.chars());
        let after = common(
            find[before..].chars().rev(),
            replace[before..].chars().rev(),
        );
        Some(Change {
            path: path.clone(),
            at: start + before..start + find.len() - after,
            with: replace[before..replace.len() - after].to_string(),
        })
    }

    fn apply(&self, sources: &mut Sources) -> Result<(), String> {
        let Edit {
            within,
            find,
            replace,
        } = self;
        let (mut found, mut has_place) = (0, false);
        let mut place = "the sources".to_string();
        if !within.is_empty() {
            place = format!("the function `{within}`");
        }
        for text in sources.values_mut() {
            let scope = match within.as_str() {
                "" => 0..text.len(),
                function => match function::range(text, function) {
                    Some(range) => range,
                    None => continue,
                },
            };
            has_place = true;
            let mut inside = text[scope.clone()].to_string();
            found += inside.matches(find.as_str()).count();
            inside = inside.replace(find, replace);
            text.replace_range(scope, &inside);
        }
        match found {
            1 => Ok(()),
            _ if !has_place => Err(format!("there is no {}", &place["the ".len()..])),
            _ => Err(format!(
                "expected its text once in {place}, found it {found} times: {find:?}"
            )),
        }
    }
}

/// The length of the text with which both begin.
fn common(a: impl Iterator<Item = char>, b: impl Iterator<Item = char>) -> usize {
    let same = a.zip(b).take_while(|(a, b)| a == b);
    same.map(|(letter, _)| letter.len_utf8()).sum()
}

/// A correct solution that is not the reference.
#[derive(Clone, Debug)]
pub struct Variant {
    /// The name of its file, without the extension.
    pub name: String,
    /// The text of its file: `pub use crate::base::*;` (the reference) and the functions that
    /// differ.
    pub text: String,
}

/// Reads the variants of a stage, ordered by name.
pub fn variants(workspace: &Workspace, stage: &str) -> Result<Vec<Variant>, GraderError> {
    let folder = folder(workspace).join("variants").join(stage);
    if !folder.is_dir() {
        return Ok(Vec::new());
    }
    let mut variants = Vec::new();
    for (path, text) in sources_below(&folder)? {
        let name = path.with_extension("").display().to_string();
        variants.push(Variant { name, text });
    }
    Ok(variants)
}

/// Reads the reference's sources of a stage.
pub fn reference_sources(workspace: &Workspace, stage: &str) -> Result<Sources, GraderError> {
    sources_below(&workspace.root().join("stages").join(stage).join("src"))
}

fn folder(workspace: &Workspace) -> PathBuf {
    workspace.root().join("grader/mutants")
}

/// Reads all `.rs` files below a folder.
fn sources_below(folder: &Path) -> Result<Sources, GraderError> {
    let mut sources = Sources::new();
    let mut open = vec![folder.to_path_buf()];
    while let Some(next) = open.pop() {
        let entries = std::fs::read_dir(&next).map_err(|e| GraderError::file("read", &next, e))?;
        for entry in entries {
            let path = entry
                .map_err(|e| GraderError::file("read", &next, e))?
                .path();
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let text = std::fs::read_to_string(&path)
                    .map_err(|e| GraderError::file("read", &path, e))?;
                let below = path.strip_prefix(folder).unwrap_or(&path).to_path_buf();
                sources.insert(below, text);
            }
        }
    }
    Ok(sources)
}

#[cfg(test)]
mod tests {
    use super::*;
    use grader::course::Course;

    #[test]
    fn a_handout_has_no_corpus() {
        let folder = tempfile::tempdir().unwrap();
        let stages = folder.path().join("stages");
        std::fs::create_dir(&stages).unwrap();
        let text = include_str!("../../../../../stages/course.toml");
        std::fs::write(stages.join("course.toml"), text).unwrap();
        let workspace = Workspace::above(folder.path()).unwrap();
        let course = Course::parse(text).unwrap();
        let task = course.select("part1.task1").unwrap()[0];
        let error = Corpus::read(&workspace, task).unwrap_err().to_string();
        assert!(error.contains("is a handout"), "{error}");
    }
}
