//! No mistake of the reference becomes golden unnoticed. Typical mistakes are planted in the
//! reference's answers, and the oracle judges these answers in all aspects. It must refuse each
//! changed answer, or say what it does not judge. `grader mutants TASK --against-bless` does the
//! same with the code of every mutant.

use crate::shared::{AfterTheGoldens, SPECS, reference, spec};
use judge::Tier;
use judge::cases::Spec;
use judge::findings::Aspect;
use judge::whole::{Verdict, Whole, judge_whole};
use wire::answer::{Hit, TriangleAnswer};
use wire::work::{NodeKind, Ray, TriangleWork};
use wire::{Answer, Work};

/// A mistake in the answer to one call of `part1.task3`.
pub(crate) type TriangleMistake = fn(&[[f64; 3]; 6], &Ray, &mut TriangleAnswer);

/// Shorter sums of vertex normals cancel.
const CANCELS: f64 = 1e-9;

pub(crate) const TRIANGLE_MISTAKES: [(&str, TriangleMistake); 10] = [
    (
        "misses where vertex normals cancel",
        |triangle, ray, answer| {
            if answer
                .hit
                .is_some_and(|hit| length(interpolated(triangle, hit.uv)) < CANCELS)
            {
                (answer.hit, answer.ray_after) = (None, *ray);
            }
        },
    ),
    ("back faces culled", |_, ray, answer| {
        if answer.hit.is_some_and(|hit| dot(hit.ng, ray.d) > 0.0) {
            *answer = TriangleAnswer {
                test: None,
                hit: None,
                ray_after: *ray,
            };
        }
    }),
    ("normals flipped", |_, _, answer| {
        record(answer, |hit| hit.n = hit.n.map(|x| -x))
    }),
    ("normals towards the ray", |_, ray, answer| {
        record(answer, |hit| {
            if dot(hit.n, ray.d) > 0.0 {
                hit.n = hit.n.map(|x| -x);
            }
        });
    }),
    ("geometric normals flipped", |_, _, answer| {
        record(answer, |hit| hit.ng = hit.ng.map(|x| -x));
    }),
    ("weights swapped in the record", |_, _, answer| {
        record(answer, |hit| hit.uv.swap(0, 1))
    }),
    ("no surface parameters", |_, _, answer| {
        record(answer, |hit| hit.uv = [0.0; 2])
    }),
    ("points off the plane", |_, _, answer| {
        record(answer, |hit| {
            hit.p = [0, 1, 2].map(|i| hit.p[i] + 1e-4 * hit.t * hit.ng[i])
        });
    }),
    ("max_t as before", |_, ray, answer| {
        answer.ray_after.max_t = ray.max_t
    }),
    ("another primitive", |_, _, answer| {
        record(answer, |hit| hit.prim += 1)
    }),
];

fn record(answer: &mut TriangleAnswer, change: impl Fn(&mut Hit)) {
    answer.hit.iter_mut().for_each(change);
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn length(v: [f64; 3]) -> f64 {
    dot(v, v).sqrt()
}

fn interpolated(triangle: &[[f64; 3]; 6], [b1, b2]: [f64; 2]) -> [f64; 3] {
    let [_, _, _, n0, n1, n2] = triangle;
    [0, 1, 2].map(|i| (1.0 - b1 - b2) * n0[i] + b1 * n1[i] + b2 * n2[i])
}

/// Whether `b` differs from `a` by more than rounding errors.
fn changes(a: &TriangleAnswer, b: &TriangleAnswer) -> bool {
    let differ = |a: &[f64], b: &[f64]| {
        let largest = a.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        a.iter().zip(b).any(|(a, b)| (a - b).abs() > 1e-6 * largest)
    };
    let hits = match (a.hit, b.hit) {
        (Some(a), Some(b)) => {
            a.prim != b.prim
                || differ(&a.p, &b.p)
                || differ(&a.n, &b.n)
                || differ(&a.ng, &b.ng)
                || a.uv.iter().zip(b.uv).any(|(a, b)| (a - b).abs() > 1e-6)
        }
        (a, b) => a.is_some() || b.is_some(),
    };
    hits || a.test != b.test || a.ray_after.max_t.to_bits() != b.ray_after.max_t.to_bits()
}

/// Prints a row for each mistake and case (`--nocapture` shows it).
#[test]
fn a_mistake_about_triangles_is_refused_or_not_judged() {
    let _begin = AfterTheGoldens;
    let specs: Vec<(&Spec, Answer)> = SPECS
        .iter()
        .filter(|spec| spec.task == "part1.task3" && matches!(spec.work, Work::Triangles(_)))
        .filter_map(|spec| Some((spec, reference(spec)?.clone())))
        .collect();
    println!("| mistake | case | refused | not judged | confirmed |\n|---|---|--:|--:|--:|");
    for (name, mistake) in TRIANGLE_MISTAKES {
        let mut refused = 0;
        for (spec, right) in &specs {
            let (Work::Triangles(work), Answer::Triangles(right)) = (&spec.work, right) else {
                panic!("{} is about triangles", spec.name)
            };
            let TriangleWork {
                triangles, probes, ..
            } = work;
            let mut wrong = right.clone();
            for (probe, answer) in probes.iter().zip(&mut wrong) {
                mistake(&triangles[probe.shape as usize], &probe.ray, answer);
            }
            let pairs = (0..).zip(right.iter().zip(&wrong));
            let changed: Vec<u32> = pairs
                .filter(|(_, (right, wrong))| changes(right, wrong))
                .map(|(call, _)| call)
                .collect();
            let whole = judge_whole(spec, Tier::Robust, &Answer::Triangles(wrong));
            let counts = whole.count(changed.iter().copied());
            if !changed.is_empty() {
                println!(
                    "| {name} | {} | {} | {} | {} |",
                    spec.name, counts.refused, counts.not_judged, counts.confirmed
                );
            }
            assert_eq!(counts.confirmed, 0, "{name}, {}", spec.name);
            assert!(counts.refused == 0 || whole.is_refused());
            refused += counts.refused;
        }
        assert!(refused > 0 || specs.is_empty(), "{name}");
    }
}

/// Before, cases that grade normals alone said nothing about misses.
#[test]
fn a_false_miss_fails_the_cases_about_normals() {
    let _begin = AfterTheGoldens;
    for (task, name) in [
        ("part1.task3", "cancelling_normals"),
        ("part1.task3", "interpolated_normals"),
        ("part1.task4", "hit_point_on_the_sphere"),
    ] {
        let spec = spec(task, name);
        assert!(!spec.about_aspects.contains(&Aspect::HitOrMiss), "{name}");
        let Some(mut answer) = reference(spec).cloned() else {
            return;
        };
        let passes = |answer: &Answer| {
            let findings = judge::judge(spec, Tier::Robust, answer);
            findings.iter().all(|finding| finding.passed())
        };
        assert!(passes(&answer), "{name}");
        let is_hit = match &mut answer {
            Answer::Triangles(answers) => {
                let hit = answers.iter_mut().rfind(|answer| answer.hit.is_some());
                hit.map(|answer| (answer.test, answer.hit) = (None, None))
            }
            Answer::Spheres(answers) => {
                let hit = answers.iter_mut().rfind(|answer| answer.hit.is_some());
                hit.map(|answer| (answer.test, answer.hit) = (None, None))
            }
            _ => None,
        };
        assert!(is_hit.is_some(), "{name} has a hit");
        assert!(!passes(&answer), "{name}");
    }
}

/// What the oracle says about the reference's answer to a case after `spoil` changed it; `None` in
/// a handout.
fn spoiled(task: &str, name: &str, spoil: impl FnOnce(&mut Answer)) -> Option<Whole> {
    let spec = spec(task, name);
    let mut answer = reference(spec)?.clone();
    spoil(&mut answer);
    Some(judge_whole(spec, Tier::Robust, &answer))
}

fn wrong_aspects(whole: &Whole) -> Vec<Aspect> {
    whole.wrong.iter().map(|finding| finding.aspect).collect()
}

/// The cases of whole scenes grade neither points nor normals, weights or work.
#[test]
fn every_field_of_a_hit_in_a_scene_is_judged() {
    let _begin = AfterTheGoldens;
    type Spoil = fn(&mut Hit);
    let fields: [(Spoil, Aspect); 6] = [
        (|hit| hit.n = hit.n.map(|x| -x), Aspect::Normal),
        (|hit| hit.ng = hit.ng.map(|x| -x), Aspect::GeometricNormal),
        (|hit| hit.p[0] += 1e-9, Aspect::Position),
        (|hit| hit.uv[0] += 1e-6, Aspect::Barycentrics),
        (|hit| hit.t *= 1.0 + 1e-9, Aspect::T),
        (|hit| hit.prim = 0, Aspect::Primitive),
    ];
    for (spoil, aspect) in fields {
        let mut call = 0;
        let whole = spoiled("part2.task3", "mesh_in_cornell_box", |answer| {
            let Answer::SceneHits(answer) = answer else {
                panic!("the case is about hits")
            };
            let mut hits = answer
                .hits
                .iter_mut()
                .enumerate()
                .filter_map(|(call, hit)| Some((call, hit.as_mut()?)));
            let (number, hit) = hits.find(|(_, hit)| hit.prim > 20).expect("a hit");
            spoil(hit);
            // The t of the hit and max_t agree, as they would in wrong code.
            (call, answer.max_t[number]) = (number as u32, hit.t);
        });
        let Some(whole) = whole else { return };
        assert_eq!(whole.wrong_calls().keys().collect::<Vec<_>>(), [&call]);
        assert!(wrong_aspects(&whole).contains(&aspect), "{aspect:?}");
    }
}

#[test]
fn work_is_refused_confirmed_or_not_judged() {
    let _begin = AfterTheGoldens;
    let times = |factor: u64| {
        spoiled("part2.task3", "mesh_in_cornell_box", |answer| {
            if let Answer::SceneHits(answer) = answer {
                answer.box_tests *= factor;
            }
        })
    };
    let (Some(once), Some(twice)) = (times(1), times(3)) else {
        return;
    };
    assert_eq!(wrong_aspects(&once), []);
    assert_eq!(wrong_aspects(&twice), [Aspect::Work]);
    let none = spoiled("part2.task3", "mesh_in_cornell_box", |answer| {
        if let Answer::SceneHits(answer) = answer {
            answer.box_tests = 1;
        }
    });
    let none = none.expect("an answer").not_judged_sentences().join(";");
    assert!(
        none.contains("number of tests: there are fewer tests"),
        "{none}"
    );
}

#[test]
fn a_tree_that_is_right_but_loose_or_costly_is_not_judged() {
    let _begin = AfterTheGoldens;
    let whole = spoiled("part2.task1", "long_boxes", |answer| {
        let Answer::Build(answer) = answer else {
            panic!("the case is about trees")
        };
        let is_leaf = |kind: &NodeKind| matches!(kind, NodeKind::Leaf { .. });
        let leaves = answer
            .tree
            .nodes
            .iter_mut()
            .filter(|node| is_leaf(&node.kind));
        for leaf in leaves {
            let [min, max] = leaf.bounds;
            leaf.bounds[1] = [0, 1, 2].map(|i| max[i] + 0.2 * (max[i] - min[i]));
        }
    });
    let Some(whole) = whole else { return };
    assert!(!whole.is_refused());
    let open: Vec<Aspect> = whole.not_judged.iter().map(|open| open.aspect).collect();
    assert_eq!(open, [Aspect::Bounds, Aspect::Work]);
    assert!(matches!(whole.verdict(7), Verdict::NotJudged(_)));
}

#[test]
fn the_parameters_of_a_sphere_are_judged() {
    let _begin = AfterTheGoldens;
    let whole = spoiled("part1.task4", "head_on", |answer| {
        if let Answer::Spheres(answers) = answer {
            answers[0].hit.iter_mut().for_each(|hit| hit.uv = [0.5; 2]);
        }
    });
    let Some(whole) = whole else { return };
    assert_eq!(whole.verdict(0), Verdict::Refused(vec![Aspect::Parameters]));
    assert_eq!(whole.verdict(1), Verdict::Confirmed);
}

/// A statistical test of all calls refuses all of them: none of them is confirmed.
#[test]
fn a_wrong_distribution_confirms_no_call() {
    let _begin = AfterTheGoldens;
    let whole = spoiled("part3.task1", "sampled_directions", |answer| {
        if let Answer::Lambert(answers) = answer {
            let samples = answers
                .iter_mut()
                .filter_map(|answer| answer.sample.as_mut());
            for sample in samples {
                // Mirrored to one half of the hemisphere: right value and density, wrong
                // directions.
                sample.wi[0] = sample.wi[0].abs();
            }
        }
    });
    let Some(whole) = whole else { return };
    assert_eq!(wrong_aspects(&whole), [Aspect::Spread]);
    assert_eq!(whole.verdict(123), Verdict::Refused(vec![Aspect::Spread]));
    let few = spoiled("part3.task1", "value", |_| {});
    assert!(matches!(
        few.expect("an answer").verdict(0),
        Verdict::NotJudged(_)
    ));
}

/// Where chance decides whether a lamp is sampled above the horizon, no ray and no light are a
/// possible answer, and never a confirmed one.
#[test]
fn light_that_may_be_lost_by_chance_is_not_judged() {
    let _begin = AfterTheGoldens;
    let lost = 18;
    let whole = spoiled("part3.task3", "many_lights", |answer| {
        let Answer::Direct(answers) = answer else {
            panic!("the case is about direct light")
        };
        assert!(!answers[lost].rays.is_empty(), "the reference finds light");
        answers[lost].rays.clear();
        answers[lost].radiance = [0.0; 3];
    });
    let Some(whole) = whole else { return };
    assert!(!whole.is_refused());
    let Verdict::NotJudged(open) = whole.verdict(lost as u32) else {
        panic!("{:?}", whole.verdict(lost as u32))
    };
    assert_eq!(open[0].aspect, Aspect::Rays);
}
