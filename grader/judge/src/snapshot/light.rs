//! Lines for answers about light.

use super::line::Value;
use super::write::{Fields, Forms, field, forms, number, vector};
use wire::adaptive::{AdaptiveAnswer, AdaptivePixel, StopAnswer, StopCall};
use wire::direct::{DirectAnswer, DirectWork, LambertAnswer, LambertProbe};
use wire::global::{PathAnswer, RouletteWork, ScriptedPath, SpecularAnswer, SpecularCall};
use wire::light::BsdfSample;
use wire::work::Xyz;
use wire::{Answer, Work};

/// The lines of `answer` to `work`, if they are about light.
pub(super) fn lines(work: &Work, answer: &Answer) -> Option<Vec<Forms>> {
    Some(match (work, answer) {
        (Work::Lambert(probes), Answer::Lambert(answers)) => each(probes, answers, lambert),
        (Work::Direct(work), Answer::Direct(answers)) => direct(work, answers),
        (Work::Specular(calls), Answer::Specular(answers)) => each(calls, answers, specular),
        (Work::Paths(paths), Answer::Paths(answers)) => each(paths, answers, path),
        (Work::Roulette(work), Answer::Roulette(answers)) => roulette(work, answers),
        (Work::Stop(calls) | Work::SureStop(calls), Answer::Stop(answers)) => {
            each(calls, answers, stop)
        }
        (Work::AdaptivePixels(works), Answer::AdaptivePixels(answers)) => {
            each(works, answers, pixel)
        }
        _ => return None,
    })
}

fn each<Q, A>(questions: &[Q], answers: &[A], line: impl Fn(&Q, &A) -> Forms) -> Vec<Forms> {
    let pairs = questions.iter().zip(answers);
    pairs
        .map(|(question, answer)| line(question, answer))
        .collect()
}

fn lambert(probe: &LambertProbe, answer: &LambertAnswer) -> Forms {
    let question = vec![
        field("reflectance", vector(&probe.reflectance)),
        field("wo", vector(&probe.wo)),
        field("wi", vector(&probe.wi)),
        field("u", vector(&probe.u)),
    ];
    let mut short = vec![field("f", vector(&answer.f)), number("pdf", answer.pdf)];
    let mut full = short.clone();
    if let Some(drawn) = &answer.sample {
        short.push(field("drawn", vector(&drawn.wi)));
        full.extend(sample("drawn", drawn));
    }
    forms(question, short, full)
}

fn sample(name: &str, sample: &BsdfSample) -> Fields {
    vec![
        field(name, vector(&sample.wi)),
        field("drawn_f", vector(&sample.f)),
        number("drawn_pdf", sample.pdf),
    ]
}

fn direct(work: &DirectWork, answers: &[DirectAnswer]) -> Vec<Forms> {
    each(&work.points, answers, |point, answer| {
        let question = vec![
            field("p", vector(&point.p)),
            field("n", vector(&point.n)),
            field("wo", vector(&point.wo)),
        ];
        let short = vec![
            field("radiance", vector(&answer.radiance)),
            number("rays", answer.asked.len() as f64),
        ];
        let mut full = short.clone();
        full.extend(answer.asked.iter().take(2).flat_map(|asked| {
            [
                field("d", vector(&asked.ray.d)),
                number("max_t", asked.ray.max_t),
            ]
        }));
        forms(question, short, full)
    })
}

fn specular(call: &SpecularCall, answer: &SpecularAnswer) -> Forms {
    let wo = |wo: Xyz| field("wo", vector(&wo));
    let question = match *call {
        SpecularCall::Fresnel { cos_i, eta } => vec![number("cos", cos_i), number("eta", eta)],
        SpecularCall::Reflect { wo: w } | SpecularCall::Mirror { wo: w, .. } => vec![wo(w)],
        SpecularCall::Refract { wo: w, ior } | SpecularCall::Refraction { wo: w, ior, .. } => {
            vec![wo(w), number("ior", ior)]
        }
        SpecularCall::Glass {
            wo: w, ior, choice, ..
        } => vec![wo(w), number("ior", ior), number("choice", choice)],
    };
    let answer = match answer {
        SpecularAnswer::Share(share) => vec![number("share", *share)],
        SpecularAnswer::Direction(wi) => {
            let wi = wi.iter().map(|wi| field("wi", vector(wi)));
            wi.collect()
        }
        SpecularAnswer::Sample(drawn) => {
            let drawn = drawn.iter().flat_map(|drawn| sample("wi", drawn));
            drawn.collect()
        }
    };
    forms(question, answer.clone(), answer)
}

fn path(path: &ScriptedPath, answer: &PathAnswer) -> Forms {
    let question = vec![
        number("max_depth", f64::from(path.max_depth)),
        number("surfaces", path.steps.len() as f64),
        field("d", vector(&path.ray.d)),
    ];
    let short = vec![
        field("radiance", vector(&answer.radiance)),
        number("rays", answer.rays.len() as f64),
        number("games", answer.games.len() as f64),
    ];
    let mut full = short.clone();
    let throughputs = answer.games.iter().take(2);
    full.extend(throughputs.map(|(throughput, _, _)| field("throughput", vector(throughput))));
    forms(question, short, full)
}

fn roulette(work: &RouletteWork, answers: &[Option<Xyz>]) -> Vec<Forms> {
    let games: Vec<(Xyz, u32, f64)> = work
        .paths
        .iter()
        .flat_map(|path| work.numbers.iter().map(move |u| (path.0, path.1, *u)))
        .collect();
    each(&games, answers, |(throughput, bounces, u), answer| {
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
    })
}

fn stop(call: &StopCall, answer: &StopAnswer) -> Forms {
    let runs = call.runs.iter().take(4);
    let mut question: Fields = runs
        .map(|&(count, x)| field("run", vector(&[f64::from(count), x])))
        .collect();
    question.push(number("tolerance", call.tolerance));
    let answer = vec![
        number("stop", f64::from(u8::from(answer.stop))),
        number("asked", answer.asked.len() as f64),
    ];
    forms(question, answer.clone(), answer)
}

fn pixel(work: &AdaptivePixel, answer: &AdaptiveAnswer) -> Forms {
    let question = vec![
        field("pixel", vector(&work.pixel.map(f64::from))),
        number("ns_aa", f64::from(work.ns_aa)),
        number("batch", f64::from(work.batch)),
        number("tolerance", work.tolerance),
    ];
    let short = vec![
        number("samples", f64::from(answer.samples)),
        field("radiance", vector(&answer.radiance)),
        number("looks", answer.looks.len() as f64),
    ];
    let mut full = short.clone();
    full.extend(
        answer
            .looks
            .iter()
            .take(2)
            .map(|&(count, mean, variance, _)| {
                field("look", Value::Vector(vec![count as f64, mean, variance]))
            }),
    );
    forms(question, short, full)
}
