//! Direct light: the kind of work of `part3.task2` and `part3.task3`.

mod call;
mod degrees;
mod judge;
mod lamps;
mod mistakes;
mod moves;
mod near_the_plane;
mod shadow_targets;
mod simple;
mod terms;
mod world_text;
pub(crate) mod worlds;

pub(crate) use moves::of_material;

use crate::tools::Tier;
use crate::tools::check::{CaseContext, Check, one_each};
use crate::tools::findings::{Aspect, Findings};
use crate::tools::moves::{LightMoves, Move, Symmetries};
use crate::tools::shown::ShownCall;
use crate::tools::snapshot::Content;
use crate::tools::snapshot::lines::each;
use crate::tools::snapshot::{field, forms, number, vector};
use wire::direct::{DirectAnswer, DirectWork, RecordedRay};
use wire::kind;

impl Check for kind::Direct {
    const MAIN: &'static [Aspect] = &[Aspect::Radiance, Aspect::Mean];

    fn calls(work: &DirectWork) -> usize {
        work.points.len()
    }

    fn fits(work: &DirectWork, answers: &Vec<DirectAnswer>) -> Result<(), String> {
        one_each(Self::calls(work), answers)
    }

    const NOT_MOVED: &'static str = "nothing emits light";

    /// One factor for all channels: lights may be chosen by their luminance.
    fn symmetries(work: &DirectWork) -> Symmetries {
        let mut emitted = Vec::new();
        moves::multiplied(work, |light| {
            emitted.extend(light);
            light
        });
        Symmetries {
            light: LightMoves::of(emitted),
            ..Symmetries::default()
        }
    }

    fn moved(work: &DirectWork, by: &Move) -> DirectWork {
        moves::multiplied(work, |light| by.light(light))
    }

    fn moved_back(answers: &Vec<DirectAnswer>, back: &Move) -> Vec<DirectAnswer> {
        let each = answers.iter().map(|answer| DirectAnswer {
            radiance: back.light(answer.radiance),
            rays: answer
                .rays
                .iter()
                .map(|ray| RecordedRay {
                    seen: back.light(ray.seen),
                    ..*ray
                })
                .collect(),
        });
        each.collect()
    }

    fn judge(
        findings: &mut Findings,
        _: &CaseContext<'_>,
        _: Tier,
        work: &DirectWork,
        answers: &Vec<DirectAnswer>,
    ) {
        judge::direct(findings, work, answers);
    }

    fn judge_rest(
        findings: &mut Findings,
        _: &CaseContext<'_>,
        _: Tier,
        work: &DirectWork,
        answers: &Vec<DirectAnswer>,
    ) {
        judge::untested(findings, work, answers);
    }

    fn lines(work: &DirectWork, answers: &Vec<DirectAnswer>) -> Option<Content> {
        let lines = each(&work.points, answers, |point, answer| {
            let mut question = vec![field("p", vector(&point.p)), field("n", vector(&point.n))];
            if point.ng != point.n {
                question.push(field("ng", vector(&point.ng)));
            }
            question.push(field("wo", vector(&point.wo)));
            let short = vec![
                field("radiance", vector(&answer.radiance)),
                number("rays", answer.rays.len() as f64),
            ];
            let mut full = short.clone();
            full.extend(answer.rays.iter().take(2).flat_map(|recorded| {
                [
                    field("d", vector(&recorded.ray.d)),
                    number("max_t", recorded.ray.max_t),
                ]
            }));
            forms(question, short, full)
        });
        Some((Vec::new(), lines))
    }

    fn simple(work: &DirectWork) -> Vec<DirectWork> {
        simple::questions(work.strategy, &work.world)
    }

    fn input(work: &DirectWork, call: usize) -> Option<String> {
        call::input(work, call)
    }

    fn shown(
        work: &DirectWork,
        _: Tier,
        _: bool,
        call: usize,
        answer: Option<&Vec<DirectAnswer>>,
    ) -> Option<ShownCall> {
        call::shown(work, call, answer)
    }

    fn overview(work: &DirectWork) -> String {
        call::overview(work)
    }
}
