//! What the grader does with one kind of work: from the question to points, golden and pasted test.

use crate::Tier;
use crate::cases::Spec;
use crate::expected::Expected;
use crate::snapshot::{Fields, Forms};
use crate::tally::{Aspect, Tally};
use wire::Answer;
use wire::work::Xyz;

/// Milliseconds after which a case has failed. Sound code needs a few.
const LIMIT_MS: u64 = 5000;

/// Milliseconds for cases that build trees over large meshes.
pub(crate) const LARGE_LIMIT_MS: u64 = 120_000;

/// What a snapshot says of an answer: totals, and each line in its short and its full form.
pub(crate) type Content = (Fields, Vec<Forms>);

/// A kind of work. Each task has a folder in `tasks` with an implementation for each of its own
/// kinds.
///
/// What the worker wrote is untrusted until [`Check::fits`] has passed it. All other functions are
/// only called with answers that fit, so they may rely on the number of answers and on every index
/// that `fits` tests.
pub(crate) trait Check {
    /// What the worker is asked, as in [`wire::Work`].
    type Question;

    /// What it answers, as in [`wire::Answer`].
    type Answer;

    /// Whether rays go through all stages that hit something, not only through the task's own.
    const NEEDS_ALL_STAGES: bool = false;

    /// Milliseconds after which a case has failed.
    const LIMIT_MS: u64 = LIMIT_MS;

    /// How many calls of the student's functions the question makes.
    fn calls(question: &Self::Question) -> usize;

    /// Whether the answer has the form that the question calls for: as many entries, indices in
    /// their range. The error ends the sentence "the worker's record does not fit the case: ...".
    fn fits(question: &Self::Question, answer: &Self::Answer) -> Result<(), String>;

    /// What scores on each call, for work on triangles and spheres: what the oracle computes once
    /// for all answers. `enclosed` is that of the case.
    fn expected(_question: &Self::Question, _tier: Tier, _enclosed: bool) -> Vec<Expected> {
        Vec::new()
    }

    /// Counts what is right and wrong about an answer to the case `spec`, whose points are of
    /// `tier`.
    fn judge(
        tally: &mut Tally,
        spec: &Spec,
        tier: Tier,
        question: &Self::Question,
        answer: &Self::Answer,
    );

    /// The content of a snapshot of the answer; `None` for what is different every time (times).
    fn lines(question: &Self::Question, answer: &Self::Answer) -> Option<Content>;

    /// The body of a Rust test for one call; `None` if there is none that is short, or more than
    /// one answer scores.
    fn repro(_tier: Tier, _question: &Self::Question, _call: usize) -> Option<String> {
        None
    }

    /// Whether such a test of one call shows what is wrong about the aspect.
    fn repro_shows(_aspect: Aspect) -> bool {
        true
    }

    /// The linear colour of each call in a picture, each channel from 0 to 1; `None` for answers
    /// without colours.
    fn colours(_answer: &Self::Answer) -> Option<Vec<Xyz>> {
        None
    }
}

/// A question of any kind, with its check.
pub(crate) trait ErasedCheck {
    /// As [`Check::NEEDS_ALL_STAGES`].
    fn needs_all_stages(&self) -> bool;

    /// As [`Check::LIMIT_MS`].
    fn limit_ms(&self) -> u64;

    /// As [`Check::calls`].
    #[cfg(test)]
    fn calls(&self) -> usize;

    /// As [`Check::fits`]. An answer to another kind of work does not fit.
    fn fits(&self, answer: &Answer) -> Result<(), String>;

    /// As [`Check::expected`].
    fn expected(&self, tier: Tier, enclosed: bool) -> Vec<Expected>;

    /// As [`Check::judge`].
    fn judge(&self, tally: &mut Tally, spec: &Spec, tier: Tier, answer: &Answer);

    /// As [`Check::lines`].
    fn lines(&self, answer: &Answer) -> Option<Content>;

    /// As [`Check::repro`].
    fn repro(&self, tier: Tier, call: usize) -> Option<String>;

    /// As [`Check::repro_shows`].
    fn repro_shows(&self, aspect: Aspect) -> bool;

    /// As [`Check::colours`].
    fn colours(&self, answer: &Answer) -> Option<Vec<Xyz>>;
}

/// A question of one kind.
pub(crate) struct CheckedQuestion<'a, C: Check> {
    pub(crate) question: &'a C::Question,
    /// The answer inside, if it is one to this kind of work.
    pub(crate) answer_of_kind: fn(&Answer) -> Option<&C::Answer>,
}

impl<C: Check> ErasedCheck for CheckedQuestion<'_, C> {
    fn needs_all_stages(&self) -> bool {
        C::NEEDS_ALL_STAGES
    }

    fn limit_ms(&self) -> u64 {
        C::LIMIT_MS
    }

    #[cfg(test)]
    fn calls(&self) -> usize {
        C::calls(self.question)
    }

    fn fits(&self, answer: &Answer) -> Result<(), String> {
        match (self.answer_of_kind)(answer) {
            Some(answer) => C::fits(self.question, answer),
            None => Err(format!(
                "it answers another kind of work, {}",
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

/// Whether there is one answer for each of so many calls.
pub(crate) fn one_each<T>(calls: usize, answers: &[T]) -> Result<(), String> {
    same_length("answers", answers.len(), calls)
}

/// Whether there are as many of `what` as the case has calls.
pub(crate) fn same_length(what: &str, found: usize, calls: usize) -> Result<(), String> {
    if found == calls {
        Ok(())
    } else {
        Err(format!(
            "expected {calls} {what}, one a call, found {found}"
        ))
    }
}

/// Whether the item `what` of call number `call` is one of `count`.
pub(crate) fn in_range(what: &str, call: usize, index: u32, count: usize) -> Result<(), String> {
    if (index as usize) < count {
        Ok(())
    } else {
        Err(format!(
            "call {call} names {what} {index}, but there are only {count}"
        ))
    }
}
