//! The student's own kernel, through the worker: the same rays, the same judge, times in the same turns.

use super::accuracy::Judge;
use super::leaks::Closed;
use super::report::Accuracy;
use super::truth::{Answer, Judged};
use grader::compile::{Build, Built};
use grader::error::GraderError;
use grader::runner::{self, Ending, Worker};
use grader::workspace::Workspace;
use judge::cases::probes::{brute_force, wire_ray, wire_triangle};
use kernels::{Bundle, Precision};
use kit::{Aabb, Ray, Sphere, Triangle};
use wire::work::{BoxWork, Probe, Shapes, SphereWork, TestTiming, TriangleWork, Xyz};
use wire::{Outcome, Work};

/// A shape that the student has a test for.
pub(crate) trait Asked: Judged {
    /// The task that the test solves.
    const TASK: &'static str;

    /// The stage that the test is in.
    const STAGE: &'static str;

    /// The work of answering pairs.
    fn ask(pairs: &[(Self, Ray)]) -> Work;

    /// The answers to that work; `None` if they are to something else.
    fn answers(answer: &wire::Answer) -> Option<Vec<Option<Answer>>>;

    /// For the worker.
    fn shapes(shapes: &[Self]) -> Shapes;
}

/// A worker with the student's stage.
pub(crate) struct Student {
    worker: Worker,
    task: &'static str,
}

/// Why the student has no row: in words that end the sentence "no row of your own: ...".
pub(crate) type Missing = String;

/// A case of the worker's may take this long: a million tests of a slow kernel.
const LIMIT_MS: u64 = 60_000;

impl Student {
    /// Builds the worker with the stage that tests shapes `S`.
    pub(crate) fn of<S: Asked>(
        workspace: Option<&Workspace>,
    ) -> Result<Result<Student, Missing>, GraderError> {
        Student::with(S::STAGE, S::TASK, workspace)
    }

    /// Builds the worker with a cargo feature of its own.
    pub(crate) fn with(
        feature: &str,
        task: &'static str,
        workspace: Option<&Workspace>,
    ) -> Result<Result<Student, Missing>, GraderError> {
        let Some(workspace) = workspace else {
            return Ok(Err("nobody asked for it".into()));
        };
        let build = Build {
            root: workspace.root(),
            features: &[feature],
            target: None,
            sealed: false,
        };
        Ok(match build.run()? {
            Built::Worker(program) => Ok(Student {
                worker: program.into(),
                task,
            }),
            Built::DoesNotCompile(_) => Err("your code does not compile".into()),
        })
    }

    /// What the student's code answers to one piece of work.
    pub(crate) fn ask(&self, work: Work) -> Result<Result<wire::Answer, Missing>, GraderError> {
        let case = wire::Case {
            task: self.task.into(),
            name: "cost".into(),
            limit_ms: LIMIT_MS,
            work,
        };
        let run = runner::run(&self.worker, &[case])?;
        let ending = run.endings.into_iter().next();
        Ok(match ending {
            Some(Ending::Recorded(record)) => match record.outcome {
                Outcome::Answered(answer) => Ok(answer),
                Outcome::NotAttempted { task } => Err(format!("{task} is not attempted")),
                Outcome::Panicked { message, .. } => Err(format!("your code panics: {message}")),
                Outcome::Unable { reason } => Err(reason),
            },
            Some(Ending::TimedOut { limit_ms, .. }) => Err(format!(
                "your code takes more than {} s for them",
                limit_ms / 1000
            )),
            Some(Ending::Died(how)) => Err(format!("your code {how}")),
            Some(Ending::Malformed(why)) => Err(why),
            Some(Ending::Skipped) | None => return Err(GraderError::new("the worker lost a case")),
        })
    }

    /// How right it is on one family of rays.
    pub(crate) fn accuracy<S: Asked>(
        &self,
        judge: &Judge<S>,
    ) -> Result<Result<Accuracy, Missing>, GraderError> {
        let answer = match self.ask(S::ask(&judge.pairs))? {
            Ok(answer) => answer,
            Err(missing) => return Ok(Err(missing)),
        };
        let answers = S::answers(&answer).ok_or_else(mixed_up)?;
        Ok(Ok(judge.accuracy(
            Precision::F64,
            false,
            answers.into_iter(),
        )))
    }

    /// Rays a million that get out of closed meshes.
    pub(crate) fn leaks(&self, closed: &Closed) -> Result<Result<f64, Missing>, GraderError> {
        let mut leaks = 0;
        for mesh in closed.meshes() {
            let rays: Vec<Ray> = mesh.rays.iter().map(|(ray, _)| *ray).collect();
            match self.ask(brute_force(&mesh.triangles, &[], &rays))? {
                Ok(wire::Answer::BruteForce(hits)) => {
                    leaks += hits.hits.iter().filter(|hit| hit.is_none()).count();
                }
                Ok(_) => return Err(mixed_up()),
                Err(missing) => return Ok(Err(missing)),
            }
        }
        Ok(Ok(closed.per_million(leaks)))
    }

    /// Nanoseconds of one test, round after round, each over `passes` passes.
    pub(crate) fn times<S: Asked>(
        &self,
        bundles: &[Bundle<S>],
        passes: u32,
        rounds: usize,
    ) -> Result<Result<Vec<f64>, Missing>, GraderError> {
        let each = bundles.iter().flat_map(|bundle| &bundle.shapes);
        let shapes: Vec<S> = each.copied().collect();
        let timing = TestTiming {
            shapes: S::shapes(&shapes),
            rays: bundles.iter().map(|bundle| wire_ray(&bundle.ray)).collect(),
            per_ray: S::PER_RAY as u32,
            passes,
            rounds: rounds as u32,
        };
        let tests = f64::from(passes) * shapes.len() as f64;
        Ok(match self.ask(Work::TimeTest(timing))? {
            Ok(wire::Answer::TimeTest(seconds)) => {
                Ok(seconds.iter().map(|s| 1e9 * s / tests).collect())
            }
            Ok(_) => return Err(mixed_up()),
            Err(missing) => Err(missing),
        })
    }
}

fn mixed_up() -> GraderError {
    GraderError::new("the worker answered to other work than it was given")
}

/// The rays, each at a shape of its own.
fn probes<S>(pairs: &[(S, Ray)]) -> Vec<Probe> {
    let numbered = (0..).zip(pairs);
    numbered
        .map(|(shape, (_, ray))| Probe {
            shape,
            ray: wire_ray(ray),
        })
        .collect()
}

impl Asked for Triangle {
    const TASK: &'static str = "part1.task3";
    const STAGE: &'static str = "intersect";

    fn ask(pairs: &[(Triangle, Ray)]) -> Work {
        Work::Triangles(TriangleWork {
            triangles: pairs.iter().map(|(tri, _)| wire_triangle(tri)).collect(),
            probes: probes(pairs),
        })
    }

    fn answers(answer: &wire::Answer) -> Option<Vec<Option<Answer>>> {
        let wire::Answer::Triangles(answers) = answer else {
            return None;
        };
        let each = answers.iter();
        Some(
            each.map(|a| surface(a.test.map(|[t, ..]| t), a.hit))
                .collect(),
        )
    }

    fn shapes(shapes: &[Triangle]) -> Shapes {
        Shapes::Triangles(shapes.iter().map(wire_triangle).collect())
    }
}

impl Asked for Sphere {
    const TASK: &'static str = "part1.task4";
    const STAGE: &'static str = "intersect";

    fn ask(pairs: &[(Sphere, Ray)]) -> Work {
        Work::Spheres(SphereWork {
            spheres: pairs.iter().map(|(s, _)| wire_sphere(s)).collect(),
            probes: probes(pairs),
        })
    }

    fn answers(answer: &wire::Answer) -> Option<Vec<Option<Answer>>> {
        let wire::Answer::Spheres(answers) = answer else {
            return None;
        };
        Some(answers.iter().map(|a| surface(a.test, a.hit)).collect())
    }

    fn shapes(shapes: &[Sphere]) -> Shapes {
        Shapes::Spheres(shapes.iter().map(wire_sphere).collect())
    }
}

impl Asked for Aabb {
    const TASK: &'static str = "part2.task2";
    const STAGE: &'static str = "bbox";

    fn ask(pairs: &[(Aabb, Ray)]) -> Work {
        Work::Boxes(BoxWork {
            boxes: pairs.iter().map(|(b, _)| wire_box(b)).collect(),
            probes: probes(pairs),
        })
    }

    fn answers(answer: &wire::Answer) -> Option<Vec<Option<Answer>>> {
        let wire::Answer::Boxes(answers) = answer else {
            return None;
        };
        let of = |ends: [f64; 2]| Answer { ends, p: None };
        Some(answers.iter().map(|ends| ends.map(of)).collect())
    }

    fn shapes(shapes: &[Aabb]) -> Shapes {
        Shapes::Boxes(shapes.iter().map(wire_box).collect())
    }
}

/// The decision and `t` are those of the test; the hit point is that of the record that follows.
fn surface(t: Option<f64>, hit: Option<wire::answer::Hit>) -> Option<Answer> {
    t.map(|t| Answer {
        ends: [t; 2],
        p: hit.map(|hit| hit.p.into()),
    })
}

fn wire_sphere(s: &Sphere) -> (Xyz, f64) {
    (s.center.into(), s.radius)
}

fn wire_box(b: &Aabb) -> [Xyz; 2] {
    [b.min.into(), b.max.into()]
}
