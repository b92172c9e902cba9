//! Measurements of tree construction and traversal, in turns.

use super::coplanar::CoplanarScenes;
use super::exactness;
use super::{BreakEven, ExactnessRow, SlackRow, TraversalCost, TreeReport, TreeRow, WrongHits};
use crate::measure::SampleCounts;
use crate::quartiles::Quartiles;
use crate::student::{Student, unexpected_answer};
use crate::timing::{Contender, Measured, Rounds, SystemClock, TIMED_PASSES, Timing, or_missing};
use base::{GraderError, Workspace};
use grader::grade::speedup;
use judge::convert;
use kernels::{Builder, ClosestHit, RoundedTree, Traversal, brute_force};
use kit::{Bvh, Ray, Triangle};
use meshes::{MeshKind, generate};
use std::cell::RefCell;
use wire::Work;
use wire::answer::TimingAnswer;
use wire::work::{SceneSource, TimingWork};

/// A rough mesh: its triangles vary in size, and much of it is occluded.
const MESH: MeshKind = MeshKind::Terrain;

/// Largest number of primitives in a leaf: the assignment's choice.
const MAX_LEAF_SIZE: usize = 4;

/// The values of slack that are compared, in ulp. The last one is enough for every ray: trees are
/// compared with it.
const SLACKS: [u32; 3] = [0, 2, 16];

/// Each round times another part of the rays, one ray in this many: a pass is short, so that most
/// passes are not interrupted. Odd, so that a part has rays in all columns of the speedup's grid.
const PARTS: usize = 17;

/// How many rays are aimed at the mesh for each ray of a family, to count what a precision loses: a
/// million in a full run.
const AIMED_RAYS_PER_RAY: usize = 17;

/// Number of rays that are compared with brute force.
const CHECKED_RAYS: usize = 256;

/// The scene that all trees are built over.
struct Scene {
    triangles: Vec<Triangle>,
    rays: Vec<Ray>,
    /// Some of the rays, with the hits of brute force.
    checked: Vec<(Ray, ClosestHit)>,
    coplanar: CoplanarScenes,
}

/// Measures trees over one mesh, the student's through the worker. `None` in a handout that does
/// not contain the builders, because they would be a solution.
pub(crate) fn measure(
    workspace: Option<&Workspace>,
    seed: u64,
    size: SampleCounts,
) -> Result<Option<TreeReport>, GraderError> {
    let builders = kernels::builders();
    if builders.is_empty() {
        return Ok(None);
    }
    let scene = Scene::new(seed, size);
    let bounds: Vec<_> = scene.triangles.iter().map(Triangle::bounds).collect();
    let build = |builder: &Builder| (builder.build)(&bounds, MAX_LEAF_SIZE);
    let trees: Vec<Bvh> = builders.iter().map(build).collect();
    let student = or_missing(StudentTree::new(workspace, &scene, size))?;

    // The contenders: each builder, the first tree with each slack, the other trees, the student.
    let mut contenders: Vec<Contender> = builders
        .iter()
        .map(|builder| Contender::here(1, |_| build(builder)))
        .collect();
    let first_slack = contenders.len();
    let [.., safe_slack] = SLACKS;
    contenders.extend(SLACKS.map(|slack| scene.contender(&trees[0], slack)));
    let first_tree = contenders.len() - 1;
    contenders.extend(
        trees[1..]
            .iter()
            .map(|tree| scene.contender(tree, safe_slack)),
    );
    let first_rounded = contenders.len();
    contenders.extend(
        kernels::rounded_trees(&trees[0], &scene.triangles)
            .into_iter()
            .map(|tree| scene.rounded_contender(tree)),
    );
    let student_place = contenders.len();
    if let Ok(student) = &student {
        contenders.push(Contender::elsewhere(|round| student.turn(round)));
    }
    let rounds = Rounds::measure(&SystemClock::start(), &mut contenders, size.tree_rounds)?;
    drop(contenders);

    let mut by_slack = Vec::new();
    for (i, slack_ulp) in SLACKS.into_iter().enumerate() {
        let time = rounds.timing(first_slack + i, first_slack);
        by_slack.push(SlackRow {
            slack_ulp,
            trace: TraversalCost {
                time: time.map_err(GraderError::new)?,
                ..scene.counts(&trees[0], slack_ulp, &builders[0])
            },
        });
    }
    let mut by_build = Vec::new();
    for (i, (builder, tree)) in builders.iter().zip(&trees).enumerate() {
        let time = rounds.timing(first_tree + i, first_tree);
        let build_s = rounds.seconds(i).map_err(GraderError::new)?;
        by_build.push(TreeRow {
            name: builder.name.into(),
            paper: builder.paper.into(),
            student: false,
            build_s: Quartiles::of(build_s.iter().copied()),
            nodes: Some(tree.nodes.len()),
            trace: TraversalCost {
                time: time.map_err(GraderError::new)?,
                ..scene.counts(tree, safe_slack, builder)
            },
            break_even: BreakEven::Base,
        });
    }
    let aimed = exactness::rays(&scene.triangles, seed, AIMED_RAYS_PER_RAY * size.rays);
    let mut rounded = kernels::rounded_trees(&trees[0], &scene.triangles);
    // Brute force takes too long for all of them.
    let (by_brute, by_tree) = aimed.split_at(CHECKED_RAYS.min(aimed.len()));
    let mut truth: Vec<ClosestHit> = by_brute
        .iter()
        .map(|ray| brute_force(&scene.triangles, ray))
        .collect();
    if let Some(exact) = rounded.first_mut() {
        truth.extend(by_tree.iter().map(|ray| (exact.closest)(ray)));
    }
    let grid = exactness::Grid::new(seed);
    let grid_bounds: Vec<_> = grid.triangles.iter().map(Triangle::bounds).collect();
    let grid_tree = |builder: &Builder| (builder.build)(&grid_bounds, MAX_LEAF_SIZE);
    let first_grid_tree = grid_tree(&builders[0]);
    let mut on_grid = kernels::rounded_trees(&first_grid_tree, &grid.triangles);
    let mut by_precision = Vec::new();
    for (i, tree) in rounded.iter_mut().enumerate() {
        let time = rounds
            .timing(first_rounded + i, first_rounded)
            .map_err(GraderError::new)?;
        let mut row = ExactnessRow::new(builders[0].name, tree, time);
        exactness::count(&mut row, &mut tree.closest, &aimed, &truth);
        grid.count(&mut row, &mut on_grid[i].closest);
        by_precision.push(row);
    }
    // The other trees, with the tests of the first row.
    if let Some(exact) = rounded.first() {
        for (i, (builder, tree)) in builders.iter().zip(&trees).enumerate().skip(1) {
            let time = rounds.timing(first_tree + i, first_rounded);
            let mut row = ExactnessRow::new(builder.name, exact, time.map_err(GraderError::new)?);
            let mut traversal = Traversal::new(safe_slack);
            let closest = |ray: &Ray| traversal.closest(tree, &scene.triangles, ray);
            exactness::count(&mut row, closest, &aimed, &truth);
            let grid_tree = grid_tree(&builders[i]);
            grid.count(&mut row, |ray| {
                traversal.closest(&grid_tree, &grid.triangles, ray)
            });
            by_precision.push(row);
        }
    }
    let student_time = student.and_then(|student| {
        let time = rounds.timing(student_place, first_tree)?;
        Ok(student.row(time))
    });
    let student_missing = student_time.map(|row| by_build.push(row)).err();
    let [base, others @ ..] = by_build.as_mut_slice() else {
        return Ok(None);
    };
    for tree in others {
        tree.break_even = BreakEven::of(tree, base);
    }
    Ok(Some(TreeReport {
        mesh: MESH.name().into(),
        triangles: scene.triangles.len(),
        by_slack,
        by_build,
        by_precision,
        student_missing,
    }))
}

/// Returns the part of the rays that is timed in `round`. All parts have the same size.
fn part<T>(rays: &[T], round: usize) -> impl Iterator<Item = &T> {
    let rays_of_part = rays.len() / PARTS;
    let rays = rays.iter().skip(round % PARTS).step_by(PARTS);
    rays.take(rays_of_part)
}

impl Scene {
    fn new(seed: u64, size: SampleCounts) -> Scene {
        let triangles = generate(MESH, size.mesh);
        let rays: Vec<Ray> = speedup::rays().iter().map(convert::ray).collect();
        // The worker chooses the same ones.
        let checked = (0..CHECKED_RAYS)
            .map(|i| rays[i * rays.len() / CHECKED_RAYS])
            .map(|ray| (ray, brute_force(&triangles, &ray)));
        Scene {
            checked: checked.collect(),
            coplanar: CoplanarScenes::new(seed, size.rays),
            triangles,
            rays,
        }
    }

    /// The traversal of a tree by a part of the rays.
    fn contender<'a>(&'a self, tree: &'a Bvh, slack_ulp: u32) -> Contender<'a> {
        let mut traversal = Traversal::new(slack_ulp);
        Contender::here(self.rays.len() / PARTS, move |round| {
            let closest = |ray| traversal.closest(tree, &self.triangles, ray);
            part(&self.rays, round).filter_map(closest).count()
        })
    }

    /// The traversal of a tree with other tests by a part of the rays.
    fn rounded_contender<'a>(&'a self, mut tree: RoundedTree<'a>) -> Contender<'a> {
        Contender::here(self.rays.len() / PARTS, move |round| {
            part(&self.rays, round)
                .filter_map(|ray| (tree.closest)(ray))
                .count()
        })
    }

    /// Counts the tests of a traversal and its wrong hits. The time is left at 0.
    fn counts(&self, tree: &Bvh, slack_ulp: u32, builder: &Builder) -> TraversalCost {
        let mut traversal = Traversal::new(slack_ulp);
        for ray in &self.rays {
            traversal.closest(tree, &self.triangles, ray);
        }
        let rays = self.rays.len() as f64;
        let (box_tests, prim_tests) = (traversal.box_tests, traversal.prim_tests);
        let differs =
            |(ray, hit): &&(Ray, ClosestHit)| traversal.closest(tree, &self.triangles, ray) != *hit;
        TraversalCost {
            time: Default::default(),
            box_tests: box_tests as f64 / rays,
            prim_tests: prim_tests as f64 / rays,
            ordinary: WrongHits {
                rays: self.checked.len(),
                wrong: self.checked.iter().filter(differs).count(),
            },
            crafted: Some(self.coplanar.wrong(builder, slack_ulp)),
        }
    }
}

/// The student's tree over the same mesh, traversed by the student's own code.
struct StudentTree {
    worker: Student,
    /// The work of counting; turns differ from it in rays and rounds.
    work: TimingWork,
    /// Test counts and comparison with brute force.
    counts: TimingAnswer,
    /// The build time in each turn.
    build_s: RefCell<Vec<f64>>,
}

impl StudentTree {
    fn new(
        workspace: Option<&Workspace>,
        scene: &Scene,
        size: SampleCounts,
    ) -> Measured<StudentTree> {
        let worker = Student::build_with("meshes", "part2.task1", workspace)?;
        let work = TimingWork {
            scene: SceneSource::Generated(MESH.name().into(), size.mesh as u32),
            max_leaf_size: MAX_LEAF_SIZE as u32,
            rays: speedup::rays(),
            brute_force_rays: scene.checked.len() as u32,
            rounds: 1,
        };
        Ok(StudentTree {
            counts: run(&worker, &work)?,
            worker,
            work,
            build_s: RefCell::default(),
        })
    }

    /// Builds and traverses the tree several times. The first time does not count. Returns the
    /// median seconds of a ray.
    fn turn(&self, round: usize) -> Measured<f64> {
        let work = TimingWork {
            rays: part(&self.work.rays, round).copied().collect(),
            brute_force_rays: 0,
            rounds: 1 + TIMED_PASSES as u32,
            ..self.work.clone()
        };
        let times = run(&self.worker, &work)?;
        let median = |seconds: &[f64]| Quartiles::of(seconds.iter().copied().skip(1)).median;
        self.build_s.borrow_mut().push(median(&times.build_s));
        Ok(median(&times.tree_s) / times.tree_rays.max(1) as f64)
    }

    fn row(self, time: Timing) -> TreeRow {
        let counts = &self.counts;
        let rays = counts.tree_rays.max(1) as f64;
        TreeRow {
            name: "yours".into(),
            paper: "stages/bvh".into(),
            student: true,
            build_s: Quartiles::of(self.build_s.into_inner()),
            nodes: None,
            trace: TraversalCost {
                time,
                box_tests: counts.box_tests as f64 / rays,
                prim_tests: counts.prim_tests as f64 / rays,
                ordinary: WrongHits {
                    rays: counts.brute_rays as usize,
                    wrong: counts.differing_hits as usize,
                },
                crafted: None,
            },
            break_even: BreakEven::Base,
        }
    }
}

fn run(worker: &Student, work: &TimingWork) -> Measured<TimingAnswer> {
    match worker.run(Work::Timing(work.clone()))? {
        wire::Answer::Timing(times) => Ok(times),
        _ => Err(unexpected_answer()),
    }
}
