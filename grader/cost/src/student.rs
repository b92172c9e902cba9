//! Measures the student's kernel through the worker: on the same rays, with the same oracle, timed
//! in the same turns.

use super::accuracy::TestSet;
use super::leak_view::{FARTHEST, MeshView};
use super::leaks::{ClosedMesh, ClosedMeshes};
use super::quartiles::Quartiles;
use super::report::{Accuracy, GridCounts};
use super::timing::{MissingReason, TurnResult};
use super::truth::{Answer, OracleShape};
use base::{GraderError, Workspace};
use grader::build::{BuildOutcome, BuildRoot};
use grader::workers::crash::Crash;
use grader::workers::runner::{self, Ending, Worker};
use judge::cases::probes::{brute_force, wire_ray, wire_triangle};
use kernels::{Precision, RayAndShapes};
use kit::{Aabb, Ray, Sphere, Triangle};
use wire::work::{
    BoxWork, BuildWork, Probe, SceneSource, SceneWork, Shapes, SphereWork, TestTiming,
    TriangleWork, Xyz,
};
use wire::{Outcome, Work};

/// A shape with a test in the student's code.
pub(crate) trait StudentShape: OracleShape {
    /// The task of the test.
    const TASK: &'static str;

    /// The stage that contains the test.
    const STAGE: &'static str;

    /// Returns the work that tests all pairs.
    fn work(pairs: &[(Self, Ray)]) -> Work;

    /// Returns the answers to that work; `None` if `answer` is for another kind of work.
    fn answers(answer: &wire::Answer) -> Option<Vec<Option<Answer>>>;

    /// Converts the shapes for the worker.
    fn shapes(shapes: &[Self]) -> Shapes;
}

/// A worker that contains the student's stage.
pub(crate) struct Student {
    worker: Worker,
    task: &'static str,
}

/// Time limit of one case: a million tests of a slow kernel.
const LIMIT_MS: u64 = 60_000;

impl Student {
    /// Builds the worker with the stage that contains the test for shapes `S`.
    pub(crate) fn build<S: StudentShape>(
        workspace: Option<&Workspace>,
    ) -> Result<Result<Student, MissingReason>, GraderError> {
        Student::build_with(S::STAGE, S::TASK, workspace)
    }

    /// Builds the worker with this cargo feature.
    pub(crate) fn build_with(
        feature: &str,
        task: &'static str,
        workspace: Option<&Workspace>,
    ) -> Result<Result<Student, MissingReason>, GraderError> {
        let Some(workspace) = workspace else {
            return Ok(Err("there is no workspace".into()));
        };
        Ok(match BuildRoot::of(workspace).build_worker(&[feature])? {
            BuildOutcome::Worker(worker) => Ok(Student { worker, task }),
            BuildOutcome::DoesNotCompile(_) => Err("your code does not compile".into()),
        })
    }

    /// Runs one piece of work and returns its answer.
    pub(crate) fn run(
        &self,
        work: Work,
    ) -> Result<Result<wire::Answer, MissingReason>, GraderError> {
        let case = wire::Case {
            task: self.task.into(),
            name: "cost".into(),
            limit_ms: LIMIT_MS,
            work,
            order: Vec::new(),
        };
        let run = runner::run(&self.worker, &[case])?;
        let ending = run.endings.into_iter().next();
        let crashed = ending.as_ref().and_then(Crash::of).map(|crash| crash.how);
        Ok(match ending {
            Some(Ending::Recorded(record)) => match record.outcome {
                Outcome::Answered(answer) => Ok(answer),
                Outcome::NotAttempted { task } => Err(format!("{task} is not attempted")),
                Outcome::Unable { reason } => Err(reason),
                Outcome::Panicked { .. } | Outcome::CalledTooOften { .. } => {
                    Err(format!("your code {}", crashed.unwrap_or_default()))
                }
            },
            Some(Ending::TimedOut { limit_ms, .. }) => {
                Err(format!("your code takes more than {} s", limit_ms / 1000))
            }
            Some(
                Ending::Died { .. }
                | Ending::PrintedTooMuch { .. }
                | Ending::TooManyThreads { .. }
                | Ending::OutOfTime,
            ) => Err(format!("your code {}", crashed.unwrap_or_default())),
            Some(Ending::Malformed(why) | Ending::ChangedCounts(why)) => Err(why),
            Some(Ending::Skipped | Ending::NotRun) | None => {
                return Err(GraderError::new("the worker returned no record for a case"));
            }
        })
    }

    /// Measures the accuracy on one family of rays.
    pub(crate) fn accuracy<S: StudentShape>(
        &self,
        test_set: &TestSet<S>,
    ) -> Result<Result<Accuracy, MissingReason>, GraderError> {
        let answer = match self.run(S::work(&test_set.pairs))? {
            Ok(answer) => answer,
            Err(missing) => return Ok(Err(missing)),
        };
        let answers = S::answers(&answer).ok_or_else(unexpected_answer)?;
        Ok(Ok(test_set.accuracy(
            Precision::F64,
            false,
            answers.into_iter(),
        )))
    }

    /// Returns the number of rays per million that leave closed meshes.
    pub(crate) fn leaks(
        &self,
        closed: &ClosedMeshes,
    ) -> Result<Result<f64, MissingReason>, GraderError> {
        let mut leaks = 0;
        for mesh in closed.meshes() {
            let rays: Vec<Ray> = mesh.rays.iter().map(|(ray, _)| *ray).collect();
            match self.run(Work::BruteForce(brute_force(&mesh.triangles, &[], &rays)))? {
                Ok(wire::Answer::BruteForce(hits)) => {
                    leaks += hits.hits.iter().filter(|hit| hit.is_none()).count();
                }
                Ok(_) => return Err(unexpected_answer()),
                Err(missing) => return Ok(Err(missing)),
            }
        }
        Ok(Ok(closed.per_million(leaks)))
    }

    /// Counts the triangles of the integer terrain that each of its rays hits.
    pub(crate) fn grid(
        &self,
        grid: &ClosedMesh,
    ) -> Result<Result<GridCounts, MissingReason>, GraderError> {
        let answer = match self.run(Triangle::work(&grid.pairs()))? {
            Ok(answer) => answer,
            Err(missing) => return Ok(Err(missing)),
        };
        let answers = Triangle::answers(&answer).ok_or_else(unexpected_answer)?;
        let mut each = answers.iter();
        let hits = grid
            .rays
            .iter()
            .map(|(_, near)| each.by_ref().take(near.len()).flatten().count());
        Ok(Ok(GridCounts::of(&hits.collect::<Vec<usize>>())))
    }

    /// Returns the pixels of the picture of leaks whose rays pass through the mesh.
    pub(crate) fn leaking_pixels(
        &self,
        view: &MeshView,
    ) -> Result<Result<Vec<u32>, MissingReason>, GraderError> {
        let (pixels, rays, mesh) = view.rays_at_edges();
        match self.run(Work::BruteForce(brute_force(mesh, &[], &rays)))? {
            Ok(wire::Answer::BruteForce(hits)) => {
                let pixels = pixels.into_iter().zip(&hits.hits);
                // The rays reach their edges at t = 1.
                let leaks = pixels.filter(|(_, hit)| hit.is_none_or(|hit| hit.t > FARTHEST));
                Ok(Ok(leaks.map(|(pixel, _)| pixel).collect()))
            }
            Ok(_) => Err(unexpected_answer()),
            Err(missing) => Ok(Err(missing)),
        }
    }

    /// Builds the student's tree over the triangles, and traces the rays through it. Returns the
    /// `t` of each closest hit.
    pub(crate) fn closest(
        &self,
        triangles: &[Triangle],
        rays: &[Ray],
    ) -> Result<Result<Vec<Option<f64>>, MissingReason>, GraderError> {
        let boxes = triangles.iter().map(|tri| wire_box(&tri.bounds()));
        let build = BuildWork {
            bounds: boxes.collect(),
            max_leaf_size: 4,
        };
        let tree = match self.run(Work::Build(build))? {
            Ok(wire::Answer::Build(answer)) => answer.tree,
            Ok(_) => return Err(unexpected_answer()),
            Err(missing) => return Ok(Err(missing)),
        };
        let scene = SceneWork {
            scene: SceneSource::Triangles(triangles.iter().map(wire_triangle).collect()),
            tree,
            rays: rays.iter().map(wire_ray).collect(),
            any_hit: false,
        };
        Ok(match self.run(Work::SceneHits(scene))? {
            Ok(wire::Answer::SceneHits(answer)) => {
                let hits = answer.hits.iter();
                Ok(hits.map(|hit| hit.map(|hit| hit.t)).collect())
            }
            Ok(_) => return Err(unexpected_answer()),
            Err(missing) => Err(missing),
        })
    }

    /// Times the student's test in each of these orders of the rays; the first one is not timed.
    /// Returns the median seconds of one test.
    pub(crate) fn time<S: StudentShape>(
        &self,
        batches: &[RayAndShapes<S>],
        orders: Vec<Vec<u32>>,
    ) -> TurnResult {
        let each = batches.iter().flat_map(|batch| &batch.shapes);
        let shapes: Vec<S> = each.copied().collect();
        let tests: Vec<usize> = orders
            .iter()
            .map(|order| order.len() * S::SHAPES_PER_RAY)
            .collect();
        let timing = TestTiming {
            shapes: S::shapes(&shapes),
            rays: batches.iter().map(|batch| wire_ray(&batch.ray)).collect(),
            per_ray: S::SHAPES_PER_RAY as u32,
            orders,
        };
        Ok(match self.run(Work::TimeTest(timing))? {
            Ok(wire::Answer::TimeTest(seconds)) => {
                let each = seconds.iter().zip(tests).skip(1);
                Ok(Quartiles::of(each.map(|(s, tests)| s / tests as f64)).median)
            }
            Ok(_) => return Err(unexpected_answer()),
            Err(missing) => Err(missing),
        })
    }
}

fn unexpected_answer() -> GraderError {
    GraderError::new("the worker's answer is for another kind of work")
}

/// Pairs each ray with the index of its shape.
fn probes<S>(pairs: &[(S, Ray)]) -> Vec<Probe> {
    let numbered = (0..).zip(pairs);
    numbered
        .map(|(shape, (_, ray))| Probe {
            shape,
            ray: wire_ray(ray),
        })
        .collect()
}

impl StudentShape for Triangle {
    const TASK: &'static str = "part1.task3";
    const STAGE: &'static str = "intersect";

    fn work(pairs: &[(Triangle, Ray)]) -> Work {
        Work::Triangles(TriangleWork {
            triangles: pairs.iter().map(|(tri, _)| wire_triangle(tri)).collect(),
            probes: probes(pairs),
            by_record: false,
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

impl StudentShape for Sphere {
    const TASK: &'static str = "part1.task4";
    const STAGE: &'static str = "intersect";

    fn work(pairs: &[(Sphere, Ray)]) -> Work {
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

impl StudentShape for Aabb {
    const TASK: &'static str = "part2.task2";
    const STAGE: &'static str = "bbox";

    fn work(pairs: &[(Aabb, Ray)]) -> Work {
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

/// Hit or miss and `t` are from the test; the hit point is from the hit record.
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
