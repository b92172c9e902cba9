//! Renders the pictures of all experiments.

use super::curve::{Curve, CurvePoint, Experiment, PictureReport, Thumbnail};
use super::efficiency::relative_efficiency;
use super::estimate::ConvergedPair;
use super::plan::{self, ExperimentPlan, RenderMethod};
use super::program::{Program, RenderRequest, RenderedPicture};
use crate::quartiles::Quartiles;
use crate::timing::{Contender, Measured, Rounds, SystemClock, TIMED_PASSES, missing, or_missing};
use base::{GraderError, Workspace};
use grader::grade::speedup::slope;
use std::cell::RefCell;
use std::path::Path;

/// Number of seeds reserved for one run, so that runs with another `--seed` use other random
/// numbers.
const SEEDS_A_RUN: u64 = 1 << 16;

/// Pictures that take less time are rendered several times: one interruption by another program may
/// take longer.
const SHORT_S: f64 = 50e-3;

/// Fewest points for a slope: two points always are on a line.
const POINTS_OF_A_LINE: usize = 3;

/// Measures the program of `workspace`. Experiments that the student's program cannot render are
/// reported as missing, with the reason.
pub fn measure(
    workspace: &Workspace,
    seed: u64,
    quick: bool,
) -> Result<PictureReport, GraderError> {
    let program = match or_missing(Program::build(workspace.root()))? {
        Ok(program) => program,
        Err(why) => {
            return Ok(PictureReport {
                missing: Some(why),
                ..PictureReport::default()
            });
        }
    };
    let plans = plan::all(quick);
    let experiments = plans.iter().map(|plan| {
        progress::stage(plan.title);
        experiment(workspace, &program, plan, seed)
    });
    Ok(PictureReport {
        experiments: experiments.collect::<Result<_, _>>()?,
        missing: None,
    })
}

/// Measures one experiment with `program`.
pub fn experiment(
    workspace: &Workspace,
    program: &Program,
    plan: &ExperimentPlan,
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
        samples_are: plan.samples_are.into(),
        reference: None,
        converged_rmse: 0.0,
        curves: Vec::new(),
        missing: None,
    };
    let scene = workspace.root().join("scenes/dae").join(plan.scene);
    let measured = measure_curves(&mut experiment, &scene, program, plan, seed);
    experiment.missing = or_missing(measured)?.err();
    Ok(experiment)
}

/// Adds the curves to an experiment, as far as there are pictures.
fn measure_curves(
    experiment: &mut Experiment,
    scene: &Path,
    program: &Program,
    plan: &ExperimentPlan,
    seed: u64,
) -> Measured<()> {
    let first = seed.wrapping_mul(SEEDS_A_RUN);
    let request = RenderRequest {
        scene,
        film: plan.film,
        cell: plan.cell,
        flags: &plan.converged,
        seed: first.wrapping_add(2),
        threads: 1,
    };
    let all_threads = std::thread::available_parallelism().map_or(1, |n| n.get());
    let converged = |index| -> Measured<Vec<[f64; 3]>> {
        let request = RenderRequest {
            seed: first.wrapping_add(index),
            threads: all_threads,
            ..request
        };
        Ok(program.render(&request)?.pixels)
    };
    let (b, a) = (converged(0)?, converged(1)?);
    let size = [plan.cell[2], plan.cell[3]];
    experiment.reference = Some(Thumbnail::of(size, &a));
    let Some(converged) = ConvergedPair::new(a, b) else {
        return missing("the converged picture is black or contains NaN");
    };
    experiment.converged_rmse = converged.rmse();
    let (pictures, why) = render_in_turns(program, plan, request)?;
    let base = pictures.first();
    let curves = plan.methods.iter().zip(&pictures);
    experiment.curves = curves
        .filter_map(|(method, pictures)| {
            curve(&converged, method, pictures, base?, plan.is_relative)
        })
        .collect();
    let is_whole = experiment.curves.len() == plan.methods.len();
    if is_whole {
        add_thumbnails(&mut experiment.curves, size, &pictures);
    }
    match why {
        Some(why) => missing(why),
        None if !is_whole => {
            missing("a picture has another size, or contains NaN or infinite values")
        }
        None => Ok(()),
    }
}

/// Adds a picture to each curve: of the point whose time is nearest to the longest time that all
/// curves reach. `pictures` are those of all curves.
fn add_thumbnails(curves: &mut [Curve], size: [u32; 2], pictures: &Pictures) {
    let longest = |curve: &Curve| {
        let seconds = curve.points.iter().map(|point| point.seconds.median);
        seconds.fold(0.0, f64::max)
    };
    let common = curves.iter().map(longest).fold(f64::INFINITY, f64::min);
    for (curve, pictures) in curves.iter_mut().zip(pictures) {
        let distance = |point: &CurvePoint| (point.seconds.median / common).ln().abs();
        let points = curve.points.iter().enumerate();
        let nearest = points.min_by(|a, b| distance(a.1).total_cmp(&distance(b.1)));
        curve.at_equal_time = nearest.and_then(|(at, _)| {
            let picture = pictures.get(at)?.first()?;
            Some((at, Thumbnail::of(size, &picture.pixels)))
        });
    }
}

/// Pictures by method, by step and by round.
type Pictures = Vec<Vec<Vec<RenderedPicture>>>;

/// Renders the pictures of all steps of all methods in turns; also returns why some are missing, if
/// some are. Each round has another seed, from that of `request` on.
///
/// Each picture is rendered by a process of its own, which starts with cold caches whatever ran
/// before.
fn render_in_turns(
    program: &Program,
    plan: &ExperimentPlan,
    request: RenderRequest,
) -> Result<(Pictures, Option<String>), GraderError> {
    let steps = |method: &RenderMethod| vec![RefCell::new(Vec::new()); method.steps.len()];
    let pictures: Vec<Vec<RefCell<Vec<RenderedPicture>>>> =
        plan.methods.iter().map(steps).collect();
    let mut contenders = Vec::new();
    for (method, pictures) in plan.methods.iter().zip(&pictures) {
        for ((step, _), pictures) in method.steps.iter().zip(pictures) {
            let flags = format!("{} {step}", method.flags);
            contenders.push(Contender::elsewhere(move |round| {
                let request = RenderRequest {
                    flags: &flags,
                    seed: request.seed.wrapping_add(round as u64),
                    ..request
                };
                match or_missing(render_and_time(program, &request))? {
                    Ok(picture) => {
                        let seconds = picture.seconds;
                        pictures.borrow_mut().push(picture);
                        Ok(seconds)
                    }
                    Err(why) => missing(format!("{}: {why}", method.name)),
                }
            }));
        }
    }
    let rounds = Rounds::measure(&SystemClock::start(), &mut contenders, plan.seeds as usize)?;
    let why = (0..contenders.len()).find_map(|i| rounds.seconds(i).err());
    drop(contenders);
    let taken = |steps: Vec<RefCell<Vec<RenderedPicture>>>| {
        steps.into_iter().map(RefCell::into_inner).collect()
    };
    Ok((pictures.into_iter().map(taken).collect(), why))
}

/// Renders a picture; if that takes little time, several times, for the median of the times. Then
/// the first time does not count.
fn render_and_time(program: &Program, request: &RenderRequest) -> Measured<RenderedPicture> {
    let mut picture = program.render(request)?;
    if picture.seconds < SHORT_S {
        let again = (0..TIMED_PASSES).map(|_| Ok(program.render(request)?.seconds));
        let seconds: Vec<f64> = again.collect::<Measured<_>>()?;
        picture.seconds = Quartiles::of(seconds).median;
    }
    Ok(picture)
}

/// Returns the curve of a method, compared with the pictures of the first method; `None` if a
/// picture is missing.
fn curve(
    converged: &ConvergedPair,
    method: &RenderMethod,
    pictures: &[Vec<RenderedPicture>],
    base: &[Vec<RenderedPicture>],
    is_relative: bool,
) -> Option<Curve> {
    let steps = method.steps.iter().zip(pictures).enumerate();
    let points: Vec<CurvePoint> = steps
        .map(|(i, ((flags, samples), pictures))| {
            let samples = f64::from(*samples);
            let point = converged.point(flags, samples, pictures, is_relative)?;
            let compare =
                |base: &Vec<_>| relative_efficiency(converged, pictures, base, is_relative);
            Some(CurvePoint {
                relative_efficiency: base.get(i).and_then(compare),
                ..point
            })
        })
        .collect::<Option<_>>()?;
    let random_points = Curve::random_points(&points, is_relative);
    Some(Curve {
        name: method.name.clone(),
        flags: method.flags.clone(),
        slope: slope(&random_points).filter(|_| random_points.len() >= POINTS_OF_A_LINE),
        points,
        at_equal_time: None,
    })
}
