//! `part4.task3`: Russian roulette.

pub(crate) mod cases;
mod judge;
mod repro;

use crate::Tier;
use crate::cases::Spec;
use crate::check::{Check, Content, one_each};
use crate::snapshot::lines::each;
use crate::snapshot::{Fields, field, forms, number, vector};
use crate::tally::{Aspect, Tally};
use wire::global::RouletteWork;
use wire::work::Xyz;

/// `play_roulette`, called for each path with each number.
pub(crate) struct Roulette;

impl Check for Roulette {
    type Question = RouletteWork;
    type Answer = Vec<Option<Xyz>>;

    const MAIN: &'static [Aspect] = &[Aspect::Survival, Aspect::Throughput, Aspect::Mean];

    fn calls(work: &RouletteWork) -> usize {
        work.paths.len() * work.numbers.len()
    }

    fn fits(work: &RouletteWork, answers: &Vec<Option<Xyz>>) -> Result<(), String> {
        one_each(Self::calls(work), answers)
    }

    fn judge(
        tally: &mut Tally,
        _: &Spec,
        _: Tier,
        work: &RouletteWork,
        answers: &Vec<Option<Xyz>>,
    ) {
        judge::roulette(tally, work, answers);
    }

    fn lines(work: &RouletteWork, answers: &Vec<Option<Xyz>>) -> Option<Content> {
        let paths = work.paths.iter();
        let calls = paths.flat_map(|path| work.numbers.iter().map(move |u| (path, u)));
        let lines = each(calls, answers, |((throughput, bounces), u), answer| {
            let question = vec![
                field("throughput", vector(throughput)),
                number("bounces", f64::from(*bounces)),
                number("u", *u),
            ];
            let answer: Fields = answer
                .iter()
                .map(|throughput| field("goes_on", vector(throughput)))
                .collect();
            forms(question, answer.clone(), answer)
        });
        Some((Vec::new(), lines))
    }

    fn repro(_: Tier, work: &RouletteWork, call: usize) -> Option<String> {
        repro::call(work, call)
    }

    /// The test makes one call, which shows nothing about statistics of many.
    fn repro_shows(aspect: Aspect) -> bool {
        !matches!(aspect, Aspect::Spread | Aspect::Mean)
    }
}
