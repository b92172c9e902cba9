//! The grader's operations on one kind of work: validate, judge, write a golden and a Rust test.

use crate::Tier;
use crate::cases::Spec;
use crate::expected::Expected;
use crate::snapshot::{Fields, Forms};
use crate::tally::{Aspect, Tally};
use wire::Answer;
use wire::work::Xyz;

/// Default time limit of a case, in milliseconds. Correct code needs a few milliseconds.
const LIMIT_MS: u64 = 5000;

/// Time limit of cases that build trees over large meshes, in milliseconds.
pub(crate) const LARGE_LIMIT_MS: u64 = 120_000;

/// The content of a snapshot: the totals, and each line in its short and its full form.
pub(crate) type Content = (Fields, Vec<Forms>);

/// The operations on one kind of work. The folder of a task in `tasks` implements it for each kind
/// of work of that task.
///
/// A worker's answer is untrusted until [`Check::fits`] accepts it. All other functions are only
/// called with answers that fit, so they may rely on the number of answers and on every index that
/// `fits` tests.
pub(crate) trait Check {
    /// The input of the work, as in [`wire::Work`].
    type Question;

    /// The result of the work, as in [`wire::Answer`].
    type Answer;

    /// Whether the work traces rays through all intersection stages, not only the task's own stage.
    const NEEDS_ALL_STAGES: bool = false;

    /// Milliseconds after which a case has failed.
    const LIMIT_MS: u64 = LIMIT_MS;

    /// The number of calls of the student's functions that the question makes.
    fn calls(question: &Self::Question) -> usize;

    /// Checks that the answer has the form that the question requires: the number of entries, the
    /// ranges of indices. The error ends the sentence "the worker's record does not fit the case:
    /// ...".
    fn fits(question: &Self::Question, answer: &Self::Answer) -> Result<(), String>;

    /// The results that score for each call, for work on triangles and spheres; the oracle computes
    /// them once for all answers. `enclosed` is [`Spec::enclosed`].
    fn expected(_question: &Self::Question, _tier: Tier, _enclosed: bool) -> Vec<Expected> {
        Vec::new()
    }

    /// Judges an answer to the case `spec`, whose points are of `tier`, and counts the results in
    /// `tally`.
    fn judge(
        tally: &mut Tally,
        spec: &Spec,
        tier: Tier,
        question: &Self::Question,
        answer: &Self::Answer,
    );

    /// Judges the aspects that [`Check::judge`] leaves out, because no case grades them, and
    /// records what remains not judged. With it, an answer is judged whole (see [`crate::whole`]).
    fn judge_rest(
        _tally: &mut Tally,
        _spec: &Spec,
        _tier: Tier,
        _question: &Self::Question,
        _answer: &Self::Answer,
    ) {
    }

    /// The content of a snapshot of the answer; `None` for answers that differ on every run
    /// (times).
    fn lines(question: &Self::Question, answer: &Self::Answer) -> Option<Content>;

    /// The body of a Rust test for one call; `None` if the test would be long, or if more than one
    /// answer scores.
    fn repro(_tier: Tier, _question: &Self::Question, _call: usize) -> Option<String> {
        None
    }

    /// Whether a test of one call can fail because of a wrong `aspect`.
    fn repro_shows(_aspect: Aspect) -> bool {
        true
    }

    /// The linear colour of each call in a picture, each channel from 0 to 1; `None` for answers
    /// without colours.
    fn colours(_answer: &Self::Answer) -> Option<Vec<Xyz>> {
        None
    }
}

/// A [`Check`] and its question with their types erased: work of any kind.
pub(crate) trait ErasedCheck {
    /// As [`Check::NEEDS_ALL_STAGES`].
    fn needs_all_stages(&self) -> bool;

    /// As [`Check::LIMIT_MS`].
    fn limit_ms(&self) -> u64;

    /// As [`Check::calls`].
    fn calls(&self) -> usize;

    /// As [`Check::fits`]. An answer to another kind of work does not fit.
    fn fits(&self, answer: &Answer) -> Result<(), String>;

    /// As [`Check::expected`].
    fn expected(&self, tier: Tier, enclosed: bool) -> Vec<Expected>;

    /// As [`Check::judge`].
    fn judge(&self, tally: &mut Tally, spec: &Spec, tier: Tier, answer: &Answer);

    /// As [`Check::judge_rest`].
    fn judge_rest(&self, tally: &mut Tally, spec: &Spec, tier: Tier, answer: &Answer);

    /// As [`Check::lines`].
    fn lines(&self, answer: &Answer) -> Option<Content>;

    /// As [`Check::repro`].
    fn repro(&self, tier: Tier, call: usize) -> Option<String>;

    /// As [`Check::repro_shows`].
    fn repro_shows(&self, aspect: Aspect) -> bool;

    /// As [`Check::colours`].
    fn colours(&self, answer: &Answer) -> Option<Vec<Xyz>>;
}

/// A question of one kind of work, with its check `C`.
pub(crate) struct CheckedQuestion<'a, C: Check> {
    pub(crate) question: &'a C::Question,
    /// The typed answer inside an [`Answer`] of this kind of work; `None` for another kind.
    pub(crate) answer_of_kind: fn(&Answer) -> Option<&C::Answer>,
}

impl<C: Check> ErasedCheck for CheckedQuestion<'_, C> {
    fn needs_all_stages(&self) -> bool {
        C::NEEDS_ALL_STAGES
    }

    fn limit_ms(&self) -> u64 {
        C::LIMIT_MS
    }

    fn calls(&self) -> usize {
        C::calls(self.question)
    }

    fn fits(&self, answer: &Answer) -> Result<(), String> {
        match (self.answer_of_kind)(answer) {
            Some(answer) => C::fits(self.question, answer),
            None => Err(format!(
                "it is an answer to another kind of work, {}",
                answer.kind()
            )),
        }
    }

    fn expected(&self, tier: Tier, enclosed: bool) -> Vec<Expected> {
        C::expected(self.question, tier, enclosed)
    }

    fn judge(&self, tally: &mut Tally, spec: &Spec, tier: Tier, answer: &Answer) {
        debug_assert_eq!(self.fits(answer), Ok(()), "{} {}", spec.task, spec.name);
        if let Some(answer) = (self.answer_of_kind)(answer) {
            C::judge(tally, spec, tier, self.question, answer);
        }
    }

    fn judge_rest(&self, tally: &mut Tally, spec: &Spec, tier: Tier, answer: &Answer) {
        if let Some(answer) = (self.answer_of_kind)(answer) {
            C::judge_rest(tally, spec, tier, self.question, answer);
        }
    }

    fn lines(&self, answer: &Answer) -> Option<Content> {
        C::lines(self.question, (self.answer_of_kind)(answer)?)
    }

    fn repro(&self, tier: Tier, call: usize) -> Option<String> {
        C::repro(tier, self.question, call)
    }

    fn repro_shows(&self, aspect: Aspect) -> bool {
        C::repro_shows(aspect)
    }

    fn colours(&self, answer: &Answer) -> Option<Vec<Xyz>> {
        C::colours((self.answer_of_kind)(answer)?)
    }
}

/// Checks that there is one answer for each call.
pub(crate) fn one_each<T>(calls: usize, answers: &[T]) -> Result<(), String> {
    same_length("answers", answers.len(), calls)
}

/// Checks that there are as many of `what` as the case has calls.
pub(crate) fn same_length(what: &str, found: usize, calls: usize) -> Result<(), String> {
    if found == calls {
        Ok(())
    } else {
        Err(format!(
            "expected {calls} {what}, one per call, found {found}"
        ))
    }
}

/// Checks that `index`, which call number `call` has for a `what`, is below `count`.
pub(crate) fn in_range(what: &str, call: usize, index: u32, count: usize) -> Result<(), String> {
    if (index as usize) < count {
        Ok(())
    } else {
        Err(format!(
            "call {call} has the {what} index {index}, expected one below {count}"
        ))
    }
}
