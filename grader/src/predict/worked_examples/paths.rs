//! Part 4: light at a boundary, the light along a path, and how many paths go on.

use super::example::{AskedNumber, WorkedExample, tenths};
use crate::predict::draw::Draw;

/// A boundary with glass below it. The cosine behind it is stored with five digits.
pub(super) fn glass(draw: &mut Draw) -> WorkedExample {
    // The index, the sine and cosine of the viewer's angle, the same behind the boundary.
    const FROM_OUTSIDE: [(f64, f64, f64, f64, f64); 6] = [
        (1.25, 0.6, 0.8, 0.48, 0.87727),
        (1.25, 0.8, 0.6, 0.64, 0.76837),
        (1.5, 0.8, 0.6, 0.53333, 0.84591),
        (1.6, 0.8, 0.6, 0.5, 0.86603),
        (2.0, 0.6, 0.8, 0.3, 0.95394),
        (2.0, 0.8, 0.6, 0.4, 0.91652),
    ];
    const FROM_INSIDE: [(f64, f64, f64, f64, f64); 6] = [
        (1.25, 0.6, 0.8, 0.75, 0.66144),
        (1.25, 0.28, 0.96, 0.35, 0.93675),
        (1.5, 0.6, 0.8, 0.9, 0.43589),
        (1.5, 0.28, 0.96, 0.42, 0.90752),
        (1.6, 0.28, 0.96, 0.448, 0.89403),
        (2.0, 0.28, 0.96, 0.56, 0.82849),
    ];
    let side = draw.one(&[1.0, -1.0]);
    let list = if side > 0.0 {
        FROM_OUTSIDE
    } else {
        FROM_INSIDE
    };
    let (index, sine, cosine, other_sine, other_cosine) = draw.one(&list);
    let quotient = other_sine / sine;
    let inverted = sine / quotient;
    WorkedExample {
        given: vec![
            format!(
                "Glass with the index of refraction {index} is below the boundary, air above it."
            ),
            format!(
                "The viewer is {} in the direction ωo = ({sine}, 0, {}). Nothing is absorbed: R = T = 1.",
                if side > 0.0 {
                    "in the air,"
                } else {
                    "in the glass,"
                },
                side * cosine
            ),
        ],
        asked: vec![
            AskedNumber::new(
                "x of the mirrored direction",
                -sine,
                &[(
                    sine,
                    "x of the viewer's direction: both point away from the surface",
                )],
            ),
            AskedNumber::new(
                "x of the refracted direction",
                -other_sine,
                &[
                    (
                        other_sine,
                        "x with the wrong sign: both directions point away from the surface",
                    ),
                    (-inverted, "x with the inverted index"),
                    (-sine, "x of light that goes straight on"),
                ],
            ),
            AskedNumber::new(
                "z of the refracted direction",
                -side * other_cosine,
                &[
                    (
                        side * other_cosine,
                        "z on the side of the viewer: that would be a mirror",
                    ),
                    (-side * cosine, "z of light that goes straight on"),
                ],
            ),
            AskedNumber::new(
                "the weight of the refraction",
                quotient * quotient,
                &[
                    (1.0, "the weight without the squared index"),
                    (quotient, "the quotient of the indices, not its square"),
                    (
                        1.0 / quotient / quotient,
                        "the square of the inverted quotient",
                    ),
                ],
            ),
        ],
    }
}

/// A path over two surfaces to a lamp, in one colour.
pub(super) fn path(draw: &mut Draw) -> WorkedExample {
    let kept = [tenths(draw.one(&[2, 4, 5])), tenths(draw.one(&[6, 8, 9]))];
    let direct = [tenths(draw.from(1, 5)), tenths(draw.from(6, 9))];
    let lamp = f64::from(draw.from(4, 12));
    let both = kept[0] * kept[1];
    let room = draw.one(&[0.2, 0.6, 0.75, 0.8, 0.9]);
    let sum = direct[0] + kept[0] * direct[1];
    let in_mirror = direct[0] + kept[0] * lamp;
    WorkedExample {
        given: vec![
            format!(
                "A camera ray hits a diffuse wall: reflectance {}, direct light {}. The next ray hits a diffuse floor: reflectance {}, direct light {}.",
                kept[0], direct[0], kept[1], direct[1]
            ),
            format!(
                "The third ray hits a lamp that emits {lamp} and reflects nothing. Neither wall nor floor emits. Directions are sampled by the cosine."
            ),
            format!("In a closed room, every surface emits 1 and reflects {room}."),
        ],
        asked: vec![
            AskedNumber::new(
                "the throughput on arrival at the lamp",
                both,
                &[
                    (
                        kept[1],
                        "the reflectance of the last surface: those before count, too",
                    ),
                    (kept[0], "the throughput on arrival at the floor"),
                    (kept[0] + kept[1], "the sum of the reflectances"),
                ],
            ),
            AskedNumber::new(
                "the radiance along the camera ray",
                sum,
                &[
                    (
                        sum + both * lamp,
                        "the radiance with the lamp counted twice: the floor's direct light contains it",
                    ),
                    (direct[0] + direct[1], "direct light without the throughput"),
                    (
                        direct[0] + both * direct[1],
                        "direct light with the throughput after the surface, not before it",
                    ),
                    (direct[0], "the direct light of the first surface alone"),
                    (
                        kept[0] * direct[0] + both * direct[1],
                        "each light with a throughput one surface too late",
                    ),
                ],
            ),
            AskedNumber::new(
                "the same if a mirror that reflects everything is in the place of the floor",
                in_mirror,
                &[
                    (
                        direct[0],
                        "the radiance with a lamp that is black in mirrors",
                    ),
                    (
                        sum,
                        "the radiance with direct light at the mirror, and without the lamp",
                    ),
                    (
                        in_mirror + kept[0] * direct[1],
                        "the radiance with direct light at the mirror",
                    ),
                    (
                        direct[0] + lamp,
                        "the radiance without the throughput of the wall",
                    ),
                ],
            ),
            AskedNumber::new(
                "the radiance in the closed room",
                1.0 / (1.0 - room),
                &[
                    (1.0 + room, "the radiance after one bounce"),
                    (
                        room / (1.0 - room),
                        "the radiance without the room's own emission",
                    ),
                    (1.0 + room + room * room, "the radiance after two bounces"),
                ],
            ),
        ],
    }
}

/// A throughput in eighths, and the game that ends paths.
pub(super) fn roulette(draw: &mut Draw) -> WorkedExample {
    let largest = draw.from(4, 7);
    let middle = draw.from(2, largest - 1);
    let smallest = draw.from(0, 1);
    let mut channels = [largest, middle, smallest];
    draw.shuffle(&mut channels);
    let [red, green, blue] = channels.map(|channel| f64::from(channel) / 8.0);
    let (of_largest, of_middle) = (f64::from(largest), f64::from(middle));
    let kept = draw.one(&[4, 5, 6, 8, 9]);
    let further = f64::from(kept) / f64::from(10 - kept);
    let mean = (red + green + blue) / 3.0;
    WorkedExample {
        given: vec![
            format!("After five bounces the throughput is ({red}, {green}, {blue})."),
            format!("All walls of a room reflect ρ = {}.", tenths(kept)),
        ],
        asked: vec![
            AskedNumber::new(
                "q, the probability of survival",
                of_largest / 8.0,
                &[
                    (
                        mean,
                        "the mean of the channels: survivors would have a channel above 1",
                    ),
                    (1.0 - of_largest / 8.0, "the probability of ending"),
                    (red + green + blue, "the sum of the channels"),
                    (of_middle / 8.0, "the second largest channel"),
                ],
            ),
            AskedNumber::new(
                "the second largest channel of a survivor",
                of_middle / of_largest,
                &[
                    (
                        of_middle / 8.0,
                        "the channel before the game: survivors make up for those that lost",
                    ),
                    (
                        of_middle / (8.0 - of_largest),
                        "the channel divided by the probability of ending",
                    ),
                    (
                        of_middle * of_largest / 64.0,
                        "the channel times the probability",
                    ),
                    (1.0, "the largest channel"),
                ],
            ),
            AskedNumber::new(
                "how many bounces more a survivor makes in the room, on average",
                further,
                &[
                    (
                        further + 1.0,
                        "the number with the bounce that was made already",
                    ),
                    (tenths(kept), "the probability of one bounce more"),
                    (10.0 / f64::from(kept), "one divided by the reflectance"),
                ],
            ),
        ],
    }
}
