//! Variants of the worked examples, with numbers that are drawn.
//!
//! The numbers are small, so that paper is enough, and such that the answers of the typical
//! mistakes differ from the truth.

mod boxes;
mod example;
mod film;
mod lights;
mod paths;
mod rays;
mod stopping;
mod tree;
#[cfg(test)]
mod truths;

pub use example::{AskedNumber, WorkedExample};

use super::draw::Draw;

/// The example of the task `key` with numbers of `seed`; `None` for tasks without one.
pub fn of(key: &str, seed: u64) -> Option<WorkedExample> {
    let draw: fn(&mut Draw) -> WorkedExample = match key {
        "part1.task1" => film::sample,
        "part1.task2" => film::camera,
        "part1.task3" => rays::triangle,
        "part1.task4" => rays::sphere,
        "part2.task1" => tree::split,
        "part2.task2" => boxes::slabs,
        "part2.task3" => tree::traversal,
        "part3.task1" => lights::diffuse,
        "part3.task2" => lights::directions,
        "part3.task3" => lights::lamp,
        "part4.task1" => paths::glass,
        "part4.task2" => paths::path,
        "part4.task3" => paths::roulette,
        "part5.task1" => stopping::spread,
        "part5.task2" => stopping::rare_light,
        _ => return None,
    };
    // Drawn again while no mistake of a question gives a wrong answer: it would confirm them.
    let mut numbers = Draw::of([0, 0], seed);
    let mut example = draw(&mut numbers);
    for _ in 0..100 {
        if example.asked.iter().all(|asked| !asked.mistakes.is_empty()) {
            break;
        }
        example = draw(&mut numbers);
    }
    Some(example)
}

#[cfg(test)]
mod tests {
    use super::*;

    const TASKS: [&str; 15] = [
        "part1.task1",
        "part1.task2",
        "part1.task3",
        "part1.task4",
        "part2.task1",
        "part2.task2",
        "part2.task3",
        "part3.task1",
        "part3.task2",
        "part3.task3",
        "part4.task1",
        "part4.task2",
        "part4.task3",
        "part5.task1",
        "part5.task2",
    ];

    #[test]
    fn every_question_has_a_finite_answer_and_a_mistake_that_differs() {
        for key in TASKS {
            for seed in 0..300 {
                let example = of(key, seed).expect("an example");
                assert!(
                    !example.given.is_empty() && example.asked.len() >= 2,
                    "{key}"
                );
                for asked in &example.asked {
                    assert!(asked.truth.is_finite(), "{key}, seed {seed}: {asked:?}");
                    assert!(!asked.mistakes.is_empty(), "{key}, seed {seed}: {asked:?}");
                    assert_eq!(asked.mistake(asked.truth), None, "{key}, seed {seed}");
                }
            }
        }
        assert_eq!(of("part6.task1", 0), None);
    }

    #[test]
    fn numbers_depend_on_the_seed() {
        for key in TASKS {
            assert_eq!(of(key, 7), of(key, 7));
            assert!((0..20).any(|seed| of(key, seed) != of(key, 7)), "{key}");
        }
    }

    /// The vectors in what is given.
    fn vectors(example: &WorkedExample) -> Vec<[f64; 3]> {
        let text = example.given.join(" ");
        let vector = |part: &str| {
            let inside = part.split(')').next()?;
            let list: Option<Vec<f64>> = inside.split(", ").map(|x| x.parse().ok()).collect();
            <[f64; 3]>::try_from(list?).ok()
        };
        text.split('(').skip(1).filter_map(vector).collect()
    }

    fn truths(example: &WorkedExample) -> Vec<f64> {
        example.asked.iter().map(|asked| asked.truth).collect()
    }

    fn mix(a: [f64; 3], t: f64, b: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|i| a[i] + t * b[i])
    }

    fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
        (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt()
    }

    /// Computes the truth from the numbers that are shown: the point on the ray is on the triangle,
    /// on the sphere, in the box.
    #[test]
    fn the_truth_is_that_of_the_shown_numbers() {
        for seed in 0..200 {
            let triangle = of("part1.task3", seed).expect("an example");
            let [p0, p1, p2, o, d] = vectors(&triangle)
                .try_into()
                .expect("three vertices and a ray");
            let [t, b1, b2] = truths(&triangle).try_into().expect("t and two weights");
            let on_ray = mix(o, t, d);
            let edge = |p| mix(p, -1.0, p0);
            let on_triangle = mix(mix(p0, b1, edge(p1)), b2, edge(p2));
            assert!(distance(on_ray, on_triangle) < 1e-12, "{triangle:?}");

            let sphere = of("part1.task4", seed).expect("an example");
            let [center, o, d] = vectors(&sphere).try_into().expect("a centre and a ray");
            let radius = sphere.given[0]
                .split("radius r = ")
                .nth(1)
                .expect("a radius");
            let radius: f64 = radius.trim_end_matches('.').parse().expect("a number");
            let [near, far, _] = truths(&sphere).try_into().expect("two roots and a normal");
            assert!(0.0 < near && near < far);
            for t in [near, far] {
                assert!(
                    (distance(mix(o, t, d), center) - radius).abs() < 1e-12,
                    "{sphere:?}"
                );
            }

            let slabs = of("part2.task2", seed).expect("an example");
            let [low, high, o, d] = vectors(&slabs).try_into().expect("a box and a ray");
            let [entry, exit] = truths(&slabs).try_into().expect("two ends");
            let is_inside = |t: f64| (0..3).all(|i| (low[i]..=high[i]).contains(&mix(o, t, d)[i]));
            assert!(
                is_inside(entry) && is_inside(exit) && is_inside(0.5 * (entry + exit)),
                "{slabs:?}"
            );
            assert!(
                !is_inside(entry - 1e-6) && !is_inside(exit + 1e-6),
                "{slabs:?}"
            );

            let split = of("part2.task1", seed).expect("an example");
            let centroids = split.given[0]
                .split("centroids at ")
                .nth(1)
                .expect("a list");
            let centroids: Vec<f64> = centroids
                .trim_end_matches('.')
                .split(", ")
                .map(|x| x.parse().expect("a number"))
                .collect();
            let length: f64 = split.given[1]
                .split(' ')
                .nth(4)
                .expect("a length")
                .parse()
                .expect("a number");
            let bounds = |i: usize| {
                let half = if i == 5 { 0.5 * length } else { 0.5 };
                kit::Aabb {
                    min: kit::Vec3::new(centroids[i] - half, 0.0, 0.0),
                    max: kit::Vec3::new(centroids[i] + half, 1.0, 1.0),
                }
            };
            let [middle, left, cost] = truths(&split).try_into().expect("three numbers");
            assert_eq!(middle, 0.5 * (centroids[0] + centroids[5]));
            assert_eq!(
                left,
                centroids.iter().filter(|x| **x < middle).count() as f64
            );
            let area = |part: &[usize]| {
                part.iter()
                    .map(|i| bounds(*i))
                    .fold(kit::Aabb::EMPTY, kit::Aabb::union)
                    .surface_area()
            };
            let sides: [Vec<usize>; 2] = (0..6).partition(|i| centroids[*i] < middle).into();
            let expected: f64 = sides
                .iter()
                .map(|side| area(side) * side.len() as f64)
                .sum();
            assert!(
                (cost - expected / area(&[0, 1, 2, 3, 4, 5])).abs() < 1e-12,
                "{split:?}"
            );

            let tree = of("part2.task3", seed).expect("an example");
            let hits = tree.given[1].split("its hit is at ").skip(1);
            let hits =
                hits.map(|rest| rest.split(';').next().unwrap_or(rest).trim_end_matches('.'));
            let nearest = hits
                .map(|hit| hit.parse().expect("a number"))
                .fold(f64::INFINITY, f64::min);
            assert_eq!(truths(&tree)[0], nearest, "{tree:?}");
        }
    }
}
