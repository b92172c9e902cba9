//! Pairs of submissions whose wrong answers are the same, beyond what chance explains. This is a
//! question for the instructor, never a verdict: two students may have learned from one source.
//!
//! Right answers say nothing: there is one truth. Of each task the wrong answers are compared as a
//! whole, call by call and with the kind of each fault, so two submissions agree in a task only if
//! they make the same mistakes there.
//!
//! How likely such an agreement is by chance is estimated from the class. If `c` of the `n - 2`
//! other students have the same wrong answers in a task, another student has them with probability
//! `(c + 1/2) / (n - 1)` (Krichevsky and Trofimov 1981: half a count for what was not seen). So a
//! typical mistake, which many make, is hardly evidence. Tasks count as independent: the
//! probability `p` of all agreements of a pair is the product. A class has `n (n - 1) / 2` pairs; a
//! pair is listed if less than [`EXPECTED`] pairs would be expected to agree so by chance.
//!
//! Equal files are listed, too: those of a stage that was written and that equal those of at most
//! four students, so that a handout or an example of the lecture is not listed. The files of more
//! students are named once, not pair by pair.

use crate::collect::{Class, Row};
use std::collections::BTreeMap;
use submission::Untrusted;

/// A pair is listed if fewer than this many pairs of the class are expected to agree so by chance:
/// at most one needless question in five classes. Two tasks with mistakes that nobody else makes
/// are just enough (0.125 in a large class), one is not.
pub const EXPECTED: f64 = 0.2;

/// Files that more students share come from the course, not from each other.
const SHARED_FILES: usize = 4;

/// Fewer wrong answers than this in a task are not compared: too many mistakes look like that.
const FEWEST_WRONG: usize = 3;

/// Two submissions with the same wrong answers or the same files.
#[derive(Clone, Debug, PartialEq)]
pub struct Pair {
    /// Whose they are, in the order of the class.
    pub names: [Untrusted; 2],
    /// The tasks with the same wrong answers: the key, the number of wrong answers, how many other
    /// students have them as well.
    pub tasks: Vec<(String, usize, usize)>,
    /// How many pairs of this class would agree so by chance.
    pub expected: f64,
    /// Stages whose source files are the same.
    pub stages: Vec<String>,
}

/// The pairs of a class, the least likely first.
pub fn pairs(class: &Class) -> Vec<Pair> {
    let answers = groups(class, |row| {
        let wrong = row.graded.iter().flat_map(|unit| &unit.wrong_answers);
        let wrong = wrong.filter(|(_, wrong)| wrong.count >= FEWEST_WRONG);
        wrong
            .map(|(task, wrong)| (task.clone(), wrong.hash.clone()))
            .collect()
    });
    let files = groups(class, written_stages);
    let count = |row: &Row, task: &str| {
        let unit = row.graded.as_ref();
        unit.and_then(|unit| unit.wrong_answers.get(task))
            .map_or(0, |wrong| wrong.count)
    };
    let n = class.rows.iter().filter(|row| row.graded.is_some()).count();
    let mut pairs: BTreeMap<[usize; 2], Pair> = BTreeMap::new();
    let new = |[a, b]: [usize; 2]| Pair {
        names: [a, b].map(|i| class.rows[i].who().clone()),
        tasks: Vec::new(),
        expected: (n * (n - 1)) as f64 / 2.0,
        stages: Vec::new(),
    };
    for ((task, _), students) in &answers {
        for both in all_pairs(students) {
            let others = students.len() - 2;
            let pair = pairs.entry(both).or_insert_with(|| new(both));
            pair.expected *= (others as f64 + 0.5) / (n as f64 - 1.0);
            pair.tasks
                .push((task.clone(), count(&class.rows[both[0]], task), others));
        }
    }
    for ((stage, _), students) in files
        .iter()
        .filter(|(_, students)| students.len() <= SHARED_FILES)
    {
        for both in all_pairs(students) {
            pairs
                .entry(both)
                .or_insert_with(|| new(both))
                .stages
                .push(stage.clone());
        }
    }
    let mut pairs: Vec<Pair> = pairs
        .into_values()
        .filter(|pair| pair.expected < EXPECTED || !pair.stages.is_empty())
        .collect();
    pairs.sort_by(|a, b| {
        let files = b.stages.len().cmp(&a.stages.len());
        files
            .then(a.expected.total_cmp(&b.expected))
            .then(a.names.cmp(&b.names))
    });
    pairs
}

/// The students who handed in the same files of a stage.
#[derive(Clone, Debug, PartialEq)]
pub struct SharedFiles {
    /// The stage.
    pub stage: String,
    /// Their names, in the order of the class.
    pub names: Vec<Untrusted>,
}

/// The files that too many students share to be listed by [`pairs`].
pub fn shared_by_many(class: &Class) -> Vec<SharedFiles> {
    let groups = groups(class, written_stages).into_iter();
    let many = groups.filter(|(_, students)| students.len() > SHARED_FILES);
    many.map(|((stage, _), students)| SharedFiles {
        stage,
        names: students
            .iter()
            .map(|&i| class.rows[i].who().clone())
            .collect(),
    })
    .collect()
}

/// The students, by their numbers, who share something: by what it is and its hash. Of those who
/// hand in together the first one.
fn groups(
    class: &Class,
    of: impl Fn(&Row) -> Vec<(String, String)>,
) -> BTreeMap<(String, String), Vec<usize>> {
    let mut groups: BTreeMap<(String, String), Vec<usize>> = BTreeMap::new();
    for (i, row) in class.rows.iter().enumerate() {
        for shared in of(row) {
            let group = groups.entry(shared).or_default();
            // Of a team several may have handed in.
            let is_team_mate = |other: &usize| class.rows[*other].owner == row.owner;
            if row.owner.is_none() || !group.iter().any(is_team_mate) {
                group.push(i);
            }
        }
    }
    groups.retain(|_, students| students.len() > 1);
    groups
}

fn all_pairs(students: &[usize]) -> impl Iterator<Item = [usize; 2]> {
    let later = |i| students.iter().skip(i + 1);
    let each = students.iter().enumerate();
    each.flat_map(move |(i, a)| later(i).map(move |b| [*a, *b]))
}

/// The stages that a student has begun, with the hashes of their files.
fn written_stages(row: &Row) -> Vec<(String, String)> {
    let Some(unit) = &row.graded else {
        return Vec::new();
    };
    let is_written = |stage: &str| {
        let mut tasks = unit.tasks.iter().filter(|task| task.stage == stage);
        tasks.any(|task| task.status != "not_attempted")
    };
    let written = unit.sources.iter().filter(|(stage, _)| is_written(stage));
    written
        .map(|(stage, hash)| (stage.clone(), hash.clone()))
        .collect()
}
