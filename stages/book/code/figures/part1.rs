//! Figures of Part 1.

use super::Figure;
use crate::drawing::{Drawing, Side, View};
use kit::{PixelSampler, Ray, Sphere, Triangle, Vec2, Vec3, camera};

pub(super) fn figures() -> Vec<Figure> {
    vec![
        ("part1-overview", overview()),
        ("part1-film", film()),
        ("part1-convergence", convergence()),
        ("part1-film-mistakes", film_mistakes()),
        ("part1-camera", camera()),
        ("part1-angles", angles()),
        ("part1-triangle", triangle()),
        ("part1-barycentric", barycentric()),
        ("part1-triangle-mistakes", triangle_mistakes()),
        ("part1-sphere", sphere()),
        ("part1-roots", roots()),
        ("part1-cancellation", cancellation()),
    ]
}

/// A ray that hits a triangle in space, with all symbols of the derivation.
fn triangle() -> String {
    let tri = Triangle::flat(Vec3::ZERO, 3.2 * Vec3::X, 2.6 * Vec3::Y);
    let (o, hit) = (Vec3::new(-1.1, 1.3, 2.6), Vec3::new(0.95, 0.75, 0.0));
    let ray = Ray::new(o, (hit - o) / 3.0);
    let view = View::from(Vec3::new(1.4, 1.0, 2.4), Vec3::Y);
    let (min, max) = (Vec2::new(-2.3, -0.9), Vec2::new(2.9, 2.3));
    let mut d = Drawing::new(
        560.0,
        400.0,
        min,
        max,
        "A ray with the origin o and the direction d hits the triangle p0 p1 p2 at the distance t. \
         The edges e1 and e2 start at p0, and so does the vector s to the origin of the ray.",
    );
    let [p0, p1, p2, h, o] = [tri.p0, tri.p1, tri.p2, hit, ray.o].map(|p| view.of(p));
    d.polygon(&[p0, p1, p2], "blue");
    d.arrow(p0, p1, "blue");
    d.arrow(p0, p2, "blue");
    d.arrow(p0, o, "green dash");
    d.line(o, h, "ink dash");
    d.arrow(o, view.of(ray.at(1.0)), "ink");
    d.line(h, view.of(ray.at(3.7)), "soft");
    d.dot(h, "red");
    d.dot(o, "ink");
    d.label(p0, Side::Below, "p_0", "blue");
    d.label(p1, Side::Right, "p_1", "blue");
    d.label(p2, Side::Above, "p_2", "blue");
    d.label(0.5 * (p0 + p1), Side::Below, "e_1", "blue");
    d.label(p0 + 0.75 * (p2 - p0), Side::Left, "e_2", "blue");
    d.label(o, Side::Left, "o", "ink");
    d.label(view.of(ray.at(0.6)), Side::Above, "d", "ink");
    d.label(0.45 * (p0 + o), Side::Below, "s", "green");
    d.label(h, Side::Below, "p", "red");
    d.finish()
}

/// The plane of a triangle, divided by the signs of the three weights.
fn barycentric() -> String {
    let (p0, p1, p2) = (Vec2::ZERO, Vec2::new(3.0, 0.0), Vec2::new(0.6, 2.2));
    let at = |b1: f64, b2: f64| p0 + b1 * (p1 - p0) + b2 * (p2 - p0);
    let mut d = Drawing::new(
        560.0,
        380.0,
        Vec2::new(-1.6, -1.1),
        Vec2::new(4.6, 3.1),
        "The three lines through the edges of a triangle divide its plane into seven regions. Only \
         inside the triangle are all three weights b0, b1 and b2 at least 0.",
    );
    for (a, b) in [(p0, p1), (p1, p2), (p2, p0)] {
        let along = b - a;
        d.line(a - 0.42 * along, b + 0.42 * along, "soft dash");
    }
    d.polygon(&[p0, p1, p2], "blue");
    d.dot(at(0.25, 0.5), "red");
    d.label(at(0.25, 0.5), Side::Below, "(¼, ½)", "red");
    d.label(p0, Side::Left, "p_0", "blue");
    d.label(p1, Side::Below, "p_1", "blue");
    d.label(p2, Side::Left, "p_2", "blue");
    d.note(at(0.62, 0.72), Side::Right, "b0 < 0", "ink");
    d.note(at(-0.38, 0.45), Side::Left, "b1 < 0", "ink");
    d.note(at(0.55, -0.3), Side::Centre, "b2 < 0", "ink");
    d.note(at(0.3, 0.13), Side::Centre, "all ≥ 0: inside", "blue");
    d.finish()
}

/// The shapes that remain of a triangle if one of the three comparisons is missing.
fn triangle_mistakes() -> String {
    let (e1, e2) = (Vec2::new(1.0, 0.0), Vec2::new(0.25, 0.8));
    let mut d = Drawing::new(
        640.0,
        250.0,
        Vec2::new(-0.1, -0.5),
        Vec2::new(6.6, 1.7),
        "What a triangle becomes if a comparison of its weights is wrong: a wedge without b1 + b2 <= 1, \
         a parallelogram with b2 <= 1 instead, a strip without b1 >= 0.",
    );
    let shape = |d: &mut Drawing, corner: Vec2, points: &[Vec2], words: &str| {
        let at = |w: &Vec2| corner + w.x * e1 + w.y * e2;
        let outline: Vec<Vec2> = points.iter().map(at).collect();
        d.area(&outline, "red");
        let tri = [Vec2::ZERO, Vec2::X, Vec2::Y].map(|w| at(&w));
        d.polygon(&tri, "blue");
        d.note(corner + Vec2::new(0.5, -0.1), Side::Below, words, "ink");
    };
    let w = Vec2::new;
    shape(
        &mut d,
        Vec2::ZERO,
        &[
            w(0.0, 0.0),
            w(1.8, 0.0),
            w(1.8, 1.2),
            w(1.0, 2.0),
            w(0.0, 2.0),
        ],
        "without b1 + b2 ≤ 1",
    );
    shape(
        &mut d,
        Vec2::new(2.5, 0.0),
        &[w(0.0, 0.0), w(1.0, 0.0), w(1.0, 1.0), w(0.0, 1.0)],
        "b1 ≤ 1 and b2 ≤ 1",
    );
    shape(
        &mut d,
        Vec2::new(5.3, 0.0),
        &[w(-0.9, 0.0), w(1.0, 0.0), w(-0.9, 1.9)],
        "without b1 ≥ 0",
    );
    d.finish()
}

/// The way of a ray: from a pixel of the film through the camera to a hit.
fn overview() -> String {
    let mut d = Drawing::new(
        640.0,
        250.0,
        Vec2::new(-0.3, -1.3),
        Vec2::new(8.2, 1.4),
        "Task 1 chooses a point of the film, Task 2 makes the ray through it, Tasks 3 and 4 find what it hits.",
    );
    let ray = Ray::new(Vec3::new(0.0, 0.0, 0.0), Vec3::new(1.0, 0.12, 0.0));
    let at = |t: f64| ray.at(t).truncate();
    d.line(Vec2::new(1.6, -0.9), Vec2::new(1.6, 0.9), "blue");
    for k in 0..=6 {
        let y = -0.9 + 0.3 * f64::from(k);
        d.line(Vec2::new(1.53, y), Vec2::new(1.67, y), "blue");
    }
    d.polygon(
        &[
            Vec2::new(6.2, -1.1),
            Vec2::new(6.9, 1.2),
            Vec2::new(7.6, -0.8),
        ],
        "green",
    );
    d.arrow(at(0.0), at(6.72), "ink");
    d.dot(at(0.0), "ink");
    d.dot(at(1.6), "blue");
    d.dot(at(6.8), "red");
    d.note(at(0.0), Side::Below, "camera", "ink");
    d.note(Vec2::new(1.6, 0.9), Side::Above, "film", "blue");
    d.note(
        Vec2::new(1.6, -0.9),
        Side::Below,
        "Task 1: which point",
        "blue",
    );
    d.note(at(4.0), Side::Above, "Task 2: which ray", "ink");
    d.note(
        Vec2::new(6.9, -1.1),
        Side::Below,
        "Tasks 3, 4: which hit",
        "green",
    );
    d.finish()
}

/// A film of 4 x 2 pixels with its coordinates, and one pixel with its samples.
fn film() -> String {
    let mut d = Drawing::new(
        640.0,
        300.0,
        Vec2::new(-0.3, -0.3),
        Vec2::new(7.6, 2.5),
        "A film of 4 by 2 pixels: column x and row y count from the bottom left. On the right, pixel (3, 1) \
         with random samples, each at its own position s.",
    );
    let w = Vec2::new;
    d.area(
        &[w(3.0, 1.0), w(4.0, 1.0), w(4.0, 2.0), w(3.0, 2.0)],
        "blue",
    );
    for x in 0..=4 {
        d.line(w(f64::from(x), 0.0), w(f64::from(x), 2.0), "soft");
    }
    for y in 0..=2 {
        d.line(w(0.0, f64::from(y)), w(4.0, f64::from(y)), "soft");
    }
    for x in 0..4 {
        d.note(
            w(f64::from(x) + 0.5, 0.0),
            Side::Below,
            &format!("x = {x}"),
            "ink",
        );
    }
    for y in 0..2 {
        d.note(
            w(0.0, f64::from(y) + 0.5),
            Side::Left,
            &format!("y = {y}"),
            "ink",
        );
    }
    d.note(w(0.0, 2.0), Side::Above, "v = 1", "green");
    d.note(w(4.0, 0.0), Side::Right, "u = 1", "green");
    d.note(w(0.0, 0.0), Side::Left, "(0, 0)", "green");
    d.dot(w(3.5, 1.5), "red");
    let corner = w(5.4, 0.2);
    let size = 2.0;
    let at = |s: Vec2| corner + size * s;
    d.polygon(
        &[
            at(w(0.0, 0.0)),
            at(w(1.0, 0.0)),
            at(w(1.0, 1.0)),
            at(w(0.0, 1.0)),
        ],
        "blue",
    );
    d.line(w(4.0, 2.0), at(w(0.0, 1.0)), "soft dash");
    d.line(w(4.0, 1.0), at(w(0.0, 0.0)), "soft dash");
    let mut sampler = PixelSampler::new(3, 1, 5);
    let samples: Vec<Vec2> = (0..8).map(|_| sampler.get_sample()).collect();
    for s in &samples {
        d.dot(at(*s), "ink");
    }
    let s = samples[0];
    d.dot(at(s), "red");
    d.arrow(at(Vec2::ZERO), at(s), "red dash");
    d.label(at(0.5 * s), Side::Left, "s", "red");
    d.finish()
}

/// The running mean of samples of a pixel, a quarter of which is white.
fn convergence() -> String {
    const MOST: u32 = 1024;
    let mut d = Drawing::graph(
        640.0,
        320.0,
        Vec2::new(0.0, -0.15),
        Vec2::new(10.0, 1.0),
        "The mean of N samples of a pixel, a quarter of which is white, for four seeds, against N from 1 to 1024 \
         on a logarithmic axis. The means approach 0.25 within a band that narrows as 1/sqrt(N).",
    );
    let at =
        |n: u32, value: f64| Vec2::new(kit::math::ln(f64::from(n)) / std::f64::consts::LN_2, value);
    let sigma = (0.25 * 0.75_f64).sqrt();
    let counts: Vec<u32> = (0..=80)
        .map(|k| kit::math::pow(2.0, f64::from(k) / 8.0).round() as u32)
        .collect();
    let edge = |sign: f64| {
        let value = move |n: &u32| at(*n, 0.25 + sign * sigma / f64::from(*n).sqrt());
        counts.iter().map(value).collect::<Vec<_>>()
    };
    let mut band = edge(1.0);
    band.extend(edge(-1.0).into_iter().rev());
    d.area(&band, "blue");
    d.line(at(1, 0.25), at(MOST, 0.25), "blue");
    for (seed, class) in [(1, "ink"), (2, "red"), (3, "green"), (4, "soft")] {
        let mut sampler = PixelSampler::new(0, 0, seed);
        let mut white = 0;
        let mut points = Vec::new();
        for n in 1..=MOST {
            let s = sampler.get_sample();
            white += u32::from(s.x < 0.5 && s.y < 0.5);
            if counts.contains(&n) {
                points.push(at(n, f64::from(white) / f64::from(n)));
            }
        }
        d.path(&points, class);
    }
    d.line(at(1, -0.15), at(MOST, -0.15), "ink");
    for power in [0, 2, 4, 6, 8, 10] {
        let n = 1 << power;
        d.note(at(n, -0.15), Side::Below, &n.to_string(), "ink");
    }
    d.note(at(MOST, 0.25), Side::Above, "0.25", "blue");
    d.note(Vec2::new(1.4, 0.95), Side::Right, "estimate E", "ink");
    d.note(Vec2::new(9.2, -0.13), Side::Above, "samples N", "ink");
    d.finish()
}

/// The camera from the side of its x axis and the sensor at z = -1.
fn camera() -> String {
    let mut d = Drawing::new(
        600.0,
        330.0,
        Vec2::new(-0.75, -0.85),
        Vec2::new(2.2, 0.95),
        "The camera seen from above: it looks along -z; the sensor at the distance 1 reaches from -a to a, where \
         a is the tangent of half the field of view.",
    );
    let a = camera::half_tan(70.0);
    let w = Vec2::new;
    // The page's x is -z of camera space, its y is -x: seen from above, with right downwards.
    d.area(&[w(0.0, 0.0), w(1.0, a), w(1.0, -a)], "soft");
    d.arrow(w(0.0, 0.0), w(2.1, 0.0), "soft");
    d.arrow(w(0.0, 0.0), w(-0.55, 0.0), "green");
    d.arrow(w(0.0, 0.0), w(0.0, -0.55), "green");
    d.line(w(0.0, 0.0), w(1.2, 1.2 * a), "soft dash");
    d.line(w(0.0, 0.0), w(1.2, -1.2 * a), "soft dash");
    d.line(w(1.0, a), w(1.0, -a), "blue");
    let q = w(1.0, -0.5 * a);
    d.arrow(w(0.0, 0.0), w(1.9, -0.95 * a), "ink");
    d.dot(q, "red");
    d.dot(w(0.0, 0.0), "ink");
    d.arc(w(0.0, 0.0), 0.38, w(1.0, a), w(1.0, 0.0), "red");
    d.label(w(0.39, 0.16), Side::Right, "α/2", "red");
    d.label(w(0.75, 0.0), Side::Below, "1", "ink");
    d.label(w(1.0, 0.5 * a), Side::Right, "a", "blue");
    d.note(w(1.0, a), Side::Above, "u = 0", "blue");
    d.note(w(1.0, -a), Side::Below, "u = 1", "blue");
    d.note(w(1.0, 0.05), Side::Right, "u = ½", "blue");
    d.label(q, Side::Right, "q", "red");
    d.label(w(1.9, -0.95 * a), Side::Right, "d", "ink");
    d.label(w(-0.55, 0.0), Side::Above, "+z", "green");
    d.label(w(0.0, -0.55), Side::Left, "+x", "green");
    d.label(w(2.1, 0.0), Side::Above, "-z", "soft");
    d.finish()
}

/// Equal steps on the sensor and equal angles.
fn angles() -> String {
    let mut d = Drawing::new(
        640.0,
        300.0,
        Vec2::new(-3.6, -0.3),
        Vec2::new(3.6, 1.3),
        "Left: equal steps on the plane of the sensor, as it must be; the angles get smaller outwards. Right: \
         equal angles; their points on the plane get farther apart outwards, so straight lines appear curved.",
    );
    let half = camera::half_tan(110.0);
    for (centre, by_angle, words) in [
        (-1.9, false, "right: equal steps"),
        (1.9, true, "wrong: equal angles"),
    ] {
        let eye = Vec2::new(centre, 0.0);
        d.line(
            eye + Vec2::new(-half, 1.0),
            eye + Vec2::new(half, 1.0),
            "blue",
        );
        for k in -4..=4 {
            let share = f64::from(k) / 4.0;
            let x = if by_angle {
                kit::math::tan((share * 55.0).to_radians())
            } else {
                share * half
            };
            d.line(eye, eye + Vec2::new(x, 1.0), "soft");
            d.dot(
                eye + Vec2::new(x, 1.0),
                if by_angle { "red" } else { "green" },
            );
        }
        d.dot(eye, "ink");
        d.note(eye, Side::Below, words, "ink");
    }
    d.finish()
}

/// A sphere, cut in the plane of the ray.
fn sphere() -> String {
    let ball = Sphere {
        center: Vec3::ZERO,
        radius: 1.5,
    };
    let (height, start) = (0.9, -4.2);
    let half_chord = (ball.radius * ball.radius - height * height).sqrt();
    let mut d = Drawing::new(
        640.0,
        330.0,
        Vec2::new(-4.4, -1.7),
        Vec2::new(2.9, 1.9),
        "The line of the ray passes the centre m at the distance l and meets the sphere at t1 and t2. The middle \
         of both is b/a. The vector f goes from the centre to the origin o; the normal n points outwards.",
    );
    let w = Vec2::new;
    d.circle(Vec2::ZERO, ball.radius, "blue");
    let o = w(start, height);
    d.line(w(-4.2, height), w(2.8, height), "soft");
    d.arrow(o, w(start + 1.2, height), "ink");
    d.arrow(Vec2::ZERO, o, "green dash");
    d.line(Vec2::ZERO, w(0.0, height), "ink dash");
    let hit = w(-half_chord, height);
    d.line(Vec2::ZERO, hit, "blue");
    d.arrow(hit, hit + 0.75 * hit.normalize(), "red");
    for p in [hit, w(half_chord, height)] {
        d.dot(p, "red");
    }
    d.dot(w(0.0, height), "ink");
    d.dot(o, "ink");
    d.dot(Vec2::ZERO, "blue");
    d.label(o, Side::Above, "o", "ink");
    d.label(w(start + 0.8, height), Side::Above, "d", "ink");
    d.label(0.55 * o, Side::Below, "f", "green");
    d.label(Vec2::ZERO, Side::Below, "m", "blue");
    d.label(0.45 * hit, Side::Left, "r", "blue");
    d.label(w(0.0, 0.5 * height), Side::Right, "ℓ", "ink");
    d.label(hit + w(0.3, 0.0), Side::Above, "t_1", "red");
    d.label(w(half_chord + 0.2, height), Side::Above, "t_2", "red");
    d.note(w(0.0, height), Side::Above, "t = b/a", "ink");
    d.label(hit + 0.75 * hit.normalize(), Side::Left, "n", "red");
    d.finish()
}

/// The relative error of the textbook's near root for a sphere of radius 1, against its distance.
fn cancellation() -> String {
    let mut d = Drawing::graph(
        640.0,
        330.0,
        Vec2::new(0.0, -17.0),
        Vec2::new(10.0, 1.0),
        "The relative error of the half chord from b*b - a*c grows with the square of the distance and reaches 1 \
         at a distance of about 10 to the power of 8 radii. Computed from r*r - l*l it stays near 10 to the power of -16.",
    );
    let (mut textbook, mut stable) = (Vec::new(), Vec::new());
    for k in 0..=80_u32 {
        let exponent = 1.0 + f64::from(k) / 10.0;
        // The largest error of a few neighbouring distances.
        let (mut worst_textbook, mut worst_stable) = (1e-17_f64, 1e-17_f64);
        for j in 0..24_u32 {
            let distance = kit::math::pow(10.0, exponent + f64::from(j) / 240.0);
            let line = 0.6;
            let f = Vec3::new(line, 0.0, distance);
            let dir = -Vec3::Z;
            let (a, b) = (dir.dot(dir), -f.dot(dir));
            let c = f.dot(f) - 1.0;
            // Exactly 1 - 0.36.
            let truth = 0.64;
            let error = |value: f64| ((value - truth) / truth).abs().min(10.0);
            worst_textbook = worst_textbook.max(error(b * b - a * c));
            let nearest = f + (b / a) * dir;
            worst_stable = worst_stable.max(error(1.0 - nearest.length_squared()));
        }
        textbook.push(Vec2::new(
            exponent,
            kit::math::ln(worst_textbook) / std::f64::consts::LN_10,
        ));
        stable.push(Vec2::new(
            exponent,
            kit::math::ln(worst_stable) / std::f64::consts::LN_10,
        ));
    }
    for power in [-16, -12, -8, -4, 0] {
        let y = f64::from(power);
        d.line(Vec2::new(1.0, y), Vec2::new(9.5, y), "soft");
        d.note(Vec2::new(1.0, y), Side::Left, &format!("1e{power}"), "ink");
    }
    for power in [1, 3, 5, 7, 9] {
        d.note(
            Vec2::new(f64::from(power), -16.6),
            Side::Below,
            &format!("1e{power}"),
            "ink",
        );
    }
    d.path(&textbook, "red");
    d.path(&stable, "green");
    d.note(Vec2::new(4.3, -6.0), Side::Left, "b·b - a·c", "red");
    d.note(Vec2::new(6.5, -14.7), Side::Above, "r·r - ℓ·ℓ", "green");
    d.note(Vec2::new(9.5, -15.4), Side::Above, "distance", "ink");
    d.note(
        Vec2::new(1.0, 0.9),
        Side::Right,
        "relative error of Δ/a",
        "ink",
    );
    d.finish()
}

/// The centre of each pixel on a film of 3 x 2, as it should be and after two mistakes.
fn film_mistakes() -> String {
    let mut d = Drawing::new(
        660.0,
        210.0,
        Vec2::new(-0.2, -0.7),
        Vec2::new(11.4, 2.3),
        "Where the only sample of each pixel of a small film is: in the middle of each pixel; in its corner; at x \
         divided by the height and y by the width.",
    );
    let (w, h) = (3.0, 2.0);
    type Place = fn(f64, f64) -> (f64, f64);
    let places: [(&str, Place); 3] = [
        ("right", |x, y| ((x + 0.5) / 3.0, (y + 0.5) / 2.0)),
        ("corner of the pixel", |x, y| (x / 3.0, y / 2.0)),
        ("x / h and y / w", |x, y| ((x + 0.5) / 2.0, (y + 0.5) / 3.0)),
    ];
    for (i, (words, place)) in places.into_iter().enumerate() {
        let corner = Vec2::new(4.0 * i as f64, 0.0);
        for x in 0..=3 {
            let x = f64::from(x);
            d.line(corner + Vec2::new(x, 0.0), corner + Vec2::new(x, h), "soft");
        }
        for y in 0..=2 {
            let y = f64::from(y);
            d.line(corner + Vec2::new(0.0, y), corner + Vec2::new(w, y), "soft");
        }
        for (x, y) in [(0, 0), (1, 0), (2, 0), (0, 1), (1, 1), (2, 1)] {
            let (u, v) = place(f64::from(x), f64::from(y));
            let p = corner + Vec2::new(u * w, v * h);
            d.dot(p, if i == 0 { "green" } else { "red" });
        }
        d.note(corner + Vec2::new(0.5 * w, -0.1), Side::Below, words, "ink");
    }
    d.finish()
}

/// Rays that start before, inside and behind a sphere, and one whose range starts inside.
fn roots() -> String {
    let mut d = Drawing::new(
        640.0,
        280.0,
        Vec2::new(-4.6, -1.7),
        Vec2::new(4.9, 1.6),
        "Four rays through a sphere: from outside the near root is the hit; from inside and with a range that begins \
         between the roots it is the far one; from behind the sphere there is none.",
    );
    d.circle(Vec2::ZERO, 1.4, "blue");
    let rows = [
        (0.9, -4.0, -4.0, "outside"),
        (0.3, -0.4, -0.4, "inside"),
        (-0.3, -4.0, 0.1, "begins inside"),
        (-0.9, 2.2, 2.2, "behind"),
    ];
    for (y, start, begin, words) in rows {
        let half = f64::sqrt(1.4 * 1.4 - y * y);
        let at = |x: f64| Vec2::new(x, y);
        if begin > start {
            d.line(at(start), at(begin), "soft dash");
        }
        d.arrow(at(begin), at(3.4), "ink");
        d.dot(at(start), "ink");
        let hit = [-half, half].into_iter().find(|x| *x >= begin);
        for x in [-half, half] {
            d.circle(at(x), 0.07, "soft");
        }
        if let Some(x) = hit {
            d.dot(at(x), "red");
        }
        d.note(at(3.4), Side::Right, words, "ink");
    }
    d.finish()
}
