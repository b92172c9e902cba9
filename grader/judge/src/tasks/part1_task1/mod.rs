//! `part1.task1`: the sample loop of a pixel.

mod call;
pub(crate) mod cases;
pub(crate) mod judge;
mod lines;
mod repro;
mod rest;
mod simple;

use crate::tools::Tier;
use crate::tools::check::{CaseContext, Check, in_range, one_each};
use crate::tools::findings::{Aspect, Findings};
use crate::tools::moves::{LightMoves, Move, Symmetries};
use crate::tools::plural;
use crate::tools::shown::ShownCall;
use crate::tools::snapshot::Content;
use wire::answer::PixelAnswer;
use wire::kind;
use wire::work::{PixelWork, PixelWorld, Xyz};

impl Check for kind::Pixels {
    const MAIN: &'static [Aspect] = &[Aspect::Placement, Aspect::Radiance];

    fn calls(work: &PixelWork) -> usize {
        work.calls().count()
    }

    fn only_call(work: &PixelWork, call: usize) -> Option<PixelWork> {
        let ([x, y], seed) = work.calls().nth(call)?;
        Some(PixelWork {
            pixels: vec![[x, y]],
            seeds: vec![seed],
            ..work.clone()
        })
    }

    fn fits(work: &PixelWork, answers: &Vec<PixelAnswer>) -> Result<(), String> {
        one_each(Self::calls(work), answers)?;
        for (call, answer) in answers.iter().enumerate() {
            let traced = answer.traced.len();
            if answer.traced_radiance.len() != traced {
                return Err(format!(
                    "call {call} has {traced} traced rays and {} radiances; expected equal numbers",
                    answer.traced_radiance.len()
                ));
            }
            for &point in answer.traced.iter().flatten() {
                in_range("point", call, point, answer.points.len())?;
            }
        }
        Ok(())
    }

    fn symmetries(work: &PixelWork) -> Symmetries {
        let light = match work.world {
            PixelWorld::Constant(light) | PixelWorld::Flicker(light) => light,
            PixelWorld::Ramp | PixelWorld::Numbers | PixelWorld::Rings => [1.0; 3],
        };
        Symmetries {
            light: LightMoves::of_channels(light),
            ..Symmetries::default()
        }
    }

    fn moved(work: &PixelWork, by: &Move) -> PixelWork {
        PixelWork {
            gain: by.light(work.gain),
            ..work.clone()
        }
    }

    fn moved_back(answers: &Vec<PixelAnswer>, back: &Move) -> Vec<PixelAnswer> {
        let each = answers.iter().map(|answer| PixelAnswer {
            traced_radiance: answer
                .traced_radiance
                .iter()
                .map(|light| back.light(*light))
                .collect(),
            radiance: back.light(answer.radiance),
            ..answer.clone()
        });
        each.collect()
    }

    fn judge(
        findings: &mut Findings,
        _: &CaseContext<'_>,
        _: Tier,
        work: &PixelWork,
        answers: &Vec<PixelAnswer>,
    ) {
        judge::pixels(findings, work, answers);
    }

    fn judge_rest(
        findings: &mut Findings,
        _: &CaseContext<'_>,
        _: Tier,
        work: &PixelWork,
        answers: &Vec<PixelAnswer>,
    ) {
        rest::pixels(findings, work, answers);
    }

    fn lines(work: &PixelWork, answers: &Vec<PixelAnswer>) -> Option<Content> {
        Some((Vec::new(), lines::pixels(work, answers)))
    }

    fn input(work: &PixelWork, call: usize) -> Option<String> {
        call::input(work, call)
    }

    fn circumstances(work: &PixelWork, call: usize) -> Option<Vec<&'static str>> {
        call::circumstances(work, call)
    }

    fn shown(
        work: &PixelWork,
        _: Tier,
        _: bool,
        call: usize,
        answers: Option<&Vec<PixelAnswer>>,
    ) -> Option<ShownCall> {
        call::shown(work, call, answers)
    }

    fn overview(work: &PixelWork) -> String {
        format!(
            "{} of a film of {} x {}, each with {}; {}",
            plural(work.pixels.len(), "pixel", "pixels"),
            work.film[0],
            work.film[1],
            plural(work.ns_aa as usize, "sample", "samples"),
            plural(work.seeds.len(), "seed", "seeds")
        )
    }

    fn repro(_: Tier, work: &PixelWork, call: usize) -> Option<String> {
        let (pixel, seed) = work.calls().nth(call)?;
        Some(repro::samples(work, pixel, seed))
    }

    fn colours(answers: &Vec<PixelAnswer>) -> Option<Vec<Xyz>> {
        Some(answers.iter().map(|pixel| pixel.radiance).collect())
    }

    fn simple(_: &PixelWork) -> Vec<PixelWork> {
        simple::questions()
    }
}
