//! The oracle's truth and the kernels' answers, in the same form for every shape.

use super::rays::Target;
use kernels::HitF64;
use kit::{Aabb, Interval, Ray, Sphere, Triangle, Vec3};
use oracle::bbox::{END_ERROR, End};
use oracle::{self, BigFloat, KernelClass, surface};

/// The oracle's truth for one pair.
#[derive(Clone, Debug)]
pub(crate) struct Truth {
    /// Whether the ray hits, by the conventions of the course.
    pub(crate) hits: bool,
    /// Whether a robust kernel in `f64` may return either result.
    pub(crate) undecidable: bool,
    /// How far the ray misses the box, relative to `t`: a conservative box test may hit if it is a
    /// few ulp. Infinite for other shapes.
    pub(crate) gap: f64,
    /// The true `t`, or those ends of a box's interval that are not the ray's own. Empty for a
    /// miss.
    pub(crate) ends: [Option<TrueEnd>; 2],
    /// The hit point; `None` for boxes.
    pub(crate) p: Option<Vec3>,
    /// See [`Target::is_front_facing`].
    pub(crate) front_facing: bool,
}

/// A true `t`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TrueEnd {
    /// The exact value.
    pub(crate) t: BigFloat,
    /// Error bound of a robust kernel in `f64`.
    pub(crate) bound: f64,
}

/// A kernel's answer for a hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Answer {
    /// `t` twice, or both ends of the interval.
    pub(crate) ends: [f64; 2],
    /// The hit point; `None` for boxes.
    pub(crate) p: Option<Vec3>,
}

impl From<HitF64> for Answer {
    fn from(found: HitF64) -> Answer {
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

/// A shape that the oracle can judge.
pub(crate) trait OracleShape: Target {
    /// Returns the truth for this shape and `ray`.
    fn truth(&self, ray: &Ray) -> Truth;

    /// Returns the distance of a point from the surface.
    fn off_surface(&self, p: Vec3) -> f64;

    /// Returns the largest absolute coordinate of the shape; errors of positions are relative to
    /// it.
    fn reach(&self) -> f64;
}

impl OracleShape for Triangle {
    fn truth(&self, ray: &Ray) -> Truth {
        let verdict = oracle::triangle(self, ray);
        let crossing = verdict.crossing.filter(|_| verdict.hits());
        let end = crossing.map(|at| TrueEnd {
            t: at.t,
            bound: at.t_tolerance.robust,
        });
        Truth {
            hits: verdict.hits(),
            undecidable: verdict.undecidable(KernelClass::Robust),
            gap: f64::INFINITY,
            ends: [end, None],
            p: crossing.map(|at| surface::triangle_point(self, &at).p),
            front_facing: self.is_front_facing(ray),
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

impl OracleShape for Sphere {
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
            undecidable: verdict.undecidable(KernelClass::Robust),
            gap: f64::INFINITY,
            ends: [end, None],
            p: point.map(|point| point.p),
            front_facing: true,
        }
    }

    fn off_surface(&self, p: Vec3) -> f64 {
        surface::off_sphere(self, p)
    }

    fn reach(&self) -> f64 {
        self.center.abs().max_element() + self.radius
    }
}

impl OracleShape for Aabb {
    fn truth(&self, ray: &Ray) -> Truth {
        let verdict = oracle::bbox(self, ray);
        let true_end = |end: End, range_end: f64| match end {
            End::At(t) if t != BigFloat::new(range_end) => Some(TrueEnd {
                t,
                bound: END_ERROR * t.to_f64().abs(),
            }),
            _ => None,
        };
        let range_end = |end: f64| if end.is_finite() { end } else { 0.0 };
        let ends = verdict.inside.map_or([None; 2], |inside| {
            [
                true_end(inside.min, range_end(ray.min_t)),
                true_end(inside.max, range_end(ray.max_t)),
            ]
        });
        Truth {
            hits: verdict.hits(),
            undecidable: verdict.undecidable(KernelClass::Robust),
            gap: verdict.gap,
            ends,
            p: None,
            front_facing: true,
        }
    }

    fn off_surface(&self, _: Vec3) -> f64 {
        0.0
    }

    fn reach(&self) -> f64 {
        self.min.abs().max(self.max.abs()).max_element()
    }
}
