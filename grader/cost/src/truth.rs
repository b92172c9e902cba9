//! What the oracle says of a ray and a shape, put the same way for every shape; and answers, put the same way for every
//! kernel.

use super::rays::Target;
use kernels::Found;
use kit::{Aabb, Interval, Ray, Sphere, Triangle, Vec3};
use oracle::bbox::{END_ERROR, End};
use oracle::{self, Kernel, BigFloat, surface};

/// What is true of one pair.
#[derive(Clone, Debug)]
pub(crate) struct Truth {
    /// Whether the ray hits; the conventions of the course count.
    pub(crate) hits: bool,
    /// Whether even a robust kernel in `f64` may answer either way.
    pub(crate) undecidable: bool,
    /// By how much a box is missed, relative to `t`: a test for a tree may hit by a hair too much. Infinite for
    /// surfaces.
    pub(crate) gap: f64,
    /// Where: `t`, or those ends of a box's interval that are not the ray's own. Empty for a miss.
    pub(crate) ends: [Option<TrueEnd>; 2],
    /// The hit point, on surfaces.
    pub(crate) p: Option<Vec3>,
    /// See [`Target::faces`].
    pub(crate) faces: bool,
}

/// A true `t`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TrueEnd {
    /// Its value.
    pub(crate) t: BigFloat,
    /// How far a robust kernel in `f64` may be off.
    pub(crate) bound: f64,
}

/// What a kernel says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Answer {
    /// `t`, or both ends of the interval.
    pub(crate) ends: [f64; 2],
    /// The hit point, on surfaces.
    pub(crate) p: Option<Vec3>,
}

impl From<Found> for Answer {
    fn from(found: Found) -> Answer {
        Answer {
            ends: [found.t; 2],
            p: Some(found.p),
        }
    }
}

impl From<Interval> for Answer {
    fn from(interval: Interval) -> Answer {
        Answer {
            ends: [interval.min, interval.max],
            p: None,
        }
    }
}

/// A shape that the oracle knows about.
pub(crate) trait Judged: Target {
    /// The oracle's verdict.
    fn truth(&self, ray: &Ray) -> Truth;

    /// How far a point is off the surface.
    fn off_surface(&self, p: Vec3) -> f64;

    /// The largest coordinate of the shape, whatever its sign: what positions are measured by.
    fn reach(&self) -> f64;
}

impl Judged for Triangle {
    fn truth(&self, ray: &Ray) -> Truth {
        let verdict = oracle::triangle(self, ray);
        let crossing = verdict.crossing.filter(|_| verdict.hits());
        let end = crossing.map(|at| TrueEnd {
            t: at.t,
            bound: at.t_tolerance.robust,
        });
        Truth {
            hits: verdict.hits(),
            undecidable: verdict.undecidable(Kernel::Robust),
            gap: f64::INFINITY,
            ends: [end, None],
            p: crossing.map(|at| surface::triangle_point(self, &at).p),
            faces: self.faces(ray),
        }
    }

    fn off_surface(&self, p: Vec3) -> f64 {
        surface::off_plane(self, p)
    }

    fn reach(&self) -> f64 {
        let outmost = self.p0.abs().max(self.p1.abs()).max(self.p2.abs());
        outmost.max_element()
    }
}

impl Judged for Sphere {
    fn truth(&self, ray: &Ray) -> Truth {
        let verdict = oracle::sphere(self, ray);
        let root = verdict.t.and_then(|t| {
            let roots = verdict.roots?;
            roots.iter().position(|root| *root == t)
        });
        let end = verdict.t.zip(root).map(|(t, root)| TrueEnd {
            t,
            bound: verdict.t_tolerance[root].robust,
        });
        let point = root.and_then(|root| surface::sphere_point(&verdict, ray, root));
        Truth {
            hits: verdict.hits(),
            undecidable: verdict.undecidable(Kernel::Robust),
            gap: f64::INFINITY,
            ends: [end, None],
            p: point.map(|point| point.p),
            faces: true,
        }
    }

    fn off_surface(&self, p: Vec3) -> f64 {
        surface::off_sphere(self, p)
    }

    fn reach(&self) -> f64 {
        self.center.abs().max_element() + self.radius
    }
}

impl Judged for Aabb {
    fn truth(&self, ray: &Ray) -> Truth {
        let verdict = oracle::bbox(self, ray);
        let true_end = |end: End, own: f64| match end {
            End::At(t) if t != BigFloat::new(own) => Some(TrueEnd {
                t,
                bound: END_ERROR * t.to_f64().abs(),
            }),
            _ => None,
        };
        let own = |end: f64| if end.is_finite() { end } else { 0.0 };
        let ends = verdict.inside.map_or([None; 2], |inside| {
            [
                true_end(inside.min, own(ray.min_t)),
                true_end(inside.max, own(ray.max_t)),
            ]
        });
        Truth {
            hits: verdict.hits(),
            undecidable: verdict.undecidable(Kernel::Robust),
            gap: verdict.gap,
            ends,
            p: None,
            faces: true,
        }
    }

    fn off_surface(&self, _: Vec3) -> f64 {
        0.0
    }

    fn reach(&self) -> f64 {
        self.min.abs().max(self.max.abs()).max_element()
    }
}
