//! Materials, lights and worlds of Parts 3 and 4, as plain numbers.

use crate::work::Xyz;
use serde::{Deserialize, Serialize};

/// The material of a surface.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Material {
    /// Diffuse, with this reflectance.
    Diffuse(Xyz),
    /// Emits this radiance on its front side.
    Emission(Xyz),
    /// A mirror with this reflectance.
    Mirror(Xyz),
    /// White glass with this index of refraction.
    Glass(f64),
    /// Emits this radiance on its front side. Neighbours in the list of panels that have this
    /// material are one lamp together.
    PartOfLamp(Xyz),
}

impl Material {
    /// The radiance that it emits on its front side.
    pub fn emitted(&self) -> Option<Xyz> {
        match self {
            Material::Emission(radiance) | Material::PartOfLamp(radiance) => Some(*radiance),
            _ => None,
        }
    }
}

/// A light without extent, or a sky.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Light {
    /// A point that shines the same everywhere.
    Point {
        /// Position.
        position: Xyz,
        /// Radiant intensity.
        intensity: Xyz,
    },
    /// A point that shines into a cone.
    Spot {
        /// Position.
        position: Xyz,
        /// Unit axis of the cone.
        direction: Xyz,
        /// Radiant intensity on the axis.
        intensity: Xyz,
        /// Full opening angle in degrees.
        falloff_angle: f64,
        /// Exponent of the cosine to the axis.
        falloff_exponent: f64,
    },
    /// A sun.
    Directional {
        /// Unit direction in which light travels.
        direction: Xyz,
        /// Irradiance on a surface that faces it.
        irradiance: Xyz,
    },
    /// The same radiance from every direction of the upper half.
    Sky(Xyz),
}

/// An axis-aligned rectangle: a ray test takes one division and no code of the student.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Panel {
    /// The axis that it is perpendicular to: 0, 1 or 2 for x, y or z.
    pub axis: usize,
    /// Its coordinate on that axis.
    pub at: f64,
    /// Its smallest coordinates on the next axis and the one after (for y: z and x).
    pub min: [f64; 2],
    /// Its largest coordinates on these axes.
    pub max: [f64; 2],
    /// 1 if its front is the side towards +axis, -1 if it is the other.
    pub faces: f64,
    /// Its material.
    pub material: Material,
}

impl Panel {
    /// The point with the coordinates `u` and `v` on the two axes in its plane.
    pub fn point(&self, [u, v]: [f64; 2]) -> Xyz {
        let mut point = [0.0; 3];
        point[self.axis] = self.at;
        point[(self.axis + 1) % 3] = u;
        point[(self.axis + 2) % 3] = v;
        point
    }

    /// Its corners, counter-clockwise as seen from +axis.
    pub fn corners(&self) -> [Xyz; 4] {
        let ([u0, v0], [u1, v1]) = (self.min, self.max);
        [[u0, v0], [u1, v0], [u1, v1], [u0, v1]].map(|place| self.point(place))
    }

    /// The unit normal of its front.
    pub fn front(&self) -> Xyz {
        let mut front = [0.0; 3];
        front[self.axis] = self.faces;
        front
    }

    /// Whether it is part of a lamp of several panels.
    pub fn is_part(&self) -> bool {
        matches!(self.material, Material::PartOfLamp(_))
    }

    /// Its area.
    pub fn area(&self) -> f64 {
        (self.max[0] - self.min[0]) * (self.max[1] - self.min[1])
    }

    /// The intersection with the line from `o` along `d`: the distance in units of the length of
    /// `d`, and the position as shares of both sides.
    pub fn meets(&self, o: Xyz, d: Xyz) -> Option<(f64, [f64; 2])> {
        let t = (self.at - o[self.axis]) / d[self.axis];
        let share = [0, 1].map(|side| {
            let along = (self.axis + 1 + side) % 3;
            (o[along] + t * d[along] - self.min[side]) / (self.max[side] - self.min[side])
        });
        let inside = share.iter().all(|share| (0.0..=1.0).contains(share));
        (inside && t.is_finite()).then_some((t, share))
    }
}

/// A world of rectangles and lights.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LitWorld {
    /// The surfaces. Panels that emit are lights.
    pub panels: Vec<Panel>,
    /// Further lights.
    pub lights: Vec<Light>,
    /// The background: the radiance of rays that miss all panels.
    pub environment: Option<Surroundings>,
}

/// An environment map, as in [`kit::Environment`]: by longitude and latitude, row by row from the
/// top left.
///
/// [`kit::Environment`]: ../../kit/environment/struct.Environment.html
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Surroundings {
    /// The number of texels in a row.
    pub width: u32,
    /// The radiance of each texel.
    pub texels: Vec<Xyz>,
}

impl Surroundings {
    /// The same radiance from everywhere.
    pub fn uniform(radiance: Xyz) -> Surroundings {
        Surroundings {
            width: 1,
            texels: vec![radiance],
        }
    }
}

/// The BSDF of a diffuse surface in scripted worlds, for directions in local space. It is not
/// Lambertian: its value depends on the directions, their order and their space, so that wrong
/// arguments show.
pub fn scripted_f(reflectance: Xyz, wo: Xyz, wi: Xyz) -> Xyz {
    if wo[2] * wi[2] <= 0.0 {
        return [0.0; 3];
    }
    let seen = MEAN_F + 0.1 * wi[0] + 0.05 * wo[1] * wi[1];
    reflectance.map(|channel| channel * seen)
}

/// The mean of [`scripted_f`] over the azimuth of `wi`, for a reflectance of 1.
pub const MEAN_F: f64 = 0.25;

/// A sampled direction: `kit::BsdfSample` as plain numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BsdfSample {
    /// Direction, in local space.
    pub wi: Xyz,
    /// Value of the BSDF.
    pub f: Xyz,
    /// Density, or probability of the choice.
    pub pdf: f64,
    /// Whether the direction is one of finitely many.
    pub delta: bool,
}
