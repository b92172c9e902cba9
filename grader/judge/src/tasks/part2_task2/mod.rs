//! `part2.task2`: intervals of rays inside boxes.

mod call;
pub(crate) mod cases;
mod judge;
mod repro;
mod simple;

use crate::tools::check::{CaseContext, Check, one_each};
use crate::tools::findings::{Aspect, Findings};
use crate::tools::moves::{AxisMoves, Move, Symmetries, most_if_ordinary, ray_numbers};
use crate::tools::plural;
use crate::tools::shown::ShownCall;
use crate::tools::simple::numbers::{self, Number};
use crate::tools::snapshot::Content;
use crate::tools::snapshot::lines::{each, ray_at};
use crate::tools::snapshot::{Fields, Value, field, forms};
use crate::tools::{Tier, colours};
use wire::kind;
use wire::work::{BoxWork, Ray, Xyz};

impl Check for kind::Boxes {
    const MAIN: &'static [Aspect] = &[Aspect::HitOrMiss, Aspect::Interval];

    fn calls(work: &BoxWork) -> usize {
        work.probes.len()
    }

    fn only_call(work: &BoxWork, call: usize) -> Option<BoxWork> {
        Some(BoxWork {
            boxes: work.boxes.clone(),
            probes: vec![*work.probes.get(call)?],
        })
    }

    fn fits(work: &BoxWork, answers: &Vec<Option<[f64; 2]>>) -> Result<(), String> {
        one_each(Self::calls(work), answers)
    }

    /// Where plain slabs compute 0 · ∞, it depends on the order of the axes what becomes of the
    /// NaN.
    fn symmetries(work: &BoxWork) -> Symmetries {
        let rays = || work.probes.iter().map(|probe| &probe.ray);
        let numbers = work
            .boxes
            .iter()
            .flatten()
            .flatten()
            .copied()
            .chain(rays().flat_map(ray_numbers));
        let is_plain = work.probes.iter().all(|probe| {
            let [min, max] = work.boxes[probe.shape as usize];
            let Ray { o, d, .. } = probe.ray;
            (0..3).all(|i| {
                let is_finite = (min[i] + max[i] + o[i] + d[i]).is_finite();
                is_finite && (d[i] != 0.0 || o[i] != min[i] && o[i] != max[i])
            })
        });
        Symmetries {
            axes: match is_plain {
                true => AxisMoves::Permutations,
                false => AxisMoves::Fixed,
            },
            lengths: most_if_ordinary(2, numbers),
            ..Symmetries::default()
        }
    }

    fn moved(work: &BoxWork, by: &Move) -> BoxWork {
        BoxWork {
            boxes: work.boxes.iter().map(|b| by.corners(*b)).collect(),
            probes: work.probes.iter().map(|probe| by.probe(probe)).collect(),
        }
    }

    fn moved_back(answers: &Vec<Option<[f64; 2]>>, back: &Move) -> Vec<Option<[f64; 2]>> {
        let each = answers.iter();
        each.map(|inside| inside.map(|ends| ends.map(|t| back.t(t))))
            .collect()
    }

    fn judge(
        findings: &mut Findings,
        _: &CaseContext<'_>,
        tier: Tier,
        work: &BoxWork,
        answers: &Vec<Option<[f64; 2]>>,
    ) {
        judge::boxes(findings, tier, &work.boxes, &work.probes, answers);
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

    fn input(work: &BoxWork, call: usize) -> Option<String> {
        call::input(work, call)
    }

    fn circumstances(work: &BoxWork, call: usize) -> Option<Vec<&'static str>> {
        call::circumstances(work, call)
    }

    fn exact(work: &BoxWork, _: bool, calls: &[u32]) -> Option<Vec<Fields>> {
        Some(call::exact(work, calls))
    }

    fn shown(
        work: &BoxWork,
        _: Tier,
        _: bool,
        call: usize,
        answer: Option<&Vec<Option<[f64; 2]>>>,
    ) -> Option<ShownCall> {
        call::shown(work, call, answer)
    }

    fn overview(work: &BoxWork) -> String {
        format!(
            "{}; {}",
            plural(work.boxes.len(), "box", "boxes"),
            plural(work.probes.len(), "ray", "rays")
        )
    }

    fn repro(tier: Tier, work: &BoxWork, call: usize) -> Option<String> {
        repro::interval(tier, &work.boxes, work.probes.get(call)?)
    }

    fn colours(answers: &Vec<Option<[f64; 2]>>) -> Option<Vec<Xyz>> {
        let entries = answers
            .iter()
            .map(|inside| inside.map(|[enters, _]| enters));
        Some(entries.map(colours::distance).collect())
    }

    fn vary(work: &mut BoxWork, change: &mut dyn FnMut(Number, &mut f64)) {
        for corner in work.boxes.iter_mut().flatten() {
            numbers::point(corner, Number::Length, change);
        }
        numbers::rays(&mut work.probes, change);
    }

    fn simple(_: &BoxWork) -> Vec<BoxWork> {
        simple::questions()
    }
}
