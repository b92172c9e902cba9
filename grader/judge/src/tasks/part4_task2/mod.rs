//! `part4.task2`: paths.

mod call;
pub(crate) mod cases;
mod draws;
mod judge;
mod lines;
mod moves;
mod simple;
mod throughput;
mod truth;

use crate::tools::Tier;
use crate::tools::check::{CaseContext, Check, in_range, one_each};
use crate::tools::findings::{Aspect, Findings};
use crate::tools::moves::{LightMoves, Move, Symmetries};
use crate::tools::shown::ShownCall;
use crate::tools::snapshot::Content;
use crate::tools::snapshot::lines::each;
use wire::global::{PathAnswer, ScriptedPath};
use wire::kind;

impl Check for kind::Paths {
    const MAIN: &'static [Aspect] = &[Aspect::Radiance];

    fn calls(paths: &Vec<ScriptedPath>) -> usize {
        paths.len()
    }

    fn fits(paths: &Vec<ScriptedPath>, answers: &Vec<PathAnswer>) -> Result<(), String> {
        one_each(Self::calls(paths), answers)?;
        for (call, (path, answer)) in paths.iter().zip(answers).enumerate() {
            for (surface, ..) in &answer.samples {
                in_range("surface", call, *surface, path.steps.len())?;
            }
        }
        Ok(())
    }

    fn look_up_truth(paths: &Vec<ScriptedPath>) {
        for path in paths {
            truth::Right::of(path);
        }
    }

    const NOT_MOVED: &'static str = "no light reaches the paths";

    fn symmetries(paths: &Vec<ScriptedPath>) -> Symmetries {
        let mut light = Vec::new();
        for path in paths {
            moves::multiplied(path, |colour| {
                light.extend(colour);
                colour
            });
        }
        Symmetries {
            light: LightMoves::of_channels(light),
            ..Symmetries::default()
        }
    }

    fn moved(paths: &Vec<ScriptedPath>, by: &Move) -> Vec<ScriptedPath> {
        let each = paths.iter();
        each.map(|path| moves::multiplied(path, |light| by.light(light)))
            .collect()
    }

    fn moved_back(answers: &Vec<PathAnswer>, back: &Move) -> Vec<PathAnswer> {
        let each = answers.iter().map(|answer| PathAnswer {
            radiance: back.light(answer.radiance),
            ..answer.clone()
        });
        each.collect()
    }

    fn judge(
        findings: &mut Findings,
        _: &CaseContext<'_>,
        _: Tier,
        paths: &Vec<ScriptedPath>,
        answers: &Vec<PathAnswer>,
    ) {
        judge::paths(findings, paths, answers);
    }

    fn lines(paths: &Vec<ScriptedPath>, answers: &Vec<PathAnswer>) -> Option<Content> {
        Some((Vec::new(), each(paths, answers, lines::path)))
    }

    fn simple(_: &Vec<ScriptedPath>) -> Vec<Vec<ScriptedPath>> {
        simple::questions()
    }

    fn input(work: &Vec<ScriptedPath>, call: usize) -> Option<String> {
        call::input(work, call)
    }

    fn circumstances(work: &Vec<ScriptedPath>, call: usize) -> Option<Vec<&'static str>> {
        call::circumstances(work, call)
    }

    fn shown(
        paths: &Vec<ScriptedPath>,
        _: Tier,
        _: bool,
        call: usize,
        answers: Option<&Vec<PathAnswer>>,
    ) -> Option<ShownCall> {
        call::shown(paths, call, answers)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Calls are told in words, not as code writes them.
    #[test]
    fn calls_of_other_functions_are_told_in_words() {
        let specs = cases::cases(0);
        let paths = specs.iter().filter_map(|spec| match &spec.work {
            wire::Work::Paths(paths) => Some(paths),
            _ => None,
        });
        let messages: Vec<String> = paths
            .flat_map(|paths| {
                let mut findings = Findings::default();
                let answer = PathAnswer {
                    direct: vec![(0, [0.0, -0.0, 1.0])],
                    roulette_calls: vec![([0.5; 3], 2, 0.25)],
                    ..PathAnswer::default()
                };
                judge::paths(&mut findings, paths, &vec![answer; paths.len()]);
                let worst = findings
                    .into_vec()
                    .into_iter()
                    .filter_map(|found| found.worst);
                worst
                    .map(|worst| worst.message.to_string())
                    .collect::<Vec<_>>()
            })
            .collect();
        let text = messages.join("\n");
        for says in [
            "your calls of direct: surface 0 with wo = (0.0, 0.0, 1.0); expected: ",
            "your calls of roulette: throughput (0.5, 0.5, 0.5) after 2 bounces; expected: ",
            "; expected: none",
        ] {
            assert!(text.contains(says), "{text}");
        }
        for code in ["Vec3", "[(", "([", "-0.0,"] {
            assert!(!text.contains(code), "{code}: {text}");
        }
    }

    #[test]
    fn a_sample_at_a_surface_that_is_not_there_does_not_fit() {
        let paths = cases::cases(0)
            .into_iter()
            .find_map(|spec| match spec.work {
                wire::Work::Paths(paths) => Some(paths),
                _ => None,
            });
        let paths = paths.expect("the cases have paths");
        let fits = |surface: usize| {
            let answer = PathAnswer {
                samples: vec![(surface as u32, [0.0; 3], [0.0; 3])],
                ..PathAnswer::default()
            };
            let mut answers = vec![PathAnswer::default(); paths.len()];
            answers[0] = answer;
            kind::Paths::fits(&paths, &answers)
        };
        let surfaces = paths[0].steps.len();
        assert_eq!(fits(surfaces - 1), Ok(()));
        let why = format!("call 0 has the surface index {surfaces}, expected one below {surfaces}");
        assert_eq!(fits(surfaces), Err(why));
    }
}
