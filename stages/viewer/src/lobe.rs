//! How a surface scatters at a point: the density of the directions that the stages sample, and the
//! directions that they sampled.

use kit::{Hit, Material, Surface, Vec2, Vec3};
use pathtracer::replay::{Outcome, PixelReplay, RayRecord};
use pathtracer::{Picture, RayRole, lobe};
use std::f64::consts::{PI, TAU};

/// The scattering at a point, as a drawing: directions times lengths from 0 to 1, in world space.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lobe {
    /// Curves of the density: the distance from the point is the density in that direction,
    /// relative to the largest one.
    pub curves: Vec<Vec<Vec3>>,
    /// The directions of mirrors and smooth glass, with their probabilities as lengths.
    pub arrows: Vec<Vec3>,
    /// The directions of the sampled rays, at the distance of their density.
    pub samples: Vec<Vec3>,
}

/// The number of curves around a lobe.
const CURVES: u32 = 12;
/// The number of pieces of a curve.
const PIECES: u32 = 32;
/// The random numbers of each dimension that find the middle of a lobe.
const GRID: u32 = 6;

impl Lobe {
    /// The scattering where `record`, a ray of `replay`, hit; the sampled directions are those of
    /// all samples whose paths hit the same primitive after as many bounces. `None` where no light
    /// is scattered.
    pub fn of(picture: &Picture, replay: &PixelReplay, record: &RayRecord) -> Option<Lobe> {
        let (Picture::Lit(lit), Outcome::Hit(hit)) = (picture, record.outcome) else {
            return None;
        };
        if !matches!(record.role, RayRole::Camera | RayRole::Bounce) {
            return None;
        }
        let surface = lit.surface(&hit);
        let wo = surface.frame.to_local(-record.ray.d.normalize());
        let directions = sampled(replay, record.depth, &hit);
        let drawn = Lobe::new(&surface, wo, &directions);
        drawn.filter(|lobe| !lobe.curves.is_empty() || !lobe.arrows.is_empty())
    }

    fn new(surface: &Surface<'_>, wo: Vec3, directions: &[Vec3]) -> Option<Lobe> {
        let (material, frame) = (surface.material, surface.frame);
        if material.is_delta() {
            let arrows = delta_directions(material, wo);
            return Some(Lobe {
                arrows: arrows.into_iter().map(|w| frame.to_world(w)).collect(),
                samples: directions.to_vec(),
                ..Lobe::default()
            });
        }
        let axis = middle(material, wo)?;
        let (u, v) = axis.any_orthonormal_pair();
        let direction = |turn: f64, angle: f64| {
            let around = turn.cos() * u + turn.sin() * v;
            angle.cos() * axis + angle.sin() * around
        };
        let curves: Vec<Vec<(Vec3, f64)>> = (0..CURVES)
            .map(|curve| {
                let turn = TAU * f64::from(curve) / f64::from(CURVES);
                let pieces = (0..=PIECES).map(|piece| {
                    // Narrow lobes change fast near their middle.
                    let share = f64::from(piece) / f64::from(PIECES);
                    let w = direction(turn, PI * share * share);
                    (w, lobe::pdf(material, wo, w))
                });
                pieces.collect()
            })
            .collect();
        let densities = curves.iter().flatten().map(|(_, pdf)| *pdf);
        let largest = densities.filter(|pdf| pdf.is_finite()).fold(0.0, f64::max);
        if largest <= 0.0 {
            return None;
        }
        let length = |w: Vec3, pdf: f64| frame.to_world(w) * (pdf / largest).clamp(0.0, 1.5);
        let samples = directions.iter().map(|&d| {
            let w = frame.to_local(d);
            length(w, lobe::pdf(material, wo, w))
        });
        Some(Lobe {
            samples: samples.collect(),
            curves: curves
                .iter()
                .map(|curve| curve.iter().map(|&(w, pdf)| length(w, pdf)).collect())
                .collect(),
            arrows: Vec::new(),
        })
    }
}

/// The directions in which paths left the primitive of `hit` after `depth` bounces.
fn sampled(replay: &PixelReplay, depth: u32, hit: &Hit) -> Vec<Vec3> {
    let of_sample = |rays: &[RayRecord]| {
        let bounces = rays.iter().filter(|ray| ray.role == RayRole::Bounce);
        let from_here = bounces.filter(|ray| {
            let parent = ray.parent.and_then(|parent| rays.get(parent));
            parent.is_some_and(|parent| {
                let hits = matches!(parent.outcome, Outcome::Hit(of) if of.prim == hit.prim);
                hits && parent.depth == depth
            })
        });
        from_here
            .map(|ray| ray.ray.d.normalize())
            .collect::<Vec<Vec3>>()
    };
    let samples = replay.samples.iter();
    samples.flat_map(|sample| of_sample(&sample.rays)).collect()
}

/// Random numbers that cover [0, 1)³ evenly.
fn grid() -> impl Iterator<Item = (Vec2, f64)> {
    let share = |i: u32| (f64::from(i) + 0.5) / f64::from(GRID);
    (0..GRID.pow(3)).map(move |i| {
        let u = Vec2::new(share(i % GRID), share(i / GRID % GRID));
        (u, share(i / GRID.pow(2)))
    })
}

/// The mean of the directions that are sampled.
fn middle(material: &Material, wo: Vec3) -> Option<Vec3> {
    let directions = grid().filter_map(|(u, choice)| lobe::sample(material, wo, u, choice));
    let sum: Vec3 = directions.map(|sample| sample.wi).sum();
    sum.try_normalize()
}

/// The directions of a material that scatters into finitely many, each as long as it is probable.
fn delta_directions(material: &Material, wo: Vec3) -> Vec<Vec3> {
    let mut found: Vec<Vec3> = Vec::new();
    // Whatever the probabilities are, the ends of the range choose different directions.
    for choice in [0.0, 1.0 - f64::EPSILON] {
        if let Some(sample) = lobe::sample(material, wo, Vec2::splat(0.5), choice) {
            let w = sample.wi * sample.pdf.clamp(0.0, 1.0);
            if !found.iter().any(|other| other.abs_diff_eq(w, 1e-9)) {
                found.push(w);
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use kit::{Frame, PrimId, Spectrum};

    fn surface(material: &Material) -> Surface<'_> {
        Surface {
            p: Vec3::ZERO,
            frame: Frame::around(Vec3::Y),
            ng: Vec3::Y,
            error: Vec3::ZERO,
            material,
            prim: PrimId(0),
        }
    }

    #[test]
    fn a_diffuse_lobe_is_a_sphere_on_the_surface_and_samples_lie_on_it() {
        let material = Material::Diffuse {
            reflectance: Spectrum::WHITE,
        };
        let wo = Vec3::new(0.6, 0.0, 0.8);
        let tilted = Vec3::new(0.3, 0.8, -0.2).normalize();
        let lobe = Lobe::new(&surface(&material), wo, &[tilted]).expect("a lobe");
        assert_eq!(lobe.curves.len(), CURVES as usize);
        let center = 0.5 * Vec3::Y;
        let is_on_sphere = |p: &Vec3| (p.distance(center) - 0.5).abs() < 0.02;
        let curves = lobe.curves.iter().flatten();
        assert!(curves.clone().all(is_on_sphere), "{:?}", lobe.curves[0]);
        assert!(curves.clone().any(|p| p.y > 0.97) && lobe.arrows.is_empty());
        assert!(is_on_sphere(&lobe.samples[0]), "{:?}", lobe.samples);
    }

    #[test]
    fn a_mirror_has_one_arrow_and_glass_two_that_are_as_long_as_probable() {
        let white = Spectrum::WHITE;
        let wo = Vec3::new(0.6, 0.0, 0.8);
        let mirror = Material::Mirror { reflectance: white };
        let lobe = Lobe::new(&surface(&mirror), wo, &[]).expect("a lobe");
        assert!(lobe.curves.is_empty());
        let [arrow] = lobe.arrows.as_slice() else {
            panic!("one arrow: {lobe:?}");
        };
        assert!((arrow.length() - 1.0).abs() < 1e-9 && arrow.y > 0.7);
        let glass = Material::Glass {
            reflectance: white,
            transmittance: white,
            roughness: 0.0,
            ior: 1.5,
        };
        let lobe = Lobe::new(&surface(&glass), wo, &[]).expect("a lobe");
        assert_eq!(lobe.arrows.len(), 2);
        let sum: f64 = lobe.arrows.iter().map(|arrow| arrow.length()).sum();
        assert!((sum - 1.0).abs() < 1e-9, "{sum}");
    }

    #[test]
    fn lamps_scatter_nothing() {
        let lamp = Material::Emission {
            radiance: Spectrum::WHITE,
        };
        assert_eq!(Lobe::new(&surface(&lamp), Vec3::Z, &[]), None);
    }
}
