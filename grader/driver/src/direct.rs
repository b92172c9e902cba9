//! Runs Part 3: diffuse surfaces, and direct light in worlds that record the traced rays.

use crate::stages::Direct;
use crate::{convert, light, panels};
use harness::{attempt, each_call};
use kit::{Frame, LitScene, PixelSampler, PrimId, Ray, Spectrum, Surface, Vec2, Vec3};
use wire::direct::{
    DirectAnswer, DirectWork, LambertAnswer, LambertProbe, RecordedRay, ShadedPoint, Strategy,
};

pub(crate) fn lambert(stage: &Direct, probes: &[LambertProbe]) -> Vec<LambertAnswer> {
    each_call(probes, |_, probe| {
        let reflectance = Spectrum::from(probe.reflectance);
        let [wo, wi] = [probe.wo, probe.wi].map(Vec3::from);
        let sample = attempt("lambert_sample", || {
            (stage.lambert_sample)(reflectance, wo, Vec2::from(probe.u))
        });
        let f = attempt("lambert_f", || (stage.lambert_f)(reflectance, wo, wi));
        LambertAnswer {
            f: f.unwrap_or_default().to_array(),
            pdf: attempt("lambert_pdf", || (stage.lambert_pdf)(wo, wi)).unwrap_or_default(),
            sample: sample.flatten().as_ref().map(convert::wire_sample),
        }
    })
}

pub(crate) fn direct(stage: &Direct, work: &DirectWork) -> Vec<DirectAnswer> {
    let lit = panels::lit_scene(&work.world);
    each_call(&work.points, |i, point| {
        estimate(stage, work, &lit, i as u32, point)
    })
}

fn estimate(
    stage: &Direct,
    work: &DirectWork,
    lit: &LitScene,
    call: u32,
    point: &ShadedPoint,
) -> DirectAnswer {
    let material = light::material(&point.material);
    let surface = Surface {
        p: point.p.into(),
        frame: Frame::around(point.n.into()),
        ng: point.ng.into(),
        error: Vec3::splat(point.error),
        material: &material,
        prim: PrimId(u32::MAX),
    };
    let wo = Vec3::from(point.wo);
    let mut rays = Vec::new();
    let mut sampler = PixelSampler::new(call, 0, work.seed);
    sampler.get_sample();
    let asked_for = || match (work.samples, work.strategy) {
        (samples, Strategy::Lights) => format!("{samples} samples of each light with an area"),
        (1, _) => "1 sample".into(),
        (samples, _) => format!("{samples} samples"),
    };
    let radiance = match work.strategy {
        Strategy::ZeroBounce => attempt("zero_bounce_radiance", || {
            (stage.zero_bounce_radiance)(&surface, wo)
        })
        .unwrap_or_default(),
        Strategy::Hemisphere => attempt("estimate_direct_lighting_hemisphere", || {
            (stage.estimate_direct_lighting_hemisphere)(
                lit,
                &surface,
                wo,
                work.samples,
                &mut sampler,
                &panels::ScriptedScattering,
                &mut |ray| {
                    harness::limit_calls("trace", rays.len(), asked_for);
                    let hit = panels::first_hit(&work.world, ray);
                    let seen = match &hit {
                        Some(hit) => lit.surface(hit).emitted(-ray.d),
                        None => lit.background(ray.d),
                    };
                    rays.push(recorded_ray(ray, seen, hit.is_some()));
                    hit
                },
            )
        })
        .unwrap_or_default(),
        Strategy::Lights => (stage.estimate_direct_lighting_importance)(
            lit,
            &surface,
            wo,
            work.samples,
            &mut sampler,
            &panels::ScriptedScattering,
            &mut |ray| {
                harness::limit_calls("occluded", rays.len(), asked_for);
                let blocked = panels::first_hit(&work.world, ray).is_some();
                rays.push(recorded_ray(ray, Spectrum::BLACK, blocked));
                blocked
            },
        ),
    };
    DirectAnswer {
        radiance: radiance.to_array(),
        rays,
    }
}

fn recorded_ray(ray: &Ray, seen: Spectrum, hit: bool) -> RecordedRay {
    RecordedRay {
        ray: convert::wire_ray(ray),
        seen: seen.to_array(),
        hit,
    }
}
