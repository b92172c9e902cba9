//! Part 3: a sampled direction, directions that meet a lamp, a point of a lamp. The questions are
//! such that π cancels.

use super::example::{AskedNumber, WorkedExample, tenths, vector};
use crate::predict::draw::Draw;

/// A direction that two random numbers choose, and its density.
pub(super) fn diffuse(draw: &mut Draw) -> WorkedExample {
    // The random number, its root, and the root of what it lacks to 1.
    let (first, root, height) = draw.one(&[
        (0.04, 0.2, 0.9798),
        (0.09, 0.3, 0.95394),
        (0.16, 0.4, 0.91652),
        (0.36, 0.6, 0.8),
        (0.49, 0.7, 0.71414),
        (0.64, 0.8, 0.6),
        (0.81, 0.9, 0.43589),
    ]);
    let second = draw.one(&[0.125, 0.375, 0.625, 0.875]);
    let reflected = tenths(draw.one(&[2, 3, 4, 5, 6, 7]));
    WorkedExample {
        given: vec![
            format!(
                "A diffuse surface has the reflectance ρ = {reflected}, the same for all colours. The viewer is above it."
            ),
            format!("The random numbers are u = ({first}, {second})."),
        ],
        asked: vec![
            AskedNumber::new(
                "r, the distance from the centre of the disk",
                root,
                &[
                    (
                        first,
                        "u itself: half of the radius would get half of the points",
                    ),
                    (second, "the number that chooses the turn"),
                    (1.0 - first, "the square of the height"),
                ],
            ),
            AskedNumber::new(
                "z of the direction",
                height,
                &[
                    (1.0 - first, "the square of the height"),
                    (1.0 - root, "1 less the radius: the squares add up to 1"),
                    (root, "the distance from the centre of the disk"),
                    (-height, "the height on the other side of the surface"),
                ],
            ),
            AskedNumber::new(
                "π p, the density times π",
                height,
                &[
                    (0.5, "that of uniform directions, times π"),
                    (1.0, "the density at the normal, times π"),
                    (
                        0.5 * height,
                        "half of it: the integral must be 1 over one hemisphere",
                    ),
                ],
            ),
            AskedNumber::new(
                "the weight f cos θ / p",
                reflected,
                &[
                    (
                        reflected * height,
                        "π f cos θ: the density cancels the cosine",
                    ),
                    (
                        2.0 * reflected * height,
                        "the weight of a uniform direction",
                    ),
                    (reflected / height, "the weight without the cosine"),
                ],
            ),
        ],
    }
}

/// Uniform directions, some of which meet a lamp.
pub(super) fn directions(draw: &mut Draw) -> WorkedExample {
    // The lamp is met by one direction of so many; the deviation is the root of the others.
    let (one_of, deviation) = draw.one(&[(10, 3.0), (17, 4.0), (26, 5.0), (50, 7.0), (101, 10.0)]);
    let count = draw.one(&[4, 5, 8, 10]);
    let reflected = tenths(draw.one(&[2, 4, 5, 6, 8]));
    let lamp = f64::from(draw.from(3, 9));
    let cosines = [tenths(draw.one(&[9, 8])), tenths(draw.one(&[7, 6, 5]))];
    let sum = cosines[0] + cosines[1];
    let of_all = f64::from(count);
    let estimate = 2.0 * reflected * lamp * sum / of_all;
    WorkedExample {
        given: vec![
            format!(
                "A floor has the reflectance ρ = {reflected}. A lamp has the radiance L = {lamp}."
            ),
            format!(
                "Of {count} uniform directions two meet the lamp, at cos θ = {} and cos θ = {}. The others see black.",
                cosines[0], cosines[1]
            ),
            format!("A uniform direction meets the lamp with the probability q = 1/{one_of}."),
        ],
        asked: vec![
            AskedNumber::new(
                "the estimate of the radiance",
                estimate,
                &[
                    (
                        estimate * of_all,
                        "the sum, which is not divided by the number of samples",
                    ),
                    (
                        estimate * of_all / 2.0,
                        "the mean over the directions that meet the lamp alone",
                    ),
                    (
                        4.0 * reflected * lamp / of_all,
                        "the estimate without the cosines",
                    ),
                    (
                        estimate / std::f64::consts::TAU,
                        "the sum without the division by the density",
                    ),
                    (
                        estimate * std::f64::consts::PI,
                        "the estimate without the division by π in f",
                    ),
                    (
                        estimate / 2.0,
                        "half of it: the density of a hemisphere is 1 / 2π",
                    ),
                ],
            ),
            AskedNumber::new(
                "the standard deviation of one sample, relative to the mean",
                deviation,
                &[
                    (deviation * deviation, "the variance: take the root"),
                    (f64::from(one_of), "1 / q"),
                    (
                        deviation / of_all.sqrt(),
                        "the deviation of the mean of all samples",
                    ),
                    (
                        deviation / f64::from(one_of),
                        "the deviation relative to the value of a sample that meets the lamp",
                    ),
                ],
            ),
        ],
    }
}

/// A point of a lamp at a whole distance.
pub(super) fn lamp(draw: &mut Draw) -> WorkedExample {
    let (at, distance) = draw.one(&[
        ([1.0, 2.0, 2.0], 3.0),
        ([2.0, 1.0, 2.0], 3.0),
        ([2.0, 3.0, 6.0], 7.0),
        ([3.0, 6.0, 2.0], 7.0),
        ([4.0, 4.0, 7.0], 9.0),
        ([1.0, 8.0, 4.0], 9.0),
    ]);
    let area = draw.one(&[0.25, 0.5, 2.0, 4.0]);
    let reflected = tenths(draw.one(&[2, 4, 5, 6, 8]));
    let light = f64::from(draw.from(3, 9)) * 10.0;
    let height = at[2];
    let square = distance * distance;
    let density = square * distance / (area * height);
    let without = reflected * light * height / distance;
    WorkedExample {
        given: vec![
            format!(
                "A floor with the reflectance ρ = {reflected} and the normal (0, 0, 1) is lit at x = (0, 0, 0)."
            ),
            format!(
                "A lamp is parallel to the floor and shines down. It has the area A = {area} and the radiance L = {light}."
            ),
            format!(
                "The sampled point of the lamp is q = {}. Nothing is in the way.",
                vector(at)
            ),
        ],
        asked: vec![
            AskedNumber::new(
                "cos θ at the lamp",
                height / distance,
                &[
                    (
                        height,
                        "the height, of a direction that is not a unit vector",
                    ),
                    (
                        height / square,
                        "the height divided by the squared distance",
                    ),
                    (
                        -height / distance,
                        "the cosine to the direction away from the lamp",
                    ),
                ],
            ),
            AskedNumber::new(
                "p, the density of the direction",
                density,
                &[
                    (1.0 / area, "the density with respect to area"),
                    (square / area, "the density without the cosine of the lamp"),
                    (
                        square / area * height / distance,
                        "the density with the cosine on the wrong side",
                    ),
                    (1.0 / density, "one divided by the density"),
                    (density * area, "the density without the area"),
                    (
                        density / distance,
                        "the density with the distance in place of its square",
                    ),
                ],
            ),
            AskedNumber::new(
                "π times the estimate f L cos θ / p",
                without / density,
                &[
                    (without, "π f L cos θ, which is not divided by the density"),
                    (
                        reflected * light / density,
                        "the estimate without the cosine at the floor",
                    ),
                    (
                        without * area / square,
                        "the estimate without the cosine at the lamp",
                    ),
                    (
                        without / density / square,
                        "the estimate that is divided by the squared distance once more",
                    ),
                ],
            ),
        ],
    }
}
