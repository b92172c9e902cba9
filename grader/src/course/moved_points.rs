//! Which points stand on questions that a seed changes: answers that were learned by heart earn
//! none of them in an instructor's run.

use super::{Course, Task};
use judge::Tier;
use judge::cases::{self, KNOWN_SEED, Spec};
use std::fmt;

/// Any other seed than the known one: whether a question is moved does not depend on which.
const ANOTHER_SEED: u64 = KNOWN_SEED + 1;

/// What another seed changes in the course.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MovedPoints {
    /// For each task its key, its core points, and those of them in cases whose questions a seed
    /// changes.
    pub tasks: Vec<(String, f64, f64)>,
    /// The cases that no seed changes, each with the reason.
    pub not_moved: Vec<String>,
}

impl MovedPoints {
    /// Those of a course.
    pub fn of(course: &Course) -> MovedPoints {
        let [known, other] = [KNOWN_SEED, ANOTHER_SEED].map(cases::all);
        let mut points = MovedPoints::default();
        for task in course.tasks() {
            let mut core = [0.0, 0.0];
            for entry in &task.cases {
                let why = why_not_moved(task, &entry.name, &known, &other);
                if entry.tier == Tier::Core {
                    core[0] += entry.points;
                    core[1] += if why.is_none() { entry.points } else { 0.0 };
                }
                if let Some(why) = why {
                    let line = format!("{}/{} ({}): {why}", task.key, entry.name, entry.points);
                    points.not_moved.push(line);
                }
            }
            points.tasks.push((task.key.clone(), core[0], core[1]));
        }
        points
    }

    /// All core points, and those of them that a seed changes.
    fn total(&self) -> [f64; 2] {
        let tasks = self.tasks.iter();
        tasks.fold([0.0; 2], |[all, moved], (_, of_task, of_moved)| {
            [all + of_task, moved + of_moved]
        })
    }

    /// One sentence.
    pub fn summary(&self) -> String {
        let [all, moved] = self.total();
        let cases = self.not_moved.len();
        format!(
            "{moved} of {all} core points stand on questions that a seed changes; golden/not_moved.txt lists the {cases} other cases"
        )
    }
}

/// Why no seed changes a case; `None` if one does.
fn why_not_moved(task: &Task, case: &str, known: &[Spec], other: &[Spec]) -> Option<&'static str> {
    let find = |specs: &[Spec]| {
        let spec = specs.iter().find(|spec| spec.is(&task.key, case));
        spec.map(|spec| {
            (
                spec.is_moved(),
                format!("{:?}", spec.work),
                spec.why_not_moved(),
            )
        })
    };
    let (_, before, _) = find(known)?;
    let (is_moved, after, why) = find(other)?;
    (!is_moved && before == after).then_some(why)
}

impl fmt::Display for MovedPoints {
    /// The text of `golden/not_moved.txt`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "Core points of each task, and those in cases whose questions a seed changes:\n"
        )?;
        for (task, all, moved) in &self.tasks {
            writeln!(f, "{task}: {all}, {moved}")?;
        }
        let [all, moved] = self.total();
        writeln!(
            f,
            "all: {all}, {moved}\n\nCases that no seed changes, with their points:\n"
        )?;
        self.not_moved
            .iter()
            .try_for_each(|line| writeln!(f, "{line}"))
    }
}
