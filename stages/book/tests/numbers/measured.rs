//! Numbers of sentences that are measured: by kernels, the reference and the course's random
//! numbers, and not by the formula that the chapter derives for them.

use super::claims::{Claim, one_digit};
use adaptive::has_converged;
use global::{fresnel_dielectric, play_roulette};
use kernels::{Kernel, Precision};
use kit::{Aabb, PixelSampler, Ray, Spectrum, Tally, Triangle, Vec3, warp};

pub(super) fn claims() -> Vec<Claim> {
    [
        scale(),
        halvings(),
        corners_of_boxes(),
        small_lamp(),
        bounces(),
        stopping(),
        leaks(),
    ]
    .concat()
}

/// The well-known test of this name, in double precision.
fn named<S: 'static, W: 'static>(kernels: Vec<Kernel<S, W>>, name: &str) -> Kernel<S, W> {
    let is_it =
        |kernel: &Kernel<S, W>| kernel.info.name == name && kernel.precision == Precision::F64;
    let found = kernels.into_iter().find(is_it);
    found.unwrap_or_else(|| panic!("grader/kernels has no {name}"))
}

/// Möller and Trumbore's test of the worked example, with all coordinates times a power of ten.
fn scale() -> Vec<Claim> {
    let kernel = named(kernels::triangles(), "Möller-Trumbore");
    // Not powers of two, so that products round as usual.
    let is_right = |exponent: i32| {
        let scaled = |x, y, z| 10_f64.powi(exponent) * Vec3::new(x, y, z);
        let tri = Triangle::flat(
            scaled(0.1, 0.2, 0.3),
            scaled(1.3, 0.4, 0.1),
            scaled(0.2, 1.7, 0.6),
        );
        let ray = Ray::new(scaled(0.7, 0.6, 1.9), scaled(-0.1, 0.05, -0.9));
        let verdict = oracle::triangle(&tri, &ray);
        let exact = verdict.crossing.expect("the ray hits").t.to_f64();
        let hit = kernel.answer(&tri, &ray);
        hit.is_some_and(|hit| (hit.t / exact - 1.0).abs() < 1e-14)
    };
    let overflows = (1..300).find(|k| !is_right(*k)).expect("it overflows");
    let loses = (1..300).find(|k| !is_right(-k)).expect("it loses digits");
    let denormal = f64::MIN_POSITIVE.log10().ceil() - 1.0;
    // What the text says is rounded: the lengths of these edges count, too.
    assert!((102..=103).contains(&overflows), "10^{overflows}");
    assert!((102..=103).contains(&loses), "10^-{loses}");
    vec![
        (
            "part1/task3.md",
            "overflow from about $10^{102}$ on, and lose digits below about $10^{-102}$".into(),
        ),
        (
            "part2/task2.md",
            format!("Below $10^{{{denormal}}}$ floats have fewer digits"),
        ),
    ]
}

/// Levels of a tree over these numbers, of which a midpoint split removes one after the other.
fn midpoint_levels(mut numbers: Vec<f64>) -> usize {
    numbers.sort_by(f64::total_cmp);
    let mut levels = 0;
    while numbers.len() > 1 {
        let middle = 0.5 * numbers[0] + 0.5 * numbers[numbers.len() - 1];
        numbers.retain(|x| *x < middle);
        levels += 1;
    }
    levels
}

fn halvings() -> Vec<Claim> {
    let halves = |from: f64, end: f64| {
        let halves = std::iter::successors(Some(from), |x| Some(0.5 * x));
        halves.take_while(|x| *x > end).collect::<Vec<_>>()
    };
    let some = halves(1.0, 1e-300);
    assert_eq!(one_digit(some.len() as f64), 1000.0, "a thousand numbers");
    // In exact arithmetic each split removes one of them. The midpoint rounds to the second number.
    let levels = midpoint_levels(some.clone());
    assert_eq!(one_digit(levels as f64), 500.0, "five hundred splits");
    let all = halves(f64::MAX, 0.0).len();
    assert_eq!(one_digit(all as f64), 2000.0, "about two thousand");
    // The reference changes to the median after 64 of them.
    let point = |x: &f64| Aabb {
        min: Vec3::splat(*x),
        max: Vec3::splat(*x),
    };
    let boxes: Vec<Aabb> = some.iter().map(point).collect();
    let height = super::part2::height(&bvh::construct_bvh(&boxes, 1), 0);
    let rest = (boxes.len() as f64).log2();
    assert!((64.0..=64.0 + rest + 1.0).contains(&height), "{height}");
    vec![
        (
            "part2/task1.md",
            "Centroids at 1, 1/2, 1/4, ... down to $10^{-300}$ are a thousand numbers, and give a path of five hundred midpoint splits".into(),
        ),
        (
            "part2/task1.md",
            "`f64` has room for about two thousand halvings, and not for a million".into(),
        ),
    ]
}

/// Rays through the edges of boxes, by naive slabs, and with the exit made later by the factor of
/// the reference.
fn corners_of_boxes() -> Vec<Claim> {
    let source =
        std::fs::read_to_string(book::folder().join("../bbox/src/lib.rs")).expect("the stage");
    let constant = source.split("const EXIT_WIDENING: f64 = ").nth(1);
    let factor = constant.and_then(|rest| rest.split(" * f64::EPSILON;").next());
    let widening: f64 = factor.and_then(|x| x.parse().ok()).expect("a number");
    let widening = widening * f64::EPSILON;
    let mut sampler = PixelSampler::new(0, 0, 4);
    let mut number = |from: f64, to: f64| {
        sampler.start_sample();
        from + (to - from) * sampler.next_1d()
    };
    let (mut hits, mut missed, mut missed_later) = (0, 0, 0);
    let mut widest = 0.0_f64;
    for _ in 0..3000 {
        let min = Vec3::from([(); 3].map(|()| number(-2.0, 0.0)));
        let b = Aabb {
            min,
            max: min + Vec3::from([(); 3].map(|()| number(0.5, 2.0))),
        };
        let o = Vec3::from([(); 3].map(|()| number(-9.0, 9.0)));
        // A point of an edge along z.
        let p = Vec3::new(b.min.x, b.max.y, number(b.min.z, b.max.z));
        let ray = Ray::new(o, p - o);
        if oracle::bbox(&b, &ray).inside.is_err() {
            continue;
        }
        hits += 1;
        // Three roundings for each plane: difference, inverse, product.
        let inverse = ray.d.map(|d| 1.0 / d);
        let (mut enters, mut leaves) = (0.0_f64, f64::INFINITY);
        for axis in 0..3 {
            let planes = [b.min[axis], b.max[axis]].map(|x| (x - o[axis]) * inverse[axis]);
            enters = enters.max(planes[0].min(planes[1]));
            leaves = leaves.min(planes[0].max(planes[1]));
        }
        missed += u32::from(enters > leaves);
        missed_later += u32::from(enters > leaves + leaves * widening);
        widest = widest.max(enters / leaves - 1.0);
    }
    assert!(hits > 500, "{hits} rays hit");
    assert!(missed > hits / 40, "naive slabs miss {missed} of {hits}");
    assert_eq!(missed_later, 0, "of {hits}");
    // A fifth of it would not be enough.
    assert!(widest > 0.2 * widening, "{widest}");
    vec![(
        "part2/task2.md",
        format!(
            "The reference takes ${} u$: for a positive exit in `f64` a factor of $1 + {:.1} \\cdot 10^{{-16}}$",
            widening / (0.5 * f64::EPSILON),
            widening * 1e16
        ),
    )]
}

/// Pixels with one sample each, under a lamp that covers 1/100 of the hemisphere.
fn small_lamp() -> Vec<Claim> {
    const PIXELS: u32 = 40_000;
    let mut brightness = Tally::default();
    let mut lit = 0;
    for pixel in 0..PIXELS {
        let direction = warp::uniform_hemisphere(PixelSampler::new(pixel, 0, 5).get_sample());
        // Around the normal, a height of 1/100 is 1/100 of the solid angle.
        let is_lit = direction.z > 1.0 - 0.01;
        lit += u32::from(is_lit);
        brightness.push(f64::from(is_lit));
    }
    let of_hundred = 100.0 * f64::from(lit) / f64::from(PIXELS);
    assert_eq!(
        of_hundred.round(),
        1.0,
        "{of_hundred} of 100 pixels are lit"
    );
    let spread = brightness.variance().sqrt() / brightness.mean();
    // The means of so many samples are off by 10 %, and of half as many by more.
    let error = |samples: u32| spread / f64::from(samples).sqrt();
    assert!(error(5000) > 0.13 && (0.09..0.11).contains(&error(10_000)));
    let [directions, points] = deviations();
    assert_eq!(one_digit(directions / points), 100.0, "a hundred times");
    let figure = book::folder().join("src/figures/part3-noise.svg");
    let title =
        format!("uniform directions begin at {directions:.0}, points of the lamp at {points:.2};");
    let figure = std::fs::read_to_string(figure).expect("the figure");
    assert!(figure.contains(&title), "the figure does not say: {title}");
    // A light in one of a thousand samples.
    let mut rare = Tally::of_equal(0.0, 999);
    rare.push(1.0);
    let needed = rare.variance() / (0.1 * rare.mean()).powi(2);
    assert_eq!(one_digit(needed), 1e5, "a hundred thousand samples");
    vec![
        (
            "part1/task1.md",
            "needs a hundred thousand samples for an error of 10 %".into(),
        ),
        (
            "part3/task2.md",
            "The error for points starts a hundred times lower.".into(),
        ),
        (
            "part3/task3.md",
            "For the lamp of the worked example by about a hundred.".into(),
        ),
        (
            "part3/task2.md",
            "A small lamp covers 1/100 of the hemisphere. Of 100 pixels with one sample each, how many are lit".into(),
        ),
        (
            "part3/task2.md",
            format!(
                "About one, and it is about {} times too bright",
                one_digit(1.0 / brightness.mean())
            ),
        ),
        (
            "part3/task2.md",
            format!(
                "with $q = 0.01$ it is about {}, and about {},000 samples are needed for an error of 10 %",
                one_digit(spread),
                one_digit((spread / 0.1).powi(2)) / 1000.0
            ),
        ),
    ]
}

/// The relative deviation of one sample for the lamp of the worked example, by uniform directions
/// and by points of the lamp.
fn deviations() -> [f64; 2] {
    let mut all = [Tally::default(), Tally::default()];
    for pixel in 0..40_000 {
        let mut sampler = PixelSampler::new(pixel, 2, 5);
        let direction = warp::uniform_hemisphere(sampler.get_sample());
        let there = 2.0 / direction.z * direction;
        let is_lit = there.x.abs() <= 0.5 && there.y.abs() <= 0.5;
        all[0].push(if is_lit { direction.z } else { 0.0 });
        let u = sampler.get_sample();
        let to_lamp = Vec3::new(u.x - 0.5, u.y - 0.5, 2.0);
        // Both cosines, divided by the squared distance.
        let square = to_lamp.length_squared();
        all[1].push(to_lamp.z * to_lamp.z / (square * square));
    }
    all.map(|samples| samples.variance().sqrt() / samples.mean())
}

/// Glass from the front, and how far paths go with roulette.
fn bounces() -> Vec<Claim> {
    let reflected = fresnel_dielectric(1.0, 1.0 / 1.5);
    let mut sampler = PixelSampler::new(0, 0, 6);
    let mut further = Tally::default();
    for _ in 0..20_000 {
        // Survivors of the game go on with a largest channel of 1.
        let (mut throughput, mut count) = (Spectrum::WHITE, 0_u32);
        loop {
            sampler.start_sample();
            let next = play_roulette(throughput * 0.8, 5 + count, sampler.next_1d());
            let Some(survivor) = next else { break };
            throughput = survivor;
            count += 1;
        }
        further.push(f64::from(count));
    }
    assert_eq!(further.mean().round(), 4.0, "{} bounces", further.mean());
    vec![
        (
            "part4/task1.md",
            format!("glass reflects {:.0} % head on", 100.0 * reflected),
        ),
        ("part4/task3.md", "For $\\rho = 0.8$ that is four.".into()),
    ]
}

/// The first number of samples, in steps of `step`, with which the plain rule stops.
fn stops_at(tolerance: f64, step: u64, sample: impl Fn(u64) -> f64) -> u64 {
    let mut samples = Tally::default();
    for n in 1.. {
        samples.push(sample(n));
        if n % step == 0 && has_converged(&samples, tolerance) {
            return n;
        }
    }
    unreachable!("the loop has no end")
}

/// The half width of 95 % for the mean of four samples of a bell curve, in standard errors:
/// bisection of Student's distribution with three degrees of freedom.
fn students_t() -> f64 {
    let below = |t: f64| {
        let x = t / 3_f64.sqrt();
        0.5 + (x / (1.0 + x * x) + x.atan()) / std::f64::consts::PI
    };
    let (mut low, mut high) = (0.0, 10.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if below(middle) < 0.975 {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

fn stopping() -> Vec<Claim> {
    let spread = |n: u64| 1.0 + (n % 2) as f64;
    let times = stops_at(0.01, 2, spread) as f64 / stops_at(0.05, 2, spread) as f64;
    // Rare light, once in a thousand samples.
    let hits = stops_at(0.05, 1000, |n| f64::from(n % 1000 == 0)) / 1000;
    let needed = (1.96_f64 / 0.05).powi(2).ceil();
    assert!(
        (hits as f64 / needed - 1.0).abs() < 2e-3,
        "{hits}, {needed}"
    );
    // With the course's random numbers.
    const PIXELS: u32 = 20_000;
    let (mut black_after_32, mut black_after_256) = (0, 0);
    for pixel in 0..PIXELS {
        let mut sampler = PixelSampler::new(pixel, 1, 8);
        let first = (1..=256).find(|_| sampler.get_sample().x < 0.001);
        black_after_32 += u32::from(first.is_none_or(|n| n > 32));
        black_after_256 += u32::from(first.is_none());
    }
    let share = |count: u32| f64::from(count) / f64::from(PIXELS);
    assert!(
        has_converged(&Tally::of_equal(0.0, 32), 0.05),
        "black stops"
    );
    let chance = share(black_after_256);
    assert!((chance - 0.77).abs() < 0.01, "{chance}");
    vec![
        (
            "part5/task1.md",
            format!("So a tolerance of 1 % takes {times:.0} times as long as one of 5 %"),
        ),
        (
            "part5/task1.md",
            format!(
                "With few samples, 1.96 itself is too small: for the four samples of the worked example it would have to be {:.2} (Student's t)",
                students_t()
            ),
        ),
        (
            "part5/task2.md",
            format!("With a tolerance of 5 % it is {needed}"),
        ),
        (
            "part5/task2.md",
            format!("A mean over {needed} lucky events"),
        ),
        (
            "part5/task2.md",
            format!(
                "With $p = 0.001$ and $b = 32$ that happens to {:.0} % of the pixels",
                100.0 * share(black_after_32)
            ),
        ),
        (
            "part5/task2.md",
            "256 samples miss the lamp with the probability 0.77".into(),
        ),
    ]
}

/// Two triangles with a common edge, and rays at points of it, for two orders of the vertices.
fn leaks() -> Vec<Claim> {
    const RAYS: u32 = 20_000;
    let kernel = named(kernels::triangles(), "Möller-Trumbore");
    let (a, b) = (Vec3::ZERO, Vec3::new(1.0, 1.0 / 3.0, 0.0));
    let (c, d) = (Vec3::new(0.3, 1.1, 0.2), Vec3::new(0.7, -0.9, 0.1));
    let leaking = |sides: [Triangle; 2]| {
        let mut sampler = PixelSampler::new(0, 0, 9);
        let mut through = 0;
        for _ in 0..RAYS {
            let (at, from) = (sampler.get_sample().x, sampler.get_sample());
            let o = Vec3::new(4.0 * from.x - 2.0, 4.0 * from.y - 2.0, 3.0);
            let ray = Ray::new(o, at * b - o);
            let is_hit = sides.iter().any(|tri| kernel.answer(tri, &ray).is_some());
            through += u32::from(!is_hit);
        }
        f64::from(through) / f64::from(RAYS)
    };
    assert_eq!(
        leaking([Triangle::flat(a, b, c), Triangle::flat(a, b, d)]),
        0.0
    );
    let share = leaking([Triangle::flat(a, b, c), Triangle::flat(d, b, a)]);
    assert!((0.01..0.1).contains(&share), "{share} of the rays leak");
    vec![(
        "part1/task3.md",
        "None leaks if both lists begin with the edge in the same direction, because both then compute the same numbers. \
         Else some in a hundred do."
            .into(),
    )]
}
