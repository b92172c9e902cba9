//! Rendering all that a plan asks for.

use super::curve::{Curve, Experiment, Pictures, Point};
use super::estimate::Truth;
use super::plan::{self, Plan, Way};
use super::program::{Order, Program, Shot};
use grader::error::GraderError;
use grader::speedup::slope;
use grader::workspace::Workspace;

/// Random numbers of the pictures of one run: those of another `--seed` start elsewhere.
const SEEDS_A_RUN: u64 = 1 << 16;

/// Through two points a line goes in any case: it says nothing.
const POINTS_OF_A_LINE: usize = 3;

/// Measures the program of `workspace`. What the student's program cannot render is missing, and it is said why.
pub fn measure(workspace: &Workspace, seed: u64, quick: bool) -> Result<Pictures, GraderError> {
    let program = match Program::build(workspace.root())? {
        Ok(program) => program,
        Err(why) => {
            return Ok(Pictures {
                experiments: Vec::new(),
                missing: Some(why),
            });
        }
    };
    let plans = plan::all(quick);
    let experiments = plans
        .iter()
        .map(|plan| experiment(workspace, &program, plan, seed));
    Ok(Pictures {
        experiments: experiments.collect::<Result<_, _>>()?,
        missing: None,
    })
}

fn experiment(
    workspace: &Workspace,
    program: &Program,
    plan: &Plan,
    seed: u64,
) -> Result<Experiment, GraderError> {
    let mut experiment = Experiment {
        title: plan.title.into(),
        scene: plan.scene.into(),
        film: plan.film,
        cell: plan.cell,
        seeds: plan.seeds,
        converged: plan.converged.clone(),
        is_relative: plan.is_relative,
        converged_rmse: 0.0,
        curves: Vec::new(),
        missing: None,
    };
    let scene = workspace.root().join("scenes/dae").join(plan.scene);
    let first = seed.wrapping_mul(SEEDS_A_RUN);
    let order = Order {
        scene: &scene,
        film: plan.film,
        cell: plan.cell,
        flags: &plan.converged,
        seed: first,
        threads: 1,
    };
    let all = std::thread::available_parallelism().map_or(1, |n| n.get());
    let mut halves = Vec::new();
    for half in 0..2 {
        match program.render(&Order {
            seed: first.wrapping_add(half),
            threads: all,
            ..order
        })? {
            Ok(shot) => halves.push(shot.pixels),
            Err(why) => {
                experiment.missing = Some(why);
                return Ok(experiment);
            }
        }
    }
    let [Some(a), Some(b)] = [halves.pop(), halves.pop()] else {
        return Ok(experiment);
    };
    let Some(truth) = Truth::new(a, b) else {
        experiment.missing = Some("the converged picture is black, or not of numbers".into());
        return Ok(experiment);
    };
    experiment.converged_rmse = truth.rmse();
    // Round by round through all ways, so that a slow minute is shared by all.
    let mut shots: Vec<Vec<Vec<Shot>>> = plan
        .ways
        .iter()
        .map(|w| vec![Vec::new(); w.steps.len()])
        .collect();
    for round in 0..u64::from(plan.seeds) {
        for (way, shots) in plan.ways.iter().zip(&mut shots) {
            for ((step, _), shots) in way.steps.iter().zip(shots) {
                let flags = format!("{} {step}", way.flags);
                match program.render(&Order {
                    seed: first.wrapping_add(2 + round),
                    flags: &flags,
                    ..order
                })? {
                    Ok(shot) => shots.push(shot),
                    Err(why) => experiment.missing = Some(format!("{}: {why}", way.name)),
                }
            }
        }
    }
    let curves = plan.ways.iter().zip(&shots);
    experiment.curves = curves
        .filter_map(|(way, shots)| curve(&truth, way, shots, plan.is_relative))
        .collect();
    if experiment.curves.len() < plan.ways.len() && experiment.missing.is_none() {
        experiment.missing =
            Some("a picture has another size, or values that are no numbers".into());
    }
    Ok(experiment)
}

/// A way whose pictures are all there.
fn curve(truth: &Truth, way: &Way, shots: &[Vec<Shot>], is_relative: bool) -> Option<Curve> {
    let steps = way.steps.iter().zip(shots);
    let points: Vec<Point> = steps
        .map(|((flags, samples), shots)| truth.judge(flags, f64::from(*samples), shots))
        .collect::<Option<_>>()?;
    let falling = Curve::falling(&points, is_relative);
    Some(Curve {
        name: way.name.clone(),
        flags: way.flags.clone(),
        slope: slope(&falling).filter(|_| falling.len() >= POINTS_OF_A_LINE),
        points,
    })
}
