//! The grader's operations on one kind of work: validate, judge, write a golden and a Rust test.
//!
//! [`Check`] is the seam: all that depends on a kind of work is one of its functions. [`any`]
//! erases the types of the kind, [`case`] is what a check knows of its case, [`fit`] has tests of
//! the form of an answer.

pub(crate) mod any;
mod case;
pub(crate) mod expected_cache;
mod fit;

pub(crate) use case::CaseContext;
pub(crate) use fit::{hits_fit, in_range, one_each, same_length};

use crate::tools::findings::{Aspect, Findings};
use crate::tools::moves::{Move, Symmetries};
use crate::tools::shown::ShownCall;
use crate::tools::simple::numbers::Number;
use crate::tools::snapshot::{Content, Fields};
use crate::tools::truth::expected::Expected;
use crate::tools::{Tier, plural};
use wire::Kind;
use wire::work::Xyz;

/// Default time limit of a case, in milliseconds. Correct code needs a few milliseconds.
const LIMIT_MS: u64 = 5000;

/// Time limit of cases that build trees over large meshes, in milliseconds.
pub(crate) const LARGE_LIMIT_MS: u64 = 120_000;

/// The operations on one kind of work. The folder of a task in `tasks` implements it for each kind
/// of work of that task; kinds that several tasks share have folders in `kinds`.
///
/// A worker's answer is untrusted until [`Check::fits`] accepts it. All other functions are only
/// called with answers that fit, so they may rely on the number of answers and on every index that
/// `fits` tests.
pub(crate) trait Check: Kind {
    /// Whether the work traces rays through all intersection stages, not only the task's own stage.
    const NEEDS_ALL_STAGES: bool = false;

    /// Milliseconds after which a case has failed.
    const LIMIT_MS: u64 = LIMIT_MS;

    /// The number of calls of the student's functions that the question makes.
    fn calls(question: &Self::Question) -> usize;

    /// The question with its call number `call` only, as call 0; `None` where calls depend on each
    /// other or on their number, or where there is no such call.
    fn only_call(_question: &Self::Question, _call: usize) -> Option<Self::Question> {
        None
    }

    /// The main answers: a case about one of them gives nothing if it is wrong. For cases about
    /// other aspects see `Spec::is_main`.
    const MAIN: &'static [Aspect] = &[Aspect::HitOrMiss];

    /// Checks that the answer has the form that the question requires: the number of entries, the
    /// ranges of indices. The error ends the sentence "the worker's record does not fit the case:
    /// ...".
    fn fits(question: &Self::Question, answer: &Self::Answer) -> Result<(), String>;

    /// The exact symmetries of the question. None for work whose answers a table could not contain,
    /// or that no move leaves as exact as it is.
    fn symmetries(_question: &Self::Question) -> Symmetries {
        Symmetries::default()
    }

    /// Why a question without symmetries has none: ends the sentence "no move, because ...".
    const NOT_MOVED: &'static str = "its numbers have no exact symmetry";

    /// The question after a move that is one of its [`Check::symmetries`].
    fn moved(question: &Self::Question, _by: &Move) -> Self::Question {
        question.clone()
    }

    /// The answer to a moved question as the answer to the question itself: `back` is the move
    /// back. The answer need not be right.
    fn moved_back(answer: &Self::Answer, _back: &Move) -> Self::Answer {
        answer.clone()
    }

    /// The results that score for each call, for work on triangles and spheres; the oracle computes
    /// them once for all answers. `enclosed` is [`CaseContext::enclosed`].
    fn expected(_question: &Self::Question, _tier: Tier, _enclosed: bool) -> Vec<Expected> {
        Vec::new()
    }

    /// Computes the right results that the judgement of an answer may need and that come from a
    /// formula: handouts have them as a table (see [`crate::tools::packed_truth`]).
    fn look_up_truth(_question: &Self::Question) {}

    /// Judges an answer to a case whose points are of `tier`, and counts the results in `findings`.
    fn judge(
        findings: &mut Findings,
        case: &CaseContext<'_>,
        tier: Tier,
        question: &Self::Question,
        answer: &Self::Answer,
    );

    /// Judges the aspects that [`Check::judge`] leaves out, because no case grades them, and
    /// records what remains not judged. With it, an answer is judged whole (see `whole`).
    fn judge_rest(
        _findings: &mut Findings,
        _case: &CaseContext<'_>,
        _tier: Tier,
        _question: &Self::Question,
        _answer: &Self::Answer,
    ) {
    }

    /// The content of a snapshot of the answer; `None` for answers that differ on every run
    /// (times).
    fn lines(_question: &Self::Question, _answer: &Self::Answer) -> Option<Content> {
        None
    }

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

    /// Simple questions that call the same function as `question`, from the simplest to the hardest
    /// (see [`crate::tools::simple`]); none for work without simple questions.
    fn simple(_question: &Self::Question) -> Vec<Self::Question> {
        Vec::new()
    }

    /// Calls `change` with each number of the question that another length or fewer digits may
    /// replace (see [`crate::tools::simple::variations`]); none for work without such numbers.
    fn vary(_question: &mut Self::Question, _change: &mut dyn FnMut(Number, &mut f64)) {}

    /// The input of call number `call`, as text: for reports on calls that have no answer to show
    /// it with. `None` for work whose input is long, or where there is no such call.
    fn input(_question: &Self::Question, _call: usize) -> Option<String> {
        None
    }

    /// The circumstances of a call, of which mistakes often depend: each ends the sentence "wrong
    /// only where ...". `None` if nothing is known of them.
    fn circumstances(_: &Self::Question, _: usize) -> Option<Vec<&'static str>> {
        None
    }

    /// The right hit or interval of each of `calls`, as the fields of a record, without fields for
    /// a miss. `None` for work that computes neither. `enclosed` is [`CaseContext::enclosed`].
    fn exact(_question: &Self::Question, _enclosed: bool, _calls: &[u32]) -> Option<Vec<Fields>> {
        None
    }

    /// One call with what is right and, if there is an answer, what the code returned. `None` for
    /// work that is shown in another way, or where there is no such call.
    fn shown(
        _question: &Self::Question,
        _tier: Tier,
        _enclosed: bool,
        _call: usize,
        _answer: Option<&Self::Answer>,
    ) -> Option<ShownCall> {
        None
    }

    /// The inputs of all calls, in a sentence without its full stop.
    fn overview(question: &Self::Question) -> String {
        plural(Self::calls(question), "call", "calls")
    }
}
