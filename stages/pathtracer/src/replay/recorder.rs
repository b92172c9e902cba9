//! Traces rays and records every test.

use super::MAX_RECORDED_SAMPLES;
use super::record::{Outcome, PrimAnswer, RayRecord, Roulette, SampleRecord, Test, Visit};
use crate::tracer::{RayRole, RayTracer, SceneTracer};
use crate::{Accel, Counters, SceneWorld};
use kit::{Aabb, Bvh, Hit, Interval, NodeKind, PrimId, Ray, Scene, Spectrum, Vec2, World};
use std::cell::RefCell;

/// Traces rays through a scene and records them, sample by sample.
#[derive(Debug)]
pub(super) struct Recorder<'a> {
    scene: &'a Scene,
    /// The binary tree, or brute force.
    accel: &'a Accel,
    samples: RefCell<Vec<SampleRecord>>,
}

impl<'a> Recorder<'a> {
    pub(super) fn new(scene: &'a Scene, accel: &'a Accel) -> Recorder<'a> {
        Recorder {
            scene,
            accel,
            samples: RefCell::default(),
        }
    }

    pub(super) fn into_samples(self) -> Vec<SampleRecord> {
        self.samples.into_inner()
    }

    fn world(&self, ray: &Ray, skip: Option<PrimId>) -> RecordingWorld<'a, SceneWorld<'a>> {
        let tree = match self.accel {
            Accel::Bvh(tree) => Some(tree),
            _ => None,
        };
        RecordingWorld {
            world: SceneWorld::new(self.scene, skip),
            interval: &bbox::intersect_bbox,
            skip,
            tree,
            expected: Vec::new(),
            whole: *ray,
            tests: Vec::new(),
        }
    }

    /// Records a ray with its tests. Everything that a ray with hits leads to starts at the last
    /// hit of the path.
    fn push(
        &self,
        role: RayRole,
        ray: &Ray,
        skip: Option<PrimId>,
        tests: Vec<Test>,
        outcome: Outcome,
    ) {
        let mut samples = self.samples.borrow_mut();
        let index = samples.len();
        let Some(sample) = samples.last_mut().filter(|_| index <= MAX_RECORDED_SAMPLES) else {
            return;
        };
        let parent = sample.last_of_path();
        sample.rays.push(RayRecord {
            role,
            depth: parent.map_or(0, |parent| sample.rays[parent].depth + 1),
            parent,
            ray: *ray,
            skip,
            outcome,
            tests,
        });
    }
}

impl RayTracer for &Recorder<'_> {
    fn closest(
        &self,
        role: RayRole,
        ray: &Ray,
        skip: Option<PrimId>,
        counters: &mut Counters,
    ) -> Option<Hit> {
        let mut world = self.world(ray, skip);
        let mut shortened = *ray;
        let hit = self
            .accel
            .closest_through(self.scene, &mut shortened, &mut world);
        *counters += world.world.counters();
        let outcome = hit.map_or(Outcome::Miss, Outcome::Hit);
        self.push(role, ray, skip, world.finish(), outcome);
        hit
    }

    fn unrecorded(&self) -> SceneTracer<'_> {
        SceneTracer {
            scene: self.scene,
            accel: self.accel,
        }
    }

    fn occluded(&self, ray: &Ray, skip: Option<PrimId>, counters: &mut Counters) -> bool {
        let mut world = self.world(ray, skip);
        let blocked = self.accel.occluded_through(self.scene, ray, &mut world);
        *counters += world.world.counters();
        let outcome = if blocked {
            Outcome::Blocked
        } else {
            Outcome::Unblocked
        };
        self.push(RayRole::Shadow, ray, skip, world.finish(), outcome);
        blocked
    }

    fn sample_starts(&self, sensor: Vec2) {
        self.samples.borrow_mut().push(SampleRecord {
            sensor,
            of_path: Spectrum::BLACK,
            radiance: Spectrum::BLACK,
            rays: Vec::new(),
            roulettes: Vec::new(),
        });
    }

    fn roulette_played(&self, throughput: Spectrum, survivor: Option<Spectrum>) {
        let mut samples = self.samples.borrow_mut();
        // Without recorded rays there is no surface that it belongs to.
        if let Some(sample) = samples.last_mut()
            && let Some(ray) = sample.last_of_path()
        {
            sample.roulettes.push(Roulette {
                ray,
                throughput,
                survivor,
            });
        }
    }

    fn sample_ends(&self, of_path: Spectrum, radiance: Spectrum) {
        if let Some(sample) = self.samples.borrow_mut().last_mut() {
            (sample.of_path, sample.radiance) = (of_path, radiance);
        }
    }
}

/// Traces `ray` through `tree` in `world` with the stage `bvh`, and records every test: the closest
/// hit, or with `any_hit` whether something is in the way.
///
/// `interval` tests a box as `world` does, but counts nothing: it finds the boxes that the ray would
/// enter beyond its hits. The record has the role of a camera ray, or with `any_hit` of a shadow ray.
pub fn record_ray<W: World>(
    tree: &Bvh,
    ray: &Ray,
    any_hit: bool,
    world: W,
    interval: &dyn Fn(&Aabb, &Ray) -> Option<Interval>,
) -> RayRecord {
    let mut world = RecordingWorld {
        world,
        interval,
        skip: None,
        tree: Some(tree),
        expected: Vec::new(),
        whole: *ray,
        tests: Vec::new(),
    };
    let outcome = match any_hit {
        true if bvh::occludes_bvh(tree, ray, &mut world) => Outcome::Blocked,
        true => Outcome::Unblocked,
        false => {
            bvh::intersect_bvh(tree, &mut { *ray }, &mut world).map_or(Outcome::Miss, Outcome::Hit)
        }
    };
    RayRecord {
        role: match any_hit {
            true => RayRole::Shadow,
            false => RayRole::Camera,
        },
        depth: 0,
        parent: None,
        ray: *ray,
        skip: None,
        outcome,
        tests: world.finish(),
    }
}

/// The [`World`] of one ray: another world, whose tests it also records.
struct RecordingWorld<'a, W> {
    world: W,
    /// Tests a box without counting.
    interval: &'a dyn Fn(&Aabb, &Ray) -> Option<Interval>,
    skip: Option<PrimId>,
    /// The tree that is traversed; `None` for brute force.
    tree: Option<&'a Bvh>,
    /// The children of entered nodes that were not tested yet.
    expected: Vec<u32>,
    /// The ray with its whole range.
    whole: Ray,
    tests: Vec<Test>,
}

impl<W> RecordingWorld<'_, W> {
    /// The node whose box is `b`: the root, an untested child of an entered node, or for unusual
    /// traversals any node with an equal box.
    fn node_of(&mut self, b: &Aabb) -> Option<u32> {
        let nodes = &self.tree?.nodes;
        if self.tests.is_empty() && nodes.first().is_some_and(|root| root.bounds == *b) {
            return Some(0);
        }
        let is_same = |&node: &u32| nodes[node as usize].bounds == *b;
        match self.expected.iter().rposition(is_same) {
            Some(i) => Some(self.expected.remove(i)),
            None => nodes
                .iter()
                .position(|node| node.bounds == *b)
                .map(|i| i as u32),
        }
    }

    /// The tests, with entered boxes marked as pruned if nothing in them was tested later.
    fn finish(self) -> Vec<Test> {
        let mut tests = self.tests;
        let Some(tree) = self.tree else { return tests };
        for i in 0..tests.len() {
            let Test::Box {
                node: Some(node),
                visit: Visit::Entered { entry, exit },
                ..
            } = tests[i]
            else {
                continue;
            };
            let later = &tests[i + 1..];
            let was_visited = match tree.nodes[node as usize].kind {
                NodeKind::Interior { left, right } => later.iter().any(|test| {
                    matches!(test, Test::Box { node: Some(n), .. } if *n == left || *n == right)
                }),
                NodeKind::Leaf { first, count } => {
                    let prims = tree.leaf(first, count);
                    prims.is_empty()
                        || later.iter().any(|test| {
                            matches!(test, Test::Primitive { prim, .. } if prims.contains(prim))
                        })
                }
            };
            if !was_visited && let Test::Box { visit, .. } = &mut tests[i] {
                *visit = Visit::Pruned { entry, exit };
            }
        }
        tests
    }

    fn push_prim(&mut self, prim: PrimId, max_t: f64, answer: PrimAnswer) {
        let skipped = self.skip == Some(prim);
        self.tests.push(Test::Primitive {
            prim,
            max_t,
            answer: if skipped { PrimAnswer::Skipped } else { answer },
        });
    }
}

impl<W: World> World for RecordingWorld<'_, W> {
    fn hit_box(&mut self, b: &Aabb, ray: &Ray) -> Option<Interval> {
        let inside = self.world.hit_box(b, ray);
        let node = self.node_of(b);
        let visit = match inside {
            Some(Interval { min, max }) => Visit::Entered {
                entry: min,
                exit: max,
            },
            // Would the ray enter it without the hits so far?
            None => match (self.interval)(b, &self.whole) {
                Some(Interval { min, .. }) if min > ray.max_t => Visit::Behind { entry: min },
                _ => Visit::Missed,
            },
        };
        if let (Some(node), Some(tree), Some(_)) = (node, self.tree, inside)
            && let NodeKind::Interior { left, right } = tree.nodes[node as usize].kind
        {
            self.expected.extend([left, right]);
        }
        self.tests.push(Test::Box {
            node,
            bounds: *b,
            max_t: ray.max_t,
            visit,
        });
        inside
    }

    fn hit_prim(&mut self, id: PrimId, ray: &mut Ray) -> Option<Hit> {
        let max_t = ray.max_t;
        let hit = self.world.hit_prim(id, ray);
        let answer = hit.map_or(PrimAnswer::Miss, |hit| PrimAnswer::Hit(hit.t));
        self.push_prim(id, max_t, answer);
        hit
    }

    fn blocked(&mut self, id: PrimId, ray: &Ray) -> bool {
        let blocked = self.world.blocked(id, ray);
        let answer = if blocked {
            PrimAnswer::Blocks
        } else {
            PrimAnswer::Miss
        };
        self.push_prim(id, ray.max_t, answer);
        blocked
    }
}
