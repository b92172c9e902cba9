//! Judges the intervals of rays inside boxes.

use crate::tools::Tier;
use crate::tools::aspects::hits;
use crate::tools::convert;
use crate::tools::findings::{Aspect, Class, Findings, Message};
use kit::{Aabb, Interval, Vec3};
use oracle::{self, BoxJudgement, KernelClass};
use wire::work::{Probe, Xyz};

/// Judges the results of `intersect_bbox` by the exact oracle.
///
/// In a tree, a false miss of a box is a hole in the picture, a false hit only costs time. So a
/// false miss is always wrong, and a false hit only if the ray misses by more than rounding errors.
pub(crate) fn boxes(
    findings: &mut Findings,
    tier: Tier,
    boxes: &[[Xyz; 2]],
    probes: &[Probe],
    answers: &[Option<[f64; 2]>],
) {
    let kernel = match tier {
        Tier::Core => KernelClass::Textbook,
        Tier::Robust => KernelClass::Robust,
    };
    for (call, (probe, answer)) in probes.iter().zip(answers).enumerate() {
        let [min, max] = boxes[probe.shape as usize].map(Vec3::from);
        let b = Aabb { min, max };
        let verdict = oracle::bbox(&b, &convert::ray(&probe.ray));
        let judgement = verdict.judge(kernel, answer.map(|[min, max]| Interval { min, max }));
        findings.expect(Aspect::HitOrMiss);
        if verdict.hits() && !verdict.undecidable(kernel) {
            findings.expect(Aspect::Interval);
        }
        if verdict.undecidable(kernel) {
            findings.not_judged(Aspect::HitOrMiss, call, hits::ROUNDING_DECIDES);
        }
        let decided = !matches!(judgement, BoxJudgement::FalseHit | BoxJudgement::FalseMiss);
        let about = || {
            format!(
                "Box: {} to {}. {}",
                hits::show(min),
                hits::show(max),
                hits::show_ray(&probe.ray)
            )
        };
        let ends_before_it_starts = answer.is_some_and(|[from, to]| from > to);
        let class = hits::decision_class(decided, answer.is_some()).map(|class| {
            if ends_before_it_starts {
                Class::Named("ends before it starts")
            } else {
                class
            }
        });
        findings.judge_class(Aspect::HitOrMiss, call, class, 1.0, || match *answer {
            None => {
                let [from, to] = verdict
                    .ends
                    .map_or([f64::NAN; 2], |(near, far)| [near.to_f64(), far.to_f64()]);
                Message::new(format!(
                    "your result: miss; expected: inside from t = {from} to t = {to}"
                ))
                .asked(about())
            }
            Some([from, to]) => {
                let backwards = if ends_before_it_starts {
                    ", which ends before it starts"
                } else {
                    ""
                };
                Message::new(format!(
                    "your result: inside from t = {from} to t = {to}{backwards}; expected: miss"
                ))
                .asked(about())
            }
        });
        let (true, Some([from, to])) = (decided, *answer) else {
            continue;
        };
        let end = match judgement {
            BoxJudgement::WrongStart(t) => Some(("start", from, t)),
            BoxJudgement::WrongEnd(t) => Some(("end", to, t)),
            _ => None,
        };
        let off = end.map_or(0.0, |(_, given, right)| (given - right).abs());
        findings.judge(Aspect::Interval, call, end.is_none(), off, || {
            let (which, given, right) = end.unwrap_or(("", from, from));
            Message::new(format!(
                "your result: the interval {which}s at t = {given}; expected: t = {right}"
            ))
            .compares([given], [right])
            .asked(about())
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wire::work::Ray;

    const UNIT: [[Xyz; 2]; 1] = [[[0.0; 3], [1.0; 3]]];

    fn failed(ray: Ray, answer: Option<[f64; 2]>) -> Vec<Aspect> {
        let mut findings = Findings::default();
        let probe = Probe { shape: 0, ray };
        boxes(&mut findings, Tier::Robust, &UNIT, &[probe], &[answer]);
        findings.wrong_aspects()
    }

    /// Enters the unit box at t = 2, leaves it at t = 3.
    const THROUGH: Ray = Ray {
        o: [0.5, 0.5, -2.0],
        d: [0.0, 0.0, 1.0],
        min_t: 0.0,
        max_t: f64::INFINITY,
    };

    #[test]
    fn a_hit_needs_its_interval() {
        assert_eq!(failed(THROUGH, Some([2.0, 3.0])), []);
        assert_eq!(failed(THROUGH, Some([2.0, 3.0_f64.next_up()])), []);
        assert_eq!(failed(THROUGH, Some([0.0, 3.0])), [Aspect::Interval]);
        assert_eq!(failed(THROUGH, Some([2.0, f64::NAN])), [Aspect::Interval]);
        assert_eq!(failed(THROUGH, None), [Aspect::HitOrMiss, Aspect::Interval]);
    }

    #[test]
    fn a_miss_by_more_than_rounding_is_a_miss() {
        let beside = Ray {
            o: [1.5, 0.5, -2.0],
            ..THROUGH
        };
        assert_eq!(failed(beside, None), []);
        assert_eq!(failed(beside, Some([2.0, 3.0])), [Aspect::HitOrMiss]);
    }

    #[test]
    fn an_interval_that_ends_before_it_starts_has_a_class_of_its_own() {
        let beside = Ray {
            o: [1.5, 0.5, -2.0],
            ..THROUGH
        };
        let class = |answer: [f64; 2]| {
            let probe = Probe {
                shape: 0,
                ray: beside,
            };
            let mut findings = Findings::default();
            boxes(
                &mut findings,
                Tier::Robust,
                &UNIT,
                &[probe],
                &[Some(answer)],
            );
            findings.into_vec()[0].faults[0].class
        };
        assert_eq!(class([2.0, 3.0]), Class::FalseHit);
        assert_eq!(class([3.0, 2.0]), Class::Named("ends before it starts"));
    }

    /// A ray in the plane of a face must not be missed.
    #[test]
    fn a_ray_in_a_face_is_never_missed() {
        let along_the_face = Ray {
            o: [1.0, 0.5, -2.0],
            ..THROUGH
        };
        assert_eq!(failed(along_the_face, Some([2.0, 3.0])), []);
        assert!(!failed(along_the_face, None).is_empty());
    }
}
