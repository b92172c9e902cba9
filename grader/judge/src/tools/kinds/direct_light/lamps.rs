//! Computes the light that arrives at a point from the lights of a scripted world.

use kit::{Emitter, Environment, Frame, LightSample, Spectrum, Surface, Vec2, Vec3, math, warp};
use std::f64::consts::{PI, TAU};
use wire::direct::{RecordedRay, ShadedPoint};
use wire::light::{Light, LitWorld, MEAN_F, Material, Panel, scripted_f};
use wire::work::Xyz;

/// A point of a surface, with its local space.
pub(crate) struct ShadingPlace {
    pub(crate) p: Vec3,
    pub(crate) frame: Frame,
    pub(crate) wo: Vec3,
    /// The geometric normal, in world space.
    pub(crate) ng: Vec3,
    reflectance: Xyz,
    error: f64,
}

/// Steps of the midpoint rule along each side of a lamp: its error is far below that of the tested
/// estimates.
const STEPS: u32 = 160;

/// Steps of the midpoint rule along each side of a hemisphere, for environment maps whose radiance
/// jumps between texels.
const SKY_STEPS: u32 = 1024;

/// The environment map of the world, if it has one.
pub(crate) fn environment_map(world: &LitWorld) -> Option<Environment> {
    let around = world.environment.as_ref()?;
    let texels: Vec<Spectrum> = around.texels.iter().map(|&texel| texel.into()).collect();
    let width = around.width as usize;
    Environment::new(width, texels.len() / width, texels).ok()
}

/// The radiance of the lamp that the ray hits first, on whichever side; black if it hits none.
pub(super) fn first_lamp(world: &LitWorld, recorded: &RecordedRay) -> Vec3 {
    let ray = &recorded.ray;
    let hits = world.panels.iter().filter_map(|panel| {
        let (t, _) = panel.meets(ray.o, ray.d)?;
        (t > ray.min_t && t < ray.max_t).then_some((t, panel))
    });
    let first = hits.min_by(|a, b| a.0.total_cmp(&b.0));
    let emitted = first.and_then(|(_, panel)| panel.material.emitted());
    emitted.map_or(Vec3::ZERO, Vec3::from)
}

impl ShadingPlace {
    pub(crate) fn of(point: &ShadedPoint) -> ShadingPlace {
        let frame = Frame::around(point.n.into());
        ShadingPlace {
            p: point.p.into(),
            wo: frame.to_local(point.wo.into()),
            frame,
            ng: point.ng.into(),
            reflectance: match point.material {
                Material::Diffuse(reflectance) => reflectance,
                _ => [0.0; 3],
            },
            error: point.error,
        }
    }

    /// `f · |cos θ|` for light from the world direction `d`.
    pub(crate) fn scattered(&self, d: Vec3) -> Vec3 {
        let wi = self.frame.to_local(d);
        self.f(self.wo, wi) * wi.z.abs()
    }

    /// The cosine of a world direction to the geometric normal, relative to that to the shading
    /// normal.
    pub(super) fn geometric_to_shading(&self, d: Vec3) -> f64 {
        (d.dot(self.ng) / d.dot(self.frame.n)).abs()
    }

    /// `f` of two local directions.
    pub(crate) fn f(&self, wo: Vec3, wi: Vec3) -> Vec3 {
        scripted_f(self.reflectance, wo.into(), wi.into()).into()
    }

    /// The right origin of a ray along `d`.
    pub(crate) fn start(&self, d: Vec3) -> Vec3 {
        let material = kit::Material::Diffuse {
            reflectance: kit::Spectrum::BLACK,
        };
        let surface = Surface {
            p: self.p,
            frame: self.frame,
            ng: self.ng,
            error: Vec3::splat(self.error),
            material: &material,
            prim: kit::PrimId(0),
        };
        surface.leave(d).o
    }

    /// Which part of a lamp contributes light here.
    pub(crate) fn visible_part(&self, panel: &Panel) -> VisiblePart {
        let towards = panel.corners().map(|corner| Vec3::from(corner) - self.p);
        let front = Vec3::from(panel.front());
        if towards[0].dot(front) >= 0.0 {
            return VisiblePart::None;
        }
        let lit = towards
            .iter()
            .filter(|d| self.scattered(d.normalize()) != Vec3::ZERO);
        match lit.count() {
            0 => VisiblePart::None,
            4 => VisiblePart::All,
            _ => VisiblePart::Some,
        }
    }

    /// The scattered radiance of all lamps, skies and the environment map, if nothing blocks them.
    pub(crate) fn lit_by(&self, world: &LitWorld) -> Vec3 {
        let lamps = world.panels.iter().map(|panel| self.lit_by_panel(panel));
        let all_around = Vec3::from(self.reflectance) * (MEAN_F * PI);
        let skies = world.lights.iter().map(|light| match light {
            Light::Sky(radiance) => Vec3::from(*radiance),
            _ => Vec3::ZERO,
        });
        let around = match &world.environment {
            // The same from all directions: no need for a sum over the hemisphere.
            Some(around) if around.texels.len() == 1 => all_around * Vec3::from(around.texels[0]),
            _ => environment_map(world)
                .map_or(Vec3::ZERO, |picture| self.lit_by_environment(&picture)),
        };
        lamps.sum::<Vec3>() + all_around * skies.sum::<Vec3>() + around
    }

    /// `∫ f · L · |cos θ| dω` over the hemisphere, by the midpoint rule in height and in angle
    /// around the normal.
    fn lit_by_environment(&self, picture: &Environment) -> Vec3 {
        let middle = |i: u32| (f64::from(i) + 0.5) / f64::from(SKY_STEPS);
        let cells = (0..SKY_STEPS).flat_map(|i| (0..SKY_STEPS).map(move |j| (i, j)));
        let sum: Vec3 = cells
            .map(|(i, j)| {
                let mut wi = warp::uniform_hemisphere(Vec2::new(middle(i), middle(j)));
                wi.z = wi.z.copysign(self.wo.z);
                let d = self.frame.to_world(wi);
                self.scattered(d) * Vec3::from(picture.radiance(d).to_array())
            })
            .sum();
        sum * (TAU / f64::from(SKY_STEPS * SKY_STEPS))
    }

    /// `∫ f · L · cos θ · cos θ' / r² dA` over the lamp.
    fn lit_by_panel(&self, panel: &Panel) -> Vec3 {
        let Some(radiance) = panel.material.emitted() else {
            return Vec3::ZERO;
        };
        let middle = |i: u32, side: usize| {
            let share = (f64::from(i) + 0.5) / f64::from(STEPS);
            panel.min[side] + share * (panel.max[side] - panel.min[side])
        };
        let front = Vec3::from(panel.front());
        let cells = (0..STEPS).flat_map(|i| (0..STEPS).map(move |j| (i, j)));
        let sum: Vec3 = cells
            .map(|(i, j)| {
                let towards = Vec3::from(panel.point([middle(i, 0), middle(j, 1)])) - self.p;
                let d = towards.normalize();
                let facing = (-d.dot(front)).max(0.0);
                self.scattered(d) * (facing / towards.length_squared())
            })
            .sum();
        Vec3::from(radiance) * sum * (panel.area() / f64::from(STEPS * STEPS))
    }
}

/// How much of a lamp contributes light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum VisiblePart {
    None,
    Some,
    All,
}

/// The light that arrives at `p` from a light without extent: `None` for a sky, `Some(None)` if no
/// light arrives.
pub(crate) fn sample_of_delta_light(light: &Light, p: Vec3) -> Option<Option<LightSample>> {
    let emitter = match *light {
        Light::Point {
            position,
            intensity,
        } => Emitter::Point {
            position: position.into(),
            intensity: intensity.into(),
        },
        Light::Spot {
            position,
            direction,
            intensity,
            falloff_angle,
            falloff_exponent,
        } => Emitter::Spot {
            position: position.into(),
            direction: direction.into(),
            intensity: intensity.into(),
            cos_edge: math::cos((0.5 * falloff_angle).to_radians()),
            falloff_exponent,
        },
        Light::Directional {
            direction,
            irradiance,
        } => Emitter::Directional {
            direction: direction.into(),
            irradiance: irradiance.into(),
        },
        Light::Sky(_) => return None,
    };
    Some(emitter.sample(p, Vec2::ZERO))
}

/// Density of the directions sampled for a sky.
pub(crate) const SKY_PDF: f64 = 1.0 / TAU;

#[cfg(test)]
mod tests {
    use super::*;
    use wire::light::Surroundings;

    fn lit_by_other_half(place: &ShadingPlace) -> f64 {
        let picture = Surroundings {
            width: 2,
            texels: vec![[0.0; 3], [2.0; 3], [7.0; 3], [7.0; 3]],
        };
        let world = LitWorld {
            environment: Some(picture),
            ..LitWorld::default()
        };
        place.lit_by(&world).x
    }

    /// A corner of the lamp is straight above the point (any catalogue of view factors).
    #[test]
    fn the_integral_over_a_lamp_matches_its_form_factor() {
        let (a, b) = (0.75_f64, 1.5_f64);
        let lamp = |material| Panel {
            axis: 1,
            at: 1.0,
            min: [0.0, 0.0],
            max: [b, a],
            faces: -1.0,
            material,
        };
        let place = |wo: Vec3| {
            ShadingPlace::of(&ShadedPoint {
                p: [0.0; 3],
                n: [0.0, 1.0, 0.0],
                ng: [0.0, 1.0, 0.0],
                error: 0.0,
                material: Material::Diffuse([1.0; 3]),
                wo: wo.into(),
            })
        };
        let world = |faces: f64| LitWorld {
            panels: vec![
                Panel {
                    faces,
                    ..lamp(Material::Emission([2.0; 3]))
                };
                1
            ],
            ..LitWorld::default()
        };
        // Four lamps around the point: the terms of `scripted_f` that depend on the direction
        // cancel.
        let around = |u: [f64; 2], v: [f64; 2]| LitWorld {
            panels: vec![Panel {
                min: [u[0], v[0]],
                max: [u[1], v[1]],
                ..lamp(Material::Emission([2.0; 3]))
            }],
            ..LitWorld::default()
        };
        let (ra, rb) = ((1.0 + a * a).sqrt(), (1.0 + b * b).sqrt());
        let factor = 4.0 * (a / ra * (b / ra).atan() + b / rb * (a / rb).atan()) / (2.0 * PI);
        let truth = 2.0 * PI * MEAN_F * factor;
        let lit = place(Vec3::Y).lit_by(&around([-b, b], [-a, a]));
        assert!((lit.x / truth - 1.0).abs() < 1e-4, "{} {truth}", lit.x);
        assert_eq!(place(Vec3::Y).lit_by(&world(1.0)), Vec3::ZERO);
        assert_eq!(place(Vec3::NEG_Y).lit_by(&world(-1.0)), Vec3::ZERO);
        let sky = LitWorld {
            lights: vec![Light::Sky([1.0; 3])],
            ..LitWorld::default()
        };
        assert!((place(Vec3::Y).lit_by(&sky).x - MEAN_F * PI).abs() < 1e-12);
        let uniform = LitWorld {
            environment: Some(Surroundings::uniform([3.0; 3])),
            ..LitWorld::default()
        };
        assert!((place(Vec3::Y).lit_by(&uniform).x - 3.0 * MEAN_F * PI).abs() < 1e-12);
        // Four texels: the front half of the upper hemisphere is lit.
        let picture = LitWorld {
            environment: Some(Surroundings {
                width: 2,
                texels: vec![[2.0; 3], [0.0; 3], [7.0; 3], [7.0; 3]],
            }),
            ..LitWorld::default()
        };
        let half = |wo: Vec3| place(wo).lit_by(&picture).x;
        let both = half(Vec3::Y) + lit_by_other_half(&place(Vec3::Y));
        assert!((both - 2.0 * MEAN_F * PI).abs() < 1e-5, "{both}");
        assert!((half(Vec3::NEG_Y) - 7.0 * MEAN_F * PI).abs() < 1e-5);
    }
}
