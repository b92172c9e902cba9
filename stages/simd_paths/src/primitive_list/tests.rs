//! A list of primitives finds the hits of the scalar kernels, bit for bit.

use super::{PrimitiveList, Scratch};
use crate::fallback::{Beam, NextRay, ScalarFallback, ScalarPath};
use crate::ray_packet::{NONE, RayPacket};
use crate::vec3x8::{LANES, Vec3x8};
use fearless_simd::{Level, Simd, f64x8, prelude::*};
use kit::{
    Hit, PixelSampler, PrimId, Primitive, Ray, Scene, Spectrum, Sphere, Triangle, TriangleHit,
    Vec3, warp,
};
use lanes::dispatch;

/// The scalar kernels; nothing else is called.
struct Kernels<'a>(&'a Scene);

impl ScalarFallback for Kernels<'_> {
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
        unreachable!("nothing is shaded")
    }

    fn closest(&mut self, ray: &Ray, skip: Option<PrimId>) -> Option<(PrimId, TriangleHit)> {
        (0..self.0.len() as u32)
            .map(PrimId)
            .filter(|&id| skip != Some(id))
            .filter_map(|id| Some((id, self.test(id, ray)?)))
            .reduce(|a, b| if b.1.t < a.1.t { b } else { a })
    }

    fn occluded(&mut self, _: &Ray, _: Option<PrimId>) -> bool {
        unreachable!("the list finds hits itself")
    }

    fn primitives_in(&mut self, _: &Beam, _: usize, _: &mut Vec<PrimId>) -> bool {
        unreachable!("the list has all primitives")
    }

    fn through_lens(&mut self, _: &Ray, _: &mut PixelSampler) -> Ray {
        unreachable!("there is no camera")
    }

    fn texture_color(&mut self, _: &Hit) -> Spectrum {
        unreachable!("nothing is shaded")
    }

    fn scatter(&mut self, _: &mut ScalarPath, _: Vec3, _: &Hit) -> Option<NextRay> {
        unreachable!("no path is traced")
    }
}

struct Random(PixelSampler);

impl Random {
    fn one(&mut self) -> f64 {
        self.0.next_1d()
    }

    fn below(&mut self, n: usize) -> usize {
        (self.one() * n as f64) as usize
    }

    /// A point of a coarse grid, or any point of the cube from -1 to 1.
    fn point(&mut self) -> Vec3 {
        let p = self.0.next_2d();
        let p = 2.0 * Vec3::new(p.x, p.y, self.one()) - 1.0;
        if self.below(2) == 0 {
            (2.0 * p).round() / 2.0
        } else {
            p
        }
    }

    /// A vertex, a point on an edge or a point inside.
    fn on(&mut self, t: &Triangle) -> Vec3 {
        let s = self.one();
        match self.below(4) {
            0 => t.p0,
            1 => t.p0 + s * (t.p1 - t.p0),
            2 => t.p1 + s * (t.p2 - t.p1),
            _ => t.p0 + 0.5 * s * (t.p1 - t.p0) + 0.5 * (1.0 - s) * (t.p2 - t.p0),
        }
    }

    /// A ray towards a point where hits are hard to decide; some have unusual ranges or directions.
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
    list: &PrimitiveList,
    scene: &Scene,
    rays: &[Ray; LANES],
    active: u64,
    skip: [f64; LANES],
) -> u32 {
    let lanes = RayPacket {
        o: Vec3x8::gather(simd, |lane| rays[lane].o.to_array()),
        d: Vec3x8::gather(simd, |lane| rays[lane].d.to_array()),
        min_t: f64x8::from_fn(simd, |lane| rays[lane].min_t),
        max_t: f64x8::from_fn(simd, |lane| rays[lane].max_t),
    };
    let mut scratch = Scratch::default();
    let mut kernels = Kernels(scene);
    let skip_lanes = f64x8::load_array(simd, skip);
    let hits = list.closest(simd, &lanes, active, skip_lanes, &mut scratch, &kernels);
    let (blocked, _) = list.occluded(simd, &lanes, active, skip_lanes, &mut scratch, &kernels);
    let [b1, b2] = hits.weights();
    let mut found = 0;
    for lane in (0..LANES).filter(|lane| active >> lane & 1 == 1) {
        let expected = kernels.closest(&rays[lane], crate::ray_packet::prim_id(skip[lane]));
        let is_hit = hits.prim[lane] >= 0.0;
        let actual = is_hit.then(|| {
            let bits = [hits.t[lane], b1[lane], b2[lane]].map(f64::to_bits);
            (hits.prim[lane] as u32, bits)
        });
        let expected = expected.map(|(id, hit)| (id.0, [hit.t, hit.b1, hit.b2].map(f64::to_bits)));
        assert_eq!(actual, expected, "{:?} in {scene:?}", rays[lane]);
        assert_eq!(blocked >> lane & 1 == 1, is_hit, "{:?}", rays[lane]);
        found += u32::from(is_hit);
    }
    found
}

#[test]
fn the_list_finds_the_hits_of_brute_force() {
    let mut random = Random(PixelSampler::new(0, 0, 6));
    let mut hits = 0;
    for i in 0..3000 {
        let scene = random.scene([1.0, 1e-9, 1e90][i % 3]);
        let list = PrimitiveList::of(&scene, |_| true).expect("few primitives");
        for _ in 0..8 {
            let rays: [Ray; LANES] = std::array::from_fn(|_| random.ray(&scene));
            let skip = std::array::from_fn(|_| match random.below(3) {
                0 => random.below(scene.len()) as f64,
                _ => NONE,
            });
            let active = random.below(256) as u64;
            for level in [Level::new(), Level::baseline()] {
                hits += dispatch!(level, simd => check(simd, &list, &scene, &rays, active, skip));
            }
        }
    }
    assert!(hits > 50_000, "{hits} rays hit");
}
