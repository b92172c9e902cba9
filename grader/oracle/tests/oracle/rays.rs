//! Random rays and shapes, by seed.

use kit::{Aabb, Ray, Sphere, Triangle, Vec3};

/// SplitMix64 (Steele, Lea, Flood 2014): small, and the same on every platform.
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Random {
        Random(seed)
    }

    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub(crate) fn below(&mut self, n: u64) -> u64 {
        self.bits() % n
    }

    /// Uniform in [0, 1).
    pub(crate) fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 * (0.5 / (1u64 << 52) as f64)
    }

    /// Uniform in [-1, 1).
    pub(crate) fn signed(&mut self) -> f64 {
        2.0 * self.unit() - 1.0
    }

    /// Uniform in the cube [-1, 1)³.
    pub(crate) fn place(&mut self) -> Vec3 {
        Vec3::new(self.signed(), self.signed(), self.signed())
    }

    /// A small integer, from -4 to 4.
    fn integer(&mut self) -> f64 {
        self.below(9) as f64 - 4.0
    }

    fn integers(&mut self) -> Vec3 {
        Vec3::new(self.integer(), self.integer(), self.integer())
    }

    /// Any finite number, all exponents with equal probability; sometimes 0.
    fn extreme(&mut self) -> f64 {
        let x = f64::from_bits(self.bits());
        if !x.is_finite() || self.below(8) == 0 {
            return 0.0;
        }
        x
    }

    fn extremes(&mut self) -> Vec3 {
        Vec3::new(self.extreme(), self.extreme(), self.extreme())
    }

    /// A denormal number of either sign.
    fn denormal(&mut self) -> f64 {
        self.signed() * f64::MIN_POSITIVE
    }

    fn denormals(&mut self) -> Vec3 {
        Vec3::new(self.denormal(), self.denormal(), self.denormal())
    }
}

/// The families of test inputs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Family {
    Ordinary,
    Lattice,
    OnEdge,
    Degenerate,
    Denormal,
    Extreme,
    Sliver,
    FarOffset,
}

/// Returns the family of the `i`th trial. The ones with long exponents come twice in `cycle`
/// trials: their rationals have thousands of bits and take as long as hundreds of others.
pub(crate) fn family(i: u64, cycle: u64) -> Family {
    match i % cycle {
        0 => Family::Extreme,
        1 => Family::Denormal,
        k => [
            Family::Ordinary,
            Family::Lattice,
            Family::OnEdge,
            Family::Degenerate,
            Family::Sliver,
            Family::FarOffset,
        ][(k % 6) as usize],
    }
}

/// Returns a triangle and a ray that passes near it.
pub(crate) fn triangle(r: &mut Random, family: Family) -> (Triangle, Ray) {
    let [mut p0, mut p1, mut p2, o] = match family {
        Family::Lattice => [0; 4].map(|_| r.integers()),
        Family::Extreme => [0; 4].map(|_| r.extremes()),
        Family::Denormal => [0; 4].map(|_| r.denormals()),
        _ => [0; 4].map(|_| r.place()),
    };
    match family {
        Family::Degenerate => match r.below(4) {
            0 => p2 = p0 + r.signed() * (p1 - p0),
            1 => p2 = 2.0 * p1 - p0,
            2 => p1 = p0,
            _ => (p1, p2) = (p0, p0),
        },
        Family::Sliver => p2 = p0 + r.unit() * (p1 - p0) + 1e-9 * r.place(),
        Family::FarOffset => {
            let offset = 1e6 * r.place();
            (p0, p1, p2) = (p0 + offset, p1 + offset, p2 + offset);
        }
        _ => {}
    }
    let o = if family == Family::FarOffset {
        p0 + r.place()
    } else {
        o
    };
    let (u, v) = (r.unit(), r.unit());
    let (u, v) = if family == Family::OnEdge {
        (u, 1.0 - u)
    } else {
        (1.2 * u, 1.2 * v)
    };
    let target = match r.below(8) {
        0 => p1,
        1 => p0.midpoint(p1),
        _ => p0 + u * (p1 - p0) + v * (p2 - p0),
    };
    let d = match (family, r.below(8)) {
        (Family::Lattice, 0..4) => r.integers(),
        (Family::Extreme, 0..4) => r.extremes(),
        (_, 0) => Vec3::X * r.signed(),
        _ => target - o,
    };
    let d = if d.is_finite() { d } else { Vec3::Z };
    (Triangle::flat(p0, p1, p2), ranged(r, o, d))
}

/// Returns a sphere and a ray that passes near it.
pub(crate) fn sphere(r: &mut Random, family: Family) -> (Sphere, Ray) {
    let (center, radius, o) = match family {
        Family::Lattice => (r.integers(), r.integer().abs(), r.integers()),
        Family::Extreme => (r.extremes(), r.extreme().abs(), r.extremes()),
        Family::Denormal => (r.denormals(), r.denormal().abs(), r.denormals()),
        Family::Degenerate => (r.place(), 0.0, r.place()),
        Family::Sliver => (1e3 * r.place(), 1e3 * r.unit(), r.place()),
        Family::FarOffset => {
            let offset = 1e6 * r.place();
            (offset, r.unit(), offset + r.place())
        }
        _ => (r.place(), r.unit(), r.place()),
    };
    let mut aim = center + 1.2 * radius * r.place();
    if family == Family::OnEdge {
        // A point on the rim: perpendicular to the line of sight, at the distance of the radius.
        let across = (center - o).cross(r.place()).normalize_or_zero();
        aim = center + radius * across;
    }
    let d = match (family, r.below(8)) {
        (Family::Lattice, 0..6) => r.integers(),
        (Family::Extreme, 0..4) => r.extremes(),
        (_, 0) => Vec3::X * r.signed(),
        _ => aim - o,
    };
    let d = if d.is_finite() { d } else { Vec3::Z };
    (Sphere { center, radius }, ranged(r, o, d))
}

/// Returns a box and a ray that passes near it.
pub(crate) fn bounds(r: &mut Random, family: Family) -> (Aabb, Ray) {
    let [a, b, o] = match family {
        Family::Lattice => [0; 3].map(|_| r.integers()),
        Family::Extreme => [0; 3].map(|_| r.extremes()),
        Family::Denormal => [0; 3].map(|_| r.denormals()),
        Family::FarOffset => [0; 3].map(|_| Vec3::splat(1e6) + r.place()),
        _ => [0; 3].map(|_| r.place()),
    };
    let mut b = Aabb::of([a, b]);
    if family == Family::Degenerate {
        match r.below(4) {
            0 => b.max.x = b.min.x,
            1 => b.max = b.min,
            2 => b = Aabb::EMPTY,
            _ => b.min.y = f64::NEG_INFINITY,
        }
    }
    let corner = |r: &mut Random| {
        Vec3::from_array([0, 1, 2].map(|i| match r.below(3) {
            0 => b.min[i],
            1 => b.max[i],
            _ => 0.5 * b.min[i] + 0.5 * b.max[i],
        }))
    };
    let mut d = match (family, r.below(4)) {
        (Family::Lattice, 0..2) => r.integers(),
        (Family::Extreme, 0..2) => r.extremes(),
        (Family::OnEdge, _) | (_, 0) => corner(r) - o,
        _ => r.place(),
    };
    if r.below(4) == 0 {
        d[r.below(3) as usize] = if r.below(2) == 0 { 0.0 } else { -0.0 };
    }
    let d = if d.is_finite() { d } else { Vec3::Z };
    (b, ranged(r, o, d))
}

/// Returns a ray, mostly with the default range, sometimes with another one.
fn ranged(r: &mut Random, o: Vec3, d: Vec3) -> Ray {
    let mut ray = Ray::new(o, d);
    match r.below(12) {
        0 => (ray.min_t, ray.max_t) = (r.signed(), 1.0),
        1 => ray.min_t = f64::NEG_INFINITY,
        2 => ray.max_t = 0.5 * r.below(5) as f64,
        3 => ray.min_t = 0.25 * r.below(9) as f64,
        _ => {}
    }
    ray
}
