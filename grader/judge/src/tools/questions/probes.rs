//! Makes probes: random numbers that are the same on every machine, shapes, rays at them, and lists
//! of both for the worker.

use kit::{PixelSampler, Ray, Sphere, Triangle, Vec3};
use wire::work::{self, BruteForceWork, Probe, SphereWork, TriangleWork, Xyz};

/// A random number generator whose numbers depend only on a name and a seed.
pub struct ProbeRng(PixelSampler);

impl ProbeRng {
    /// The generator of the case `name`; `seed` is 0 where its numbers are always the same.
    pub fn new(name: &str, seed: u64) -> ProbeRng {
        // FNV-1a (Fowler, Noll, Vo): any change of the name changes the numbers.
        let hash = name.bytes().fold(0x811c_9dc5_u32, |hash, byte| {
            (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193)
        });
        ProbeRng(PixelSampler::new(hash, 0, seed))
    }

    /// Uniform in [low, high).
    pub fn range(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.next_1d()
    }

    /// Uniform among 0..count.
    pub fn below(&mut self, count: usize) -> usize {
        (self.0.next_1d() * count as f64) as usize
    }

    /// One of the given values.
    pub fn one_of<T: Copy>(&mut self, values: &[T]) -> T {
        values[self.below(values.len())]
    }

    /// Uniform in the cube [-1, 1]³.
    pub fn in_cube(&mut self) -> Vec3 {
        let [x, y, z] = [0; 3].map(|_| self.range(-1.0, 1.0));
        Vec3::new(x, y, z)
    }

    /// Uniform on the unit sphere.
    pub fn direction(&mut self) -> Vec3 {
        loop {
            let v = self.in_cube();
            let length = v.length();
            if (0.1..=1.0).contains(&length) {
                return v / length;
            }
        }
    }

    /// Barycentric weights of `p1` and `p2` of a point inside a triangle; all three weights are at
    /// least `margin`.
    pub fn inside(&mut self, margin: f64) -> [f64; 2] {
        loop {
            let (b1, b2) = (self.range(0.0, 1.0), self.range(0.0, 1.0));
            if b1.min(b2).min(1.0 - b1 - b2) >= margin {
                return [b1, b2];
            }
        }
    }

    /// A triangle in [-1, 1]³ that is neither small nor thin, each vertex with a normal of its own.
    pub(crate) fn triangle(&mut self) -> Triangle {
        loop {
            let [p0, p1, p2] = [0; 3].map(|_| self.in_cube());
            let longest = (p1 - p0)
                .length()
                .max((p2 - p0).length())
                .max((p2 - p1).length());
            let doubled_area = (p1 - p0).cross(p2 - p0).length();
            if doubled_area > 0.5 && doubled_area > 0.4 * longest * longest {
                return self.with_normals(Triangle::flat(p0, p1, p2));
            }
        }
    }

    /// The triangle with a random normal at each vertex, up to 45 degrees from the geometric
    /// normal.
    pub(crate) fn with_normals(&mut self, flat: Triangle) -> Triangle {
        let [n0, n1, n2] = [0; 3].map(|_| (flat.n0 + 0.7 * self.direction()).normalize());
        Triangle { n0, n1, n2, ..flat }
    }

    /// A ray of unit direction that crosses the plane of `triangle` where the weights of `p1` and
    /// `p2` are `b`, at `t = distance`. It comes from the side of the normal (`side` 1) or from the
    /// other (-1), at most 65 degrees from the normal.
    pub(crate) fn ray_to(
        &mut self,
        triangle: &Triangle,
        b: [f64; 2],
        side: f64,
        distance: f64,
    ) -> Ray {
        let normal = (triangle.p1 - triangle.p0)
            .cross(triangle.p2 - triangle.p0)
            .normalize();
        let away = loop {
            let away = self.direction();
            if away.dot(normal) * side > 0.42 {
                break away;
            }
        };
        Ray::new(at(triangle, b) + distance * away, -away)
    }
}

impl ProbeRng {
    /// A sphere of radius 0.2 to 5, its centre up to 10 away.
    pub(crate) fn sphere(&mut self) -> Sphere {
        Sphere {
            center: 10.0 * self.direction() * self.range(0.1, 1.0),
            radius: self.range(0.2, 5.0),
        }
    }

    /// A ray of unit direction whose closest point to the centre of `s` is at `t = distance`,
    /// `impact` radii away from the centre (a miss if that is above 1).
    pub fn ray_past(&mut self, s: &Sphere, impact: f64, distance: f64) -> Ray {
        let d = self.direction();
        let aside = loop {
            let aside = self.direction().reject_from_normalized(d);
            if aside.length() > 0.2 {
                break aside.normalize();
            }
        };
        Ray::new(s.center + impact * s.radius * aside - distance * d, d)
    }
}

/// The point of a triangle's plane where `p1` and `p2` have the weights `b`.
pub fn at(t: &Triangle, [b1, b2]: [f64; 2]) -> Vec3 {
    t.p0 + b1 * (t.p1 - t.p0) + b2 * (t.p2 - t.p0)
}

/// The ray from `o` through `target`, of unit direction.
pub fn through(o: Vec3, target: Vec3) -> Ray {
    Ray::new(o, (target - o).normalize())
}

/// The same ray with another range.
pub(crate) fn within(ray: Ray, min_t: f64, max_t: f64) -> Ray {
    Ray {
        min_t,
        max_t,
        ..ray
    }
}

/// Triangles or spheres with rays aimed at them, for the worker.
#[derive(Default)]
pub(crate) struct Probes {
    triangles: Vec<[Xyz; 6]>,
    spheres: Vec<(Xyz, f64)>,
    probes: Vec<Probe>,
}

impl Probes {
    /// Adds a triangle; the rays added next are aimed at it.
    pub(crate) fn triangle(&mut self, t: &Triangle) {
        self.triangles.push(wire_triangle(t));
    }

    /// Adds a sphere; the rays added next are aimed at it.
    pub(crate) fn sphere(&mut self, s: &Sphere) {
        self.spheres.push((s.center.into(), s.radius));
    }

    /// Adds a ray aimed at the last shape.
    pub(crate) fn ray(&mut self, ray: Ray) {
        let shapes = self.triangles.len() + self.spheres.len();
        self.probes.push(Probe {
            shape: shapes as u32 - 1,
            ray: wire_ray(&ray),
        });
    }

    /// All rays, aimed at triangles.
    pub(crate) fn of_triangles(self) -> TriangleWork {
        assert!(self.spheres.is_empty(), "probes are aimed at triangles");
        TriangleWork {
            triangles: self.triangles,
            probes: self.probes,
            by_record: false,
        }
    }

    /// All rays, aimed at spheres.
    pub(crate) fn of_spheres(self) -> SphereWork {
        assert!(self.triangles.is_empty(), "probes are aimed at spheres");
        SphereWork {
            spheres: self.spheres,
            probes: self.probes,
        }
    }
}

/// The work of tracing rays through a list of shapes.
pub fn brute_force(triangles: &[Triangle], spheres: &[Sphere], rays: &[Ray]) -> BruteForceWork {
    BruteForceWork {
        triangles: triangles.iter().map(wire_triangle).collect(),
        spheres: spheres
            .iter()
            .map(|s| (s.center.into(), s.radius))
            .collect(),
        rays: rays.iter().map(wire_ray).collect(),
    }
}

/// Converts a ray to the type of `wire`.
pub fn wire_ray(ray: &Ray) -> work::Ray {
    work::Ray {
        o: ray.o.into(),
        d: ray.d.into(),
        min_t: ray.min_t,
        max_t: ray.max_t,
    }
}

/// Converts a triangle to the type of `wire`: vertices, then their normals.
pub fn wire_triangle(t: &Triangle) -> [Xyz; 6] {
    [t.p0, t.p1, t.p2, t.n0, t.n1, t.n2].map(Vec3::into)
}
