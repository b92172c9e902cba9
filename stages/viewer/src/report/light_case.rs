//! An estimate of light: the surfaces and lights of the case, and the rays that the stage traced.

use judge::convert;
use kit::{Aabb, Frame, Ray, Vec3};
use wire::direct::{DirectAnswer, DirectWork, ShadedPoint};
use wire::global::{PathAnswer, ScriptedPath};
use wire::light::{Light, Material, Panel};

/// A point of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// The point.
    pub p: Vec3,
    /// Its unit normal.
    pub n: Vec3,
}

/// A ray that the stage traced.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TracedRay {
    /// The ray.
    pub ray: Ray,
    /// Whether it hit something in its range.
    pub is_hit: bool,
}

/// A rectangle, and whether it shines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LitPanel {
    /// Its corners, in order.
    pub corners: [Vec3; 4],
    /// Whether it is a light.
    pub shines: bool,
}

/// An estimate of light at a point, or a path.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LightCase {
    /// The rectangles.
    pub panels: Vec<LitPanel>,
    /// The lights without extent.
    pub lights: Vec<Vec3>,
    /// The shaded point, or the surfaces of the path in order.
    pub points: Vec<SurfacePoint>,
    /// Unit directions to the viewer, one at each point that has one.
    pub viewers: Vec<(Vec3, Vec3)>,
    /// The rays that the stage traced, in order.
    pub rays: Vec<TracedRay>,
    /// The rays that are right: origin and unit direction. For an estimate by random directions there
    /// is no single right one.
    pub right: Vec<(Vec3, Vec3)>,
    /// What roulette does at the surfaces of a path: the factor of the throughput, or the end.
    pub roulettes: Vec<(Vec3, Option<f64>)>,
    /// The radiance that the stage returned.
    pub radiance: [f64; 3],
}

impl LightCase {
    /// An estimate of direct light at one point.
    pub fn of_point(work: &DirectWork, point: &ShadedPoint, answer: &DirectAnswer) -> LightCase {
        let p = Vec3::from(point.p);
        let (mut lights, mut right) = (Vec::new(), Vec::new());
        for light in &work.world.lights {
            match light {
                Light::Point { position, .. } | Light::Spot { position, .. } => {
                    let position = Vec3::from(*position);
                    lights.push(position);
                    right.push((p, (position - p).normalize_or_zero()));
                }
                Light::Directional { direction, .. } => {
                    right.push((p, -Vec3::from(*direction)));
                }
                Light::Sky(_) => {}
            }
        }
        // Rays to a light without extent have one right direction; all others are random.
        if work.strategy != wire::direct::Strategy::Lights {
            right.clear();
        }
        LightCase {
            panels: work.world.panels.iter().map(panel).collect(),
            lights,
            points: vec![SurfacePoint {
                p,
                n: point.n.into(),
            }],
            viewers: vec![(p, point.wo.into())],
            rays: answer
                .rays
                .iter()
                .map(|traced| TracedRay {
                    ray: convert::ray(&traced.ray),
                    is_hit: traced.hit,
                })
                .collect(),
            right,
            roulettes: Vec::new(),
            radiance: answer.radiance,
        }
    }

    /// A path over given surfaces.
    pub fn of_path(path: &ScriptedPath, answer: &PathAnswer) -> LightCase {
        let points = path.steps.iter().map(|step| SurfacePoint {
            p: step.p.into(),
            n: step.n.into(),
        });
        let points: Vec<SurfacePoint> = points.collect();
        let rays = answer.rays.iter().map(convert::ray).enumerate();
        let first = convert::ray(&path.ray);
        let mut right = vec![(first.o, first.d.normalize_or_zero())];
        for (step, point) in path.steps.iter().zip(&points) {
            let (Some(sample), Some(_)) = (&step.sample, step.roulette) else {
                break;
            };
            let d = Frame::around(point.n).to_world(sample.wi.into());
            right.push((point.p, d));
        }
        right.truncate(path.max_depth as usize);
        let ends = path.steps.iter().position(|step| step.roulette.is_none());
        let played = path.steps.iter().take(ends.map_or(usize::MAX, |i| i + 1));
        let roulettes = played
            .map(|step| (step.p.into(), step.roulette))
            .filter(|(_, factor)| *factor != Some(1.0));
        LightCase {
            rays: rays
                .map(|(i, ray)| {
                    let reaches = points.get(i);
                    let end = reaches.map(|point| point.p.distance(ray.o) / ray.d.length());
                    TracedRay {
                        ray: Ray {
                            max_t: end.unwrap_or(ray.max_t),
                            ..ray
                        },
                        is_hit: reaches.is_some(),
                    }
                })
                .collect(),
            roulettes: roulettes.collect(),
            points,
            right,
            radiance: answer.radiance,
            ..LightCase::default()
        }
    }

    /// A box around everything that is drawn.
    pub fn bounds(&self) -> Aabb {
        let corners = self.panels.iter().flat_map(|panel| panel.corners);
        let points = self.points.iter().map(|point| point.p);
        let origins = self.rays.iter().map(|traced| traced.ray.o);
        let all = corners
            .chain(points)
            .chain(origins)
            .chain(self.lights.iter().copied());
        all.filter(|p| p.is_finite())
            .fold(Aabb::EMPTY, Aabb::grown_by)
    }
}

fn panel(panel: &Panel) -> LitPanel {
    LitPanel {
        corners: panel.corners().map(Vec3::from),
        shines: matches!(panel.material, Material::Emission(_)),
    }
}
