//! `part5.task1`: the stopping rule of adaptive sampling, and pixels that stop by it.

pub(crate) mod cases;
pub(crate) mod judge;
pub(crate) mod lines;
mod placement;
pub(crate) mod repro;
mod simple;
mod truth;

use crate::plural;
use crate::tools::Tier;
use crate::tools::call_text::{few, point};
use crate::tools::check::{CaseContext, Check, one_each};
use crate::tools::findings::{Aspect, Findings};
use crate::tools::kinds::stopping;
use crate::tools::moves::{LightMoves, Move, Symmetries};
use crate::tools::snapshot::Content;
use crate::tools::snapshot::lines::each;
use wire::adaptive::{AdaptiveAnswer, AdaptivePixel, StopAnswer, StopCall, StopRule};
use wire::kind;

impl Check for kind::Stop {
    const MAIN: &'static [Aspect] = &[Aspect::Stop];

    fn calls(questions: &Vec<StopCall>) -> usize {
        questions.len()
    }

    fn only_call(calls: &Vec<StopCall>, call: usize) -> Option<Vec<StopCall>> {
        Some(vec![calls.get(call)?.clone()])
    }

    fn fits(questions: &Vec<StopCall>, answers: &Vec<StopAnswer>) -> Result<(), String> {
        one_each(Self::calls(questions), answers)
    }

    fn look_up_truth(calls: &Vec<StopCall>) {
        for call in calls {
            truth::converged(call);
        }
    }

    const NOT_MOVED: &'static str = stopping::NOT_MOVED;

    fn symmetries(questions: &Vec<StopCall>) -> Symmetries {
        stopping::symmetries(questions)
    }

    fn moved(questions: &Vec<StopCall>, by: &Move) -> Vec<StopCall> {
        stopping::moved(questions, by)
    }

    fn moved_back(answers: &Vec<StopAnswer>, back: &Move) -> Vec<StopAnswer> {
        stopping::moved_back(answers, back)
    }

    fn judge(
        findings: &mut Findings,
        _: &CaseContext<'_>,
        _: Tier,
        questions: &Vec<StopCall>,
        answers: &Vec<StopAnswer>,
    ) {
        judge::stop(findings, questions, answers);
    }

    fn lines(questions: &Vec<StopCall>, answers: &Vec<StopAnswer>) -> Option<Content> {
        Some((Vec::new(), each(questions, answers, stopping::line)))
    }

    fn input(work: &Vec<StopCall>, call: usize) -> Option<String> {
        work.get(call).map(stopping::input)
    }

    fn repro(_: Tier, questions: &Vec<StopCall>, call: usize) -> Option<String> {
        repro::plain(questions.get(call)?)
    }

    fn simple(_: &Vec<StopCall>) -> Vec<Vec<StopCall>> {
        simple::rules()
    }
}

impl Check for kind::AdaptivePixels {
    const MAIN: &'static [Aspect] = &[Aspect::Radiance, Aspect::Placement];

    fn calls(questions: &Vec<AdaptivePixel>) -> usize {
        questions.len()
    }

    fn only_call(pixels: &Vec<AdaptivePixel>, call: usize) -> Option<Vec<AdaptivePixel>> {
        Some(vec![pixels.get(call)?.clone()])
    }

    fn fits(questions: &Vec<AdaptivePixel>, answers: &Vec<AdaptiveAnswer>) -> Result<(), String> {
        one_each(Self::calls(questions), answers)
    }

    fn look_up_truth(pixels: &Vec<AdaptivePixel>) {
        for pixel in pixels {
            truth::right_samples(pixel);
        }
    }

    /// One factor for all channels: the rule gets luminances.
    fn symmetries(pixels: &Vec<AdaptivePixel>) -> Symmetries {
        let channels = pixels
            .iter()
            .flat_map(|pixel| pixel.stream.iter().flatten());
        Symmetries {
            light: LightMoves::of(channels.copied()),
            ..Symmetries::default()
        }
    }

    fn moved(pixels: &Vec<AdaptivePixel>, by: &Move) -> Vec<AdaptivePixel> {
        let each = pixels.iter().map(|pixel| AdaptivePixel {
            stream: pixel.stream.iter().map(|light| by.light(*light)).collect(),
            ..pixel.clone()
        });
        each.collect()
    }

    fn moved_back(answers: &Vec<AdaptiveAnswer>, back: &Move) -> Vec<AdaptiveAnswer> {
        let each = answers.iter().map(|answer| {
            let calls = answer
                .rule_calls
                .iter()
                .map(|&(count, mean, variance, tolerance)| {
                    let [mean, variance] = [back.luminance(mean), back.squared_luminance(variance)];
                    (count, mean, variance, tolerance)
                });
            AdaptiveAnswer {
                rule_calls: calls.collect(),
                radiance: back.light(answer.radiance),
                ..answer.clone()
            }
        });
        each.collect()
    }

    fn judge(
        findings: &mut Findings,
        _: &CaseContext<'_>,
        _: Tier,
        questions: &Vec<AdaptivePixel>,
        answers: &Vec<AdaptiveAnswer>,
    ) {
        judge::pixels(findings, questions, answers);
    }

    fn judge_rest(
        findings: &mut Findings,
        _: &CaseContext<'_>,
        _: Tier,
        questions: &Vec<AdaptivePixel>,
        answers: &Vec<AdaptiveAnswer>,
    ) {
        judge::untested(findings, questions, answers);
    }

    fn lines(questions: &Vec<AdaptivePixel>, answers: &Vec<AdaptiveAnswer>) -> Option<Content> {
        Some((Vec::new(), each(questions, answers, lines::pixel)))
    }

    fn input(work: &Vec<AdaptivePixel>, call: usize) -> Option<String> {
        let pixel = work.get(call)?;
        let [x, y] = pixel.pixel;
        let rule = match pixel.rule {
            StopRule::From(u64::MAX) => "a rule that never stops".into(),
            StopRule::From(least) => format!(
                "a rule that stops from {} on",
                plural(least, "sample", "samples")
            ),
            StopRule::Plain => "the plain rule".into(),
        };
        Some(format!(
            "x = {x}, y = {y}, ns_aa = {}, batch = {}, tolerance = {:?}, {rule}{}",
            pixel.ns_aa,
            pixel.batch,
            pixel.tolerance,
            few(pixel.stream.iter().map(|colour| point(*colour)), ", ")
                .map_or_else(String::new, |colours| format!(
                    ", samples in turn {colours}"
                ))
        ))
    }

    fn repro(_: Tier, questions: &Vec<AdaptivePixel>, call: usize) -> Option<String> {
        repro::pixel(questions.get(call)?)
    }

    /// The test is of one pixel.
    fn repro_shows(aspect: Aspect) -> bool {
        aspect != Aspect::Independence
    }

    fn simple(_: &Vec<AdaptivePixel>) -> Vec<Vec<AdaptivePixel>> {
        simple::pixels()
    }
}
