//! Random and hard inputs from a fixed seed.

use kit::{PixelSampler, Ray, Triangle, Vec3, warp};

pub(crate) struct Random(PixelSampler);

impl Random {
    pub(crate) fn new(seed: u64) -> Random {
        Random(PixelSampler::new(0, 0, seed))
    }

    /// A number in [0, 1).
    pub(crate) fn one(&mut self) -> f64 {
        self.0.next_1d()
    }

    pub(crate) fn below(&mut self, n: usize) -> usize {
        (self.one() * n as f64) as usize
    }

    /// One of `choices`.
    pub(crate) fn of<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.below(choices.len())]
    }

    pub(crate) fn direction(&mut self) -> Vec3 {
        warp::uniform_sphere(self.0.next_2d())
    }

    /// A point of a coarse grid, where much is equal or in one plane, or any point of the cube from
    /// -1 to 1.
    pub(crate) fn point(&mut self) -> Vec3 {
        let p = 2.0 * Vec3::new(self.one(), self.one(), self.one()) - 1.0;
        self.of(&[p, (2.0 * p).round() / 2.0])
    }

    /// A direction along an axis, with zeros of either sign, or any direction.
    pub(crate) fn normal(&mut self) -> Vec3 {
        let any = self.direction();
        let axis = self.of(&[Vec3::X, Vec3::Y, Vec3::Z]);
        self.of(&[any, any, axis, -axis])
    }

    /// A triangle; some have no area or are needles. The normals of the vertices agree, differ or
    /// cancel.
    pub(crate) fn triangle(&mut self) -> Triangle {
        let mut p = [0, 1, 2].map(|_| self.point());
        match self.below(8) {
            0 => p[2] = p[self.below(2)],
            1 => p[2] = 0.5 * (p[0] + p[1]),
            2 => p[2] = p[0] + 1e-7 * self.direction(),
            _ => {}
        }
        let scale = self.scale();
        let [p0, p1, p2] = p.map(|p| scale * p);
        let mut triangle = Triangle::flat(p0, p1, p2);
        if self.below(3) > 0 {
            triangle.n0 = self.normal();
            triangle.n1 = self.normal();
            let last = [self.normal(), -triangle.n0, Vec3::NAN];
            triangle.n2 = self.of(&last);
        }
        triangle
    }

    /// The weights of the second and third vertex at a vertex, on an edge or inside.
    pub(crate) fn weights(&mut self) -> [f64; 2] {
        let (a, b) = (self.one(), self.one());
        self.of(&[
            [0.0, 0.0],
            [1.0, 0.0],
            [a, 0.0],
            [a, 1.0 - a],
            [a * b, a * (1.0 - b)],
        ])
    }

    /// A ray from `o` towards `to`. Some directions are not unit, have zeros of either sign or are
    /// no directions; some ranges end before the target or at it, or begin behind the origin.
    pub(crate) fn ray(&mut self, o: Vec3, to: Vec3) -> Ray {
        let mut d = to - o;
        match self.below(14) {
            0..6 => d = d.normalize_or(Vec3::X),
            6 => d[self.below(3)] = 0.0,
            7 => d[self.below(3)] = -0.0,
            8 => d = self.direction(),
            9 => d *= 1e-200,
            10 => d *= 1e160,
            11 => d[self.below(3)] = self.of(&[f64::NAN, f64::INFINITY]),
            12 => d *= self.of(&[0.0, 1e-320]),
            _ => {}
        }
        let mut ray = Ray::new(o, d);
        match self.below(8) {
            0 => ray.max_t = 1.0,
            1 => ray.min_t = -2.0,
            2 => ray.min_t = 1.0,
            3 => ray.max_t = self.of(&[f64::NAN, -1.0, 0.0]),
            _ => {}
        }
        ray
    }

    /// Scales at which squares are ordinary, underflow or overflow.
    pub(crate) fn scale(&mut self) -> f64 {
        self.of(&[1.0, 1.0, 1.0, 1e-9, 1e6, 1e-130, 1e90, 1e200])
    }
}

/// The numbers of a ray, as a formula takes them.
pub(crate) fn numbers(ray: &Ray) -> [f64; 8] {
    let (o, d) = (ray.o, ray.d);
    [o.x, o.y, o.z, d.x, d.y, d.z, ray.min_t, ray.max_t]
}

/// The ray with these [`numbers`].
#[inline(always)]
pub(crate) fn ray<R: Copy>(n: &[R]) -> lanes::Ray<R> {
    lanes::Ray {
        o: vector(&n[0..3]),
        d: vector(&n[3..6]),
        min_t: n[6],
        max_t: n[7],
    }
}

#[inline(always)]
pub(crate) fn vector<R: Copy>(n: &[R]) -> lanes::Vec3<R> {
    lanes::Vec3 {
        x: n[0],
        y: n[1],
        z: n[2],
    }
}

/// The numbers of a vector, as formulas return them.
#[inline(always)]
pub(crate) fn coordinates<R>(v: lanes::Vec3<R>) -> [R; 3] {
    [v.x, v.y, v.z]
}

/// All numbers of `parts`, one after the other.
pub(crate) fn join<const N: usize>(parts: &[&[f64]]) -> [f64; N] {
    parts.concat().try_into().expect("as many numbers")
}
