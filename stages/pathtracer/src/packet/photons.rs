//! Photons: light that mirrors and smooth glass lead to diffuse surfaces, for the guide of caustic
//! rays.

use crate::materials::{Materials, Place};
use crate::tracer::RayOrigin;
use crate::{Accel, Counters};
use kit::shading_normal::{Sides, towards_viewer};
use kit::warp::{uniform_sphere, uniform_triangle};
use kit::{Emitter, LitScene, Material, PixelSampler, PrimId, Primitive, Ray, Scattering, Vec3};
use simd_paths::{CausticGuide, Landing};
use std::f64::consts::PI;
use std::sync::OnceLock;

/// The number of photons.
const PHOTONS: u32 = 1 << 14;

/// The largest number of mirrors and glass surfaces on the way of a photon.
const MAX_SURFACES: usize = 8;

/// Where the caustic rays of a scene are sent, which is found when it is first asked for.
#[derive(Clone, Debug, Default)]
pub struct Guide(OnceLock<Option<CausticGuide>>);

impl Guide {
    /// Whether it has found where caustic rays are sent.
    pub fn is_known(&self) -> bool {
        self.0.get().is_some_and(Option::is_some)
    }

    /// `accel` is built over the scene of `lit`.
    pub(super) fn get(&self, lit: &LitScene, accel: &Accel) -> Option<&CausticGuide> {
        self.0.get_or_init(|| guide(lit, accel)).as_ref()
    }
}

/// The guide of a scene in which mirrors or smooth glass may lead light of area lights to diffuse
/// surfaces; else `None`.
fn guide(lit: &LitScene, accel: &Accel) -> Option<CausticGuide> {
    let scene = &lit.scene;
    let lamps: Vec<&Emitter> = lit.emitters.iter().filter(|e| !e.is_delta()).collect();
    let mut area = 0.0;
    let mut targets = Vec::new();
    for id in 0..scene.len() as u32 {
        if scene.material_of(PrimId(id)).is_delta() {
            area += area_of(scene.primitive(PrimId(id)));
            targets.push((area, PrimId(id)));
        }
    }
    if lamps.is_empty() || !(area > 0.0 && area.is_finite()) {
        return None;
    }
    let bounds = scene.bounds();
    let outside = 2.0 * (bounds.max - bounds.min).length();
    let landings: Vec<Landing> = (0..PHOTONS)
        .filter_map(|i| {
            let mut sampler = PixelSampler::new(i, 0, 0);
            sampler.start_sample();
            let lamp = lamps[(sampler.next_1d() * lamps.len() as f64) as usize];
            let place = sampler.next_1d() * area;
            let number = targets.partition_point(|(end, _)| *end <= place);
            let target = scene.primitive(targets[number.min(targets.len() - 1)].1);
            land(lit, accel, (lamp, outside), target, &mut sampler)
        })
        .collect();
    CausticGuide::new(&landings)
}

fn area_of(primitive: Primitive<'_>) -> f64 {
    match primitive {
        Primitive::Triangle(t) => 0.5 * (t.p1 - t.p0).cross(t.p2 - t.p0).length(),
        Primitive::Sphere(s) => 4.0 * PI * s.radius * s.radius,
    }
}

/// Follows light of `lamp` towards a point on `target` to the first surface that is neither a
/// mirror nor smooth glass, if it is diffuse. It starts at most at the distance `outside`.
fn land(
    lit: &LitScene,
    accel: &Accel,
    (lamp, outside): (&Emitter, f64),
    target: Primitive<'_>,
    sampler: &mut PixelSampler,
) -> Option<Landing> {
    let u = sampler.next_2d();
    let (p, n) = match target {
        Primitive::Triangle(t) => {
            let b = uniform_triangle(u);
            let (e1, e2) = (t.p1 - t.p0, t.p2 - t.p0);
            (t.p0 + e1 * b.x + e2 * b.y, e1.cross(e2).try_normalize()?)
        }
        Primitive::Sphere(s) => {
            let n = uniform_sphere(u);
            (s.center + n * s.radius, n)
        }
    };
    let light = lamp.sample(p, sampler.next_2d())?;
    let mut throughput = light.radiance * (light.wi.dot(n).abs() / light.pdf);
    // From just before the lamp.
    let distance = light.distance.min(outside) * (1.0 - 1e-6);
    let mut ray = Ray::new(p + light.wi * distance, -light.wi);
    let materials = Materials::new(false, false);
    // The last mirror or glass.
    let mut last: Option<(RayOrigin, Vec3)> = None;
    for _ in 0..=MAX_SURFACES {
        let skip = last.and_then(|(origin, _)| origin.skip(&lit.scene, ray.d));
        let found = accel.closest(&lit.scene, &mut ray, skip, &mut Counters::default())?;
        let hit = towards_viewer(lit, found, ray.d);
        let surface = lit.surface(&hit);
        if let (Material::Diffuse { .. }, Some((_, from))) = (surface.material, last) {
            let light = throughput.luminance();
            return (light > 0.0 && light.is_finite()).then_some(Landing {
                p: hit.p,
                from,
                light,
            });
        }
        if !surface.material.is_delta() {
            return None;
        }
        let wo = surface.frame.to_local(-ray.d);
        let place = Place {
            sides: Sides::of(&surface),
            ..Place::PLAIN
        };
        let (u, choice) = (sampler.next_2d(), sampler.next_1d());
        let sample = materials
            .at(place)
            .sample(surface.material, wo, u, choice)?;
        throughput *= sample.weight();
        last = Some((RayOrigin::from(&surface), hit.p));
        ray = surface.leave(surface.frame.to_world(sample.wi));
    }
    None
}
