//! The drawings of calls, in characters and as SVG.

use grader::report::claims;
use grader::sketch::Sketch;
use judge::Tier;
use judge::expected::HitOrMiss;
use judge::shown::{ShownBounce, ShownCall, ShownPixel, ShownRay, ShownSpans, Span};
use kit::{Aabb, Ray, Scene, Sphere, Triangle, Vec3};

/// A ray at the triangle (0, 0, 0) (4, 0, 0) (0, 4, 0), and at which `t` it hits: expected, yours.
fn triangle(ray: Ray, expected: Option<f64>, yours: Option<f64>) -> ShownRay {
    let n = Vec3::Z;
    let corners = [
        Vec3::ZERO,
        Vec3::new(4.0, 0.0, 0.0),
        Vec3::new(0.0, 4.0, 0.0),
    ];
    ShownRay {
        scene: Scene {
            triangles: vec![Triangle::smooth(corners, [n; 3])],
            ..Scene::default()
        },
        expected: expected.into_iter().collect(),
        yours: yours.into_iter().collect(),
        decision: HitOrMiss::Either,
        ..ShownRay::new(ray)
    }
}

fn text(call: ShownCall) -> String {
    assert_eq!(claims::false_of_drawing(&call), [""; 0]);
    let lines = Sketch::of(&call).expect("it can be drawn").text(80);
    for line in &lines {
        assert!(line.chars().count() <= 80, "{line}");
    }
    assert!(lines.len() <= 10, "{lines:#?}");
    lines.join("\n")
}

fn in_a_line(drawn: &str) -> String {
    drawn.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Compares drawings with a snapshot. `look_for` says what its reader looks for.
fn shows(name: &str, look_for: &str, calls: impl IntoIterator<Item = ShownCall>) {
    let drawn: Vec<String> = calls.into_iter().map(text).collect();
    let mut settings = insta::Settings::clone_current();
    settings.set_description(look_for);
    settings.set_omit_expression(true);
    settings.set_prepend_module_to_snapshot(false);
    settings.set_snapshot_path("screens");
    let rule = format!("\n{}\n", "=".repeat(80));
    settings.bind(|| insta::assert_snapshot!(name, drawn.join(&rule)));
}

/// A ray along z that starts below the point (`x`, `y`) of the triangle's plane.
fn upwards(x: f64, y: f64) -> Ray {
    Ray::new(Vec3::new(x, y, -1.0), Vec3::Z)
}

#[test]
fn hits_of_a_triangle_are_drawn_where_they_are() {
    let beside = triangle(upwards(3.0, 3.0), None, Some(1.0));
    let at_the_origin = Ray::new(Vec3::new(1.0, 1.0, 0.0), Vec3::X);
    let origin = triangle(at_the_origin, Some(0.0), None);
    let both = triangle(upwards(1.0, 1.0), Some(1.0), Some(1.0));
    shows(
        "triangles",
        "x beside the triangle, with the side; o at the ray's origin, which is no second answer; * for both answers in one place. Only what is drawn is explained",
        [beside, origin, both].map(ShownCall::Ray),
    );
}

#[test]
fn a_range_that_ends_has_an_axis_with_both_hits() {
    let ended = Ray {
        max_t: 4.0,
        ..upwards(1.0, 1.0)
    };
    let from_the_hit = Ray {
        min_t: 1.0,
        ..upwards(1.0, 1.0)
    };
    let calls = [
        triangle(ended, Some(1.0), Some(5.0)),
        triangle(from_the_hit, Some(1.0), Some(2.0)),
        triangle(upwards(1.0, 1.0), Some(1.0), None),
    ];
    shows(
        "ranges",
        "the axis t with the range, the expected hit and the wrong one after its end; the signs of the second; none for the range without an end",
        calls.map(ShownCall::Ray),
    );
}

#[test]
fn normals_that_differ_are_two_arrows() {
    let shown = ShownCall::Ray(ShownRay {
        normals: Some([Vec3::Z, -Vec3::Z]),
        ..triangle(Ray::new(Vec3::ONE, -Vec3::Z), Some(1.0), Some(1.0))
    });
    let svg = Sketch::of(&shown).expect("it can be drawn").svg();
    assert!(svg.contains("class=\"expected\"") && svg.contains(">your normal</text>"));
    shows(
        "normals",
        "two arrows, seen from the side, with their names",
        [shown],
    );
}

/// What the drawing says of a point is where the answer says that it is, not where its `t` is.
#[test]
fn a_wrong_point_is_marked_where_it_is() {
    let right = Vec3::new(1.0, 1.0, 0.0);
    // In the plane, and off it along the ray, where it is seen from the side.
    let yours = [right, Vec3::new(3.0, 1.0, 0.0), Vec3::new(1.0, 1.0, 1.5)];
    let shown = yours.map(|yours| {
        ShownCall::Ray(ShownRay {
            points: Some([right, yours]),
            ..triangle(upwards(1.0, 1.0), Some(1.0), Some(1.0))
        })
    });
    shows(
        "points",
        "one place for both answers, then o and x apart, twice",
        shown,
    );
}

/// A right point does not hide that `t` is wrong: the hit is drawn at its `t`.
#[test]
fn a_wrong_t_is_drawn_beside_the_right_one() {
    let right = Vec3::new(0.0, 0.0, -1.0);
    let drawn = text(ShownCall::Ray(ShownRay {
        scene: Scene {
            spheres: vec![Sphere {
                center: Vec3::ZERO,
                radius: 1.0,
            }],
            ..Scene::default()
        },
        expected: vec![1.0],
        yours: vec![0.2],
        points: Some([right; 2]),
        ..ShownRay::new(Ray::new(Vec3::new(0.0, 0.0, -2.0), Vec3::Z))
    }));
    assert!(
        drawn.contains("o expected, x yours") && !drawn.contains('*'),
        "{drawn}"
    );
}

/// One pair of answers is in one place, the other apart.
#[test]
fn what_is_equal_is_not_said_to_be_near() {
    let drawn = text(ShownCall::Ray(ShownRay {
        boxes: vec![Aabb {
            min: Vec3::ZERO,
            max: Vec3::new(1.0, 2.0, 4.0),
        }],
        expected: vec![-4.0, 0.0],
        yours: vec![-9.0, -0.0],
        ..ShownRay::new(Ray {
            min_t: -9.0,
            max_t: 9.0,
            ..Ray::new(Vec3::new(0.5, 1.0, 0.0), -Vec3::Z)
        })
    }));
    assert!(drawn.contains("* expected and yours"), "{drawn}");
    assert!(
        !drawn.contains("too near") && !drawn.contains("-0"),
        "{drawn}"
    );
    let ended = Ray {
        max_t: 4.0,
        ..upwards(1.0, 1.0)
    };
    let near = text(ShownCall::Ray(triangle(ended, Some(1.0), Some(1.001))));
    let says = "too near to be drawn apart";
    assert!(in_a_line(&near).contains(says), "{near}");
}

#[test]
fn what_is_not_finite_is_not_drawn_and_the_legend_says_so() {
    let infinite = Vec3::new(f64::NEG_INFINITY, f64::INFINITY, f64::INFINITY);
    let hit = |t: f64| triangle(upwards(1.0, 1.0), Some(1.0), Some(t));
    let ray = |ray: ShownRay| text(ShownCall::Ray(ray));
    let bounce = |yours: [f64; 3]| {
        text(ShownCall::Bounce(ShownBounce {
            wo: [0.6, 0.0, 0.8],
            expected: Some([-0.6, 0.0, 0.8]),
            yours: Some(yours),
        }))
    };
    let point = ray(ShownRay {
        points: Some([Vec3::new(1.0, 1.0, 0.0), infinite]),
        ..hit(1.0)
    });
    let normal = ray(ShownRay {
        normals: Some([Vec3::Z, Vec3::NAN]),
        ..hit(1.0)
    });
    for (drawn, what) in [
        (point, "point"),
        (ray(hit(f64::NAN)), "t"),
        (
            in_a_line(&normal)
                .replace("* expected and yours", "")
                .replacen('*', "", 1),
            "normal",
        ),
        (bounce([f64::NAN; 3]), "direction"),
        (bounce([f64::INFINITY, 0.0, 1.0]), "direction"),
    ] {
        assert!(
            drawn.contains(&format!("your {what} is not finite")),
            "{drawn}"
        );
        assert!(!drawn.contains('*') && !drawn.contains("yours"), "{drawn}");
    }
}

#[test]
fn a_sphere_and_a_box_show_where_the_ray_ends_and_begins() {
    let sphere = ShownRay {
        scene: Scene {
            spheres: vec![Sphere {
                center: Vec3::ZERO,
                radius: 1.0,
            }],
            ..Scene::default()
        },
        expected: vec![2.0],
        yours: vec![4.0],
        // The far point has another normal, which is not what is wrong.
        normals: Some([-Vec3::Z, Vec3::Z]),
        ..ShownRay::new(Ray::new(Vec3::new(0.0, 0.0, -3.0), Vec3::Z))
    };
    // The ray misses in y, which is not its next axis.
    let beside = ShownRay {
        boxes: vec![Aabb {
            min: Vec3::ZERO,
            max: Vec3::ONE,
        }],
        yours: vec![1.0],
        ..ShownRay::new(Ray::new(Vec3::new(0.5, 2.0, -1.0), Vec3::Z))
    };
    shows(
        "spheres_and_boxes",
        "origin, near point and far point from left to right, without normals; the box with y to the right, along which the ray misses",
        [sphere, beside].map(ShownCall::Ray),
    );
}

#[test]
fn samples_and_directions_are_drawn_where_they_differ() {
    let pixel = |yours: [f64; 2]| {
        ShownCall::Pixel(ShownPixel {
            film: [2, 1],
            pixel: [1, 0],
            samples: 1,
            seed: 0,
            yours: vec![yours],
        })
    };
    let bounce = |wo, expected, yours| {
        ShownCall::Bounce(ShownBounce {
            wo,
            expected,
            yours,
        })
    };
    assert_eq!(Sketch::of(&pixel([0.75, 0.5])), None);
    assert_eq!(Sketch::of(&bounce([f64::NAN; 3], None, None)), None);
    let below = bounce(
        [0.6, 0.0, 0.8],
        Some([-0.6, 0.0, 0.8]),
        Some([0.6, 0.0, -0.8]),
    );
    shows(
        "samples_and_directions",
        "o in the middle of the pixel, x in its corner; wo and the expected direction above the surface, yours below",
        [pixel([0.5, 0.0]), below],
    );
}

#[test]
fn a_tree_is_drawn_level_by_level_and_what_is_not_finite_is_left_out() {
    let span = |from: f64, to: f64, label: &str| Span {
        ends: [from, to],
        label: label.into(),
    };
    let levels = [8.0, f64::NAN].map(|from| {
        let (root, left, right) = (
            span(0.0, 9.0, ""),
            span(0.0, 1.0, "0"),
            span(from, 9.0, "1"),
        );
        ShownCall::Spans(ShownSpans {
            along: "x",
            about: "the boxes",
            rows: vec![vec![root], vec![left, right]],
            expected: None,
            yours: None,
        })
    });
    shows(
        "levels_of_a_tree",
        "the root from end to end, its children below it; then only the left one",
        levels,
    );
}

/// A drawing of its own can be read without a style sheet of ours, and says what its signs mean.
#[test]
fn a_drawing_as_a_file_has_its_style_and_its_signs() {
    let ray = Ray::new(Vec3::new(0.3, 0.3, -1.0), Vec3::Z);
    let call = ShownCall::Ray(triangle(ray, Some(1.0), Some(5.0)));
    let sketch = Sketch::of(&call).expect("a drawing");
    let drawing = sketch.drawing();
    let start = "<svg xmlns=\"http://www.w3.org/2000/svg\" class=";
    assert!(drawing.svg.starts_with(start), "{}", drawing.svg);
    let (_, style) = drawing.svg.split_once("<style>").expect("a style");
    let (style, shapes) = style.split_once("</style>").expect("its end");
    for class in shapes.split("class=\"").skip(1) {
        let name = class.split('"').next().expect("a name");
        assert!(style.contains(&format!(".{name} {{")), "{name}: {style}");
    }
    assert!(drawing.caption.contains(". ") && drawing.caption.contains("○ expected"));
}

/// The words of an SVG, each with the rectangle that its letters take: left, top, right, bottom.
fn placed_words(svg: &str) -> Vec<(&str, [f64; 4])> {
    let texts = svg.split("<text ").skip(1).map(|text| {
        let value = |name: &str| {
            let (_, value) = text
                .split_once(&format!("{name}=\""))
                .expect("an attribute");
            value.split_once('"').expect("its end").0
        };
        let [x, y] = ["x", "y"].map(|name| value(name).parse::<f64>().expect("a number"));
        let (_, word) = text.split_once('>').expect("a word");
        let word = word.split_once("</text>").expect("its end").0;
        // Of 14 pixels, in DejaVu Sans. It has wider letters, but not in these words.
        let width = 8.9 * word.chars().count() as f64;
        let left = match value("text-anchor") {
            "start" => x,
            "middle" => x - 0.5 * width,
            _ => x - width,
        };
        (word, [left, y - 13.0, left + width, y + 4.0])
    });
    texts.collect()
}

fn overlap(a: &[f64; 4], b: &[f64; 4]) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

/// The words that a drawing must have.
fn needed(call: &ShownCall) -> Vec<&'static str> {
    match call {
        ShownCall::Bounce(bounce) => {
            let yours = bounce.yours.filter(|wi| Some(*wi) != bounce.expected);
            let expected = bounce.expected.map(|_| "expected");
            let words = [Some("wo"), expected, yours.map(|_| "yours")];
            words.into_iter().flatten().collect()
        }
        ShownCall::Directions(_) => vec!["wo", "wi"],
        ShownCall::Path(path) => path.surfaces.clone(),
        _ => Vec::new(),
    }
}

/// Answers that are nearly right have their words beside those of the right ones.
fn nearly_right(call: ShownCall) -> ShownCall {
    match call {
        ShownCall::Ray(ray) => ShownCall::Ray(ShownRay {
            yours: ray
                .expected
                .iter()
                .map(|t| t * (1.0 + 1e-15) + 1e-3)
                .collect(),
            normals: ray
                .expected
                .first()
                .map(|_| [Vec3::Z, Vec3::new(0.1, 0.0, 0.995)]),
            ..ray
        }),
        ShownCall::Bounce(bounce) => ShownCall::Bounce(ShownBounce {
            yours: bounce.expected.map(|[x, y, z]| [x + 0.02, y, z]),
            ..bounce
        }),
        other => other,
    }
}

#[test]
fn no_word_of_a_drawing_covers_another_one_or_is_cut_off() {
    let mut drawings = 0;
    for spec in judge::cases::all(0) {
        let calls = (0..spec.calls().min(4)).filter_map(|i| spec.shown(Tier::Core, i, None));
        for call in calls.flat_map(|call| [nearly_right(call.clone()), call]) {
            let Some(sketch) = Sketch::of(&call) else {
                continue;
            };
            drawings += 1;
            assert_eq!(
                claims::false_of_drawing(&call),
                [""; 0],
                "{} {}:\n{}",
                spec.task,
                spec.name,
                sketch.text(80).join("\n")
            );
            let svg = sketch.svg();
            let name = format!("{} {}: {svg}", spec.task, spec.name);
            let placed = placed_words(&svg);
            for (i, (word, rect)) in placed.iter().enumerate() {
                let inside = 0.0 < rect[0] && rect[2] < 428.0 && 0.0 < rect[1];
                assert!(inside, "{word}: {name}");
                let covered = placed[..i].iter().find(|(_, it)| overlap(rect, it));
                assert_eq!(covered, None, "{word}: {name}");
                // Of a number: names of primitives are short or have blanks.
                let counted = word.trim_start_matches(['−', '0', '.']).split('e').next();
                let digits = counted.map_or(0, |number| number.matches(char::is_numeric).count());
                assert!(digits <= 6 || word.contains(' '), "{word}: {name}");
            }
            let mut left: Vec<&str> = placed.iter().map(|(word, _)| *word).collect();
            for word in needed(&call) {
                let at = left.iter().position(|it| *it == word);
                left.remove(at.unwrap_or_else(|| panic!("no {word}: {name}")));
            }
        }
    }
    assert!(drawings > 300, "{drawings}");
}

/// README and the book show a report with this drawing.
#[test]
fn the_drawing_in_the_texts_is_drawn_like_that() {
    let ray = Ray::new(Vec3::new(1.0, 5.0, -1.0), Vec3::Z);
    let drawn = text(ShownCall::Ray(triangle(ray, None, Some(1.0))));
    for (name, shown) in [
        ("README.md", include_str!("../../README.md")),
        (
            "grading.md",
            include_str!("../../stages/book/src/grading.md"),
        ),
    ] {
        assert!(shown.contains(&drawn), "{name}:\n{drawn}");
    }
}
