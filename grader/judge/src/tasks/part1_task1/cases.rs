//! Cases of the sample loop of a pixel.

use crate::tools::findings::Aspect::{Calls, Independence, Placement, Radiance, Spread};
use crate::tools::spec::Spec;
use wire::kind;
use wire::work::{PixelWork, PixelWorld};

/// The cases of `part1.task1`.
pub(crate) fn cases(seed: u64) -> Vec<Spec> {
    vec![
        case(
            "center_of_each_pixel",
            "With one sample a pixel, the ray goes through the centre of the pixel, ((x + 0.5) / \
             w, (y + 0.5) / h). The film is not square. Pitfall: integer division gives (0, 0) \
             for every pixel.",
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
            "The corner pixels and the centre pixel of a film of 8192 x 4320 pixels.",
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
            "16 samples a pixel: each at a different point, all inside the pixel, distributed \
             uniformly over it.",
            work([9, 8], all([9, 8]), 16, PixelWorld::Ramp, 0),
        )
        .only(&[Calls, Placement, Spread])
        .mainly(&[Calls, Placement]),
        case(
            "fresh_samples",
            "64 samples a pixel, with random numbers that depend on the seed.",
            work([6, 5], all([6, 5]), 64, PixelWorld::Ramp, seed),
        )
        .mainly(&[Calls, Placement, Radiance]),
        case(
            "fresh_offsets_in_each_pixel",
            "2 samples in each of 256 pixels: the samples of a pixel are independent of those of \
             other pixels. A correlation of 75 % is always detected. Pitfall: another sampler than \
             the pixel's own, or fixed positions, gives every pixel the same ones, which show as a \
             pattern in the picture.",
            work([16, 16], all([16, 16]), 2, PixelWorld::Ramp, seed),
        )
        .only(&[Independence]),
        case(
            "fresh_offsets_for_each_seed",
            "4 samples in one pixel, with 256 seeds: the samples depend on the seed. A correlation \
             of 75 % is always detected. Pitfall: with positions that do not depend on the seed, \
             the mean of many pictures is as noisy as one of them.",
            PixelWork {
                seeds: (0..256).map(|i| seed.wrapping_add(i)).collect(),
                ..work([16, 16], vec![[9, 5]], 4, PixelWorld::Ramp, seed)
            },
        )
        .only(&[Independence]),
        case(
            "fresh_numbers_for_each_ray",
            "4 samples in each of 48 pixels, in a scene where trace_ray draws a random number: each \
             ray gets a number of its own. Pitfall: trace_ray with a sampler that starts anew for \
             each ray gives all of them the same numbers, so more samples do not reduce the noise.",
            work([8, 6], all([8, 6]), 4, PixelWorld::Numbers, seed),
        )
        .only(&[Independence]),
        case(
            "odd_number_of_samples",
            "7 samples a pixel: 7 rays, and their mean. Pitfall: sampling in whole rows of a \
             grid, or starting the loop at 1, traces another number of rays.",
            work([5, 4], all([5, 4]), 7, PixelWorld::Ramp, 0),
        )
        .only(&[Calls, Radiance])
        .mainly(&[Calls, Radiance]),
        case(
            "many_samples",
            "20,011 samples in one pixel: as many rays, and their mean. Pitfall: an upper limit on \
             the number of samples, or a counter of 8 or 16 bits.",
            work([3, 2], vec![[1, 1]], 20_011, PixelWorld::Ramp, 0),
        )
        .only(&[Calls, Radiance])
        .mainly(&[Calls, Radiance]),
        case(
            "bright_light",
            "Radiance can be a million times 1, as that of the sun; the pixel is the mean of the \
             samples as they are. Pitfall: the mean of clamped samples is too dark.",
            work(
                [3, 2],
                all([3, 2]),
                8,
                PixelWorld::Constant([1e6, 3.0, 0.01]),
                0,
            ),
        )
        .only(&[Radiance, Calls])
        .mainly(&[Radiance, Calls]),
        case(
            "light_and_dark",
            "Samples alternate between bright and black; the pixel is their mean. Pitfall: it is \
             neither their sum nor the last sample.",
            work(
                [3, 2],
                all([3, 2]),
                10,
                PixelWorld::Flicker([8.0, 4.0, 2.0]),
                0,
            ),
        )
        .only(&[Radiance, Calls])
        .mainly(&[Radiance, Calls]),
        case(
            "no_samples",
            "With 0 samples the radiance is black and the sample count is 0. Pitfall: the mean of \
             no samples is 0 / 0.",
            work([3, 2], all([3, 2]), 0, PixelWorld::Ramp, 0),
        )
        .only(&[Calls, Radiance]),
        case(
            "beyond_the_film",
            "Pixels to the right of the film and above it: the same formula applies.",
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
                "A picture of concentric rings with one sample a pixel. The rings in the corners \
                 are aliasing: the true ones are too narrow for one sample a pixel.",
                work(PICTURE, all(PICTURE), 1, PixelWorld::Rings, 0),
            )
        },
    ]
}

/// Width and height of the picture.
const PICTURE: [u32; 2] = [128, 96];

fn case(name: &'static str, about: &'static str, work: PixelWork) -> Spec {
    Spec::new::<kind::Pixels>("part1.task1", name, about, work)
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
        seeds: vec![seed],
        world,
        gain: [1.0; 3],
    }
}

/// All pixels of a film, row by row from the bottom left.
fn all([w, h]: [u32; 2]) -> Vec<[u32; 2]> {
    (0..h).flat_map(|y| (0..w).map(move |x| [x, y])).collect()
}
