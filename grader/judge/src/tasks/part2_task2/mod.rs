//! `part2.task2`: intervals of rays inside boxes.

pub(crate) mod cases;
mod judge;
mod repro;

use crate::cases::Spec;
use crate::check::{Check, Content, one_each};
use crate::snapshot::lines::{each, ray_at};
use crate::snapshot::{Fields, Value, field, forms};
use crate::tally::{Aspect, Tally};
use crate::{Tier, picture};
use wire::work::{BoxWork, Xyz};

/// `intersect_bbox`, called for each probe.
pub(crate) struct Boxes;

impl Check for Boxes {
    type Question = BoxWork;
    type Answer = Vec<Option<[f64; 2]>>;

    const MAIN: &'static [Aspect] = &[Aspect::HitOrMiss, Aspect::Interval];

    fn calls(work: &BoxWork) -> usize {
        work.probes.len()
    }

    fn fits(work: &BoxWork, answers: &Vec<Option<[f64; 2]>>) -> Result<(), String> {
        one_each(Self::calls(work), answers)
    }

    fn judge(
        tally: &mut Tally,
        _: &Spec,
        tier: Tier,
        work: &BoxWork,
        answers: &Vec<Option<[f64; 2]>>,
    ) {
        judge::boxes(tally, tier, &work.boxes, &work.probes, answers);
    }

    fn lines(work: &BoxWork, answers: &Vec<Option<[f64; 2]>>) -> Option<Content> {
        let lines = each(&work.probes, answers, |probe, answer| {
            let interval: Fields = answer
                .iter()
                .map(|&[min, max]| field("inside", Value::Range(min, max)))
                .collect();
            let question = ray_at(Some(probe.shape), &probe.ray);
            forms(question, interval.clone(), interval)
        });
        Some((Vec::new(), lines))
    }

    fn repro(tier: Tier, work: &BoxWork, call: usize) -> Option<String> {
        repro::interval(tier, &work.boxes, work.probes.get(call)?)
    }

    fn colours(answers: &Vec<Option<[f64; 2]>>) -> Option<Vec<Xyz>> {
        let entries = answers
            .iter()
            .map(|inside| inside.map(|[enters, _]| enters));
        Some(entries.map(picture::distance).collect())
    }
}
