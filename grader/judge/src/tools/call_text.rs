//! Parts of the text about one call: its input, and its circumstances.
//!
//! Circumstances are properties of a question of which mistakes often depend. Each ends the
//! sentence "wrong only where ...". If all wrong answers have one in common that most right answers
//! do not have, it tells where to look, even if the mistake is not known.

use crate::tools::aspects::hits::show_ray;
use kit::Vec3;
use wire::light::Material;
use wire::work::{Ray, Xyz};

/// A point or a vector.
pub(crate) fn point(xyz: Xyz) -> String {
    // As `Debug` writes it, so that it can be pasted. The sum of 0 removes the sign of a zero.
    let [x, y, z] = xyz.map(|x| x + 0.0);
    format!("({x:?}, {y:?}, {z:?})")
}

/// A unit vector. If its coordinates are fifths, it is written with whole numbers, because a person
/// can work with them: (3.0, 0.0, 4.0) / 5.
pub(crate) fn direction(unit: Xyz) -> String {
    let fifths = unit.map(|x| (x * 5.0).round());
    let is_of_fifths = (0..3).all(|i| fifths[i] / 5.0 == unit[i]);
    let is_of_halves = unit.iter().all(|x| (2.0 * x).fract() == 0.0);
    match is_of_fifths && !is_of_halves {
        true => format!("{} / 5", point(fifths)),
        false => point(unit),
    }
}

/// All `parts` in a sentence; "none" if there are none.
pub(crate) fn all_or_none(parts: impl Iterator<Item = String>) -> String {
    let parts: Vec<String> = parts.collect();
    match parts.is_empty() {
        true => "none".into(),
        false => parts.join(", then "),
    }
}

/// What a surface is made of.
pub(crate) fn material(material: &Material) -> String {
    match *material {
        Material::Diffuse(reflectance) => format!("a diffuse surface of {}", point(reflectance)),
        Material::Emission(radiance) | Material::PartOfLamp(radiance) => {
            format!("a lamp of {}", point(radiance))
        }
        Material::Mirror(reflectance) => format!("a mirror of {}", point(reflectance)),
        Material::Glass(ior) => format!("glass with the index {ior:?}"),
    }
}

/// All `parts`, if they are so few that they can be read.
pub(crate) fn few(parts: impl Iterator<Item = String>, between: &str) -> Option<String> {
    let parts: Vec<String> = parts.take(FEW + 1).collect();
    (parts.len() <= FEW).then(|| parts.join(between))
}

/// The most parts of an input that are listed.
const FEW: usize = 5;

/// A ray and what it is tested against.
pub(crate) fn ray_and(ray: &Ray, shape: &str) -> String {
    format!("{}; {shape}", show_ray(ray))
}

/// The sentences whose conditions hold.
pub(crate) fn holding(all: &[(bool, &'static str)]) -> Vec<&'static str> {
    let holding = all.iter().filter(|(holds, _)| *holds);
    holding.map(|(_, sentence)| *sentence).collect()
}

/// The circumstances of a ray.
pub(crate) fn ray_circumstances(ray: &Ray) -> Vec<&'static str> {
    let [x, y, z] = ray.d;
    let length = Vec3::from(ray.d).length();
    let direction = holding(&[
        (x < 0.0, "the ray's direction has a negative x"),
        (y < 0.0, "the ray's direction has a negative y"),
        (z < 0.0, "the ray's direction has a negative z"),
        (x > 0.0, "the ray's direction has a positive x"),
        (y > 0.0, "the ray's direction has a positive y"),
        (z > 0.0, "the ray's direction has a positive z"),
        (
            ray.d.contains(&0.0),
            "a coordinate of the ray's direction is 0",
        ),
        (
            (length - 1.0).abs() > 1e-9,
            "the ray's direction does not have length 1",
        ),
        (
            ray.o != [0.0; 3],
            "the ray does not start at the world's origin",
        ),
    ]);
    [direction, range_circumstances(ray)].concat()
}

/// The circumstances of the range of a ray.
pub(crate) fn range_circumstances(ray: &Ray) -> Vec<&'static str> {
    holding(&[
        (ray.min_t > 0.0, "min_t is above 0"),
        (ray.min_t < 0.0, "min_t is below 0"),
        (ray.max_t < f64::INFINITY, "max_t is finite"),
    ])
}

/// Whether the channels of a colour differ.
pub(crate) fn is_coloured([r, g, b]: Xyz) -> bool {
    r != g || g != b
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_unit_vector_is_written_in_whole_numbers_if_that_is_exact() {
        assert_eq!(direction([0.6, 0.0, -0.8]), "(3.0, 0.0, -4.0) / 5");
        assert_eq!(direction([0.0, -0.0, 1.0]), "(0.0, 0.0, 1.0)");
        assert_eq!(direction([0.6, 0.0, 0.81]), "(0.6, 0.0, 0.81)");
    }
}
