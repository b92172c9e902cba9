//! Rust tests of the sample loop.

use wire::work::{PixelWork, PixelWorld};

/// A test of each sample of one pixel; if there are several samples, also of their distribution
/// over pixels of a film, and of their dependence on the pixel and the seed.
pub(crate) fn samples(work: &PixelWork, [x, y]: [u32; 2], seed: u64) -> String {
    let PixelWork {
        film: [w, h],
        ns_aa,
        world,
        ..
    } = work;
    if *world == PixelWorld::Numbers {
        return numbers(*ns_aa);
    }
    let one = format!(
        "use kit::{{FilmSize, PixelSampler, Ray, Spectrum, Vec2, Vec3}};
use std::collections::HashSet;
let film = FilmSize {{ w: {w}, h: {h} }};
let mut points: Vec<Vec2> = Vec::new();
let mut traced: Vec<Ray> = Vec::new();
// Alternates between dark and brighter than white.
let light = |i: usize| Spectrum::new([0.0, 20.0, 0.25][i % 3], 3.0, 0.4);
let estimate = raygen::raytrace_pixel(
    {x},
    {y},
    film,
    {ns_aa},
    &mut PixelSampler::new({x}, {y}, {seed}),
    &mut |point: Vec2| {{
        points.push(point);
        Ray::new(Vec3::new(point.x, point.y, points.len() as f64), Vec3::NEG_Z)
    }},
    &mut |ray: &Ray, _: &mut PixelSampler| {{
        traced.push(*ray);
        light(traced.len() - 1)
    }},
);
assert_eq!((points.len(), traced.len(), estimate.samples), ({ns_aa}, {ns_aa}, {ns_aa}));
let bits = |point: Vec2| point.to_array().map(f64::to_bits);
let mut samples = HashSet::new();
for &point in &points {{
    let offset = point * Vec2::new({w}.0, {h}.0) - Vec2::new({x}.0, {y}.0);
    let off = (offset - 0.5).abs().max_element();
    assert!(off <= {allowed:?}, \"{{point}} is at the wrong position in pixel ({x}, {y})\");
    assert!(samples.insert(bits(point)), \"two samples at {{point}}\");
}}
let mut rays = HashSet::new();
for ray in &traced {{
    let point = bits(Vec2::new(ray.o.x, ray.o.y));
    assert!(samples.contains(&point), \"a ray that the camera did not return\");
    assert!(rays.insert((point, ray.o.z.to_bits())), \"a ray was traced twice\");
}}
{mean}
let off = [estimate.radiance.r - mean.r, estimate.radiance.g - mean.g, estimate.radiance.b - mean.b];
assert!(off.iter().all(|off| off.abs() <= 1e-10), \"{{:?}}, the mean is {{mean:?}}\", estimate.radiance);
",
        allowed = if *ns_aa == 1 { 1e-9 } else { 0.5 + 1e-9 },
        mean = match ns_aa {
            0 => "let mean = Spectrum::BLACK;".into(),
            _ => format!(
                "let mean = (0..{ns_aa}).map(light).sum::<Spectrum>() / f64::from({ns_aa});"
            ),
        },
    );
    match ns_aa {
        0 | 1 => one,
        _ => one + &spread(*ns_aa),
    }
}

/// A test that each ray of a few pixels draws a random number of its own.
fn numbers(ns_aa: u32) -> String {
    format!(
        "use kit::{{FilmSize, PixelSampler, Ray, Spectrum, Vec2, Vec3}};
let mut numbers: Vec<f64> = Vec::new();
for (x, y) in [(0, 0), (1, 0), (0, 1)] {{
    raygen::raytrace_pixel(
        x,
        y,
        FilmSize {{ w: 2, h: 2 }},
        {ns_aa},
        &mut PixelSampler::new(x, y, 0),
        &mut |_: Vec2| Ray::new(Vec3::ZERO, Vec3::NEG_Z),
        &mut |_: &Ray, sampler: &mut PixelSampler| {{
            numbers.push(sampler.next_1d());
            Spectrum::BLACK
        }},
    );
}}
assert_eq!(numbers.len(), 3 * {ns_aa});
for (i, number) in numbers.iter().enumerate() {{
    assert!(!numbers[..i].contains(number), \"two rays drew {{number}}\");
}}
"
    )
}

/// How many positions the mean, the variance and the covariance are computed of, about: their
/// standard errors are at most a tenth of what the test allows.
const POSITIONS: u32 = 1 << 16;

/// A test of the mean, variance and covariance of positions in the pixel, over the first pixels of
/// a film of 64 x 64, and that they differ between pixels and between seeds.
fn spread(ns_aa: u32) -> String {
    let pixels = (POSITIONS / ns_aa).clamp(4, 64 * 64);
    format!(
        "let film = FilmSize {{ w: 64, h: 64 }};
let offsets_of = |x: u32, y: u32, seed: u64| -> Vec<Vec2> {{
    let corner = Vec2::new(f64::from(x), f64::from(y));
    let mut offsets = Vec::new();
    raygen::raytrace_pixel(
        x,
        y,
        film,
        {ns_aa},
        &mut PixelSampler::new(x, y, seed),
        &mut |point: Vec2| {{
            offsets.push(64.0 * point - corner);
            Ray::new(Vec3::ZERO, Vec3::NEG_Z)
        }},
        &mut |_: &Ray, _: &mut PixelSampler| Spectrum::BLACK,
    );
    offsets
}};
let same = |a: &[Vec2], b: &[Vec2]| a.iter().zip(b).all(|(a, b)| (*a - *b).abs().max_element() <= 1e-9);
let first = offsets_of(0, 0, 0);
for (x, y) in [(1, 0), (0, 1), (17, 23)] {{
    assert!(!same(&first, &offsets_of(x, y, 0)), \"pixel ({{x}}, {{y}}) has the positions of pixel (0, 0)\");
}}
assert!(!same(&first, &offsets_of(0, 0, 1)), \"the positions do not depend on the seed\");
let offsets: Vec<Vec2> = (0..{pixels}).flat_map(|pixel| offsets_of(pixel % 64, pixel / 64, 0)).collect();
let mean = |f: &dyn Fn(&Vec2) -> f64| offsets.iter().map(f).sum::<f64>() / offsets.len() as f64;
// A low-discrepancy set of {ns_aa} samples may be off by 1/{ns_aa}.
let slack = 0.02 + 1.0 / {ns_aa}.0;
assert!((mean(&|o| o.x) - 0.5).abs() <= slack && (mean(&|o| o.y) - 0.5).abs() <= slack, \"the mean position is not the centre\");
for variance in [mean(&|o| (o.x - 0.5).powi(2)), mean(&|o| (o.y - 0.5).powi(2))] {{
    assert!((variance - 1.0 / 12.0).abs() <= slack, \"the variance is {{variance}}, expected 1/12\");
}}
assert!(mean(&|o| (o.x - 0.5) * (o.y - 0.5)).abs() <= slack, \"x and y are correlated\");
"
    )
}
