//! The type of a case.

use crate::tools::Tier;
use crate::tools::check::any::{AnyCheck, check_of_kind};
use crate::tools::check::expected_cache::ExpectedCache;
use crate::tools::check::{CaseContext, Check};
use crate::tools::findings::Aspect;
use crate::tools::moves::{self, Move};
use crate::tools::questions::probes::ProbeRng;
use crate::tools::shown::ShownCall;
use crate::tools::snapshot::Fields;
use crate::tools::truth::expected::Expected;
use std::sync::Arc;
use wire::{Answer, Work};

/// One case of one task.
///
/// ```
/// let spec = &judge::cases::of("part1.task3", 0)[0];
/// assert_eq!(spec.task, "part1.task3");
/// assert!(judge::calls(&spec.work) > 0 && !spec.about.is_empty());
/// ```
#[derive(Clone, Debug)]
pub struct Spec {
    /// Key of the task.
    pub task: &'static str,
    /// Name, as in `course.toml`.
    pub name: &'static str,
    /// What is checked, in a sentence for students; after [`PITFALL`], what a naive formula does
    /// there. [`checked`] returns the part without the hint.
    pub about: &'static str,
    /// The question that is judged and shown. The worker gets it moved.
    pub work: Work,
    /// Whether a teacher added the case. It has no golden.
    pub is_own: bool,
    /// Width and height, if the answers are the pixels of a picture, row by row from the bottom
    /// left.
    pub picture: Option<[u32; 2]>,
    /// Whether the shapes enclose the origin of every ray, so that a miss is never right.
    pub enclosed: bool,
    /// The aspects that the case judges; empty for all aspects of its answers. So a mistake that
    /// shows in every case is reported only in the cases that are about it.
    pub about_aspects: &'static [Aspect],
    /// The main answers of the case, if they are not those of `Spec::is_main`'s rule.
    pub main_aspects: &'static [Aspect],
    /// The check of the kind of `work`.
    pub(crate) check: &'static dyn AnyCheck,
    /// The exact results, as far as they have been computed.
    pub(crate) expected_cache: Arc<ExpectedCache>,
    /// The move of the question that the worker gets.
    pub(crate) moved_by: Arc<Move>,
    /// The seed that draws the order of the calls, and the place of the case among those of its task.
    pub(crate) seed: u64,
}

/// The seed whose questions students have. None of them is moved.
pub const KNOWN_SEED: u64 = 0;

/// Separates what a case checks from the mistake that its sentence names.
pub const PITFALL: &str = " Pitfall: ";

/// The part of the sentence `about` that names no mistake.
pub fn checked(about: &str) -> &str {
    about
        .split_once(PITFALL)
        .map_or(about, |(checked, _)| checked)
}

impl Spec {
    /// The case `name` of `task` with a question of the kind `K`, without a picture; `about` is for
    /// students.
    pub(crate) fn new<K: Check>(
        task: &'static str,
        name: &'static str,
        about: &'static str,
        question: K::Question,
    ) -> Spec {
        Spec::of_work(task, name, about, K::work(question), check_of_kind::<K>())
    }

    /// The case `name` of `task` with `work` of the kind that `check` judges.
    pub(crate) fn of_work(
        task: &'static str,
        name: &'static str,
        about: &'static str,
        work: Work,
        check: &'static dyn AnyCheck,
    ) -> Spec {
        Spec {
            task,
            name,
            about,
            work,
            check,
            is_own: false,
            picture: None,
            enclosed: false,
            about_aspects: &[],
            main_aspects: &[],
            expected_cache: Arc::default(),
            moved_by: Arc::new(Move::IDENTITY),
            seed: KNOWN_SEED,
        }
    }

    /// The same case with a move and an order of its calls that the seed draws.
    pub fn moved_for(self, seed: u64) -> Spec {
        if seed == KNOWN_SEED {
            return self;
        }
        let mut rng = ProbeRng::new(&format!("{}/{}", self.task, self.name), seed);
        let drawn = self.check.symmetries(&self.work).draw(&mut rng);
        Spec {
            moved_by: Arc::new(drawn),
            seed,
            ..self
        }
    }

    /// The same case, judged on these aspects only.
    pub(crate) fn only(self, about_aspects: &'static [Aspect]) -> Spec {
        Spec {
            about_aspects,
            ..self
        }
    }

    /// The same case with these main answers.
    pub(crate) fn mainly(self, main_aspects: &'static [Aspect]) -> Spec {
        Spec {
            main_aspects,
            ..self
        }
    }

    /// Whether `aspect` is a main answer: if it is wrong, the case gives no points.
    ///
    /// Main are those of the aspects that the case is about that are main in all work of its kind,
    /// such as the positions of samples; if there are none, the first that the case is about.
    /// Wherever hit or miss is judged it is main, since without it nothing else means much.
    pub(crate) fn is_main(&self, aspect: Aspect) -> bool {
        if aspect.is_decision() || !self.main_aspects.is_empty() {
            return aspect.is_decision() || self.main_aspects.contains(&aspect);
        }
        let of_kind = self.check.main();
        let about = self.about_aspects;
        match about.first() {
            Some(first) if about.iter().all(|aspect| !of_kind.contains(aspect)) => aspect == *first,
            _ => of_kind.contains(&aspect),
        }
    }

    /// Whether this is the case `name` of `task`.
    pub fn is(&self, task: &str, name: &str) -> bool {
        self.task == task && self.name == name
    }

    /// Whether the case traces rays through all intersection stages, not only the task's own stage.
    pub fn needs_all_stages(&self) -> bool {
        self.check.needs_all_stages()
    }

    /// What a seed draws apart from the question; `None` for the seed that students have.
    fn order_rng(&self, of: &str) -> Option<ProbeRng> {
        let name = format!("{of} of {}/{}", self.task, self.name);
        (self.seed != KNOWN_SEED).then(|| ProbeRng::new(&name, self.seed))
    }

    /// A number by which the cases of a task are sorted before they run; 0 with the seed that students
    /// have. Then code that counts its calls does not know which question it is asked.
    pub fn place(&self) -> usize {
        self.order_rng("place")
            .map_or(0, |mut rng| rng.below(1 << 30))
    }

    /// The case in the form that the worker gets: with its question moved and its calls in another
    /// order. The answer is judged after [`Spec::moved_back`].
    pub fn case(&self) -> wire::Case {
        wire::Case {
            task: self.task.into(),
            name: self.name.into(),
            limit_ms: self.check.limit_ms(),
            work: match self.is_moved() {
                true => self.check.moved(&self.work, &self.moved_by),
                false => self.work.clone(),
            },
            order: self
                .order_rng("calls")
                .map_or_else(Vec::new, |mut rng| moves::shuffled(self.calls(), &mut rng)),
        }
    }

    /// The worker's answer to [`Spec::case`], which [`fits`](crate::fits), as an answer to the
    /// question that is judged.
    pub fn moved_back(&self, answer: Answer) -> Answer {
        match self.is_moved() {
            true => self.check.moved_back(answer, &self.moved_by.inverse()),
            false => answer,
        }
    }

    /// Whether the worker gets another question than students have.
    pub fn is_moved(&self) -> bool {
        !self.moved_by.is_identity()
    }

    /// Why no seed moves the case: ends the sentence "no move, because ...".
    pub fn why_not_moved(&self) -> &'static str {
        self.check.why_not_moved()
    }

    /// The same case with the question that students have, in its order.
    pub fn unmoved(&self) -> Spec {
        Spec {
            moved_by: Arc::new(Move::IDENTITY),
            seed: KNOWN_SEED,
            ..self.clone()
        }
    }

    /// The number of calls of the student's functions that the case makes.
    pub fn calls(&self) -> usize {
        self.check.calls(&self.work)
    }

    /// The same case with its call number `call` only, as call 0; `None` where calls depend on each
    /// other or on their number (of which random numbers are made), or where there is no such call.
    /// Its question is not moved.
    pub fn only_call(&self, call: usize) -> Option<Spec> {
        Some(Spec {
            work: self.check.only_call(&self.work, call)?,
            picture: None,
            expected_cache: Arc::default(),
            ..self.unmoved()
        })
    }

    /// The simple questions of the case's kind of work (see `tools::simple`), judged as the
    /// case is, and not moved.
    pub fn simple(&self) -> Vec<Spec> {
        let works = self.check.simple(&self.work).into_iter();
        works.map(|work| self.with_work(work)).collect()
    }

    /// Another question, judged as the case is, and not moved.
    pub(crate) fn with_work(&self, work: Work) -> Spec {
        Spec {
            work,
            picture: None,
            enclosed: false,
            expected_cache: Arc::default(),
            ..self.unmoved()
        }
    }

    /// The results that score for each probe or ray of a case about single shapes or a list of
    /// shapes; empty for other cases.
    pub fn expected(&self, tier: Tier) -> Vec<Expected> {
        self.check.expected(&self.work, tier, self.enclosed)
    }

    /// What the check needs to know of the case.
    pub(crate) fn context(&self) -> CaseContext<'_> {
        CaseContext {
            name: self.name,
            enclosed: self.enclosed,
            cache: &self.expected_cache,
        }
    }

    /// The input of call number `call`, as text: for reports on calls that have no answer to show
    /// it with. `None` for work whose input is long, or where there is no such call.
    pub fn input(&self, call: usize) -> Option<String> {
        self.check.input(&self.work, call)
    }

    /// The circumstances of a call, of which mistakes often depend: each ends the sentence "wrong
    /// only where ...". `None` if nothing is known of them.
    pub fn circumstances(&self, call: usize) -> Option<Vec<&'static str>> {
        self.check.circumstances(&self.work, call)
    }

    /// The right hit or interval of each of `calls`, as the fields of a record, without fields for
    /// a miss. `None` for work that computes neither.
    pub fn exact(&self, calls: &[u32]) -> Option<Vec<Fields>> {
        self.check.exact(&self.work, self.enclosed, calls)
    }

    /// One call with what scores at `tier` and, if there is an answer, what the code returned.
    /// `None` for work that is shown in another way, or where there is no such call.
    pub fn shown(&self, tier: Tier, call: usize, answer: Option<&Answer>) -> Option<ShownCall> {
        self.check
            .shown(&self.work, tier, self.enclosed, call, answer)
    }

    /// The inputs of all calls, in a sentence without its full stop.
    pub fn overview(&self) -> String {
        self.check.overview(&self.work)
    }
}
