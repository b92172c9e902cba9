//! Worlds for traversals, in which every hit is plain to see.
//!
//! A primitive is a box with three plates inside, one across each axis. Rays run along an axis, so
//! a ray that passes through the box meets the plate across its axis: nothing rounds, and no
//! intersection code is needed.

use super::tree_plan::TreePlan;
use kit::{Aabb, Ray, Vec3};
use wire::Work;
use wire::work::{self, ScriptedRay, ScriptedWorld, Tree};

/// A box, and the point in which its three plates meet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cross {
    /// The box.
    pub(crate) bounds: Aabb,
    /// Inside it.
    pub(crate) at: Vec3,
}

/// Crosses in a tree.
pub(crate) struct CrossScene {
    crosses: Vec<Cross>,
    tree: Tree,
}

impl Cross {
    /// With the corners `min` and `max`, and the plates in the middle.
    pub(crate) fn new(min: Vec3, max: Vec3) -> Cross {
        Cross {
            bounds: Aabb { min, max },
            at: 0.5 * (min + max),
        }
    }

    /// The same box with the plates through `at`.
    pub(crate) fn with_plates(self, at: Vec3) -> Cross {
        Cross { at, ..self }
    }

    /// The same box with nothing in it.
    pub(crate) fn without_plates(self) -> Cross {
        self.with_plates(Vec3::NAN)
    }

    fn meets(&self, ray: &Ray) -> Option<f64> {
        let axis = axis_of(ray);
        let t = (self.at[axis] - ray.o[axis]) / ray.d[axis];
        span(&self.bounds, ray).map(|_| t).filter(|t| !t.is_nan())
    }
}

impl CrossScene {
    pub(crate) fn new(crosses: Vec<Cross>, plan: &TreePlan) -> CrossScene {
        let bounds: Vec<Aabb> = crosses.iter().map(|cross| cross.bounds).collect();
        CrossScene {
            tree: plan.tree(&bounds),
            crosses,
        }
    }

    /// Nothing, in a tree without nodes.
    pub(crate) fn empty() -> CrossScene {
        CrossScene {
            crosses: Vec::new(),
            tree: Tree::default(),
        }
    }

    /// The closest hits of `rays`.
    pub(crate) fn closest(&self, rays: &[Ray]) -> Work {
        Work::Traverse(self.script(rays, false))
    }

    /// Whether `rays` are blocked.
    pub(crate) fn any(&self, rays: &[Ray]) -> Work {
        Work::Traverse(self.script(rays, true))
    }

    /// Everything that a traversal may ask about `rays`, answered.
    pub(crate) fn script(&self, rays: &[Ray], any_hit: bool) -> ScriptedWorld {
        let rays = rays.iter().map(|ray| ScriptedRay {
            ray: wire_ray(ray),
            spans: self
                .tree
                .nodes
                .iter()
                .map(|node| span(&corners(&node.bounds), ray))
                .collect(),
            prims: self.crosses.iter().map(|cross| cross.meets(ray)).collect(),
        });
        ScriptedWorld {
            tree: self.tree.clone(),
            any_hit,
            rays: rays.collect(),
        }
    }
}

/// The ray from `o` along `axis` (0 for x), with steps of length `step`, forwards or backwards.
pub(crate) fn along(axis: usize, step: f64, o: Vec3) -> Ray {
    Ray::new(o, step * Vec3::AXES[axis])
}

fn axis_of(ray: &Ray) -> usize {
    ray.d.abs().max_position()
}

/// Where the line of a ray along an axis is inside a box.
fn span(b: &Aabb, ray: &Ray) -> Option<[f64; 2]> {
    let axis = axis_of(ray);
    let beside = |i: usize| i != axis && !(b.min[i] <= ray.o[i] && ray.o[i] <= b.max[i]);
    if (0..3).any(beside) {
        return None;
    }
    let [a, b] = [b.min, b.max].map(|corner| (corner[axis] - ray.o[axis]) / ray.d[axis]);
    Some([a.min(b), a.max(b)])
}

fn corners(&[min, max]: &[work::Xyz; 2]) -> Aabb {
    Aabb {
        min: min.into(),
        max: max.into(),
    }
}

pub(crate) fn wire_ray(ray: &Ray) -> work::Ray {
    work::Ray {
        o: ray.o.into(),
        d: ray.d.into(),
        min_t: ray.min_t,
        max_t: ray.max_t,
    }
}
