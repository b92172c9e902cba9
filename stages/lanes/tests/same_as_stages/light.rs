//! `lanes::light`, `kit::Emitter::sample`, `kit::Emitter::pdf`,
//! `direct::estimate_direct_lighting_importance` and `direct::estimate_direct_lighting_mis`.

use crate::inputs::{Random, coordinates, join, vector};
use crate::widths::{Formula, as_number, at_every_width, same};
use direct::{
    estimate_direct_lighting_importance, estimate_direct_lighting_mis, lambert_f, lambert_pdf,
};
use kit::emitting_mesh::EmittingTriangle;
use kit::{
    BsdfSample, Emitter, EmittingMesh, Frame, LitScene, Material, PixelSampler, PrimId, Ray,
    Scattering, Scene, Spectrum, Surface, Vec2, Vec3, math,
};
use lanes::mis::power_heuristic;
use lanes::{Real, diffuse, light};
use std::f64::consts::TAU;

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

/// From the point, the normal, the reflectance, the viewer and `u`: the estimate of direct light
/// by light sampling, and the same part of that by multiple importance sampling.
struct Estimate<'a>(&'a EmittingMesh);

impl Formula<14, 7> for Estimate<'_> {
    #[inline(always)]
    fn compute<R: Real>(&self, input: [R; 14]) -> [R; 7] {
        let (n, wo) = (vector(&input[3..6]), vector(&input[9..12]));
        let sample = light::sample_mesh(self.0, vector(&input), [input[12], input[13]]);
        let wi_z = sample.wi.dot(n);
        let f = diffuse::lambert_f(vector(&input[6..9]));
        let [r, g, b] = coordinates(sample.scattered(f, wi_z, wi_z.constant(1.0)));
        let weight = power_heuristic(sample.pdf, diffuse::lambert_pdf(wo.dot(n), wi_z));
        let [r_mis, g_mis, b_mis] = coordinates(sample.scattered(f, wi_z, weight));
        let counts = sample.exists & diffuse::on_same_side(wo.dot(n), wi_z);
        [as_number(counts, r), r, g, b, r_mis, g_mis, b_mis]
    }
}

/// Diffuse materials, whose BSDF gives no samples.
struct Diffuse;

impl Scattering for Diffuse {
    fn f(&self, material: &Material, wo: Vec3, wi: Vec3) -> Spectrum {
        match *material {
            Material::Diffuse { reflectance } => lambert_f(reflectance, wo, wi),
            _ => Spectrum::BLACK,
        }
    }

    fn pdf(&self, _: &Material, wo: Vec3, wi: Vec3) -> f64 {
        lambert_pdf(wo, wi)
    }

    fn sample(&self, _: &Material, _: Vec3, _: Vec2, _: f64) -> Option<BsdfSample> {
        None
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
            let weighted = estimate_direct_lighting_mis(
                &lit,
                &surface,
                wo,
                1,
                &mut sampler.clone(),
                &Diffuse,
                &mut |_| None,
                &mut occluded,
            );
            let unweighted = estimate_direct_lighting_importance(
                &lit,
                &surface,
                wo,
                1,
                &mut sampler,
                &Diffuse,
                &mut occluded,
            );
            expected.push((unweighted, weighted));
            let vectors = [p, n, colour, wo].map(|v| v.to_array());
            inputs.push(join(&[vectors.as_flattened(), &[u.x, u.y]]));
        }
        let results = at_every_width(&Estimate(&mesh), &inputs);
        for ((input, result), expected) in inputs.iter().zip(results).zip(expected) {
            let [counts, r, g, b, r_mis, g_mis, b_mis] = result;
            let estimates = if counts == 1.0 {
                (Spectrum::new(r, g, b), Spectrum::new(r_mis, g_mis, b_mis))
            } else {
                (Spectrum::BLACK, Spectrum::BLACK)
            };
            assert_eq!(estimates, expected, "for {input:?}, {mesh:?}");
            lit_points += usize::from(!expected.1.is_black());
        }
    }
    assert!(lit_points > 1000, "{lit_points} points are lit");
}

/// From `u` and the sine and cosine of the angle: whether there is a sample, its direction,
/// distance, density and radiance.
struct SampledSky(Vec3);

impl Formula<3, 9> for SampledSky {
    #[inline(always)]
    fn compute<R: Real>(&self, [u, sin, cos]: [R; 3]) -> [R; 9] {
        let sample = light::sample_sky(self.0, u, (sin, cos));
        let [x, y, z] = coordinates(sample.wi);
        let [r, g, b] = coordinates(sample.radiance);
        let exists = as_number(sample.exists, u);
        [exists, x, y, z, sample.distance, sample.pdf, r, g, b]
    }
}

#[test]
fn samples_of_skies() {
    let mut random = Random::new(16);
    let radiance = Spectrum::new(0.25, 3.0, 0.0);
    let last = 1.0 - f64::EPSILON / 2.0;
    let points: Vec<Vec2> = (0..4000)
        .map(|_| {
            let any = Vec2::new(random.one(), random.one());
            random.of(&[any, any, Vec2::new(0.0, any.y), Vec2::new(last, any.x)])
        })
        .collect();
    let inputs: Vec<[f64; 3]> = points
        .iter()
        .map(|u| {
            let (sin, cos) = math::sin_cos(TAU * u.y);
            [u.x, sin, cos]
        })
        .collect();
    let results = at_every_width(&SampledSky(radiance.to_array().into()), &inputs);
    for (u, result) in points.iter().zip(results) {
        let expected = Emitter::Sky { radiance }
            .sample(Vec3::ZERO, *u)
            .expect("a sky is visible from everywhere");
        let expected: [f64; 9] = join(&[
            &[1.0],
            &expected.wi.to_array(),
            &[expected.distance, expected.pdf],
            &expected.radiance.to_array(),
        ]);
        assert!(
            (0..9).all(|i| same(result[i], expected[i])),
            "{result:?}, expected {expected:?} for {u}"
        );
    }
}

/// From the direction, the distance and the normal: the density.
struct Density<'a>(&'a EmittingMesh);

impl Formula<7, 1> for Density<'_> {
    #[inline(always)]
    fn compute<R: Real>(&self, input: [R; 7]) -> [R; 1] {
        let area = input[3].constant(self.0.area());
        let (wi, normal) = (vector(&input), vector(&input[4..7]));
        [light::mesh_pdf(area, wi, input[3], normal)]
    }
}

#[test]
fn densities_of_meshes() {
    let mut random = Random::new(14);
    let mut counts = [0; 2];
    for _ in 0..200 {
        let Some(mesh) = mesh(&mut random) else {
            continue;
        };
        let inputs: Vec<[f64; 7]> = (0..40)
            .map(|_| {
                let (wi, normal) = (random.normal(), random.normal());
                let distance = random.of(&[1.0, 0.0, 1e-300, 1e200]) * random.one();
                join(&[&wi.to_array(), &[distance], &normal.to_array()])
            })
            .collect();
        let results = at_every_width(&Density(&mesh), &inputs);
        let emitter = Emitter::Mesh(mesh);
        for (input, [pdf]) in inputs.iter().zip(results) {
            let (wi, normal) = (Vec3::from_slice(input), Vec3::from_slice(&input[4..]));
            let expected = emitter.pdf(Vec3::ZERO, wi, input[3], normal);
            assert!(
                same(pdf, expected),
                "{pdf}, expected {expected} for {input:?}"
            );
            counts[usize::from(expected > 0.0)] += 1;
        }
    }
    assert!(counts.iter().all(|&count| count > 1000), "{counts:?}");
}
