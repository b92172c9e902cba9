//! Worlds of rectangles and lights, and scripted scattering.

use crate::light::{environment, material, scene};
use kit::scene::NamedLight;
use kit::{BsdfSample, Material, Scattering, Spectrum};
use kit::{Hit, LitScene, PrimId, Ray, Triangle, Vec2, Vec3};
use wire::light::scripted_f;
use wire::light::{Light, LitWorld, Panel};

/// Converts the world to a scene with lights. Panel `i` becomes the triangles `2i` and `2i + 1`, and
/// an object of its own or with its neighbours.
pub(crate) fn lit_scene(world: &LitWorld) -> LitScene {
    let objects = world
        .panels
        .chunk_by(|a, b| a.is_part() && b.is_part())
        .map(|panels| {
            let triangles = panels.iter().flat_map(halves);
            (triangles.collect(), material(&panels[0].material))
        });
    let objects: Vec<_> = objects.collect();
    let mut scene = scene(&objects);
    scene.lights = world
        .lights
        .iter()
        .map(|light| NamedLight {
            name: "light".into(),
            light: kit_light(light),
        })
        .collect();
    LitScene::new(scene, world.environment.as_ref().map(environment))
}

/// The first panel in the ray's range.
pub(crate) fn first_hit(world: &LitWorld, ray: &Ray) -> Option<Hit> {
    let hits = world.panels.iter().enumerate().filter_map(|(i, panel)| {
        let (t, share) = panel.meets(ray.o.into(), ray.d.into())?;
        let half = u32::from(share[0] < share[1]);
        ray.in_range(t)
            .then(|| (t, PrimId(2 * i as u32 + half), panel))
    });
    let (t, prim, panel) = hits.min_by(|a, b| a.0.total_cmp(&b.0))?;
    let front = Vec3::from(panel.front());
    // Exactly in the plane of the panel: the rays that leave it start there.
    let mut p = ray.at(t);
    p[panel.axis] = panel.at;
    Some(Hit {
        t,
        p,
        n: front,
        ng: front,
        uv: Vec2::ZERO,
        prim,
    })
}

/// The two triangles of a panel, below and above its diagonal. Their normals point to its front.
fn halves(panel: &Panel) -> [Triangle; 2] {
    let [a, b, c, d] = panel.corners().map(Vec3::from);
    let halves = if panel.faces > 0.0 {
        [[a, b, c], [a, c, d]]
    } else {
        [[a, c, b], [a, d, c]]
    };
    halves.map(|[p0, p1, p2]| Triangle::flat(p0, p1, p2))
}

fn kit_light(light: &Light) -> kit::Light {
    match *light {
        Light::Point {
            position,
            intensity,
        } => kit::Light::Point {
            position: position.into(),
            intensity: intensity.into(),
        },
        Light::Spot {
            position,
            direction,
            intensity,
            falloff_angle,
            falloff_exponent,
        } => kit::Light::Spot {
            position: position.into(),
            direction: direction.into(),
            intensity: intensity.into(),
            falloff_angle,
            falloff_exponent,
        },
        Light::Directional {
            direction,
            irradiance,
        } => kit::Light::Directional {
            direction: direction.into(),
            irradiance: irradiance.into(),
        },
        Light::Sky(radiance) => kit::Light::Hemisphere {
            radiance: radiance.into(),
        },
    }
}

/// Scripted scattering: [`scripted_f`] for diffuse surfaces, black for all others.
pub(crate) struct ScriptedScattering;

impl Scattering for ScriptedScattering {
    fn f(&self, material: &Material, wo: Vec3, wi: Vec3) -> Spectrum {
        match material {
            Material::Diffuse { reflectance } => {
                scripted_f(reflectance.to_array(), wo.into(), wi.into()).into()
            }
            _ => Spectrum::BLACK,
        }
    }

    fn pdf(&self, _: &Material, _: Vec3, _: Vec3) -> f64 {
        0.0
    }

    fn sample(&self, _: &Material, _: Vec3, _: Vec2, _: f64) -> Option<BsdfSample> {
        None
    }
}
