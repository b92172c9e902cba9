// BEGIN SOLUTION(part6.task2)
//! What a room says is what asking every primitive says, bit for bit.

use super::{Room, Scratch};
use crate::neighbours::{Neighbours, Path};
use crate::rays::{NONE, Rays};
use crate::vec3x8::{LANES, Vec3x8};
use fearless_simd::{Level, Simd, dispatch, f64x8, prelude::*};
use kit::{
    Hit, PixelSampler, PrimId, Primitive, Ray, Scene, Spectrum, Sphere, Triangle, TriangleHit,
    Vec3, warp,
};

/// The plain kernels; nothing else is asked for.
struct Kernels<'a>(&'a Scene);

impl Neighbours for Kernels<'_> {
    fn test(&self, id: PrimId, ray: &Ray) -> Option<TriangleHit> {
        match self.0.primitive(id) {
            Primitive::Triangle(t) => intersect::test_triangle(t, ray),
            Primitive::Sphere(s) => intersect::test_sphere(s, ray).map(|t| TriangleHit {
                t,
                b1: 0.0,
                b2: 0.0,
            }),
        }
    }

    fn record(&self, _: PrimId, _: &Ray, _: TriangleHit) -> Hit {
        unreachable!("nothing is lit")
    }

    fn closest(&mut self, ray: &Ray, left: Option<PrimId>) -> Option<(PrimId, TriangleHit)> {
        (0..self.0.len() as u32)
            .map(PrimId)
            .filter(|&id| left != Some(id))
            .filter_map(|id| Some((id, self.test(id, ray)?)))
            .reduce(|a, b| if b.1.t < a.1.t { b } else { a })
    }

    fn occluded(&mut self, _: &Ray, _: Option<PrimId>) -> bool {
        unreachable!("a room is asked")
    }

    fn aim(&mut self, _: &Ray, _: &mut PixelSampler) -> Ray {
        unreachable!("there is no camera")
    }

    fn tint(&mut self, _: &Hit) -> Spectrum {
        unreachable!("nothing is lit")
    }

    fn go_on(&mut self, _: &mut Path, _: Vec3, _: &Hit) -> Option<(Ray, Option<PrimId>)> {
        unreachable!("no path is followed")
    }
}

struct Numbers(PixelSampler);

impl Numbers {
    fn one(&mut self) -> f64 {
        self.0.next_1d()
    }

    fn below(&mut self, n: usize) -> usize {
        (self.one() * n as f64) as usize
    }

    /// A corner of a coarse grid, or any point of the cube from -1 to 1.
    fn point(&mut self) -> Vec3 {
        let p = self.0.next_2d();
        let p = 2.0 * Vec3::new(p.x, p.y, self.one()) - 1.0;
        if self.below(2) == 0 {
            (2.0 * p).round() / 2.0
        } else {
            p
        }
    }

    /// A corner, a point on an edge or one inside.
    fn on(&mut self, t: &Triangle) -> Vec3 {
        let s = self.one();
        match self.below(4) {
            0 => t.p0,
            1 => t.p0 + s * (t.p1 - t.p0),
            2 => t.p1 + s * (t.p2 - t.p1),
            _ => t.p0 + 0.5 * s * (t.p1 - t.p0) + 0.5 * (1.0 - s) * (t.p2 - t.p0),
        }
    }

    /// A ray at places where hits are hard to tell, some of them with ends or directions out of the ordinary.
    fn ray(&mut self, scene: &Scene) -> Ray {
        let [from, to] = [0, 1].map(|_| {
            let of = self.below(scene.triangles.len());
            self.on(&scene.triangles[of])
        });
        let o = if self.below(2) == 0 {
            from
        } else {
            2.0 * self.point()
        };
        let mut d = to - o;
        match self.below(12) {
            0..6 => d = d.normalize_or(Vec3::X),
            6 => d[self.below(3)] = 0.0,
            7 => d = warp::uniform_sphere(self.0.next_2d()),
            8 => d *= 1e-200,
            9 => d *= 1e160,
            10 => d[self.below(3)] = f64::NAN,
            _ => {}
        }
        let mut ray = Ray::new(o, d);
        match self.below(6) {
            0 => ray.max_t = 1.0,
            1 => ray.min_t = -2.0,
            2 => ray.min_t = 1.0,
            _ => {}
        }
        ray
    }

    fn scene(&mut self, scale: f64) -> Scene {
        let mut triangles: Vec<Triangle> = (0..1 + self.below(16))
            .map(|_| {
                let [a, b, c] = [0, 1, 2].map(|_| scale * self.point());
                Triangle::flat(a, b, c)
            })
            .collect();
        if triangles.len() > 4 {
            triangles[3] = triangles[0];
        }
        let spheres = (0..self.below(9)).map(|_| Sphere {
            center: scale * self.point(),
            radius: scale * [1e-6, 0.3, 1.0, 0.0][self.below(4)],
        });
        Scene {
            spheres: spheres.collect(),
            triangles,
            ..Scene::default()
        }
    }
}

#[inline(always)]
fn check<S: Simd>(
    simd: S,
    room: &Room,
    scene: &Scene,
    rays: &[Ray; LANES],
    asked: u64,
    left: [f64; LANES],
) -> u32 {
    let lanes = Rays {
        o: Vec3x8::gather(simd, |lane| rays[lane].o.to_array()),
        d: Vec3x8::gather(simd, |lane| rays[lane].d.to_array()),
        min_t: f64x8::from_fn(simd, |lane| rays[lane].min_t),
        max_t: f64x8::from_fn(simd, |lane| rays[lane].max_t),
    };
    let mut scratch = Scratch::default();
    let mut kernels = Kernels(scene);
    let left_lanes = f64x8::load_array(simd, left);
    let hits = room.closest(simd, &lanes, asked, left_lanes, &mut scratch, &kernels);
    let (blocked, _) = room.occluded(simd, &lanes, asked, left_lanes, &mut scratch, &kernels);
    let [b1, b2] = hits.weights();
    let mut found = 0;
    for lane in (0..LANES).filter(|lane| asked >> lane & 1 == 1) {
        let wanted = kernels.closest(&rays[lane], crate::rays::prim(left[lane]));
        let is_hit = hits.prim[lane] >= 0.0;
        let said = is_hit.then(|| {
            let bits = [hits.t[lane], b1[lane], b2[lane]].map(f64::to_bits);
            (hits.prim[lane] as u32, bits)
        });
        let wanted = wanted.map(|(id, hit)| (id.0, [hit.t, hit.b1, hit.b2].map(f64::to_bits)));
        assert_eq!(said, wanted, "{:?} in {scene:?}", rays[lane]);
        assert_eq!(blocked >> lane & 1 == 1, is_hit, "{:?}", rays[lane]);
        found += u32::from(is_hit);
    }
    found
}

#[test]
fn a_room_says_what_asking_every_primitive_says() {
    let mut numbers = Numbers(PixelSampler::new(0, 0, 6));
    let mut found = 0;
    for i in 0..3000 {
        let scene = numbers.scene([1.0, 1e-9, 1e90][i % 3]);
        let room = Room::new(&scene).expect("few primitives");
        for _ in 0..8 {
            let rays: [Ray; LANES] = std::array::from_fn(|_| numbers.ray(&scene));
            let left = std::array::from_fn(|_| match numbers.below(3) {
                0 => numbers.below(scene.len()) as f64,
                _ => NONE,
            });
            let asked = numbers.below(256) as u64;
            for level in [Level::new(), Level::baseline()] {
                found += dispatch!(level, simd => check(simd, &room, &scene, &rays, asked, left));
            }
        }
    }
    assert!(found > 50_000, "{found} rays hit");
}
// END SOLUTION(part6.task2)
