//! What light comes from, ready to be sampled.
//!
//! A [`Light`](crate::Light) is what a file says; an [`Emitter`] is what a renderer aims shadow rays at: the points,
//! cones and suns of the file, and the surfaces that emit. [`LitScene`](crate::LitScene) makes the one from the other.

use crate::math;
use crate::warp;
use crate::{Environment, Frame, PrimId, Spectrum, Sphere, Vec2, Vec3};
use std::f64::consts::TAU;

/// A direction drawn towards a light, seen from a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightSample {
    /// Unit direction to the light, in world space.
    pub wi: Vec3,
    /// How far the light is along `wi`; infinite for suns and skies.
    pub distance: f64,
    /// Density of `wi` with respect to solid angle, in 1/sr; 1 for lights without extent.
    pub pdf: f64,
    /// Radiance that arrives along `wi` if nothing is in between. For lights without extent, the irradiance on a
    /// surface that faces the light.
    pub radiance: Spectrum,
}

/// A source of light.
#[derive(Clone, Debug, PartialEq)]
pub enum Emitter {
    /// A point that shines the same everywhere: irradiance falls with the squared distance.
    Point {
        /// Position.
        position: Vec3,
        /// Radiant intensity, in W/sr.
        intensity: Spectrum,
    },
    /// A point that shines into a cone.
    Spot {
        /// Position.
        position: Vec3,
        /// Unit axis of the cone.
        direction: Vec3,
        /// Radiant intensity on the axis, in W/sr.
        intensity: Spectrum,
        /// Cosine of half the opening angle. The edge of the cone is lit.
        cos_edge: f64,
        /// Exponent of the cosine to the axis.
        falloff_exponent: f64,
    },
    /// A sun infinitely far away.
    Directional {
        /// Unit direction in which the light travels.
        direction: Vec3,
        /// Irradiance on a surface that faces the light.
        irradiance: Spectrum,
    },
    /// Triangles that emit the same radiance from their front sides. One light, however many triangles.
    Mesh(EmittingMesh),
    /// A sphere that emits outwards.
    Sphere {
        /// The sphere.
        sphere: Sphere,
        /// Emitted radiance.
        radiance: Spectrum,
        /// Its number in the scene.
        prim: PrimId,
    },
    /// A sky: the same radiance from every direction of the upper half (+y).
    Sky {
        /// Radiance of the sky.
        radiance: Spectrum,
    },
    /// A picture all around.
    Environment(Environment),
}

/// Triangles that emit, and their areas summed up.
#[derive(Clone, Debug, PartialEq)]
pub struct EmittingMesh {
    triangles: Vec<EmittingTriangle>,
    /// Area of the triangles up to and with this one.
    area_up_to: Vec<f64>,
    /// Emitted radiance.
    pub radiance: Spectrum,
}

/// One of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmittingTriangle {
    /// First vertex.
    pub p0: Vec3,
    /// Edge to the second vertex.
    pub e1: Vec3,
    /// Edge to the third vertex.
    pub e2: Vec3,
    /// Unit normal of the side that shines.
    pub front: Vec3,
}

impl EmittingMesh {
    /// A light made of `triangles`; those without area are left out. `None` if no area is left.
    pub fn new(triangles: Vec<EmittingTriangle>, radiance: Spectrum) -> Option<EmittingMesh> {
        let area = |t: &EmittingTriangle| 0.5 * t.e1.cross(t.e2).length();
        let triangles: Vec<EmittingTriangle> =
            triangles.into_iter().filter(|t| area(t) > 0.0).collect();
        let mut sum = 0.0;
        let area_up_to: Vec<f64> = triangles
            .iter()
            .map(|t| {
                sum += area(t);
                sum
            })
            .collect();
        (sum > 0.0 && sum.is_finite()).then_some(EmittingMesh {
            triangles,
            area_up_to,
            radiance,
        })
    }

    /// Area of all triangles.
    pub fn area(&self) -> f64 {
        *self.area_up_to.last().expect("a light has a triangle")
    }

    /// A point uniform over the area and the normal there, from `u` in [0, 1)².
    fn sample(&self, u: Vec2) -> (Vec3, Vec3) {
        let target = u.x * self.area();
        let i = self
            .area_up_to
            .partition_point(|&a| a <= target)
            .min(self.triangles.len() - 1);
        let before = if i == 0 { 0.0 } else { self.area_up_to[i - 1] };
        let within = (target - before) / (self.area_up_to[i] - before);
        let b = warp::uniform_triangle(Vec2::new(within.min(1.0), u.y));
        let t = &self.triangles[i];
        (t.p0 + b.x * t.e1 + b.y * t.e2, t.front)
    }
}

impl Emitter {
    /// Whether light comes from a single direction at every point, so that one sample says it all and no ray
    /// that is cast at random ever finds it.
    pub fn is_delta(&self) -> bool {
        matches!(
            self,
            Emitter::Point { .. } | Emitter::Spot { .. } | Emitter::Directional { .. }
        )
    }

    /// Draws a direction from the point `p` to this light, from `u` uniform in [0, 1)². Lights without extent do
    /// not use `u`.
    ///
    /// `None` where the drawn part of the light shines nothing to `p`: seen from behind or edge-on, outside the cone
    /// of a spot, or from the very place of the light.
    pub fn sample(&self, p: Vec3, u: Vec2) -> Option<LightSample> {
        match self {
            Emitter::Point {
                position,
                intensity,
            } => from_point(p, *position, *intensity),
            Emitter::Spot {
                position,
                direction,
                intensity,
                cos_edge,
                falloff_exponent,
            } => {
                let cos = (p - *position).try_normalize()?.dot(*direction);
                if cos < *cos_edge {
                    return None;
                }
                let falloff = math::pow(cos.clamp(0.0, 1.0), *falloff_exponent);
                from_point(p, *position, *intensity * falloff)
            }
            Emitter::Directional {
                direction,
                irradiance,
            } => Some(LightSample {
                wi: -*direction,
                distance: f64::INFINITY,
                pdf: 1.0,
                radiance: *irradiance,
            }),
            Emitter::Mesh(mesh) => {
                let (q, front) = mesh.sample(u);
                let (wi, distance) = towards(p, q)?;
                let cos = -wi.dot(front);
                let pdf = distance * distance / (cos * mesh.area());
                // Not `cos <= 0.0`: a NaN has no place in a picture either.
                (cos > 0.0 && pdf.is_finite() && pdf > 0.0).then_some(LightSample {
                    wi,
                    distance,
                    pdf,
                    radiance: mesh.radiance,
                })
            }
            Emitter::Sphere {
                sphere, radiance, ..
            } => sample_sphere(sphere, *radiance, p, u),
            Emitter::Sky { radiance } => {
                let w = warp::uniform_hemisphere(u);
                Some(LightSample {
                    wi: Vec3::new(w.x, w.z, w.y),
                    distance: f64::INFINITY,
                    pdf: warp::UNIFORM_HEMISPHERE_PDF,
                    radiance: *radiance,
                })
            }
            Emitter::Environment(environment) => environment.sample(u),
        }
    }
}

/// Unit direction and distance from `p` to `q`; `None` if they are the same point.
fn towards(p: Vec3, q: Vec3) -> Option<(Vec3, f64)> {
    let d = q - p;
    let distance = d.length();
    (distance > 0.0 && distance.is_finite()).then(|| (d / distance, distance))
}

fn from_point(p: Vec3, position: Vec3, intensity: Spectrum) -> Option<LightSample> {
    let (wi, distance) = towards(p, position)?;
    let radiance = intensity / (distance * distance);
    radiance.is_finite().then_some(LightSample {
        wi,
        distance,
        pdf: 1.0,
        radiance,
    })
}

/// What a sphere shows to a point outside: a cone, sampled uniformly (Shirley, Wang, Zimmerman: "Monte Carlo
/// techniques for direct lighting calculations", 1996). Nothing to a point inside or on it.
fn sample_sphere(s: &Sphere, radiance: Spectrum, p: Vec3, u: Vec2) -> Option<LightSample> {
    let (axis, d) = towards(p, s.center)?;
    let sin2_max = (s.radius / d) * (s.radius / d);
    if s.radius <= 0.0 || sin2_max >= 1.0 {
        return None;
    }
    let share = cone_height(sin2_max);
    // 1 - cos θ uniform in [0, share): written so that a small cone keeps its digits.
    let one_minus_cos = u.x * share;
    let cos = 1.0 - one_minus_cos;
    let sin2 = (one_minus_cos * (2.0 - one_minus_cos)).max(0.0);
    let (sin_phi, cos_phi) = math::sin_cos(TAU * u.y);
    let sin = sin2.sqrt();
    let frame = Frame::around(axis);
    let wi = frame
        .to_world(Vec3::new(sin * cos_phi, sin * sin_phi, cos))
        .normalize();
    let half_chord2 = (s.radius * s.radius - d * d * sin2).max(0.0);
    Some(LightSample {
        wi,
        distance: d * cos - half_chord2.sqrt(),
        pdf: 1.0 / (TAU * share),
        radiance,
    })
}

/// `1 - cos θ` of a cone whose half angle has the squared sine `sin2`, without cancellation.
fn cone_height(sin2: f64) -> f64 {
    sin2 / (1.0 + (1.0 - sin2).max(0.0).sqrt())
}

// --- What the same directions would cost if another strategy drew them: for multiple importance sampling.

impl Emitter {
    /// The density with which [`Emitter::sample`] draws `wi` from `p`, given that the ray along `wi` meets this
    /// emitter at `distance` on a surface with the unit normal `normal` (its front side). For skies and
    /// environments distance and normal say nothing. 0 for lights without extent.
    pub fn pdf(&self, p: Vec3, wi: Vec3, distance: f64, normal: Vec3) -> f64 {
        match self {
            Emitter::Point { .. } | Emitter::Spot { .. } | Emitter::Directional { .. } => 0.0,
            Emitter::Mesh(mesh) => {
                let cos = -wi.dot(normal);
                if cos > 0.0 {
                    distance * distance / (cos * mesh.area())
                } else {
                    0.0
                }
            }
            Emitter::Sphere { sphere, .. } => {
                let sin2 = sphere.radius * sphere.radius / p.distance_squared(sphere.center);
                if sin2 < 1.0 {
                    1.0 / (TAU * cone_height(sin2))
                } else {
                    0.0
                }
            }
            Emitter::Sky { .. } if wi.y >= 0.0 => warp::UNIFORM_HEMISPHERE_PDF,
            Emitter::Sky { .. } => 0.0,
            Emitter::Environment(environment) => environment.pdf(wi),
        }
    }
}
