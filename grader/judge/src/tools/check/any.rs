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

/// Declares [`AnyCheck`] and implements it for [`ErasedCheck`], from one list of functions.
macro_rules! any_check {
    ($($(#[$about:meta])* fn $name:ident($($arg:ident: $kind:ty),*) $(-> $result:ty)? $body:block)*) => {
        /// The [`Check`] of some kind of work. It is called with work and answers of its own kind
        /// only; [`AnyCheck::fits`] says whether an answer is.
        pub(crate) trait AnyCheck: Debug + Sync {
            $($(#[$about])* fn $name(&self, $($arg: $kind),*) $(-> $result)?;)*
        }

        impl<K: Check> AnyCheck for ErasedCheck<K> {
            $(fn $name(&self, $($arg: $kind),*) $(-> $result)? $body)*
        }
    };
}

any_check! {
    /// As [`Check::NEEDS_ALL_STAGES`].
    fn needs_all_stages() -> bool {
        K::NEEDS_ALL_STAGES
    }

    /// As [`Check::LIMIT_MS`].
    fn limit_ms() -> u64 {
        K::LIMIT_MS
    }

    /// As [`Check::calls`].
    fn calls(work: &Work) -> usize {
        K::calls(Self::question(work))
    }

    /// As [`Check::only_call`].
    fn only_call(work: &Work, call: usize) -> Option<Work> {
        K::only_call(Self::question(work), call).map(K::work)
    }

    /// As [`Check::MAIN`].
    fn main() -> &'static [Aspect] {
        K::MAIN
    }

    /// As [`Check::fits`]. An answer to another kind of work does not fit.
    fn fits(work: &Work, answer: &Answer) -> Result<(), String> {
        match K::answer(answer) {
            Some(answer) => K::fits(Self::question(work), answer),
            None => Err(format!(
                "it is an answer to another kind of work, {}",
                answer.kind()
            )),
        }
    }

    /// As [`Check::symmetries`].
    fn symmetries(work: &Work) -> Symmetries {
        K::symmetries(Self::question(work))
    }

    /// As [`Check::NOT_MOVED`].
    fn why_not_moved() -> &'static str {
        K::NOT_MOVED
    }

    /// As [`Check::moved`].
    fn moved(work: &Work, by: &Move) -> Work {
        K::work(K::moved(Self::question(work), by))
    }

    /// As [`Check::moved_back`]. An answer to another kind of work stays.
    fn moved_back(answer: Answer, back: &Move) -> Answer {
        match K::answer(&answer) {
            Some(typed) => K::answered(K::moved_back(typed, back)),
            None => answer,
        }
    }

    /// As [`Check::expected`].
    fn expected(work: &Work, tier: Tier, enclosed: bool) -> Vec<Expected> {
        K::expected(Self::question(work), tier, enclosed)
    }

    /// As [`Check::look_up_truth`].
    fn look_up_truth(work: &Work) {
        K::look_up_truth(Self::question(work));
    }

    /// As [`Check::judge`].
    fn judge(
        findings: &mut Findings,
        case: &CaseContext<'_>,
        tier: Tier,
        work: &Work,
        answer: &Answer
    ) {
        debug_assert_eq!(check_of_kind::<K>().fits(work, answer), Ok(()), "{}", case.name);
        if let Some(answer) = K::answer(answer) {
            K::judge(findings, case, tier, Self::question(work), answer);
        }
    }

    /// As [`Check::judge_rest`].
    fn judge_rest(
        findings: &mut Findings,
        case: &CaseContext<'_>,
        tier: Tier,
        work: &Work,
        answer: &Answer
    ) {
        if let Some(answer) = K::answer(answer) {
            K::judge_rest(findings, case, tier, Self::question(work), answer);
        }
    }

    /// As [`Check::lines`].
    fn lines(work: &Work, answer: &Answer) -> Option<Content> {
        K::lines(Self::question(work), K::answer(answer)?)
    }

    /// As [`Check::repro`].
    fn repro(tier: Tier, work: &Work, call: usize) -> Option<String> {
        K::repro(tier, Self::question(work), call)
    }

    /// As [`Check::repro_shows`].
    fn repro_shows(aspect: Aspect) -> bool {
        K::repro_shows(aspect)
    }

    /// As [`Check::colours`].
    fn colours(answer: &Answer) -> Option<Vec<Xyz>> {
        K::colours(K::answer(answer)?)
    }

    /// As [`Check::simple`].
    fn simple(work: &Work) -> Vec<Work> {
        let questions = K::simple(Self::question(work)).into_iter();
        questions.map(K::work).collect()
    }

    /// The work after `change` of its numbers, as by [`Check::vary`].
    fn varied(work: &Work, change: &mut dyn FnMut(Number, &mut f64)) -> Work {
        let mut question = Self::question(work).clone();
        K::vary(&mut question, change);
        K::work(question)
    }

    /// As [`Check::input`].
    fn input(work: &Work, call: usize) -> Option<String> {
        K::input(Self::question(work), call)
    }

    /// As [`Check::circumstances`].
    fn circumstances(work: &Work, call: usize) -> Option<Vec<&'static str>> {
        K::circumstances(Self::question(work), call)
    }

    /// As [`Check::exact`].
    fn exact(work: &Work, enclosed: bool, calls: &[u32]) -> Option<Vec<Fields>> {
        K::exact(Self::question(work), enclosed, calls)
    }

    /// As [`Check::shown`].
    fn shown(
        work: &Work,
        tier: Tier,
        enclosed: bool,
        call: usize,
        answer: Option<&Answer>
    ) -> Option<ShownCall> {
        let answer = answer.and_then(K::answer);
        K::shown(Self::question(work), tier, enclosed, call, answer)
    }

    /// As [`Check::overview`].
    fn overview(work: &Work) -> String {
        K::overview(Self::question(work))
    }
}
