//! Checks with their types erased.

use super::{CaseContext, Check};
use crate::tools::Tier;
use crate::tools::findings::{Aspect, Findings};
use crate::tools::moves::{Move, Symmetries};
use crate::tools::shown::ShownCall;
use crate::tools::simple::numbers::Number;
use crate::tools::snapshot::{Content, Fields};
use crate::tools::truth::expected::Expected;
use std::fmt::Debug;
use std::marker::PhantomData;
use wire::work::Xyz;
use wire::{Answer, Work};

/// The [`Check`] of some kind of work. It is called with work and answers of its own kind only;
/// [`AnyCheck::fits`] says whether an answer is.
pub(crate) trait AnyCheck: Debug + Sync {
    /// As [`Check::NEEDS_ALL_STAGES`].
    fn needs_all_stages(&self) -> bool;

    /// As [`Check::LIMIT_MS`].
    fn limit_ms(&self) -> u64;

    /// As [`Check::calls`].
    fn calls(&self, work: &Work) -> usize;

    /// As [`Check::only_call`].
    fn only_call(&self, work: &Work, call: usize) -> Option<Work>;

    /// As [`Check::MAIN`].
    fn main(&self) -> &'static [Aspect];

    /// As [`Check::fits`]. An answer to another kind of work does not fit.
    fn fits(&self, work: &Work, answer: &Answer) -> Result<(), String>;

    /// As [`Check::symmetries`].
    fn symmetries(&self, work: &Work) -> Symmetries;

    /// As [`Check::NOT_MOVED`].
    fn why_not_moved(&self) -> &'static str;

    /// As [`Check::moved`].
    fn moved(&self, work: &Work, by: &Move) -> Work;

    /// As [`Check::moved_back`]. An answer to another kind of work stays.
    fn moved_back(&self, answer: Answer, back: &Move) -> Answer;

    /// As [`Check::expected`].
    fn expected(&self, work: &Work, tier: Tier, enclosed: bool) -> Vec<Expected>;

    /// As [`Check::look_up_truth`].
    fn look_up_truth(&self, work: &Work);

    /// As [`Check::judge`].
    fn judge(
        &self,
        findings: &mut Findings,
        case: &CaseContext<'_>,
        tier: Tier,
        work: &Work,
        answer: &Answer,
    );

    /// As [`Check::judge_rest`].
    fn judge_rest(
        &self,
        findings: &mut Findings,
        case: &CaseContext<'_>,
        tier: Tier,
        work: &Work,
        answer: &Answer,
    );

    /// As [`Check::lines`].
    fn lines(&self, work: &Work, answer: &Answer) -> Option<Content>;

    /// As [`Check::repro`].
    fn repro(&self, tier: Tier, work: &Work, call: usize) -> Option<String>;

    /// As [`Check::repro_shows`].
    fn repro_shows(&self, aspect: Aspect) -> bool;

    /// As [`Check::colours`].
    fn colours(&self, answer: &Answer) -> Option<Vec<Xyz>>;

    /// As [`Check::simple`].
    fn simple(&self, work: &Work) -> Vec<Work>;

    /// The work after `change` of its numbers, as by [`Check::vary`].
    fn varied(&self, work: &Work, change: &mut dyn FnMut(Number, &mut f64)) -> Work;

    /// As [`Check::input`].
    fn input(&self, work: &Work, call: usize) -> Option<String>;

    /// As [`Check::circumstances`].
    fn circumstances(&self, work: &Work, call: usize) -> Option<Vec<&'static str>>;

    /// As [`Check::exact`].
    fn exact(&self, work: &Work, enclosed: bool, calls: &[u32]) -> Option<Vec<Fields>>;

    /// As [`Check::shown`].
    fn shown(
        &self,
        work: &Work,
        tier: Tier,
        enclosed: bool,
        call: usize,
        answer: Option<&Answer>,
    ) -> Option<ShownCall>;

    /// As [`Check::overview`].
    fn overview(&self, work: &Work) -> String;
}

/// The check of the kind of work `K`.
pub(crate) fn check_of_kind<K: Check>() -> &'static dyn AnyCheck {
    &ErasedCheck::<K>(PhantomData)
}

/// The check of the kind of work `K`, without its types.
struct ErasedCheck<K>(PhantomData<fn() -> K>);

impl<K: Check> ErasedCheck<K> {
    fn question(work: &Work) -> &K::Question {
        K::question(work).expect("a check gets work of its own kind")
    }
}

impl<K> Debug for ErasedCheck<K> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(std::any::type_name::<K>())
    }
}

impl<K: Check> AnyCheck for ErasedCheck<K> {
    fn needs_all_stages(&self) -> bool {
        K::NEEDS_ALL_STAGES
    }

    fn limit_ms(&self) -> u64 {
        K::LIMIT_MS
    }

    fn calls(&self, work: &Work) -> usize {
        K::calls(Self::question(work))
    }

    fn only_call(&self, work: &Work, call: usize) -> Option<Work> {
        K::only_call(Self::question(work), call).map(K::work)
    }

    fn main(&self) -> &'static [Aspect] {
        K::MAIN
    }

    fn fits(&self, work: &Work, answer: &Answer) -> Result<(), String> {
        match K::answer(answer) {
            Some(answer) => K::fits(Self::question(work), answer),
            None => Err(format!(
                "it is an answer to another kind of work, {}",
                answer.kind()
            )),
        }
    }

    fn symmetries(&self, work: &Work) -> Symmetries {
        K::symmetries(Self::question(work))
    }

    fn why_not_moved(&self) -> &'static str {
        K::NOT_MOVED
    }

    fn moved(&self, work: &Work, by: &Move) -> Work {
        K::work(K::moved(Self::question(work), by))
    }

    fn moved_back(&self, answer: Answer, back: &Move) -> Answer {
        match K::answer(&answer) {
            Some(typed) => K::answered(K::moved_back(typed, back)),
            None => answer,
        }
    }

    fn expected(&self, work: &Work, tier: Tier, enclosed: bool) -> Vec<Expected> {
        K::expected(Self::question(work), tier, enclosed)
    }

    fn look_up_truth(&self, work: &Work) {
        K::look_up_truth(Self::question(work));
    }

    fn judge(
        &self,
        findings: &mut Findings,
        case: &CaseContext<'_>,
        tier: Tier,
        work: &Work,
        answer: &Answer,
    ) {
        debug_assert_eq!(self.fits(work, answer), Ok(()), "{}", case.name);
        if let Some(answer) = K::answer(answer) {
            K::judge(findings, case, tier, Self::question(work), answer);
        }
    }

    fn judge_rest(
        &self,
        findings: &mut Findings,
        case: &CaseContext<'_>,
        tier: Tier,
        work: &Work,
        answer: &Answer,
    ) {
        if let Some(answer) = K::answer(answer) {
            K::judge_rest(findings, case, tier, Self::question(work), answer);
        }
    }

    fn lines(&self, work: &Work, answer: &Answer) -> Option<Content> {
        K::lines(Self::question(work), K::answer(answer)?)
    }

    fn repro(&self, tier: Tier, work: &Work, call: usize) -> Option<String> {
        K::repro(tier, Self::question(work), call)
    }

    fn repro_shows(&self, aspect: Aspect) -> bool {
        K::repro_shows(aspect)
    }

    fn colours(&self, answer: &Answer) -> Option<Vec<Xyz>> {
        K::colours(K::answer(answer)?)
    }

    fn simple(&self, work: &Work) -> Vec<Work> {
        let questions = K::simple(Self::question(work)).into_iter();
        questions.map(K::work).collect()
    }

    fn varied(&self, work: &Work, change: &mut dyn FnMut(Number, &mut f64)) -> Work {
        let mut question = Self::question(work).clone();
        K::vary(&mut question, change);
        K::work(question)
    }

    fn input(&self, work: &Work, call: usize) -> Option<String> {
        K::input(Self::question(work), call)
    }

    fn circumstances(&self, work: &Work, call: usize) -> Option<Vec<&'static str>> {
        K::circumstances(Self::question(work), call)
    }

    fn exact(&self, work: &Work, enclosed: bool, calls: &[u32]) -> Option<Vec<Fields>> {
        K::exact(Self::question(work), enclosed, calls)
    }

    fn shown(
        &self,
        work: &Work,
        tier: Tier,
        enclosed: bool,
        call: usize,
        answer: Option<&Answer>,
    ) -> Option<ShownCall> {
        let answer = answer.and_then(K::answer);
        K::shown(Self::question(work), tier, enclosed, call, answer)
    }

    fn overview(&self, work: &Work) -> String {
        K::overview(Self::question(work))
    }
}
