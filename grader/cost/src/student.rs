//! Measures the student's kernel through the worker: on the same rays, with the same oracle, timed
//! in the same turns.

use super::accuracy::TestSet;
use super::leak_view::{FARTHEST, MeshView};
use super::leaks::{ClosedMesh, ClosedMeshes};
use super::quartiles::Quartiles;
use super::report::{Accuracy, GridCounts};
use super::timing::{Measured, NotMeasured, missing};
use super::truth::{Answer, OracleShape};
use base::{GraderError, Workspace};
use grader::build::{BuildOutcome, BuildRoot};
use grader::workers::crash::Crash;
use grader::workers::runner::{self, Ending, Worker};
use judge::cases::probes::{brute_force, wire_ray, wire_triangle};
use kernels::{Precision, RayAndShapes};
use kit::{Aabb, Ray, Sphere, Triangle};
use wire::answer::Hit;
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
    pub(crate) fn build<S: StudentShape>(workspace: Option<&Workspace>) -> Measured<Student> {
        Student::build_with(S::STAGE, S::TASK, workspace)
    }

    /// Builds the worker with this cargo feature.
    pub(crate) fn build_with(
        feature: &str,
        task: &'static str,
        workspace: Option<&Workspace>,
    ) -> Measured<Student> {
        let Some(workspace) = workspace else {
            return missing("there is no workspace");
        };
        match BuildRoot::of(workspace).build_worker(&[feature])? {
            BuildOutcome::Worker(worker) => Ok(Student { worker, task }),
            BuildOutcome::DoesNotCompile(_) => missing("your code does not compile"),
        }
    }

    /// Runs one piece of work and returns its answer.
    pub(crate) fn run(&self, work: Work) -> Measured<wire::Answer> {
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
        missing(match ending {
            Some(Ending::Recorded(record)) => match record.outcome {
                Outcome::Answered(answer) => return Ok(answer),
                Outcome::NotAttempted { task } => format!("{task} is not attempted"),
                Outcome::Unable { reason } => reason,
                Outcome::Panicked { .. } | Outcome::CalledTooOften { .. } => {
                    format!("your code {}", crashed.unwrap_or_default())
                }
            },
            Some(Ending::TimedOut { limit_ms, .. }) => {
                format!("your code takes more than {} s", limit_ms / 1000)
            }
            Some(
                Ending::Died { .. }
                | Ending::PrintedTooMuch { .. }
                | Ending::TooManyThreads { .. }
                | Ending::OutOfTime,
            ) => format!("your code {}", crashed.unwrap_or_default()),
            Some(Ending::Malformed(why) | Ending::ChangedCounts(why)) => why,
            Some(Ending::Skipped | Ending::NotRun) | None => {
                return Err(GraderError::new("the worker returned no record for a case").into());
            }
        })
    }

    /// Returns the student's answers for all pairs.
    fn answers<S: StudentShape>(&self, pairs: &[(S, Ray)]) -> Measured<Vec<Option<Answer>>> {
        let answer = self.run(S::work(pairs))?;
        S::answers(&answer).ok_or_else(unexpected_answer)
    }

    /// Returns the closest hits of rays, without a tree.
    fn brute_force(&self, triangles: &[Triangle], rays: &[Ray]) -> Measured<Vec<Option<Hit>>> {
        match self.run(Work::BruteForce(brute_force(triangles, &[], rays)))? {
            wire::Answer::BruteForce(answer) => Ok(answer.hits),
            _ => Err(unexpected_answer()),
        }
    }

    /// Measures the accuracy on one family of rays.
    pub(crate) fn accuracy<S: StudentShape>(&self, test_set: &TestSet<S>) -> Measured<Accuracy> {
        let answers = self.answers(&test_set.pairs)?.into_iter();
        Ok(test_set.accuracy(Precision::F64, false, answers))
    }

    /// Returns the number of rays per million that leave closed meshes.
    pub(crate) fn leaks(&self, closed: &ClosedMeshes) -> Measured<f64> {
        let mut leaks = 0;
        for mesh in closed.meshes() {
            let rays: Vec<Ray> = mesh.rays.iter().map(|(ray, _)| *ray).collect();
            let hits = self.brute_force(&mesh.triangles, &rays)?;
            leaks += hits.iter().filter(|hit| hit.is_none()).count();
        }
        Ok(closed.per_million(leaks))
    }

    /// Counts the triangles of the integer terrain that each of its rays hits.
    pub(crate) fn grid(&self, grid: &ClosedMesh) -> Measured<GridCounts> {
        let answers = self.answers(&grid.pairs())?;
        let mut each = answers.iter();
        let rays = grid.rays.iter();
        let hits = rays.map(|(_, near)| each.by_ref().take(near.len()).flatten().count());
        Ok(GridCounts::of(&hits.collect::<Vec<usize>>()))
    }

    /// Returns the pixels of the picture of leaks whose rays pass through the mesh.
    pub(crate) fn leaking_pixels(&self, view: &MeshView) -> Measured<Vec<u32>> {
        let (pixels, rays, mesh) = view.rays_at_edges();
        let hits = self.brute_force(mesh, &rays)?;
        let pixels = pixels.into_iter().zip(hits);
        // The rays reach their edges at t = 1.
        let leaks = pixels.filter(|(_, hit)| hit.is_none_or(|hit| hit.t > FARTHEST));
        Ok(leaks.map(|(pixel, _)| pixel).collect())
    }

    /// Builds the student's tree over the triangles, and traces the rays through it. Returns the
    /// `t` of each closest hit.
    pub(crate) fn closest(
        &self,
        triangles: &[Triangle],
        rays: &[Ray],
    ) -> Measured<Vec<Option<f64>>> {
        let boxes = triangles.iter().map(|tri| wire_box(&tri.bounds()));
        let build = BuildWork {
            bounds: boxes.collect(),
            max_leaf_size: 4,
        };
        let wire::Answer::Build(built) = self.run(Work::Build(build))? else {
            return Err(unexpected_answer());
        };
        let scene = SceneWork {
            scene: SceneSource::Triangles(triangles.iter().map(wire_triangle).collect()),
            tree: built.tree,
            rays: rays.iter().map(wire_ray).collect(),
            any_hit: false,
        };
        let wire::Answer::SceneHits(answer) = self.run(Work::SceneHits(scene))? else {
            return Err(unexpected_answer());
        };
        let hits = answer.hits.iter();
        Ok(hits.map(|hit| hit.map(|hit| hit.t)).collect())
    }

    /// Times the student's test in each of these orders of the rays; the first one is not timed.
    /// Returns the median seconds of one test.
    pub(crate) fn time<S: StudentShape>(
        &self,
        batches: &[RayAndShapes<S>],
        orders: Vec<Vec<u32>>,
    ) -> Measured<f64> {
        let each = batches.iter().flat_map(|batch| &batch.shapes);
        let shapes: Vec<S> = each.copied().collect();
        let tests = orders.iter().map(|order| order.len() * S::SHAPES_PER_RAY);
        let tests: Vec<usize> = tests.collect();
        let timing = TestTiming {
            shapes: S::shapes(&shapes),
            rays: batches.iter().map(|batch| wire_ray(&batch.ray)).collect(),
            per_ray: S::SHAPES_PER_RAY as u32,
            orders,
        };
        let wire::Answer::TimeTest(seconds) = self.run(Work::TimeTest(timing))? else {
            return Err(unexpected_answer());
        };
        let each = seconds.iter().zip(tests).skip(1);
        Ok(Quartiles::of(each.map(|(s, tests)| s / tests as f64)).median)
    }
}

/// The worker's answer is for another kind of work.
pub(crate) fn unexpected_answer() -> NotMeasured {
    GraderError::new("the worker's answer is for another kind of work").into()
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
fn surface(t: Option<f64>, hit: Option<Hit>) -> Option<Answer> {
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
