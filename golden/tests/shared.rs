//! The cases, and the reference's answers to them.

use judge::cases::{self, Spec};
use std::sync::{LazyLock, OnceLock};
use wire::{Answer, Outcome, Record};

/// Where to begin if tests of the goldens fail: the one that shows what changed.
pub(crate) const BEGIN: &str = "This test uses the reference's answers. If \
    `the_goldens_are_what_the_reference_answers` fails, too, begin with what it lists:
  cargo test -p golden the_goldens_are
  cargo grader review     shows every difference, `cargo insta review` line by line
  cargo grader bless TASK accepts what is meant";

/// While it is there, a test that fails also says where to [`BEGIN`].
pub(crate) struct AfterTheGoldens;

impl Drop for AfterTheGoldens {
    fn drop(&mut self) {
        if std::thread::panicking() {
            eprintln!("{BEGIN}");
        }
    }
}

/// All cases; each keeps the exact results that were computed for it.
pub(crate) static SPECS: LazyLock<Vec<Spec>> = LazyLock::new(|| cases::all(0));

static RECORDS: LazyLock<Vec<OnceLock<Record>>> =
    LazyLock::new(|| SPECS.iter().map(|_| OnceLock::new()).collect());

/// The case `name` of `task` in [`SPECS`].
pub(crate) fn spec(task: &str, name: &str) -> &'static Spec {
    let found = SPECS.iter().find(|spec| spec.is(task, name));
    found.expect("the case exists")
}

/// What the worker records of a case of [`SPECS`], which is asked once for all tests.
pub(crate) fn record(spec: &Spec) -> &'static Record {
    let place = SPECS
        .iter()
        .position(|s| s.is(spec.task, spec.name))
        .expect("the case is one of the list");
    RECORDS[place].get_or_init(|| worker::run(0, &SPECS[place].case()))
}

/// The reference's answer to a case of [`SPECS`]; `None` in a handout.
pub(crate) fn reference(spec: &Spec) -> Option<&'static Answer> {
    let record = record(spec);
    match &record.outcome {
        Outcome::Answered(answer) if record.untouched.is_empty() => Some(answer),
        _ => None,
    }
}

/// The reference's answer to a question that may be moved, asked now and moved back; `None` in a
/// handout.
pub(crate) fn moved_back(spec: &Spec) -> Option<Answer> {
    match worker::run(0, &spec.case()).outcome {
        Outcome::Answered(answer) => Some(spec.moved_back(answer)),
        Outcome::NotAttempted { .. } => None,
        outcome => panic!("{} {}: {outcome:?}", spec.task, spec.name),
    }
}
