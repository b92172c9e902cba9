//! Light sources that can be sampled.
//!
//! A [`Light`](crate::Light) is the description of a light in a scene file. An [`Emitter`] is what
//! a renderer samples: the point, spot, directional and sky lights of the file, and the surfaces
//! that emit. [`LitScene`](crate::LitScene) creates the emitters of a scene.

use crate::emitting_sphere;
use crate::lamps::Lamps;
use crate::light_sample::towards;
use crate::math;
use crate::warp;
use crate::{EmittingMesh, Environment, LightSample, PrimId, Spectrum, Sphere, Vec2, Vec3};

/// A source of light.
///
/// ```
/// use kit::{Emitter, Spectrum, Vec2, Vec3};
/// let lamp = Emitter::Point {
///     position: 2.0 * Vec3::Y,
///     intensity: Spectrum::grey(8.0),
/// };
/// let sample = lamp.sample(Vec3::ZERO, Vec2::splat(0.5)).expect("it lights every point");
/// assert_eq!((sample.wi, sample.distance, sample.pdf), (Vec3::Y, 2.0, 1.0));
/// assert_eq!(sample.radiance, Spectrum::grey(2.0)); // 8 / 2²
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum Emitter {
    /// A point light that is the same in all directions. Irradiance falls with the squared
    /// distance.
    Point {
        /// Position.
        position: Vec3,
        /// Radiant intensity, in W/sr.
        intensity: Spectrum,
    },
    /// A point light that is restricted to a cone.
    Spot {
        /// Position.
        position: Vec3,
        /// Unit axis of the cone.
        direction: Vec3,
        /// Radiant intensity on the axis, in W/sr.
        intensity: Spectrum,
        /// Cosine of half the opening angle. A direction on the edge of the cone is lit.
        cos_edge: f64,
        /// Exponent of the cosine of the angle to the axis.
        falloff_exponent: f64,
    },
    /// A light at infinite distance.
    Directional {
        /// Unit direction of propagation, away from the light.
        direction: Vec3,
        /// Irradiance on a surface that faces the light.
        irradiance: Spectrum,
    },
    /// Triangles that emit the same radiance from their front sides. Together they are one light.
    Mesh(EmittingMesh),
    /// A sphere that emits outwards.
    Sphere {
        /// The sphere.
        sphere: Sphere,
        /// Emitted radiance.
        radiance: Spectrum,
        /// Id of the sphere in the scene.
        prim: PrimId,
    },
    /// A sky: the same radiance from every direction with `y >= 0`.
    Sky {
        /// Radiance of the sky.
        radiance: Spectrum,
    },
    /// An environment map.
    Environment(Environment),
    /// Many lamps: each sample chooses one. Only for light sampling: their [`Emitter::pdf`] is 0.
    Lamps(Lamps),
}

impl Emitter {
    /// Whether the direction to this light is unique at every point (a delta distribution). One
    /// sample is then exact, and a ray in a random direction hits the light with probability 0.
    #[inline]
    pub fn is_delta(&self) -> bool {
        matches!(
            self,
            Emitter::Point { .. } | Emitter::Spot { .. } | Emitter::Directional { .. }
        )
    }

    /// Samples a direction from the point `p` to this light from `u`, uniform in [0, 1)². Delta
    /// lights do not use `u`.
    ///
    /// `None` if the sampled point of the light sends nothing to `p`: `p` is behind it, in its
    /// plane or at the same position, or outside the cone of a spot light.
    #[inline]
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
                let d = q - p;
                let height = -d.dot(front);
                if height <= 0.0 {
                    return None;
                }
                let distance2 = d.length_squared();
                let distance = distance2.sqrt();
                // distance² / (cos · area), where cos = height / distance.
                let pdf = distance2 * distance / (height * mesh.area());
                (pdf.is_finite() && pdf > 0.0).then(|| LightSample {
                    wi: d / distance,
                    distance,
                    pdf,
                    radiance: mesh.radiance,
                })
            }
            Emitter::Sphere {
                sphere, radiance, ..
            } => emitting_sphere::sample(sphere, *radiance, p, u),
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
            Emitter::Lamps(lamps) => lamps.sample(p, u),
        }
    }

    /// The density with which [`Emitter::sample`] samples `wi` from `p`, in 1/sr, given that the
    /// ray along `wi` hits this emitter at `distance`. `normal` is the unit normal of the front
    /// side at that point. Skies and environment maps ignore `distance` and `normal`. 0 for delta
    /// lights.
    pub fn pdf(&self, p: Vec3, wi: Vec3, distance: f64, normal: Vec3) -> f64 {
        match self {
            Emitter::Point { .. }
            | Emitter::Spot { .. }
            | Emitter::Directional { .. }
            | Emitter::Lamps(_) => 0.0,
            Emitter::Mesh(mesh) => {
                let cos = -wi.dot(normal);
                if cos > 0.0 {
                    distance * distance / (cos * mesh.area())
                } else {
                    0.0
                }
            }
            Emitter::Sphere { sphere, .. } => emitting_sphere::pdf(sphere, p),
            Emitter::Sky { .. } if wi.y >= 0.0 => warp::UNIFORM_HEMISPHERE_PDF,
            Emitter::Sky { .. } => 0.0,
            Emitter::Environment(environment) => environment.pdf(wi),
        }
    }
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

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::PixelSampler;
    use crate::emitting_mesh::EmittingTriangle;
    use statistics::chi_square;

    /// Significance level of each χ² test of light sampling: 1e-6 for the four tests together.
    const SIGNIFICANCE: f64 = 2.5e-7;
    pub(crate) const P: Vec3 = Vec3::new(0.1, -0.2, 0.3);

    fn lamp() -> EmittingMesh {
        let up = |x: f64, y: f64| Vec3::new(x, y, 1.1);
        let triangle = |p0: Vec3, p1: Vec3, p2: Vec3| EmittingTriangle {
            p0,
            e1: p1 - p0,
            e2: p2 - p0,
            front: -Vec3::Z,
        };
        let triangles = vec![
            triangle(up(-1.0, -1.0), up(2.0, -1.0), up(-1.0, 0.5)),
            triangle(up(0.0, 0.0), up(0.0, 0.0), up(1.0, 1.0)),
            triangle(up(0.5, 0.5), up(1.5, 0.5), up(1.5, 1.5)),
        ];
        EmittingMesh::new(triangles, Spectrum::WHITE).unwrap()
    }

    /// Distance and normal of the point where the ray from `P` along `w` hits the lamp.
    fn hit_lamp(w: Vec3) -> Option<(f64, Vec3)> {
        let t = (1.1 - P.z) / w.z;
        let q = P + t * w;
        let first = q.x >= -1.0 && q.y >= -1.0 && (q.x + 1.0) / 3.0 + (q.y + 1.0) / 1.5 <= 1.0;
        let second = q.x <= 1.5 && q.y >= 0.5 && q.x - 0.5 >= q.y - 0.5;
        (t > 0.0 && (first || second)).then_some((t, -Vec3::Z))
    }

    pub(crate) fn assert_follows_pdf(emitter: &Emitter, pdf: impl Fn(Vec3) -> f64) {
        let sample = |u, _| emitter.sample(P, u).map(|s| s.wi);
        let fit = chi_square::fit_samples(20_000, 5, sample, &pdf);
        assert!(fit.p > SIGNIFICANCE, "{emitter:?}: {fit:?}");
        // The test detects every deviation of 14 % (root mean square), so also a density that is
        // wrong by a factor of 2.
        assert!(fit.detectable_deviation(SIGNIFICANCE) < 0.14, "{fit:?}");
        let half = chi_square::fit_samples(20_000, 5, sample, |w| 0.5 * pdf(w));
        assert!(half.p < 1e-30, "{half:?}");
        let mut sampler = PixelSampler::new(0, 0, 1);
        for _ in 0..1000 {
            let Some(s) = emitter.sample(P, sampler.get_sample()) else {
                continue;
            };
            let normal = hit_lamp(s.wi).map_or(Vec3::ZERO, |(_, n)| n);
            let pdf = emitter.pdf(P, s.wi, s.distance, normal);
            assert!((s.pdf / pdf - 1.0).abs() < 1e-9, "{} {pdf}", s.pdf);
            assert!((s.wi.length() - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn mesh_samples_follow_the_pdf() {
        assert!((lamp().area() - 2.75).abs() < 1e-12);
        let emitter = Emitter::Mesh(lamp());
        let pdf = |w: Vec3| hit_lamp(w).map_or(0.0, |(t, n)| emitter.pdf(P, w, t, n));
        assert_follows_pdf(&emitter, pdf);
    }

    #[test]
    fn sky_and_environment_samples_follow_the_pdf() {
        let sky = Emitter::Sky {
            radiance: Spectrum::WHITE,
        };
        // The upper hemisphere is around +y; the cells of the test are arranged around z.
        assert_follows_pdf(&sky, |w| sky.pdf(P, w, 0.0, Vec3::ZERO));
        let texels = [1.0, 0.0, 5.0, 2.0, 0.5, 0.5, 0.0, 0.0, 0.0, 9.0, 1.0, 3.0];
        let environment =
            Environment::new(4, 3, texels.map(Spectrum::grey).to_vec()).expect("12 texels");
        let environment = Emitter::Environment(environment);
        assert_follows_pdf(&environment, |w| environment.pdf(P, w, 0.0, Vec3::ZERO));
    }
}
