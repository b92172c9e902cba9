//! The corpus: `grader/mutants/<task>.toml` and `grader/mutants/variants/<stage>/<name>.rs`.

use grader::course::Task;
use grader::error::GraderError;
use grader::workspace::Workspace;
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// The mistakes of one task and the code that makes them.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Corpus {
    /// The mistakes that have a name.
    #[serde(rename = "mistake", default)]
    pub mistakes: Vec<Mistake>,
    /// The code that makes them.
    #[serde(rename = "mutant", default)]
    pub mutants: Vec<Mutant>,
}

/// A mistake that students make.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mistake {
    /// Its name.
    pub id: String,
    /// "Your answers equal those of code that ...": how the sentence ends.
    pub says: String,
    /// Where to look, without giving the solution away.
    pub hint: String,
    /// Its numbers in the list of mistakes that students were seen to make, such as `P1T3-01`.
    #[serde(default)]
    pub seen: Vec<String>,
}

/// Code that makes one mistake, or two at once.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mutant {
    /// The mistake's name; two for a pair.
    pub mistakes: Vec<String>,
    /// What it is made from: `reference` or the name of a variant.
    #[serde(default = "reference")]
    pub on: String,
    /// In which way, where the same mistake is made more than once of the same code.
    #[serde(default)]
    pub how: String,
    /// The edits that make it.
    pub edits: Vec<Edit>,
    /// Kept out of the signatures: it only tests whether the diagnosis recognises the mistake in other clothes.
    #[serde(default)]
    pub held_out: bool,
}

/// One replacement. `find` must stand exactly once in the stage's sources.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Edit {
    /// What stands there.
    pub find: String,
    /// What takes its place.
    pub replace: String,
}

/// The name of what is no variant.
pub const REFERENCE: &str = "reference";

fn reference() -> String {
    REFERENCE.into()
}

/// Sources of a crate: path below `src`, text.
pub type Sources = BTreeMap<PathBuf, String>;

impl Corpus {
    /// Where the mutants of a task are.
    pub fn file(workspace: &Workspace, task: &Task) -> PathBuf {
        folder(workspace).join(format!("{}.toml", task.key))
    }

    /// Reads the mutants of a task.
    pub fn read(workspace: &Workspace, task: &Task) -> Result<Corpus, GraderError> {
        workspace.ensure_full("it has no list of typical mistakes")?;
        let path = Corpus::file(workspace, task);
        let corpus = Corpus::parse(&path)?;
        corpus
            .check()
            .map_err(|sentence| GraderError::file("use", &path, sentence))?;
        Ok(corpus)
    }

    /// The mutants in the file of a task in `folder`, whose mistakes need not be listed; none if there is no such file.
    pub fn strangers(folder: &Path, task: &Task) -> Result<Vec<Mutant>, GraderError> {
        let path = folder.join(format!("{}.toml", task.key));
        if !path.is_file() {
            return Ok(Vec::new());
        }
        Ok(Corpus::parse(&path)?.mutants)
    }

    fn parse(path: &Path) -> Result<Corpus, GraderError> {
        let text = std::fs::read_to_string(path).map_err(|e| GraderError::file("read", path, e))?;
        toml::from_str(&text).map_err(|e| GraderError::file("understand", path, e))
    }

    /// The mistake with this name.
    pub fn mistake(&self, id: &str) -> Option<&Mistake> {
        self.mistakes.iter().find(|mistake| mistake.id == id)
    }

    fn check(&self) -> Result<(), String> {
        let mut ids = BTreeSet::new();
        if let Some(twice) = self
            .mistakes
            .iter()
            .find(|mistake| !ids.insert(&mistake.id))
        {
            return Err(format!("two mistakes are called `{}`", twice.id));
        }
        let mut names = BTreeSet::new();
        if let Some(twice) = self
            .mutants
            .iter()
            .map(Mutant::name)
            .find(|name| !names.insert(name.clone()))
        {
            return Err(format!("two mutants are called `{twice}`"));
        }
        for mutant in &self.mutants {
            if let Some(unknown) = mutant.mistakes.iter().find(|id| !ids.contains(id)) {
                return Err(format!(
                    "a mutant makes the mistake `{unknown}`, which is not listed"
                ));
            }
            if mutant.mistakes.is_empty() || mutant.edits.is_empty() {
                return Err("a mutant makes no mistake or no edit".into());
            }
        }
        Ok(())
    }
}

impl Mutant {
    /// Its name: its mistakes, and what it is made from in which way.
    pub fn name(&self) -> String {
        let mistakes = self.mistakes.join("+");
        match (self.on.as_str(), self.how.as_str()) {
            (REFERENCE, "") => mistakes,
            (on, "") => format!("{mistakes} on {on}"),
            (on, how) => format!("{mistakes} on {on}: {how}"),
        }
    }

    /// Makes the edits on `sources`.
    pub fn apply(&self, sources: &Sources) -> Result<Sources, GraderError> {
        let mut sources = sources.clone();
        for edit in &self.edits {
            let found: usize = sources
                .values()
                .map(|text| text.matches(&edit.find).count())
                .sum();
            if found != 1 {
                return Err(GraderError::new(format!(
                    "mutant `{}`: its text stands {found} times in {}, not once: {:?}. Fit the mutant to the code again",
                    self.name(),
                    self.on,
                    edit.find
                )));
            }
            for text in sources.values_mut() {
                *text = text.replace(&edit.find, &edit.replace);
            }
        }
        Ok(sources)
    }
}

/// A correct solution that is not the reference.
#[derive(Clone, Debug)]
pub struct Variant {
    /// Name of its file.
    pub name: String,
    /// Its file: it has `pub use crate::base::*;` and defines what it does otherwise.
    pub text: String,
}

/// The variants of a stage, by name.
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

/// The reference's sources of a stage.
pub fn reference_sources(workspace: &Workspace, stage: &str) -> Result<Sources, GraderError> {
    sources_below(&workspace.root().join("stages").join(stage).join("src"))
}

fn folder(workspace: &Workspace) -> PathBuf {
    workspace.root().join("grader/mutants")
}

/// All `.rs` files below a folder.
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
    fn a_handout_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let stages = folder.path().join("stages");
        std::fs::create_dir(&stages).unwrap();
        let text = include_str!("../../../../stages/course.toml");
        std::fs::write(stages.join("course.toml"), text).unwrap();
        let workspace = Workspace::above(folder.path()).unwrap();
        let course = Course::parse(text).unwrap();
        let task = course.select("part1.task1").unwrap()[0];
        let error = Corpus::read(&workspace, task).unwrap_err().to_string();
        assert!(error.contains("is a handout"), "{error}");
    }
}
