//! `part5.task1`: the stopping rule of adaptive sampling, and pixels that stop by it.

pub(crate) mod cases;
pub(crate) mod judge;
pub(crate) mod lines;
mod placement;
pub(crate) mod repro;

use crate::Tier;
use crate::cases::Spec;
use crate::check::{Check, Content, one_each};
use crate::snapshot::lines::each;
use crate::tally::{Aspect, Tally};
use wire::adaptive::{AdaptiveAnswer, AdaptivePixel, StopAnswer, StopCall};

/// `has_converged`, called for each question.
pub(crate) struct Stop;

impl Check for Stop {
    type Question = Vec<StopCall>;
    type Answer = Vec<StopAnswer>;

    const MAIN: &'static [Aspect] = &[Aspect::Stop];

    fn calls(questions: &Vec<StopCall>) -> usize {
        questions.len()
    }

    fn fits(questions: &Vec<StopCall>, answers: &Vec<StopAnswer>) -> Result<(), String> {
        one_each(Self::calls(questions), answers)
    }

    fn judge(
        tally: &mut Tally,
        _: &Spec,
        _: Tier,
        questions: &Vec<StopCall>,
        answers: &Vec<StopAnswer>,
    ) {
        judge::stop(tally, questions, answers);
    }

    fn lines(questions: &Vec<StopCall>, answers: &Vec<StopAnswer>) -> Option<Content> {
        Some((Vec::new(), each(questions, answers, lines::stop)))
    }

    fn repro(_: Tier, questions: &Vec<StopCall>, call: usize) -> Option<String> {
        repro::plain(questions.get(call)?)
    }
}

/// `raytrace_pixel_adaptive`, called for each pixel.
pub(crate) struct AdaptivePixels;

impl Check for AdaptivePixels {
    type Question = Vec<AdaptivePixel>;
    type Answer = Vec<AdaptiveAnswer>;

    const MAIN: &'static [Aspect] = &[Aspect::Radiance, Aspect::Placement];

    fn calls(questions: &Vec<AdaptivePixel>) -> usize {
        questions.len()
    }

    fn fits(questions: &Vec<AdaptivePixel>, answers: &Vec<AdaptiveAnswer>) -> Result<(), String> {
        one_each(Self::calls(questions), answers)
    }

    fn judge(
        tally: &mut Tally,
        _: &Spec,
        _: Tier,
        questions: &Vec<AdaptivePixel>,
        answers: &Vec<AdaptiveAnswer>,
    ) {
        judge::pixels(tally, questions, answers);
    }

    fn judge_rest(
        tally: &mut Tally,
        _: &Spec,
        _: Tier,
        questions: &Vec<AdaptivePixel>,
        answers: &Vec<AdaptiveAnswer>,
    ) {
        judge::untested(tally, questions, answers);
    }

    fn lines(questions: &Vec<AdaptivePixel>, answers: &Vec<AdaptiveAnswer>) -> Option<Content> {
        Some((Vec::new(), each(questions, answers, lines::pixel)))
    }

    fn repro(_: Tier, questions: &Vec<AdaptivePixel>, call: usize) -> Option<String> {
        repro::pixel(questions.get(call)?)
    }

    /// The test is of one pixel.
    fn repro_shows(aspect: Aspect) -> bool {
        aspect != Aspect::Independence
    }
}
