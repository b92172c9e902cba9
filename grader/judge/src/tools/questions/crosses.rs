//! Scenes for traversals, whose hits are known without intersection code.
//!
//! A primitive is a box with three plates inside, each perpendicular to one axis. Rays are parallel
//! to an axis, so a ray through the box hits the plate that is perpendicular to it, and nothing
//! rounds.

use super::probes::wire_ray;
use super::tree_plan::TreePlan;
use kit::{Aabb, Ray, Vec3};
use wire::work::{self, ScriptedRay, ScriptedWorld, Tree};

/// A primitive: a box with three plates, each perpendicular to one axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cross {
    /// The box.
    pub(crate) bounds: Aabb,
    /// The point in which the three plates meet.
    pub(crate) at: Vec3,
}

/// Crosses and a tree over them.
pub(crate) struct CrossScene {
    crosses: Vec<Cross>,
    tree: Tree,
}

impl Cross {
    /// The box from `min` to `max`, with the plates in the middle.
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

    /// The same box without plates: every ray misses it.
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

    /// No crosses, in a tree without nodes.
    pub(crate) fn empty() -> CrossScene {
        CrossScene {
            crosses: Vec::new(),
            tree: Tree::default(),
        }
    }

    /// The work of finding the closest hits of `rays`.
    pub(crate) fn closest(&self, rays: &[Ray]) -> ScriptedWorld {
        self.script(rays, false)
    }

    /// The work of finding whether `rays` hit anything.
    pub(crate) fn any(&self, rays: &[Ray]) -> ScriptedWorld {
        self.script(rays, true)
    }

    /// The results of all box and primitive tests that a traversal may make with `rays`.
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
            is_hidden: false,
        });
        ScriptedWorld {
            tree: self.tree.clone(),
            any_hit,
            rays: rays.collect(),
        }
    }
}

/// The ray from `o` along `axis` (0 for x); `step` is its direction's component on that axis, of
/// either sign.
pub(crate) fn along(axis: usize, step: f64, o: Vec3) -> Ray {
    Ray::new(o, step * Vec3::AXES[axis])
}

fn axis_of(ray: &Ray) -> usize {
    ray.d.abs().max_position()
}

/// The interval in which the line of a ray along an axis is inside a box.
fn span(b: &Aabb, ray: &Ray) -> Option<[f64; 2]> {
    let axis = axis_of(ray);
    let outside = |i: usize| i != axis && !(b.min[i] <= ray.o[i] && ray.o[i] <= b.max[i]);
    if (0..3).any(outside) {
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
