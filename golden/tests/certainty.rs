//! What judging by chance is sure to see: each case that does so says it to students, the reference's answers bear it out,
//! and answers that are off by as much are caught.

use judge::Tier;
use judge::cases::{self, Spec};
use judge::tally::{Aspect, Finding};
use std::f64::consts::{SQRT_2, TAU};
use wire::global::SpecularAnswer;
use wire::work::Xyz;
use wire::{Answer, Outcome};

/// A case says at most this many times what is sure: whoever says 90 % of everything says nothing.
const LOOSEST: f64 = 1.4;

/// How much more than what is stated the wrong answers here are off.
const JUST_ABOVE: f64 = 1.02;

/// What the reference answers; `None` in a handout.
fn reference(spec: &Spec) -> Option<Answer> {
    match worker::run(0, &spec.case()).outcome {
        Outcome::Answered(answer) => Some(answer),
        Outcome::NotAttempted { .. } => None,
        outcome => panic!("{} {}: {outcome:?}", spec.task, spec.name),
    }
}

/// The share that `about` says is sure to be seen of what judges `aspect`.
fn stated(spec: &Spec, aspect: Aspect) -> Option<f64> {
    let start = match aspect {
        Aspect::Mean => "A bias of ",
        Aspect::Spread => "A deviation of ",
        _ => return None,
    };
    let (_, rest) = spec.about.split_once(start)?;
    let (percent, rest) = rest.split_once(" %")?;
    assert!(rest.starts_with(" is always detected"), "{}", spec.name);
    Some(percent.parse::<f64>().ok()? / 100.0)
}

/// The cases that are judged by chance, with what the reference answers and what that is sure to show.
fn by_chance(seed: u64) -> Vec<(Spec, Answer, Vec<Finding>)> {
    let light = |spec: &Spec| ["part3", "part4", "part5"].contains(&&spec.task[..5]);
    let specs = cases::all(seed).into_iter().filter(light);
    let answered = specs.filter_map(|spec| reference(&spec).map(|answer| (spec, answer)));
    answered
        .map(|(spec, answer)| {
            let mut findings = judge::judge(&spec, Tier::Core, &answer);
            findings.retain(|finding| finding.detectable.is_some());
            (spec, answer, findings)
        })
        .filter(|(.., findings)| !findings.is_empty())
        .collect()
}

#[test]
fn each_case_states_what_it_is_sure_to_see() {
    let mut unlike = Vec::new();
    for seed in [0, 1] {
        for (spec, _, findings) in by_chance(seed) {
            for finding in findings {
                let name = format!("{} {} {:?}", spec.task, spec.name, finding.aspect);
                assert!(finding.passed(), "{name}: {:?}", finding.worst);
                let sure = finding.detectable.expect("those without are left out");
                let stated = stated(&spec, finding.aspect);
                if !stated.is_some_and(|stated| sure <= stated && stated <= LOOSEST * sure) {
                    unlike.push(format!(
                        "{name}: a share of {sure:.4} is always detected, the case states {stated:?}"
                    ));
                }
            }
        }
    }
    assert!(unlike.is_empty(), "{}", unlike.join("\n"));
}

#[test]
fn answers_that_are_off_by_what_is_stated_are_caught() {
    for (spec, answer, findings) in by_chance(0) {
        for finding in findings {
            let share = stated(&spec, finding.aspect).expect("the other test asks for it");
            for off in [JUST_ABOVE * share, -JUST_ABOVE * share] {
                let wrong = match finding.aspect {
                    Aspect::Mean => biased(&answer, off),
                    _ => uneven(&answer, off),
                };
                let judged = judge::judge(&spec, Tier::Core, &wrong);
                let same = judged.iter().find(|other| other.aspect == finding.aspect);
                assert!(
                    same.is_some_and(|same| !same.passed()),
                    "{} {}: {:?} off by {off} gets away",
                    spec.task,
                    spec.name,
                    finding.aspect
                );
            }
        }
    }
}

/// In a handout of Part 3 nothing is judged here; with the reference these are.
#[test]
fn there_are_cases_judged_by_chance() {
    let cases = by_chance(0);
    let of = |task: &str| cases.iter().filter(|(spec, ..)| spec.task == task).count();
    let solved = |task: &str| {
        let specs = cases::all(0);
        let first = specs.iter().find(|spec| spec.task == task);
        first.is_some_and(|spec| reference(spec).is_some())
    };
    for (task, least) in [
        ("part3.task1", 2),
        ("part3.task2", 4),
        ("part3.task3", 5),
        ("part4.task1", 1),
        ("part4.task3", 1),
    ] {
        assert!(!solved(task) || of(task) >= least, "{task}: {}", of(task));
    }
}

/// The same answers with a mean that is off by this share.
fn biased(answer: &Answer, off: f64) -> Answer {
    let scaled = |colour: &mut Xyz| *colour = colour.map(|channel| channel * (1.0 + off));
    let mut answer = answer.clone();
    match &mut answer {
        Answer::Direct(answers) => answers
            .iter_mut()
            .for_each(|answer| scaled(&mut answer.radiance)),
        Answer::Roulette(answers) => answers.iter_mut().flatten().for_each(scaled),
        Answer::Specular(answers) => {
            let heights = answers.iter_mut().filter_map(|answer| match answer {
                SpecularAnswer::Sample(Some(sample)) => Some(&mut sample.wi[2]),
                _ => None,
            });
            // Seen from above: what goes up is reflected.
            let (up, down): (Vec<_>, Vec<_>) = heights.partition(|height| **height > 0.0);
            let turned = (off.abs() * up.len() as f64).ceil() as usize;
            let from = if off > 0.0 { down } else { up };
            from.into_iter()
                .take(turned)
                .for_each(|height| *height = -*height);
        }
        _ => panic!("no mean is judged of this kind of answer"),
    }
    answer
}

/// The same answers with directions crowded around the normal in two places, so that the root mean square of their
/// deviation is this share.
fn uneven(answer: &Answer, off: f64) -> Answer {
    let mut answer = answer.clone();
    match &mut answer {
        Answer::Lambert(answers) => {
            let samples = answers
                .iter_mut()
                .filter_map(|answer| answer.sample.as_mut());
            samples.for_each(|sample| crowd(&mut sample.wi, [0, 1], off));
        }
        // The surface lies in the plane of x and z.
        Answer::Direct(answers) => {
            let asked = answers.iter_mut().flat_map(|answer| &mut answer.rays);
            asked.for_each(|asked| crowd(&mut asked.ray.d, [2, 0], off));
        }
        _ => panic!("no spread is judged of this kind of answer"),
    }
    answer
}

/// Turns a direction about the third axis, so that of many the density differs by the factor `1 + √2·off·cos 2φ`.
fn crowd(d: &mut Xyz, [a, b]: [usize; 2], off: f64) {
    let (even, radius) = (d[b].atan2(d[a]).rem_euclid(TAU), d[a].hypot(d[b]));
    let (mut low, mut high) = (0.0, TAU);
    for _ in 0..50 {
        let phi: f64 = 0.5 * (low + high);
        let below = phi + 0.5 * SQRT_2 * off * (2.0 * phi).sin();
        if below < even {
            low = phi;
        } else {
            high = phi;
        }
    }
    (d[a], d[b]) = (radius * high.cos(), radius * high.sin());
}
