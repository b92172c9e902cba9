//! The sample loop of a pixel.

use crate::cases::Spec;
use crate::tally::Aspect::{Calls, Placement, Radiance, Spread};
use wire::Work;
use wire::work::{PixelWork, PixelWorld};

/// The cases of `part1.task1`.
pub(crate) fn cases(seed: u64) -> Vec<Spec> {
    vec![
        case(
            "center_of_each_pixel",
            "One sample a pixel goes through its centre, ((x + 0.5) / w, (y + 0.5) / h); the film \
             is not square. Pitfall: integer division makes every pixel (0, 0).",
            work([7, 3], all([7, 3]), 1, PixelWorld::Ramp, 0),
        ),
        case(
            "film_of_one_pixel",
            "A film of one pixel: the ray goes through (0.5, 0.5).",
            work([1, 1], all([1, 1]), 1, PixelWorld::Ramp, 0),
        )
        .only(&[Placement]),
        case(
            "large_film",
            "Corners and centre of a film of 8192 x 4320 pixels.",
            work(
                [8192, 4320],
                vec![[0, 0], [8191, 0], [0, 4319], [8191, 4319], [4096, 2160]],
                1,
                PixelWorld::Ramp,
                0,
            ),
        )
        .only(&[Placement]),
        case(
            "samples_inside_the_pixel",
            "16 samples a pixel: each somewhere else, all inside the pixel, spread evenly \
             over it.",
            work([9, 8], all([9, 8]), 16, PixelWorld::Ramp, 0),
        )
        .only(&[Calls, Placement, Spread]),
        case(
            "fresh_samples",
            "64 samples a pixel with other random numbers for each seed.",
            work([6, 5], all([6, 5]), 64, PixelWorld::Ramp, seed),
        ),
        case(
            "odd_number_of_samples",
            "7 samples a pixel: as many rays, and their mean. Pitfall: whoever takes whole rows of \
             samples, or starts the loop at 1, has another number.",
            work([5, 4], all([5, 4]), 7, PixelWorld::Ramp, 0),
        )
        .only(&[Calls, Radiance]),
        case(
            "bright_light",
            "Radiance may be far above 1: it is averaged as it comes. Pitfall: a mean of clamped \
             values is too dark.",
            work(
                [3, 2],
                all([3, 2]),
                8,
                PixelWorld::Constant([50.0, 3.0, 0.01]),
                0,
            ),
        )
        .only(&[Radiance]),
        case(
            "light_and_dark",
            "Samples are bright and black by turns: the pixel is their mean. Pitfall: neither their \
             sum nor the last one is.",
            work(
                [3, 2],
                all([3, 2]),
                10,
                PixelWorld::Flicker([8.0, 4.0, 2.0]),
                0,
            ),
        )
        .only(&[Radiance]),
        case(
            "no_samples",
            "No samples: nothing is known, so the pixel is black and says so. Pitfall: their mean is 0 / 0.",
            work([3, 2], all([3, 2]), 0, PixelWorld::Ramp, 0),
        )
        .only(&[Calls, Radiance]),
        case(
            "beyond_the_film",
            "Pixels beside and above the film: a camera sees there, too.",
            work(
                [4, 3],
                vec![[4, 0], [0, 3], [9, 7], [400, 300]],
                1,
                PixelWorld::Ramp,
                0,
            ),
        )
        .only(&[Calls, Placement]),
        Spec {
            picture: Some(PICTURE),
            ..case(
                "picture_of_rings",
                "A picture of rings with one sample a pixel; the rings in the corners are \
                 what one sample cannot resolve.",
                work(PICTURE, all(PICTURE), 1, PixelWorld::Rings, 0),
            )
        },
    ]
}

/// Width and height of the picture.
const PICTURE: [u32; 2] = [128, 96];

fn case(name: &'static str, about: &'static str, work: PixelWork) -> Spec {
    Spec::new("part1.task1", name, about, Work::Pixels(work))
}

fn work(
    film: [u32; 2],
    pixels: Vec<[u32; 2]>,
    ns_aa: u32,
    world: PixelWorld,
    seed: u64,
) -> PixelWork {
    PixelWork {
        film,
        pixels,
        ns_aa,
        seed,
        world,
    }
}

/// All pixels of a film, row by row from the bottom left.
fn all([w, h]: [u32; 2]) -> Vec<[u32; 2]> {
    (0..h).flat_map(|y| (0..w).map(move |x| [x, y])).collect()
}
