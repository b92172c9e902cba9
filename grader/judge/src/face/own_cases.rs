//! Cases that a teacher adds to tasks as data: a question of a kind of work that the task has.
//!
//! `grader course build` writes them to `own_cases.toml` in a term's copy of First Light, from
//! where they are compiled in. The check of their kind judges them as it judges all others.

use crate::tasks;
use crate::tools::Tier;
use crate::tools::spec::{KNOWN_SEED, Spec, checked};
use crate::tools::truth::expected::HitOrMiss;
use serde::{Deserialize, Serialize};
use std::mem::discriminant;
use std::panic::{self, AssertUnwindSafe};
use std::sync::LazyLock;
use wire::Work;

/// The file of the cases, below the workspace's root folder.
pub const FILE: &str = "grader/judge/src/face/own_cases.toml";

/// What [`FILE`] had when the grader was compiled.
pub const COMPILED: &str = include_str!("own_cases.toml");

/// The most calls of one case.
const MAX_CALLS: usize = 100_000;

/// A case of a teacher.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OwnCase {
    /// Key of the task.
    pub task: String,
    /// Name, as in `course.toml`.
    pub name: String,
    /// What is checked, in a sentence for students.
    pub about: String,
    /// The question.
    pub work: Work,
}

/// All cases, as [`FILE`] has them.
#[derive(Default, Serialize, Deserialize)]
struct OwnCases {
    #[serde(default)]
    case: Vec<OwnCase>,
}

/// The text of [`FILE`] with these cases. The error says what TOML cannot hold.
pub fn text(cases: Vec<OwnCase>) -> Result<String, String> {
    let head = COMPILED.lines().take_while(|line| line.starts_with('#'));
    let mut text: String = head.map(|line| format!("{line}\n")).collect();
    if !cases.is_empty() {
        let cases = toml::to_string(&OwnCases { case: cases });
        text += "\n";
        text += &cases.map_err(|e| e.to_string())?;
    }
    Ok(text)
}

/// The cases of the tasks whose keys `is_wanted`. Their questions are moved as `seed` draws.
pub(super) fn cases(seed: u64, is_wanted: impl Fn(&str) -> bool) -> Vec<Spec> {
    static CASES: LazyLock<OwnCases> = LazyLock::new(|| {
        let mut cases: OwnCases =
            toml::from_str(COMPILED).expect("`grader course build` writes what it can read");
        for case in &mut cases.case {
            case.about = marked(&case.about);
        }
        cases
    });
    let wanted = CASES.case.iter().filter(|case| is_wanted(&case.task));
    wanted.map(|case| spec(case).moved_for(seed)).collect()
}

/// What a case checks, told apart from what First Light's cases check.
fn marked(about: &str) -> String {
    format!("{} (a case of this course).", about.trim_end_matches('.'))
}

fn spec(case: &'static OwnCase) -> Spec {
    Spec {
        is_own: true,
        ..Spec::of_work(
            &case.task,
            &case.name,
            &case.about,
            case.work.clone(),
            tasks::check_of(&case.work),
        )
    }
}

/// Says why a case of a teacher cannot be asked; `None` if it can. Whether the reference's answers
/// are right is not tested.
pub fn problem(case: &OwnCase) -> Option<String> {
    let OwnCase {
        task, about, work, ..
    } = case;
    let given = tasks::cases(KNOWN_SEED, |key| key == task);
    if given.is_empty() {
        return Some(format!("First Light has no task `{task}` with cases"));
    }
    if given.iter().any(|given| given.name == case.name) {
        return Some(format!("First Light has a case of this name in {task}"));
    }
    let about_length = checked(about).chars().count();
    if !(10..=400).contains(&about_length) || about.contains('\n') {
        return Some(
            "`about` has to say in one line of 10 to 400 characters what the case checks".into(),
        );
    }
    let is_asked = |given: &Spec| discriminant(&given.work) == discriminant(work);
    if !given.iter().any(is_asked) {
        let mut kinds: Vec<&str> = given.iter().map(|given| given.work.kind()).collect();
        kinds.sort_unstable();
        kinds.dedup();
        return Some(format!(
            "{task} is not asked work of the kind {}: expected {}",
            work.kind(),
            kinds.join(" or ")
        ));
    }
    let is_timed = matches!(
        work,
        Work::BuildGrowth(_) | Work::Timing(_) | Work::TimeTest(_)
    );
    if is_timed {
        return Some(format!(
            "{} measures times, and the bounds of times are First Light's own",
            work.kind()
        ));
    }
    trial(work)
}

/// Asks the judge for what it needs of every question.
fn trial(work: &Work) -> Option<String> {
    let check = tasks::check_of(work);
    let before = panic::take_hook();
    panic::set_hook(Box::new(|_| ()));
    let tried = panic::catch_unwind(AssertUnwindSafe(|| {
        let calls = check.calls(work);
        let last = calls.saturating_sub(1);
        let expected = check.expected(work, Tier::Core, false);
        let _ = check.input(work, last);
        let _ = check.overview(work);
        let _ = check.circumstances(work, last);
        let _ = check.shown(work, Tier::Core, false, last, None);
        check.look_up_truth(work);
        (calls, expected)
    }));
    panic::set_hook(before);
    let Ok((calls, expected)) = tried else {
        return Some(
            "its numbers do not fit together: an index is too large, or a number is out of its range".into(),
        );
    };
    if !(1..=MAX_CALLS).contains(&calls) {
        return Some(format!("it makes {calls} calls: expected 1 to {MAX_CALLS}"));
    }
    let decides = |decision| decision != HitOrMiss::Either;
    let is_open = !expected.is_empty() && !expected.iter().any(|e| decides(e.decision()));
    is_open.then(|| {
        "textbook code may answer each of its calls either way, so it would judge nothing".into()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases;
    use std::collections::BTreeMap;
    use wire::work::{Probe, Ray, TriangleWork};

    fn door() -> OwnCase {
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1e-3, 0.0]];
        let normal = [0.0, 0.0, 1.0];
        let [p0, p1, p2] = corners;
        let ray = Ray {
            o: [0.25, 0.25e-3, -2.0],
            d: [0.0, 0.0, 1.0],
            min_t: 0.0,
            max_t: f64::INFINITY,
        };
        OwnCase {
            task: "part1.task3".into(),
            name: "thin_door".into(),
            about: "Rays meet a thin door.".into(),
            work: Work::Triangles(TriangleWork {
                triangles: vec![[p0, p1, p2, normal, normal, normal]],
                probes: vec![Probe { shape: 0, ray }],
            }),
        }
    }

    #[test]
    fn a_case_is_read_as_it_was_written() {
        let text = text(vec![door()]).expect("TOML can hold it");
        let read: OwnCases = toml::from_str(&text).expect("it is TOML");
        assert_eq!(read.case, [door()]);
        assert_eq!(problem(&door()), None);
    }

    #[test]
    fn questions_of_every_kind_can_be_written() {
        let mut kinds = BTreeMap::new();
        for spec in cases::all(0) {
            let is_written = kinds.entry(spec.work.kind()).or_insert(false);
            // TOML has no list with holes, such as the missing hits of a scripted world.
            let question = spec.only_call(0).unwrap_or(spec);
            let case = OwnCase {
                task: question.task.into(),
                name: "own".into(),
                about: question.about.into(),
                work: question.work,
            };
            if *is_written {
                continue;
            }
            let Ok(text) = text(vec![case.clone()]) else {
                continue;
            };
            let read: OwnCases = toml::from_str(&text).expect("it is TOML");
            // As text, in which NaN equals itself.
            assert_eq!(format!("{:?}", read.case[0]), format!("{case:?}"));
            *is_written = true;
        }
        let not_written: Vec<_> = kinds
            .iter()
            .filter(|(_, is_written)| !**is_written)
            .collect();
        assert!(
            kinds.len() > 15 && not_written.is_empty(),
            "{not_written:?}"
        );
    }

    #[test]
    fn what_cannot_be_asked_is_refused() {
        let refused = |change: &dyn Fn(&mut OwnCase, &mut TriangleWork), words: &str| {
            let mut case = door();
            let Work::Triangles(mut work) = case.work.clone() else {
                unreachable!("it is about triangles")
            };
            change(&mut case, &mut work);
            if matches!(case.work, Work::Triangles(_)) {
                case.work = Work::Triangles(work);
            }
            let problem = problem(&case).unwrap_or_default();
            assert!(problem.contains(words), "{problem}");
        };
        refused(&|case, _| case.name = "range".into(), "a case of this name");
        refused(&|case, _| case.about = "Door.".into(), "10 to 400");
        refused(
            &|case, _| case.work = Work::Stop(Vec::new()),
            "the kind Stop: expected BruteForce or Triangles",
        );
        refused(&|_, work| work.probes[0].shape = 1, "an index is too large");
        refused(&|_, work| work.probes.clear(), "0 calls");
        // Along an edge, within the error of the textbook's formula.
        refused(&|_, work| work.probes[0].ray.o[0] = 1e-20, "either way");
    }
}
