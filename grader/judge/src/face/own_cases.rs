//! Cases that a teacher adds to tasks as data: a question of a kind of work that the task has.
//!
//! `grader course build` writes them to `own_cases.tsv` in a term's copy of First Light, from where
//! they are compiled in: a line for each with its task, name, sentence, and the bytes of its work
//! in hexadecimal digits. Code that reads each kind of work as text would be a third of this crate.
//! The check of their kind judges them as it judges all others.

use crate::tasks;
use crate::tools::Tier;
use crate::tools::spec::{KNOWN_SEED, Spec, checked};
use crate::tools::truth::expected::HitOrMiss;
use std::mem::discriminant;
use std::panic::{self, AssertUnwindSafe};
use std::sync::LazyLock;
use wire::Work;
use wire::file::{work_from_bytes, work_to_bytes};

/// The file of the cases, below the workspace's root folder.
pub const FILE: &str = "grader/judge/src/face/own_cases.tsv";

/// What [`FILE`] had when the grader was compiled.
pub const COMPILED: &str = include_str!("own_cases.tsv");

/// The most calls of one case.
const MAX_CALLS: usize = 100_000;

/// A case of a teacher.
#[derive(Clone, Debug, PartialEq)]
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

/// The text of [`FILE`] with these cases.
pub fn text(cases: &[OwnCase]) -> String {
    let head = COMPILED.lines().take_while(|line| line.starts_with('#'));
    let mut text: String = head.map(|line| format!("{line}\n")).collect();
    for case in cases {
        let [task, name, about] = [&case.task, &case.name, &case.about];
        text += &format!("{task}\t{name}\t{about}\t");
        for byte in work_to_bytes(&case.work) {
            text += &format!("{byte:02x}");
        }
        text.push('\n');
    }
    text
}

/// The cases in a text that [`text`] wrote; `None` if it is another.
fn read(text: &str) -> Option<Vec<OwnCase>> {
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    let case = |line: &str| {
        let mut fields = line.split('\t');
        let mut field = || fields.next();
        Some(OwnCase {
            task: field()?.into(),
            name: field()?.into(),
            about: field()?.into(),
            work: work_from_bytes(&bytes(field()?)?).ok()?,
        })
    };
    lines.map(case).collect()
}

/// The bytes that these hexadecimal digits stand for.
fn bytes(digits: &str) -> Option<Vec<u8>> {
    let pairs = digits.as_bytes().chunks(2);
    let byte = |pair| u8::from_str_radix(std::str::from_utf8(pair).ok()?, 16).ok();
    pairs.map(byte).collect()
}

/// The cases of the tasks whose keys `is_wanted`. Their questions are moved as `seed` draws.
pub(super) fn cases(seed: u64, is_wanted: impl Fn(&str) -> bool) -> Vec<Spec> {
    static CASES: LazyLock<Vec<OwnCase>> = LazyLock::new(|| {
        let mut cases = read(COMPILED).expect("`grader course build` writes what it can read");
        for case in &mut cases {
            case.about = marked(&case.about);
        }
        cases
    });
    let wanted = CASES.iter().filter(|case| is_wanted(&case.task));
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
    if !(10..=400).contains(&about_length) || about.contains(['\n', '\t']) {
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
    use std::collections::BTreeSet;
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
                by_record: false,
            }),
        }
    }

    #[test]
    fn cases_of_every_kind_are_read_as_they_were_written() {
        assert_eq!(problem(&door()), None);
        let mut kinds = BTreeSet::new();
        let one_of_each = cases::all(0)
            .into_iter()
            .filter(|spec| kinds.insert(spec.work.kind()));
        let mut written = vec![door()];
        written.extend(one_of_each.map(|spec| OwnCase {
            task: spec.task.into(),
            name: "own".into(),
            about: spec.about.into(),
            work: spec.work,
        }));
        assert!(written.len() > 16);
        let read = read(&text(&written)).expect("it is read");
        // As text, in which NaN equals itself.
        assert_eq!(format!("{read:?}"), format!("{written:?}"));
    }

    #[test]
    fn a_damaged_file_is_not_read() {
        let whole = text(&[door()]);
        for damaged in [
            whole.trim_end().trim_end_matches(|c| c != '\t'),
            &whole[..whole.len() - 3],
            &whole.replace('\t', " "),
        ] {
            assert_eq!(read(damaged), None);
        }
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
