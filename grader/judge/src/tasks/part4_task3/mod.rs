//! `part4.task3`: Russian roulette.

pub(crate) mod cases;
mod judge;
mod repro;
mod simple;
mod truth;

use crate::tools::Tier;
use crate::tools::call_text::point;
use crate::tools::check::{CaseContext, Check, one_each};
use crate::tools::findings::{Aspect, Findings};
use crate::tools::moves::{Move, Symmetries};
use crate::tools::snapshot::Content;
use crate::tools::snapshot::lines::each;
use crate::tools::snapshot::{Fields, field, forms, number, vector};
use wire::global::RouletteWork;
use wire::kind;
use wire::work::Xyz;

impl Check for kind::Roulette {
    const MAIN: &'static [Aspect] = &[Aspect::Survival, Aspect::Throughput, Aspect::Mean];

    fn calls(work: &RouletteWork) -> usize {
        work.paths.len() * work.numbers.len()
    }

    fn fits(work: &RouletteWork, answers: &Vec<Option<Xyz>>) -> Result<(), String> {
        one_each(Self::calls(work), answers)
    }

    fn look_up_truth(work: &RouletteWork) {
        for (throughput, bounces) in &work.paths {
            truth::survival(*throughput, *bounces);
        }
    }

    const NOT_MOVED: &'static str = "its paths are grey, and the largest channel decides";

    /// The largest channel decides, whichever it is. Grey paths have no other order of channels.
    fn symmetries(work: &RouletteWork) -> Symmetries {
        let is_grey = |[r, g, b]: Xyz| r == g && g == b;
        Symmetries {
            channels: work
                .paths
                .iter()
                .any(|(throughput, _)| !is_grey(*throughput)),
            ..Symmetries::default()
        }
    }

    fn moved(work: &RouletteWork, by: &Move) -> RouletteWork {
        let paths = work
            .paths
            .iter()
            .map(|(throughput, bounces)| (by.permuted(*throughput), *bounces));
        RouletteWork {
            paths: paths.collect(),
            numbers: work.numbers.clone(),
        }
    }

    fn moved_back(answers: &Vec<Option<Xyz>>, back: &Move) -> Vec<Option<Xyz>> {
        let each = answers.iter();
        each.map(|throughput| throughput.map(|throughput| back.permuted(throughput)))
            .collect()
    }

    fn judge(
        findings: &mut Findings,
        _: &CaseContext<'_>,
        _: Tier,
        work: &RouletteWork,
        answers: &Vec<Option<Xyz>>,
    ) {
        judge::roulette(findings, work, answers);
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

    fn input(work: &RouletteWork, call: usize) -> Option<String> {
        let numbers = work.numbers.len().max(1);
        let (throughput, bounces) = work.paths.get(call / numbers)?;
        let u = work.numbers.get(call % numbers)?;
        Some(format!(
            "throughput = {}, bounces = {bounces}, u = {u:?}",
            point(*throughput)
        ))
    }

    fn repro(_: Tier, work: &RouletteWork, call: usize) -> Option<String> {
        repro::call(work, call)
    }

    /// The test makes one call, which shows nothing about statistics of many.
    fn repro_shows(aspect: Aspect) -> bool {
        !matches!(aspect, Aspect::Spread | Aspect::Mean)
    }

    fn simple(_: &RouletteWork) -> Vec<RouletteWork> {
        simple::questions()
    }
}
