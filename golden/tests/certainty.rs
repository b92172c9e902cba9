//! Tests the smallest error that a statistical test always detects. The text of each case with
//! such a test states this error: the reference's answers pass, and answers with this error fail.

use crate::shared::{AfterTheGoldens, moved_back};
use judge::Tier;
use judge::cases::{self, Spec};
use judge::findings::{Aspect, Finding};
use std::f64::consts::{SQRT_2, TAU};
use std::sync::LazyLock;
use wire::global::SpecularAnswer;
use wire::work::Xyz;
use wire::{Answer, Work};

/// A case may state at most this multiple of the bias that is certainly detected: a statement such
/// as "90 %" in every case would be true but useless.
const LOOSEST: f64 = 1.4;

/// The errors of the wrong answers here are this multiple of the stated ones.
const JUST_ABOVE: f64 = 1.02;

/// The bias or deviation of `aspect` that is always detected, as `about` states it.
fn stated(spec: &Spec, aspect: Aspect) -> Option<f64> {
    let start = match aspect {
        Aspect::Mean => "A bias of ",
        Aspect::Spread => "A deviation of ",
        Aspect::Independence => "A correlation of ",
        _ => return None,
    };
    let (_, rest) = spec.about.split_once(start)?;
    let (percent, rest) = rest.split_once(" %")?;
    assert!(rest.starts_with(" is always detected"), "{}", spec.name);
    Some(percent.parse::<f64>().ok()? / 100.0)
}

/// A case with the reference's answer and the findings of its statistical tests.
type Judged = (Spec, Answer, Vec<Finding>);

/// The cases of seed 0 that have statistical tests.
static OF_SEED_0: LazyLock<Vec<Judged>> = LazyLock::new(|| with_statistical_tests(0));

/// The cases of a seed that have statistical tests.
fn with_statistical_tests(seed: u64) -> Vec<Judged> {
    let draws = |spec: &Spec| {
        spec.task == "part1.task1" || ["part3", "part4", "part5"].contains(&&spec.task[..5])
    };
    let specs = cases::all(seed).into_iter().filter(draws);
    let answered = specs.filter_map(|spec| moved_back(&spec).map(|answer| (spec, answer)));
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
fn each_case_states_what_it_always_detects() {
    let _begin = AfterTheGoldens;
    let mut unlike = Vec::new();
    let of_seed_1 = with_statistical_tests(1);
    for (spec, _, findings) in OF_SEED_0.iter().chain(&of_seed_1) {
        for finding in findings {
            let name = format!("{} {} {:?}", spec.task, spec.name, finding.aspect);
            assert!(finding.passed(), "{name}: {:?}", finding.worst);
            let sure = finding.detectable.expect("those without are left out");
            let stated = stated(spec, finding.aspect);
            if !stated.is_some_and(|stated| sure <= stated && stated <= LOOSEST * sure) {
                unlike.push(format!(
                    "{name}: a relative error of {sure:.4} is always detected, the case states {stated:?}"
                ));
            }
        }
    }
    assert!(unlike.is_empty(), "{}", unlike.join("\n"));
}

#[test]
fn answers_with_the_stated_error_fail() {
    let _begin = AfterTheGoldens;
    for (spec, answer, findings) in OF_SEED_0.iter() {
        for finding in findings {
            let share = stated(spec, finding.aspect).expect("the other test checks it");
            for off in [JUST_ABOVE * share, -JUST_ABOVE * share] {
                let wrong = match finding.aspect {
                    Aspect::Mean => biased(answer, off),
                    Aspect::Independence => correlated(spec, answer, off),
                    _ => uneven(answer, off),
                };
                let judged = judge::judge(spec, Tier::Core, &wrong);
                let same = judged.iter().find(|other| other.aspect == finding.aspect);
                assert!(
                    same.is_some_and(|same| !same.passed()),
                    "{} {}: {:?} off by {off} is not detected",
                    spec.task,
                    spec.name,
                    finding.aspect
                );
            }
        }
    }
}

/// Tests that the tasks that are solved have statistical tests. In a handout of Part 3 none is
/// solved.
#[test]
fn there_are_cases_with_statistical_tests() {
    let _begin = AfterTheGoldens;
    let of = |task: &str| {
        OF_SEED_0
            .iter()
            .filter(|(spec, ..)| spec.task == task)
            .count()
    };
    let solved = |task: &str| {
        let specs = cases::all(0);
        let first = specs.iter().find(|spec| spec.task == task);
        first.is_some_and(|spec| moved_back(spec).is_some())
    };
    for (task, least) in [
        ("part1.task1", 2),
        ("part3.task1", 2),
        ("part3.task2", 4),
        ("part3.task3", 5),
        ("part4.task1", 1),
        ("part4.task3", 1),
        ("part5.task1", 2),
    ] {
        assert!(!solved(task) || of(task) >= least, "{task}: {}", of(task));
    }
}

/// The same answers with a mean whose relative error is `off`.
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
        _ => panic!("this kind of answer has no mean to judge"),
    }
    answer
}

/// The same answers, with the samples moved along x: the mean positions in the pixels of successive
/// calls have the correlation `r`.
fn correlated(spec: &Spec, answer: &Answer, r: f64) -> Answer {
    /// Shrinks the positions towards the centre of the pixel, so that they stay inside it.
    const SHRINK: f64 = 0.3;
    let mut answer = answer.clone();
    let points: Vec<&mut Vec<[f64; 2]>> = match &mut answer {
        Answer::Pixels(answers) => answers.iter_mut().map(|one| &mut one.points).collect(),
        Answer::AdaptivePixels(answers) => answers.iter_mut().map(|one| &mut one.points).collect(),
        _ => panic!("this kind of answer has no positions to judge"),
    };
    let columns: Vec<(u32, u32)> = match &spec.work {
        Work::Pixels(work) => work.calls().map(|(p, _)| (p[0], work.film[0])).collect(),
        Work::AdaptivePixels(works) => works.iter().map(|w| (w.pixel[0], w.film[0])).collect(),
        _ => panic!("this kind of work has no pixels"),
    };
    // An autoregressive process: each mean is r times the one before, plus what is new.
    let mut before = 0.0;
    for (points, (column, width)) in points.into_iter().zip(columns) {
        let (column, width) = (f64::from(column), f64::from(width));
        let from_center = |point: &[f64; 2]| point[0] * width - column - 0.5;
        let own = points.iter().map(from_center).sum::<f64>() / points.len() as f64;
        let mean = r * before + (1.0 - r * r).sqrt() * own;
        for point in points {
            let moved = SHRINK * (from_center(point) - own + mean);
            point[0] = (column + 0.5 + moved) / width;
        }
        before = mean;
    }
    answer
}

/// The same answers, with directions turned around the normal so that they are denser on two sides.
/// The root mean square of the relative deviation of their density is `off`.
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
        _ => panic!("this kind of answer has no distribution to judge"),
    }
    answer
}

/// Turns a direction about the third axis. Turned in this way, uniform directions have a density
/// that is multiplied by `1 + √2·off·cos 2φ`.
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
