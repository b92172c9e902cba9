//! Judges the random numbers of a path, and the directions that it samples with them.

use super::judge::PLACE_BOUND;
use super::truth::Right;
use crate::plural;
use crate::tools::aspects::numbers;
use crate::tools::findings::{Aspect, Class, Findings};
use kit::{Frame, PixelSampler, Vec3};
use std::collections::{BTreeSet, HashSet};
use wire::global::{PathAnswer, ScriptedPath};

/// Judges the calls of `sample`: `wo` is in local space, and each random number comes from the
/// path's sampler and is used once.
pub(super) fn judge(
    findings: &mut Findings,
    call: usize,
    path: &ScriptedPath,
    answer: &PathAnswer,
    right: &Right,
    about: &impl Fn() -> String,
) {
    if answer.samples.is_empty() {
        return;
    }
    findings.expect(Aspect::SampledDirection);
    for (i, wo, _) in &answer.samples {
        let Some(d) = right.directions.get(*i as usize) else {
            continue;
        };
        let frame = Frame::around(path.steps[*i as usize].n.into());
        let (local, aspect) = (frame.to_local(-Vec3::from(*d)), Aspect::SampledDirection);
        numbers::direction(findings, aspect, call, *wo, local, PLACE_BOUND, || {
            format!("wo of surface {i} in its local space. {}", about())
        });
    }
    findings.expect(Aspect::Spread);
    let drawn = answer.samples.iter().flat_map(|(_, _, numbers)| *numbers);
    let roulette = answer.roulette_calls.iter().map(|(_, _, u)| *u);
    let all: Vec<u64> = drawn.chain(roulette).map(f64::to_bits).collect();
    let different = all.iter().collect::<BTreeSet<_>>().len();
    let own = numbers_of_sampler(call, path);
    let is_of_sampler = all.iter().any(|number| own.contains(number));
    let class = if !is_of_sampler {
        Some(Class::Named("of another sampler"))
    } else {
        (different != all.len()).then_some(Class::of_size(1.0))
    };
    findings.judge_class(Aspect::Spread, call, class, 1.0, || {
        let numbers = all.len();
        if !is_of_sampler {
            return format!(
                "none of {numbers} random numbers comes from the sampler that the function is given: draw each with its next_2d or next_1d, so that other pixels and seeds have other paths. {}",
                about()
            );
        }
        format!(
            "the {numbers} random numbers have only {}: use each once. {}",
            plural(different, "value", "values"),
            about()
        )
    });
}

/// The numbers, as bits, that code can draw from the sampler of the path: more than a path needs,
/// and those of its next samples, too.
fn numbers_of_sampler(call: usize, path: &ScriptedPath) -> HashSet<u64> {
    let most = 8 * (path.steps.len() + 2);
    let call = u32::try_from(call).unwrap_or(u32::MAX);
    let mut sampler = PixelSampler::new(call, 0, path.seed);
    let mut numbers = HashSet::new();
    // 0: before the first sample starts.
    for _ in 0..path.steps.len() + 3 {
        let mut of_sample = sampler.clone();
        numbers.extend((0..most).map(|_| of_sample.next_1d().to_bits()));
        sampler.start_sample();
    }
    numbers
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases;
    use wire::Work;
    use wire::work::Xyz;

    /// The class of the random numbers of a path, call number 3 of its case, that draws them from
    /// `sampler`. With `repeat`, roulette gets a number that chose the direction.
    fn class(sampler: impl Fn(u64) -> PixelSampler, repeat: bool) -> Option<Class> {
        let specs = cases::of("part4.task2", 0);
        let spec = specs.iter().find(|spec| spec.name == "drawn_directions");
        let Some(Work::Paths(paths)) = spec.map(|spec| &spec.work) else {
            panic!("the case is there")
        };
        let path = &paths[0];
        let mut sampler = sampler(path.seed);
        sampler.get_sample();
        let wo: Xyz = [0.0, 0.0, 1.0];
        let mut answer = PathAnswer::default();
        for surface in 0..3 {
            let (u, choice) = (sampler.next_2d(), sampler.next_1d());
            answer.samples.push((surface, wo, [u.x, u.y, choice]));
            let u = if repeat { choice } else { sampler.next_1d() };
            answer.roulette_calls.push((wo, surface, u));
        }
        let mut findings = Findings::default();
        let right = Right::of(path);
        judge(&mut findings, 3, path, &answer, &right, &String::new);
        let list = findings.into_vec();
        let spread = list.iter().find(|one| one.aspect == Aspect::Spread);
        spread?.faults.first().map(|fault| fault.class)
    }

    #[test]
    fn random_numbers_come_from_the_sampler_and_are_used_once() {
        let own = |seed| PixelSampler::new(3, 0, seed);
        assert_eq!(class(own, false), None);
        assert!(matches!(class(own, true), Some(Class::Off(_))));
        let another = Some(Class::Named("of another sampler"));
        assert_eq!(class(|_| PixelSampler::new(0, 0, 0), false), another);
        assert_eq!(
            class(|seed| PixelSampler::new(3, 0, seed + 1), false),
            another
        );
    }
}
