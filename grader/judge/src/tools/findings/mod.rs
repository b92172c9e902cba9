//! The findings about the answers to a case: right and wrong ones, counted aspect by aspect.

mod aspect;
mod class;
mod distribution;
mod finding;
mod message;
mod not_judged;

pub use aspect::Aspect;
pub(crate) use class::SAME;
pub use class::{BLACK_CHANNEL, Class};
pub use distribution::{COUNTS, DirectionCounts};
pub use finding::{Fault, Finding, FunctionCount, RightNumbers, Worst, WrongAnswer, WrongNumbers};
pub use message::Message;
pub(crate) use message::told_apart;
pub use not_judged::NotJudged;

use crate::tools::errors::{ErrorSpread, NumberError};
use std::cmp::Ordering;

/// The number of digits that a reader of the message has to compare.
fn digits(message: &Message) -> usize {
    let text = message.to_string();
    text.bytes().filter(u8::is_ascii_digit).count()
}

/// The findings about a case, one for each aspect.
///
/// ```
/// use judge::findings::{Aspect, Findings};
/// let mut findings = Findings::default();
/// findings.judge(Aspect::T, 0, true, 0.0, String::new);
/// findings.judge(Aspect::T, 1, false, 0.5, || "2.5, expected 2".to_string());
/// let found = &findings.into_vec()[0];
/// assert_eq!(found.to_string(), "t wrong on 1 of 2: 2.5, expected 2");
/// ```
#[derive(Clone, Debug, Default)]
pub struct Findings {
    list: Vec<Finding>,
    /// Every wrong answer with its message, if they are kept.
    wrong_answers: Option<Vec<WrongAnswer>>,
    not_judged: Vec<NotJudged>,
    function: Option<&'static str>,
    counted_for: Option<&'static str>,
    not_written: Vec<String>,
}

impl Findings {
    /// The findings of a case in which some functions have holes: their answers mean nothing.
    pub fn without(not_written: &[String]) -> Findings {
        Findings {
            not_written: not_written.to_vec(),
            ..Findings::default()
        }
    }

    /// The same findings, but they keep the message of every wrong answer, not only of the worst.
    pub(crate) fn with_messages(self) -> Findings {
        Findings {
            wrong_answers: Some(Vec::new()),
            ..self
        }
    }

    /// The wrong answers, in the order in which they were judged, if they are kept.
    pub(crate) fn take_wrong_answers(&mut self) -> Vec<WrongAnswer> {
        self.wrong_answers.take().unwrap_or_default()
    }

    /// Whether the answers of `function` are to be judged: it has no hole. If they are not, its
    /// share of `aspects` is lost.
    pub fn is_written(&mut self, function: &'static str, aspects: &[Aspect]) -> bool {
        let is_written = self.not_written.iter().all(|hole| hole != function);
        if !is_written {
            for &aspect in aspects {
                self.entry(aspect).of_function(function);
            }
        }
        is_written
    }

    /// Sets the function that the next answers count for, in tasks with several functions.
    pub fn count_for(&mut self, function: &'static str) {
        self.counted_for = Some(function);
    }

    /// Sets the function whose answers are judged next, in a case that calls several.
    pub fn answers_of(&mut self, function: &'static str) {
        self.function = Some(function);
    }

    /// Counts a call whose right answer has `aspect`.
    pub fn expect(&mut self, aspect: Aspect) {
        self.entry(aspect).expected += 1;
    }

    /// Judges `aspect` of the answer to call number `call`; `badness` ranks the wrong answers.
    pub fn judge<M: Into<Message>>(
        &mut self,
        aspect: Aspect,
        call: usize,
        right: bool,
        badness: f64,
        message: impl FnOnce() -> M,
    ) {
        let class = (!right).then(|| Class::of_size(badness));
        self.judge_class(aspect, call, class, badness, message);
    }

    /// Judges `aspect` of the answer to call number `call`, with the class of a wrong answer;
    /// `None` if it is right.
    pub fn judge_class<M: Into<Message>>(
        &mut self,
        aspect: Aspect,
        call: usize,
        class: Option<Class>,
        badness: f64,
        message: impl FnOnce() -> M,
    ) {
        let mut message = Some(message);
        self.count(aspect, call, class, badness, &mut || {
            message.take().map(|message| message().into())
        });
    }

    /// [`Findings::judge_class`], compiled once for all messages. `words` returns one once.
    fn count(
        &mut self,
        aspect: Aspect,
        call: usize,
        class: Option<Class>,
        badness: f64,
        words: &mut dyn FnMut() -> Option<Message>,
    ) {
        let call = u32::try_from(call).unwrap_or(u32::MAX);
        let (function, counted_for) = (self.function, self.counted_for);
        let keeps_messages = self.wrong_answers.is_some();
        let finding = self.entry(aspect);
        // Two functions may be judged on the same aspect in one call: it counts once.
        if finding.judged_calls.last() != Some(&call) {
            finding.judged += 1;
            finding.judged_calls.push(call);
        }
        if let Some(function) = counted_for {
            finding.of_function(function).count(call, class.is_some());
        }
        let named = counted_for.or(function);
        let Some(class) = class else {
            if finding.looks_at_right(named)
                && let Some(message) = words()
            {
                finding.add_right_numbers(named, &message.compared);
            }
            return;
        };
        let again = finding.faults.last().is_some_and(|last| last.call == call);
        finding.wrong += u32::from(!again);
        let fault = Fault {
            call,
            function,
            counts_for: counted_for,
            class,
        };
        finding.faults.push(fault);
        // NaN ranks as the worst.
        let badness = if badness.is_nan() {
            f64::INFINITY
        } else {
            badness
        };
        let size = |badness: f64| badness.log2().floor();
        let worst = finding.worst.as_ref();
        let compared = worst.map(|worst| size(badness).total_cmp(&size(worst.badness)));
        let may_be_the_same = finding.may_be_the_same(named);
        if compared == Some(Ordering::Less) && !keeps_messages && !may_be_the_same {
            return;
        }
        let Some(message) = words() else {
            return;
        };
        if may_be_the_same && !message.are_beside {
            finding.add_numbers(named, &message.compared);
        }
        // Of errors of about the same size, the one with the fewest digits to read.
        let is_worst = match (compared, &finding.worst) {
            (Some(Ordering::Equal), Some(worst)) => digits(&message) < digits(&worst.message),
            (compared, _) => compared != Some(Ordering::Less),
        };
        if is_worst {
            finding.worst = Some(Worst {
                call,
                function: named,
                badness,
                message: message.clone(),
            });
        }
        if let Some(all) = &mut self.wrong_answers {
            all.push(WrongAnswer {
                aspect,
                fault,
                message,
            });
        }
    }

    /// Records that `aspect` of the answer to call number `call` is not judged, because of `why`:
    /// no answer, or none within wide limits, would count as wrong.
    pub(crate) fn not_judged(&mut self, aspect: Aspect, call: usize, why: &'static str) {
        let call = Some(u32::try_from(call).unwrap_or(u32::MAX));
        self.not_judged.push(NotJudged { aspect, call, why });
    }

    /// Records that `aspect` is judged in no answer of the case, because of `why`.
    pub(crate) fn never_judged(&mut self, aspect: Aspect, why: &'static str) {
        let call = None;
        self.not_judged.push(NotJudged { aspect, call, why });
    }

    /// What is not judged, in the order in which it was recorded.
    pub(crate) fn take_not_judged(&mut self) -> Vec<NotJudged> {
        std::mem::take(&mut self.not_judged)
    }

    /// Whether no answer so far has a wrong `aspect`.
    pub fn is_right(&mut self, aspect: Aspect) -> bool {
        self.entry(aspect).wrong == 0
    }

    /// Records that `aspect` counts as right because it cannot be judged in this run.
    pub(crate) fn leave_undecided(&mut self, aspect: Aspect, call: usize, why: &'static str) {
        self.judge_class(aspect, call, None, 0.0, String::new);
        self.entry(aspect).undecided = Some(why);
    }

    /// Records that a statistical test of `aspect` always detects a relative deviation of `share`;
    /// of several tests the largest value counts.
    pub fn set_detectable(&mut self, aspect: Aspect, share: f64) {
        let weakest = &mut self.entry(aspect).detectable;
        *weakest = Some(weakest.map_or(share, |other| other.max(share)));
    }

    /// Records the error of a number that belongs to `aspect`, right or wrong.
    pub fn measure(&mut self, aspect: Aspect, error: NumberError) {
        self.entry(aspect).errors.push(error);
    }

    /// The findings, in the order in which their aspects were first judged or expected.
    pub fn into_vec(mut self) -> Vec<Finding> {
        for finding in &mut self.list {
            finding.spread = ErrorSpread::of(&finding.errors);
        }
        self.list
    }

    /// The aspects that failed.
    #[cfg(test)]
    #[allow(dead_code, reason = "some handouts lack its users")]
    pub(crate) fn wrong_aspects(self) -> Vec<Aspect> {
        let failed = self.list.iter().filter(|finding| !finding.passed());
        failed.map(|finding| finding.aspect).collect()
    }

    fn entry(&mut self, aspect: Aspect) -> &mut Finding {
        let at = self
            .list
            .iter()
            .position(|finding| finding.aspect == aspect)
            .unwrap_or_else(|| {
                self.list.push(Finding::new(aspect));
                self.list.len() - 1
            });
        &mut self.list[at]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two functions answer each of four calls; the second is wrong from `wrong_from` on.
    fn judged(wrong_from: usize) -> Finding {
        let mut findings = Findings::default();
        for call in 0..4 {
            findings.count_for("test");
            findings.judge(Aspect::T, call, true, 0.0, String::new);
            findings.count_for("record");
            for _ in 0..2 {
                findings.judge(Aspect::T, call, call < wrong_from, 1.0, String::new);
            }
        }
        findings.into_vec().remove(0)
    }

    #[test]
    fn each_function_is_counted_by_itself_and_each_call_once() {
        let finding = judged(3);
        assert_eq!((finding.judged, finding.wrong), (4, 1));
        let counts: Vec<_> = finding
            .functions
            .iter()
            .map(|f| (f.function, f.judged, f.wrong))
            .collect();
        assert_eq!(counts, [("test", 4, 0), ("record", 4, 1)]);
        assert_eq!(finding.passed_by("test"), Some(true));
        assert_eq!(finding.passed_by("record"), Some(false));
        assert_eq!(finding.passed_by("other"), None);
    }

    #[test]
    fn the_worst_answer_is_large_and_simple() {
        let worst = |answers: &[(f64, &str)]| {
            let mut findings = Findings::default();
            for (call, (badness, message)) in answers.iter().enumerate() {
                findings.judge(Aspect::T, call, false, *badness, || message.to_string());
            }
            let finding = findings.into_vec().remove(0);
            finding.worst.map(|worst| worst.message.to_string())
        };
        let all = [
            (1.0, "1.741 against 1.74"),
            (6.0, "7.31"),
            (7.5, "8.125"),
            (5.0, "7"),
        ];
        assert_eq!(worst(&all).as_deref(), Some("7"));
        assert_eq!(worst(&all[..3]).as_deref(), Some("7.31"));
        assert_eq!(
            worst(&[all[3], (f64::NAN, "NaN at 0.25")]).as_deref(),
            Some("NaN at 0.25")
        );
    }

    #[test]
    fn half_of_the_answers_is_not_most_of_them() {
        assert_eq!(judged(3).mostly_right_by("record"), Some(true));
        assert_eq!(judged(2).mostly_right_by("record"), Some(false));
        assert_eq!(judged(2).mostly_right_by("test"), Some(true));
    }

    #[test]
    fn an_aspect_of_all_answers_together_is_right_or_wrong() {
        let mut findings = Findings::default();
        for call in 0..9 {
            findings.judge(Aspect::Mean, call, call > 0, 1.0, String::new);
        }
        let finding = findings.into_vec().remove(0);
        assert_eq!(finding.mostly_right_by(""), Some(false));
    }

    #[test]
    fn a_function_with_a_hole_has_a_share_of_its_aspects() {
        let mut findings = Findings::without(&["record".to_string()]);
        assert!(findings.is_written("test", &[Aspect::T]));
        assert!(!findings.is_written("record", &[Aspect::T]));
        let list = findings.into_vec();
        assert_eq!(list.len(), 1, "{list:?}");
        assert_eq!(list[0].functions[0].function, "record");
        assert_eq!(list[0].judged, 0);
    }
}
