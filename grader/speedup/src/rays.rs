//! The rays that are traced.

use crate::rung::Rung;
use grader::grade::speedup;
use judge::convert;
use kit::{Frame, PixelSampler, Ray, Triangle, Vec3, warp};
use serde::Serialize;
use simd_bvh::TestCounts;

/// The kinds of rays.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum RayKind {
    /// From one point through the pixels of a picture, in order; the closest hit.
    Camera,
    /// From the hits in random directions of the hemisphere; the closest hit.
    Bounce,
    /// From the hits to a point above the mesh; any hit.
    Shadow,
}

impl RayKind {
    /// All kinds.
    pub const ALL: [RayKind; 3] = [RayKind::Camera, RayKind::Bounce, RayKind::Shadow];
}

/// The rays of each kind.
pub struct RaySets {
    sets: [Vec<Ray>; 3],
}

/// The distance of an origin from its surface, as a share of the size of the meshes, which is 2.
const OFFSET: f64 = 1e-9;

/// Shadow rays go to this point.
const LIGHT: Vec3 = Vec3::new(0.3, 3.0, 0.2);

impl RaySets {
    /// Camera rays of `grader part2`, and the bounce and shadow rays from their hits, which `rung`
    /// finds.
    pub fn new(triangles: &[Triangle], rung: &Rung, seed: u64) -> RaySets {
        let camera: Vec<Ray> = speedup::rays().iter().map(convert::ray).collect();
        let mut sampler = PixelSampler::new(0, 0, seed);
        let (mut bounce, mut shadow) = (Vec::new(), Vec::new());
        for ray in &camera {
            let Some((t, id)) = rung.closest(ray, &mut TestCounts::default()) else {
                continue;
            };
            let triangle = &triangles[id.0 as usize];
            let normal = (triangle.p1 - triangle.p0)
                .cross(triangle.p2 - triangle.p0)
                .normalize_or(Vec3::Y);
            let normal = if normal.dot(ray.d) > 0.0 {
                -normal
            } else {
                normal
            };
            let o = ray.o + t * ray.d + OFFSET * normal;
            let d = Frame::around(normal).to_world(warp::uniform_hemisphere(sampler.next_2d()));
            bounce.push(Ray::new(o, d));
            let to_light = LIGHT - o;
            shadow.push(Ray {
                max_t: to_light.length(),
                ..Ray::new(o, to_light.normalize())
            });
        }
        RaySets {
            sets: [camera, bounce, shadow],
        }
    }

    /// The rays of `kind`.
    pub fn of(&self, kind: RayKind) -> &[Ray] {
        &self.sets[kind as usize]
    }
}
