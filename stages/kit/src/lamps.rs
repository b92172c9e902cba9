//! Many lamps as one light: each sample chooses one of them.

use crate::{Emitter, LightSample, Vec2, Vec3};

/// Lamps of which each sample chooses one, in proportion to about what it can send to the point:
/// its power, divided by the squared distance. Of a flat lamp only the front counts, and at a
/// grazing angle less.
#[derive(Clone, Debug, PartialEq)]
pub struct Lamps {
    lamps: Vec<Lamp>,
}

/// One of many lamps.
#[derive(Clone, Debug, PartialEq)]
pub struct Lamp {
    emitter: Emitter,
    /// The middle of its bounding box.
    pub center: Vec3,
    /// Of the smallest sphere about the centre that holds the lamp, squared.
    pub radius2: f64,
    /// The front normal, if all of the lamp lies in one plane.
    pub front: Option<Vec3>,
    /// The largest channel of its radiance, times its area.
    pub power: f64,
}

/// How far a flat lamp may be from a plane, relative to its radius, and its normals from each
/// other, squared: a few roundings. Points so near to the plane get hardly any light.
const FLATNESS2: f64 = 1e-24;

impl Lamps {
    /// Combines `emitters`, meshes and spheres; others are left out.
    pub(crate) fn new(emitters: Vec<Emitter>) -> Lamps {
        let lamps = emitters.into_iter().filter_map(Lamp::new);
        Lamps {
            lamps: lamps.collect(),
        }
    }

    /// The lamps.
    pub fn lamps(&self) -> &[Lamp] {
        &self.lamps
    }

    /// Samples one of the lamps from `p`, as [`Emitter::sample`] does. The density includes the
    /// choice of the lamp.
    pub fn sample(&self, p: Vec3, u: Vec2) -> Option<LightSample> {
        let sum: f64 = self.lamps.iter().map(|lamp| lamp.weight(p)).sum();
        if sum.is_finite() {
            return self.choose(p, u, sum, |lamp| lamp.weight(p));
        }
        // Beside a lamp whose power is too large for a number, all that send light here are equal.
        let sends = |lamp: &Lamp| f64::from(lamp.weight(p) > 0.0);
        let count = self.lamps.iter().map(sends).sum();
        self.choose(p, u, count, sends)
    }

    /// Chooses a lamp in proportion to its `weight_of`; `total` is their sum.
    fn choose(
        &self,
        p: Vec3,
        u: Vec2,
        total: f64,
        weight_of: impl Fn(&Lamp) -> f64,
    ) -> Option<LightSample> {
        let mut rest = u.x * total;
        for lamp in &self.lamps {
            let weight = weight_of(lamp);
            if rest < weight {
                // What is left of the number is uniform again.
                return lamp.sample(p, Vec2::new(rest / weight, u.y), weight / total);
            }
            rest -= weight;
        }
        None
    }
}

impl Lamp {
    fn new(emitter: Emitter) -> Option<Lamp> {
        let (center, radius2, front, power) = match &emitter {
            Emitter::Mesh(mesh) => {
                let parts = (0..mesh.len()).map(|i| mesh.part(i).triangle);
                let corners = || parts.clone().flat_map(|t| [t.p0, t.p0 + t.e1, t.p0 + t.e2]);
                let low = corners().reduce(Vec3::min)?;
                let high = corners().reduce(Vec3::max)?;
                let (center, front) = (0.5 * (low + high), mesh.part(0).triangle.front);
                let radius2 = corners()
                    .map(|corner| corner.distance_squared(center))
                    .fold(0.0, f64::max);
                let is_flat = parts
                    .clone()
                    .all(|t| (t.front - front).length_squared() < FLATNESS2)
                    && corners().all(|corner| {
                        let height = (corner - center).dot(front);
                        height * height <= FLATNESS2 * radius2
                    });
                let power = mesh.radiance.max_channel() * mesh.area();
                (center, radius2, is_flat.then_some(front), power)
            }
            Emitter::Sphere {
                sphere, radiance, ..
            } => {
                let radius2 = sphere.radius * sphere.radius;
                let area = std::f64::consts::PI * radius2;
                (sphere.center, radius2, None, radiance.max_channel() * area)
            }
            _ => return None,
        };
        Some(Lamp {
            emitter,
            center,
            radius2,
            front,
            power,
        })
    }

    /// Samples the lamp, which was chosen with a probability of `share`, from `p`.
    pub fn sample(&self, p: Vec3, u: Vec2, share: f64) -> Option<LightSample> {
        let sample = self.emitter.sample(p, u)?;
        let pdf = sample.pdf * share;
        (pdf > 0.0).then_some(LightSample { pdf, ..sample })
    }

    /// About what the lamp can send to `p`. Positive wherever it sends light, but for rounding.
    #[inline]
    pub fn weight(&self, p: Vec3) -> f64 {
        let d = p - self.center;
        let distance2 = d.length_squared();
        let at_front = self.power / distance2.max(self.radius2);
        match self.front {
            // At the centre itself the distance is 0, and no light comes.
            Some(front) => {
                at_front * (d.dot(front).max(0.0) / distance2.max(f64::MIN_POSITIVE).sqrt())
            }
            None => at_front,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::emitting_mesh::EmittingTriangle;
    use crate::{EmittingMesh, PixelSampler, PrimId, Spectrum, Sphere, Tally};

    fn lamps() -> Vec<Emitter> {
        let panel = |x: f64, y: f64, front: Vec3| {
            let triangle = |p0, e1, e2| EmittingTriangle { p0, e1, e2, front };
            let p0 = Vec3::new(x, y, 2.0);
            let (e1, e2) = (0.5 * Vec3::X, 0.25 * Vec3::Y);
            let halves = vec![triangle(p0, e1, e2), triangle(p0 + e1 + e2, -e1, -e2)];
            Emitter::Mesh(EmittingMesh::new(halves, Spectrum::grey(3.0)).expect("an area"))
        };
        let slope = EmittingTriangle {
            p0: Vec3::new(1.0, 1.0, 1.0),
            e1: Vec3::X,
            e2: Vec3::new(0.0, 1.0, 1.0),
            front: Vec3::new(0.0, 1.0, -1.0).normalize(),
        };
        let floor = EmittingTriangle {
            e2: Vec3::Y,
            front: -Vec3::Z,
            ..slope
        };
        let bent = EmittingMesh::new(vec![slope, floor], Spectrum::grey(1.0));
        vec![
            panel(0.0, 0.0, -Vec3::Z),
            panel(2.0, -1.0, -Vec3::Z),
            panel(-1.0, 0.5, Vec3::Z),
            Emitter::Mesh(bent.expect("an area")),
            Emitter::Sphere {
                sphere: Sphere {
                    center: Vec3::new(-2.0, 0.0, 1.0),
                    radius: 0.4,
                },
                radiance: Spectrum::grey(5.0),
                prim: PrimId(9),
            },
        ]
    }

    /// At each point, also behind some of the lamps and near one.
    #[test]
    fn one_lamp_chosen_sends_the_sum_of_all() {
        assert_same_mean(&lamps());
    }

    #[test]
    fn a_lamp_whose_power_is_no_number_hides_no_other() {
        let (e1, e2) = (20.0 * Vec3::X, 20.0 * Vec3::Y);
        let sky = EmittingTriangle {
            p0: Vec3::new(-9.0, -9.0, 9.0),
            e1: e2,
            e2: e1,
            front: -Vec3::Z,
        };
        let sky = EmittingMesh::new(vec![sky], Spectrum::new(1e308, 1.0, 1.0));
        let mut emitters = lamps();
        emitters.push(Emitter::Mesh(sky.expect("an area")));
        assert_same_mean(&emitters);
    }

    /// Choosing one of `emitters` sends the green of all.
    fn assert_same_mean(emitters: &[Emitter]) {
        let all = Emitter::Lamps(Lamps::new(emitters.to_vec()));
        let near = Vec3::new(-2.0, 0.41, 1.0);
        for p in [
            Vec3::ZERO,
            Vec3::new(1.0, 2.0, 3.0),
            Vec3::new(0.2, 0.1, 1.9),
            near,
            // The centre of a flat lamp.
            Vec3::new(0.25, 0.125, 2.0),
        ] {
            let mut sampler = PixelSampler::new(0, 0, 1);
            let mut mean = |emitters: &[Emitter]| {
                let values = (0..40_000).map(|_| {
                    let u = sampler.get_sample();
                    let light = emitters.iter().filter_map(|emitter| emitter.sample(p, u));
                    light.map(|s| s.radiance.g / s.pdf).sum::<f64>()
                });
                values.collect::<Tally>()
            };
            let (one, each) = (mean(std::slice::from_ref(&all)), mean(emitters));
            let error = ((one.variance() + each.variance()) / 40_000.0).sqrt();
            let difference = one.mean() - each.mean();
            assert!(difference.abs() < 5.0 * error, "{p}: {one:?} {each:?}");
        }
    }
}
