// BEGIN SOLUTION(part6.task2)
//! `lanes::light`, `kit::Emitter::sample` and `direct::estimate_direct_lighting_importance`.

use crate::inputs::{Random, coordinates, join, vector};
use crate::widths::{Formula, as_number, at_every_width, same};
use direct::{estimate_direct_lighting_importance, lambert_f};
use kit::emitting_mesh::EmittingTriangle;
use kit::{
    BsdfSample, Emitter, EmittingMesh, Frame, LitScene, Material, PixelSampler, PrimId, Ray,
    Scattering, Scene, Spectrum, Surface, Vec2, Vec3,
};
use lanes::{Real, diffuse, light};

/// A lamp of one triangle, of several or of some without area.
fn mesh(random: &mut Random) -> Option<EmittingMesh> {
    let count = random.of(&[1, 2, 4, 7]);
    let scale = random.of(&[1.0, 1.0, 1e-9, 1e6]);
    let triangles = (0..count).map(|_| EmittingTriangle {
        p0: scale * random.point(),
        e1: scale * random.point(),
        e2: scale * random.point(),
        front: random.normal(),
    });
    EmittingMesh::new(triangles.collect(), Spectrum::new(3.0, random.one(), 0.0))
}

/// From the point and `u`: whether there is a sample, its direction, distance and density.
struct Sampled<'a>(&'a EmittingMesh);

impl Formula<5, 6> for Sampled<'_> {
    #[inline(always)]
    fn compute<R: Real>(&self, input: [R; 5]) -> [R; 6] {
        let sample = light::sample_mesh(self.0, vector(&input), [input[3], input[4]]);
        let [x, y, z] = coordinates(sample.wi);
        [
            as_number(sample.exists, x),
            x,
            y,
            z,
            sample.distance,
            sample.pdf,
        ]
    }
}

#[test]
fn samples_of_meshes() {
    let mut random = Random::new(12);
    let mut counts = [0; 2];
    for _ in 0..200 {
        let Some(mesh) = mesh(&mut random) else {
            continue;
        };
        let inputs: Vec<[f64; 5]> = (0..40)
            .map(|_| {
                let near = mesh.part(0).triangle;
                let p =
                    near.p0 + random.of(&[0.0, 1.0, 1e-9, 1e5]) * near.e1.length() * random.point();
                let any = [random.one(), random.one()];
                let last = 1.0 - f64::EPSILON / 2.0;
                let u = random.of(&[any, any, any, [0.0, 0.0], [last, last], [0.5, any[1]]]);
                [p.x, p.y, p.z, u[0], u[1]]
            })
            .collect();
        let results = at_every_width(&Sampled(&mesh), &inputs);
        let emitter = Emitter::Mesh(mesh);
        for (input, result) in inputs.iter().zip(results) {
            let [x, y, z, u, v] = *input;
            let expected = emitter.sample(Vec3::new(x, y, z), Vec2::new(u, v));
            counts[usize::from(expected.is_some())] += 1;
            let is_same = match &expected {
                None => result[0] == 0.0,
                Some(s) => {
                    let expected = [1.0, s.wi.x, s.wi.y, s.wi.z, s.distance, s.pdf];
                    (0..6).all(|i| same(result[i], expected[i]))
                }
            };
            assert!(
                is_same,
                "{result:?}, expected {expected:?} for {input:?}, {emitter:?}"
            );
        }
    }
    assert!(counts.iter().all(|&count| count > 1000), "{counts:?}");
}

/// From the point, the normal, the reflectance, the viewer and `u`: the estimate of direct light.
struct Estimate<'a>(&'a EmittingMesh);

impl Formula<14, 4> for Estimate<'_> {
    #[inline(always)]
    fn compute<R: Real>(&self, input: [R; 14]) -> [R; 4] {
        let (n, wo) = (vector(&input[3..6]), vector(&input[9..12]));
        let sample = light::sample_mesh(self.0, vector(&input), [input[12], input[13]]);
        let wi_z = sample.wi.dot(n);
        let [r, g, b] =
            coordinates(sample.scattered(diffuse::lambert_f(vector(&input[6..9])), wi_z));
        let counts = sample.exists & diffuse::on_same_side(wo.dot(n), wi_z);
        [as_number(counts, r), r, g, b]
    }
}

/// Diffuse materials.
struct Diffuse;

impl Scattering for Diffuse {
    fn f(&self, material: &Material, wo: Vec3, wi: Vec3) -> Spectrum {
        match *material {
            Material::Diffuse { reflectance } => lambert_f(reflectance, wo, wi),
            _ => Spectrum::BLACK,
        }
    }

    fn pdf(&self, _: &Material, _: Vec3, _: Vec3) -> f64 {
        unreachable!("only lights are sampled")
    }

    fn sample(&self, _: &Material, _: Vec3, _: Vec2, _: f64) -> Option<BsdfSample> {
        unreachable!("only lights are sampled")
    }
}

#[test]
fn estimates_of_direct_light() {
    let mut random = Random::new(13);
    let mut lit_points = 0;
    for seed in 0..200 {
        let Some(mesh) = mesh(&mut random) else {
            continue;
        };
        let mut lit = LitScene::new(Scene::default(), None);
        lit.emitters = vec![Emitter::Mesh(mesh.clone())];
        let mut sampler = PixelSampler::new(0, 0, seed);
        let (mut inputs, mut expected) = (Vec::new(), Vec::new());
        for _ in 0..40 {
            let near = mesh.part(0).triangle;
            let p = near.p0 + near.e1.length() * random.point();
            let (n, wo) = (random.normal(), random.normal());
            let colour = random.point().abs();
            let material = Material::Diffuse {
                reflectance: Spectrum::new(colour.x, colour.y, colour.z),
            };
            let surface = Surface {
                p,
                frame: Frame::around(n),
                ng: n,
                error: Vec3::ZERO,
                material: &material,
                prim: PrimId(0),
            };
            let u = sampler.clone().next_2d();
            let mut occluded = |_: &Ray| false;
            expected.push(estimate_direct_lighting_importance(
                &lit,
                &surface,
                wo,
                1,
                &mut sampler,
                &Diffuse,
                &mut occluded,
            ));
            let vectors = [p, n, colour, wo].map(|v| v.to_array());
            inputs.push(join(&[vectors.as_flattened(), &[u.x, u.y]]));
        }
        let results = at_every_width(&Estimate(&mesh), &inputs);
        for ((input, [counts, r, g, b]), expected) in inputs.iter().zip(results).zip(expected) {
            let estimate = if counts == 1.0 {
                Spectrum::new(r, g, b)
            } else {
                Spectrum::BLACK
            };
            assert_eq!(estimate, expected, "for {input:?}, {mesh:?}");
            lit_points += usize::from(!expected.is_black());
        }
    }
    assert!(lit_points > 1000, "{lit_points} points are lit");
}
// END SOLUTION(part6.task2)
