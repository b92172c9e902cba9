//! Tests whose results only the grader knows: the worker asks for each, and the grader counts.
//!
//! Points depend on how many boxes and primitives a traversal tests. The worker counts them, but
//! code that breaks the compiler's checks could change its memory. So of some rays of a submission
//! the worker gets no results ([`wire::work::ScriptedRay::is_hidden`]). It cannot answer these
//! without asking, and its counts must be those of its questions. Which rays these are is drawn for
//! each run, so the others cannot have fewer tests ([`Excess`]).

use super::excess::Excess;
use std::collections::HashMap;
use std::hash::{BuildHasher, RandomState};
use wire::answer::TraverseAnswer;
use wire::question::{Question, Reply};
use wire::work::ScriptedRay;
use wire::{Answer, Case, Outcome, Record, Work};

/// Of so many rays of a case, one is hidden.
const ONE_OF: u64 = 4;

/// Of so many rays of a case, the first ones, one is always hidden: more often than others.
const FIRST: u64 = ONE_OF;

/// The questions about the cases of one worker.
pub(crate) struct Asked<'a> {
    cases: &'a [Case],
    /// What was asked for a hidden ray: its case and its call.
    counts: HashMap<(u32, u32), Counts>,
    /// How far hidden rays have more tests than the others.
    excess: Excess,
    /// How a record shows that something changed the worker's counts, if one does.
    why_changed: Option<String>,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Counts {
    boxes: u32,
    prims: u32,
}

impl<'a> Asked<'a> {
    /// Nothing of `cases` is hidden.
    pub(crate) fn none(cases: &'a [Case]) -> Asked<'a> {
        Asked {
            cases,
            counts: HashMap::new(),
            excess: Excess::default(),
            why_changed: None,
        }
    }

    /// Hides the results of some rays of `cases`. Returns also the cases to send.
    pub(crate) fn hide(cases: &'a [Case]) -> (Asked<'a>, Vec<Case>) {
        let mut asked = Asked::none(cases);
        let draw = RandomState::new();
        let mut to_send = cases.to_vec();
        for (case, number) in to_send.iter_mut().zip(0..) {
            let Work::Traverse(world) = &mut case.work else {
                continue;
            };
            let first = draw.hash_one(number) % FIRST;
            for (ray, call) in world.rays.iter_mut().zip(0..) {
                let drawn = draw.hash_one((number, call)) % ONE_OF;
                // One in each case with a few rays, too.
                if drawn == 0 || u64::from(call) == first {
                    (ray.spans, ray.prims, ray.is_hidden) = (Vec::new(), Vec::new(), true);
                    asked.counts.insert((number, call), Counts::default());
                }
            }
        }
        (asked, to_send)
    }

    /// Whether there is anything to ask.
    pub(crate) fn is_open(&self) -> bool {
        !self.counts.is_empty()
    }

    /// The reply to a question about a hidden ray. An error is a sentence.
    pub(crate) fn reply(
        &mut self,
        case: u32,
        call: u32,
        question: Question,
    ) -> Result<Reply, String> {
        let cases = self.cases;
        let scripted = scripted(cases, case, call);
        let (Some(counts), Some(scripted)) = (self.counts.get_mut(&(case, call)), scripted) else {
            return Err(format!("call {call} of case {case} has nothing to ask"));
        };
        let reply = match question {
            Question::Box(node) => {
                counts.boxes = counts.boxes.saturating_add(1);
                scripted.spans.get(node as usize).copied()
            }
            Question::Prim(prim) => {
                counts.prims = counts.prims.saturating_add(1);
                let hit = scripted.prims.get(prim as usize);
                hit.map(|hit| hit.map(|t| [t, t]))
            }
        };
        reply.ok_or_else(|| format!("{question:?} is not in the tree"))
    }

    /// The sentence about counts that are not those of the questions, if there were any.
    pub(crate) fn why_changed(&self) -> Option<&str> {
        self.why_changed.as_deref()
    }

    /// Whether the counts of a record are those of its questions. If not, a sentence says which.
    pub(crate) fn check(&mut self, record: &Record) -> Result<(), String> {
        let Outcome::Answered(Answer::Traverse(answers)) = &record.outcome else {
            return Ok(());
        };
        for (answer, call) in answers.iter().zip(0..) {
            let Some(asked) = self.counts.get(&(record.case, call)) else {
                continue;
            };
            let counted = Counts {
                // A box that is no node's is not asked for.
                boxes: answer.box_tests.saturating_sub(answer.unknown_boxes),
                prims: answer.prim_tests,
            };
            if counted != *asked {
                let why = format!(
                    "in call {call} it counts {} box tests and {} primitive tests, but it asked for {} and {}",
                    counted.boxes, counted.prims, asked.boxes, asked.prims
                );
                return self.changed(why);
            }
        }
        self.compare(record.case, answers)
    }

    /// Compares the counts of hidden rays with those of the others. If all cases so far show that
    /// hidden rays have more tests, a sentence says so.
    fn compare(&mut self, case: u32, answers: &[TraverseAnswer]) -> Result<(), String> {
        let calls = (0..).zip(answers).skip(FIRST as usize);
        let tests = calls.map(|(call, answer)| {
            let all = u64::from(answer.box_tests) + u64::from(answer.prim_tests);
            (all, self.counts.contains_key(&(case, call)))
        });
        let tests: Vec<(u64, bool)> = tests.collect();
        self.excess.add(&tests);
        if !self.excess.is_certain() {
            return Ok(());
        }
        let why = "it makes more tests for the rays whose tests the grader counts than it counts for the others, which chance does not explain";
        self.changed(why.to_string())
    }

    /// Notes that something changed the worker's counts.
    fn changed(&mut self, why: String) -> Result<(), String> {
        self.why_changed = Some(why.clone());
        Err(why)
    }
}

/// The ray of a call.
fn scripted(cases: &[Case], case: u32, call: u32) -> Option<&ScriptedRay> {
    match &cases.get(case as usize)?.work {
        Work::Traverse(world) => world.rays.get(call as usize),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A case of part2.task3 with scripted rays, alone.
    fn cases() -> Vec<Case> {
        let specs = judge::cases::of("part2.task3", 1);
        let is_scripted =
            |case: &Case| matches!(&case.work, Work::Traverse(world) if world.tree.nodes.len() > 2);
        let cases = specs.iter().map(|spec| spec.case());
        cases.filter(is_scripted).take(1).collect()
    }

    /// A record of case 0 that makes as many tests in each call as `counts` says.
    fn record(rays: usize, counts: impl Fn(u32) -> (u32, u32)) -> Record {
        let answer = |call| TraverseAnswer {
            hit: None,
            ray_after: wire::work::Ray {
                o: [0.0; 3],
                d: [0.0; 3],
                min_t: 0.0,
                max_t: 0.0,
            },
            box_tests: counts(call).0,
            prim_tests: counts(call).1,
            prim_hits: 0,
            repeated_prims: 0,
            unknown_boxes: 0,
        };
        Record {
            case: 0,
            untouched: Vec::new(),
            holes: Vec::new(),
            outcome: Outcome::Answered(Answer::Traverse((0..rays as u32).map(answer).collect())),
        }
    }

    #[test]
    fn what_is_hidden_is_not_sent_and_the_rest_is_unchanged() {
        let specs = judge::cases::of("part2.task3", 1);
        let cases: Vec<Case> = specs.iter().map(|spec| spec.case()).collect();
        let (asked, sent) = Asked::hide(&cases);
        let mut rays = 0;
        for ((case, sent), number) in cases.iter().zip(&sent).zip(0..) {
            let (Work::Traverse(world), Work::Traverse(sent)) = (&case.work, &sent.work) else {
                assert_eq!(
                    serde_json::to_string(case).unwrap(),
                    serde_json::to_string(sent).unwrap()
                );
                continue;
            };
            assert!(sent.rays.iter().any(|ray| ray.is_hidden) || world.rays.len() < 4);
            for ((ray, sent), call) in world.rays.iter().zip(&sent.rays).zip(0..) {
                rays += 1;
                assert_eq!(sent.is_hidden, asked.counts.contains_key(&(number, call)));
                match sent.is_hidden {
                    true => assert!(sent.spans.is_empty() && sent.prims.is_empty()),
                    false => assert_eq!((&ray.spans, &ray.prims), (&sent.spans, &sent.prims)),
                }
            }
        }
        let hidden = asked.counts.len();
        assert!(rays / 8 < hidden && hidden < rays / 2, "{hidden} of {rays}");
    }

    #[test]
    fn counts_that_are_not_those_of_the_questions_are_found() {
        let cases = cases();
        let Work::Traverse(world) = &cases[0].work else {
            panic!("it is a traversal")
        };
        let (mut asked, _) = Asked::hide(&cases);
        let &(case, call) = asked.counts.keys().next().expect("one is hidden");
        let ray = &world.rays[call as usize];
        assert_eq!(asked.reply(case, call, Question::Box(0)), Ok(ray.spans[0]));
        for question in [Question::Prim(0), Question::Prim(1)] {
            assert!(asked.reply(case, call, question).is_ok());
        }
        let of_call = |it: u32, counts| if it == call { counts } else { (0, 0) };
        let rays = world.rays.len();
        assert_eq!(asked.check(&record(rays, |it| of_call(it, (1, 2)))), Ok(()));
        for wrong in [(1, 1), (0, 2), (1, 3)] {
            assert!(asked.check(&record(rays, |it| of_call(it, wrong))).is_err());
        }
        assert!(asked.reply(case, call, Question::Prim(u32::MAX)).is_err());
        assert!(asked.reply(77, call, Question::Box(0)).is_err());
    }

    #[test]
    fn more_tests_for_hidden_rays_than_for_the_others_are_found() {
        let cases = cases();
        let Work::Traverse(world) = &cases[0].work else {
            panic!("it is a traversal")
        };
        let rays = world.rays.len();
        // Where the others are counted as they are, and where they are set back.
        for (of_others, is_found) in [(40, false), (3, true)] {
            let (mut asked, _) = Asked::hide(&cases);
            let hidden: Vec<u32> = asked.counts.keys().map(|(_, call)| *call).collect();
            for &call in &hidden {
                (0..40).for_each(|_| drop(asked.reply(0, call, Question::Box(0))));
            }
            let counts = |call| {
                (
                    if hidden.contains(&call) {
                        40
                    } else {
                        of_others
                    },
                    0,
                )
            };
            let found = (0..20).any(|_| asked.check(&record(rays, counts)).is_err());
            assert_eq!(found, is_found, "{of_others}");
            assert_eq!(asked.why_changed().is_some(), is_found);
        }
    }
}
