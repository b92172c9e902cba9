//! Exact results in rational arithmetic: slow, simple, and without rounding errors.
// BEGIN SOLUTION(part1.task3)
use kit::{Ray, Sphere, Triangle, Vec3};
use num_rational::BigRational;

type Exact = BigRational;
type ExactVec = [Exact; 3];

fn exact(x: f64) -> Exact {
    Exact::from_float(x).expect("inputs are finite")
}

fn exact_vec(v: Vec3) -> ExactVec {
    v.to_array().map(exact)
}

fn minus(a: &ExactVec, b: &ExactVec) -> ExactVec {
    [&a[0] - &b[0], &a[1] - &b[1], &a[2] - &b[2]]
}

fn cross(a: &ExactVec, b: &ExactVec) -> ExactVec {
    [
        &a[1] * &b[2] - &a[2] * &b[1],
        &a[2] * &b[0] - &a[0] * &b[2],
        &a[0] * &b[1] - &a[1] * &b[0],
    ]
}

fn dot(a: &ExactVec, b: &ExactVec) -> Exact {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

/// `x` rounded to a float, with an error of at most 1 ulp.
fn to_f64(x: &Exact) -> f64 {
    // Converts an integer multiple of 2^-k, with k chosen so that it has well over 53 bits.
    let size = x.numer().bits() as i64 - x.denom().bits() as i64;
    let shift = 80 - size;
    let scaled = if shift >= 0 {
        (x.numer() << shift as usize) / x.denom()
    } else {
        x.numer() / (x.denom() << (-shift) as usize)
    };
    let digits: f64 = scaled
        .to_string()
        .parse()
        .expect("an integer has decimal digits");
    let half = (-shift / 2) as i32;
    digits * 2.0_f64.powi(half) * 2.0_f64.powi(-shift as i32 - half)
}

/// The intersection of the infinite line of a ray with the plane of a triangle.
pub(crate) struct Crossing {
    t: Exact,
    weights: [Exact; 3],
}

impl Crossing {
    /// `None` if the line is parallel to the plane or the triangle has no area.
    pub(crate) fn of(tri: &Triangle, ray: &Ray) -> Option<Crossing> {
        let [p0, p1, p2, o, d] = [tri.p0, tri.p1, tri.p2, ray.o, ray.d].map(exact_vec);
        let (e1, e2, s) = (minus(&p1, &p0), minus(&p2, &p0), minus(&o, &p0));
        // Cramer's rule.
        let p = cross(&d, &e2);
        let det = dot(&e1, &p);
        if det == exact(0.0) {
            return None;
        }
        let q = cross(&s, &e1);
        let b1 = dot(&s, &p) / &det;
        let b2 = dot(&d, &q) / &det;
        Some(Crossing {
            t: dot(&e2, &q) / &det,
            weights: [exact(1.0) - &b1 - &b2, b1, b2],
        })
    }

    /// Whether the intersection is inside the triangle, including its edges.
    pub(crate) fn is_inside(&self) -> bool {
        self.weights.iter().all(|w| *w >= exact(0.0))
    }

    /// The smallest barycentric weight. It is negative if the intersection is outside of the
    /// triangle.
    pub(crate) fn margin(&self) -> f64 {
        let [a, b, c] = &self.weights;
        to_f64(a.min(b).min(c))
    }

    /// The distance along the ray, rounded.
    pub(crate) fn t(&self) -> f64 {
        to_f64(&self.t)
    }

    /// The absolute error of `t`.
    pub(crate) fn error_of(&self, t: f64) -> f64 {
        to_f64(&(exact(t) - &self.t)).abs()
    }
}

/// The unit normal of the plane of `tri`, rounded.
pub(crate) fn unit_normal(tri: &Triangle) -> Vec3 {
    let [p0, p1, p2] = [tri.p0, tri.p1, tri.p2].map(exact_vec);
    let normal = cross(&minus(&p1, &p0), &minus(&p2, &p0));
    let largest = normal
        .iter()
        .map(|x| x.max(&-x).clone())
        .max()
        .expect("there are three components");
    let zero = exact(0.0);
    Vec3::from_array(normal.map(|x| {
        if x == zero {
            0.0
        } else {
            to_f64(&(x / &largest))
        }
    }))
    .normalize()
}

/// The distance of `p` from the plane of `tri`, exact to first order.
pub(crate) fn distance_from_plane(tri: &Triangle, p: Vec3) -> f64 {
    let [p0, p1, p2, p] = [tri.p0, tri.p1, tri.p2, p].map(exact_vec);
    let normal = cross(&minus(&p1, &p0), &minus(&p2, &p0));
    to_f64(&dot(&normal, &minus(&p, &p0))).abs() / to_f64(&dot(&normal, &normal)).sqrt()
}

/// The discriminant `b² - a·c` of the ray/sphere equation, with exact sign: negative for a line
/// that misses, 0 for a tangent.
pub(crate) fn discriminant(s: &Sphere, ray: &Ray) -> f64 {
    let [center, o, d] = [s.center, ray.o, ray.d].map(exact_vec);
    let f = minus(&o, &center);
    let (a, b) = (dot(&d, &d), dot(&f, &d));
    let c = dot(&f, &f) - exact(s.radius) * exact(s.radius);
    let disc = &b * &b - a * c;
    if disc == exact(0.0) {
        0.0
    } else {
        to_f64(&disc)
    }
}

/// The distance of `t` from the nearest root of the ray/sphere equation, by one exact Newton step.
/// It is accurate if the error is small compared to the distance between the roots.
pub(crate) fn error_of_root(s: &Sphere, ray: &Ray, t: f64) -> f64 {
    let [center, o, d] = [s.center, ray.o, ray.d].map(exact_vec);
    let t = exact(t);
    let at: ExactVec = [0, 1, 2].map(|i| &o[i] + &t * &d[i] - &center[i]);
    let value = dot(&at, &at) - exact(s.radius) * exact(s.radius);
    if value == exact(0.0) {
        return 0.0;
    }
    to_f64(&(value / (exact(2.0) * dot(&at, &d)))).abs()
}

/// The distance of `p` from the surface of `s`.
pub(crate) fn distance_from_sphere(s: &Sphere, p: Vec3) -> f64 {
    let [center, p] = [s.center, p].map(exact_vec);
    let v = minus(&p, &center);
    let excess = dot(&v, &v) - exact(s.radius) * exact(s.radius);
    if excess == exact(0.0) {
        0.0
    } else {
        to_f64(&excess).abs() / (2.0 * s.radius)
    }
}
// END SOLUTION(part1.task3)
