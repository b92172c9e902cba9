//! The results that score, in the form in which answers are judged.

use kit::{Vec2, Vec3};
use oracle::BigFloat;

/// The answers that score for one ray.
#[derive(Clone, Debug, PartialEq)]
pub struct Expected {
    /// The hits that score, the likeliest first: more than one where rounding errors of correct
    /// `f64` code decide which hit is the closest, or where shapes touch.
    pub hits: Vec<ExpectedHit>,
    /// Whether a miss scores.
    pub miss: bool,
    /// Why the ray truly misses, as the end of the sentence "it misses: ..."; empty if it hits.
    pub why_miss: &'static str,
}

/// Whether hit, miss or both are right.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HitOrMiss {
    /// Only a hit is right.
    Hit,
    /// Only a miss is right.
    Miss,
    /// Both are right: rounding errors of correct `f64` code decide.
    Either,
}

/// An exact hit, and how far an answer may be from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExpectedHit {
    /// Number of the primitive.
    pub prim: u32,
    /// Distance along the ray, rounded to the nearest float.
    pub t: f64,
    /// `t` with more digits than `f64` has.
    pub exact_t: BigFloat,
    /// How far `t` may be off.
    pub t_bound: f64,
    /// Hit point.
    pub p: Vec3,
    /// How far each coordinate of the hit point may be off, in world units.
    pub p_bound: f64,
    /// The surface on which the hit point must lie, and its largest distance from it; `None` if
    /// that is not judged.
    pub surface: Option<(TrueSurface, f64)>,
    /// Barycentric weights of `p1` and `p2`, and how far they may be off; for triangles.
    pub uv: Option<(Vec2, f64)>,
    /// Unit shading normal; `None` where any unit vector is right (the vertex normals cancel).
    pub n: Option<Vec3>,
    /// How far a component of the shading normal may be off.
    pub n_bound: f64,
    /// Unit geometric normal; `None` where any unit vector is right (a sphere without size).
    pub ng: Option<Vec3>,
    /// How far a component of the geometric normal may be off.
    pub ng_bound: f64,
}

/// The exact surface of a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TrueSurface {
    /// The plane through a point with a unit normal.
    Plane(Vec3, Vec3),
    /// The sphere around a centre with a radius.
    Sphere(Vec3, f64),
}

impl Expected {
    /// Whether hit, miss or both are right.
    pub fn decision(&self) -> HitOrMiss {
        match (self.hits.is_empty(), self.miss) {
            (true, _) => HitOrMiss::Miss,
            (false, true) => HitOrMiss::Either,
            (false, false) => HitOrMiss::Hit,
        }
    }

    /// Whether `max_t` is right after a call that returned a wrong hit or miss. `before` is `max_t`
    /// before the call.
    pub fn has_right_max_t(&self, returned: Option<f64>, before: f64, max_t: f64) -> bool {
        let is_right_t = |t: f64| {
            let mut hits = self.hits.iter();
            hits.any(|hit| (t - hit.t).abs() <= hit.t_bound)
        };
        let is_miss = self.hits.is_empty();
        let is_returned_right = returned.map_or(is_miss || self.miss, is_right_t);
        let is_right = is_right_t(max_t) || is_miss && max_t == before;
        !is_returned_right && is_right
    }

    /// The expected hit to compare an answer with: one of the same primitive if possible, and of
    /// those the one whose `t` is the closest relative to its bound.
    pub fn closest_to(&self, prim: u32, t: f64) -> Option<&ExpectedHit> {
        let off = |hit: &ExpectedHit| {
            let off = (t - hit.t).abs() / hit.t_bound;
            (
                hit.prim != prim,
                if off.is_nan() { f64::INFINITY } else { off },
            )
        };
        let key = |a: &ExpectedHit, b: &ExpectedHit| {
            let ((a_other, a_off), (b_other, b_off)) = (off(a), off(b));
            a_other.cmp(&b_other).then(a_off.total_cmp(&b_off))
        };
        self.hits.iter().min_by(|a, b| key(a, b))
    }
}

impl TrueSurface {
    /// How far `p` is from the surface.
    pub fn distance(&self, p: Vec3) -> f64 {
        match *self {
            TrueSurface::Plane(q, n) => (p - q).dot(n).abs(),
            TrueSurface::Sphere(center, radius) => ((p - center).length() - radius).abs(),
        }
    }
}
