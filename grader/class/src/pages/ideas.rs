//! Which idea of its task a mistake is about.

use serde::Deserialize;
use std::sync::LazyLock;

/// An idea that mistakes are about.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Idea {
    /// Its name, such as "the range of a ray".
    pub(super) name: String,
    /// The section of a task's chapter that teaches it.
    pub(super) section: String,
    /// The parts whose tasks have it; all if there are none.
    #[serde(default)]
    parts: Vec<u32>,
    /// The words by which its mistakes are known.
    words: Vec<String>,
}

#[derive(Deserialize)]
struct Ideas {
    idea: Vec<Idea>,
}

/// All ideas, in the order in which they are tried.
static IDEAS: LazyLock<Vec<Idea>> = LazyLock::new(|| {
    let ideas: Ideas = toml::from_str(include_str!("ideas.toml")).expect("a list of ideas");
    ideas.idea
});

/// The idea of mistakes that belong to no other.
static FORMULAS: LazyLock<Idea> = LazyLock::new(|| Idea {
    name: "the formulas of the task".into(),
    section: "The derivation".into(),
    parts: Vec::new(),
    words: Vec::new(),
});

/// The idea of mistakes that nobody has named.
static UNNAMED: LazyLock<Idea> = LazyLock::new(|| Idea {
    name: "mistakes without a name".into(),
    section: "A worked example".into(),
    parts: Vec::new(),
    words: Vec::new(),
});

/// The idea of the mistake of `task` with this name, whose code does what `about` says.
pub(super) fn of(task: &str, name: &str, about: &str) -> &'static Idea {
    let text = format!(" {} {name} {about} ", name.replace('_', " ")).to_lowercase();
    let part = task
        .strip_prefix("part")
        .and_then(|rest| rest.split('.').next()?.parse().ok());
    let fits = |idea: &&Idea| {
        let is_of_part =
            idea.parts.is_empty() || part.is_some_and(|part| idea.parts.contains(&part));
        is_of_part && idea.words.iter().any(|word| text.contains(word.as_str()))
    };
    IDEAS.iter().find(fits).unwrap_or(&FORMULAS)
}

/// The idea of wrong answers that are those of no known mistake.
pub(super) fn unnamed() -> &'static Idea {
    &UNNAMED
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    /// The names, tasks and descriptions of all typical mistakes.
    fn mistakes() -> Vec<(String, String, String)> {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../mutants");
        let mut found = Vec::new();
        for entry in std::fs::read_dir(folder).expect("the lists of mistakes") {
            let path = entry.expect("a file").path();
            let task = path
                .file_stem()
                .expect("a name")
                .to_string_lossy()
                .into_owned();
            if !task.starts_with("part") {
                continue;
            }
            let text = std::fs::read_to_string(&path).expect("a list");
            let heads = text
                .lines()
                .filter_map(|line| line.strip_prefix("mistake "));
            found.extend(heads.map(|head| {
                let (name, about) = head.split_once(": ").expect("a description");
                let name = name.split(' ').next().unwrap_or_default();
                (task.clone(), name.to_string(), about.to_string())
            }));
        }
        found
    }

    #[test]
    fn nearly_all_mistakes_belong_to_an_idea_and_every_idea_has_some() {
        let mistakes = mistakes();
        assert!(mistakes.len() > 1000);
        let ideas: Vec<&Idea> = mistakes
            .iter()
            .map(|(task, name, about)| of(task, name, about))
            .collect();
        let others = ideas.iter().filter(|idea| **idea == &*FORMULAS).count();
        assert!(
            others * 100 <= mistakes.len() * 15,
            "{others} of {}",
            mistakes.len()
        );
        for idea in IDEAS.iter() {
            assert!(ideas.contains(&idea), "{}", idea.name);
        }
    }

    #[test]
    fn mistakes_that_students_make_belong_where_a_teacher_looks() {
        for (task, name, about, idea) in [
            (
                "part1.task3",
                "min_t_ignored",
                "uses 0 instead of min_t",
                "the range of a ray",
            ),
            (
                "part1.task4",
                "normal_not_normalised",
                "does not normalise",
                "normals",
            ),
            (
                "part1.task2",
                "degrees",
                "does not convert degrees",
                "units and lengths",
            ),
            (
                "part1.task3",
                "back_face_culled",
                "culls back faces",
                "which side, which sign",
            ),
            (
                "part3.task2",
                "density_of_cosine",
                "divides by the density of cosine sampling",
                "densities and weights",
            ),
            (
                "part2.task3",
                "second_child_skipped",
                "skips the second child",
                "order, and what is left to visit",
            ),
            (
                "part1.task1",
                "gamma",
                "applies a gamma curve",
                "the formulas of the task",
            ),
        ] {
            assert_eq!(of(task, name, about).name, idea, "{name}");
        }
    }

    #[test]
    fn sections_are_those_of_every_chapter() {
        let chapter = include_str!("../../../../stages/book/src/part1/task3.md");
        for idea in IDEAS.iter().chain([&*FORMULAS, &*UNNAMED]) {
            let heading = format!("\n## {}\n", idea.section);
            assert!(chapter.contains(&heading), "{}", idea.section);
        }
    }
}
