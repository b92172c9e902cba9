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
    let [p0, p1, p2] = corners;
    ShownRay {
        scene: Scene {
            triangles: vec![Triangle {
                p0,
                p1,
                p2,
                n0: n,
                n1: n,
                n2: n,
            }],
            ..Scene::default()
        },
        expected: expected.into_iter().collect(),
        yours: yours.into_iter().collect(),
        decision: HitOrMiss::Either,
        ..ShownRay::new(ray)
    }
}

fn text(call: ShownCall) -> String {
    let lines = Sketch::of(&call).expect("it can be drawn").text(80);
    for line in &lines {
        assert!(line.chars().count() <= 80, "{line}");
    }
    assert!(lines.len() <= 10, "{lines:#?}");
    lines.join("\n")
}

/// The line and the column of a sign.
fn place(text: &str, sign: char) -> Option<[usize; 2]> {
    let mut lines = text.lines().enumerate();
    lines.find_map(|(line, text)| Some([line, text.find(sign)?]))
}

#[test]
fn a_hit_outside_a_triangle_is_beside_it() {
    let ray = Ray::new(Vec3::new(3.0, 3.0, -1.0), Vec3::Z);
    let drawn = text(ShownCall::Ray(triangle(ray, None, Some(1.0))));
    let x = place(&drawn, 'x').expect("the hit is drawn");
    let p2 = drawn.lines().position(|line| line.contains("p2"));
    let p0 = drawn.lines().position(|line| line.contains("p0"));
    assert!(p2 < Some(x[0]) && Some(x[0]) < p0, "{drawn}");
    assert!(drawn.contains("ray from the back; x yours"), "{drawn}");
}

#[test]
fn a_range_that_ends_has_an_axis_with_both_hits() {
    let ray = Ray {
        max_t: 4.0,
        ..Ray::new(Vec3::new(1.0, 1.0, -1.0), Vec3::Z)
    };
    let drawn = text(ShownCall::Ray(triangle(ray, Some(1.0), Some(5.0))));
    let axis = drawn.lines().find(|line| line.starts_with("  t "));
    let axis = axis.expect("there is an axis");
    let signs: String = axis.chars().filter(|c| "[o]x>".contains(*c)).collect();
    assert!(signs.starts_with("[o]x>"), "{axis}");
    let open = Ray::new(Vec3::new(1.0, 1.0, -1.0), Vec3::Z);
    let plain = text(ShownCall::Ray(triangle(open, Some(1.0), None)));
    assert!(!plain.contains("  t "), "{plain}");
}

#[test]
fn normals_that_differ_are_two_arrows() {
    let ray = Ray::new(Vec3::new(1.0, 1.0, 1.0), -Vec3::Z);
    let shown = ShownRay {
        normals: Some([Vec3::Z, -Vec3::Z]),
        ..triangle(ray, Some(1.0), Some(1.0))
    };
    let sketch = Sketch::of(&ShownCall::Ray(shown)).expect("it can be drawn");
    let drawn = sketch.text(80).join("\n");
    for part in ["expected normal", "your normal", "from its side"] {
        assert!(drawn.contains(part), "{drawn}");
    }
    let svg = sketch.svg();
    assert!(svg.contains("class=\"expected\"") && svg.contains(">your normal</text>"));
}

/// What the drawing says of a point is where the answer says that it is, not where its `t` is.
#[test]
fn a_wrong_point_is_marked_where_it_is() {
    let ray = Ray::new(Vec3::new(1.0, 1.0, -1.0), Vec3::Z);
    let right = Vec3::new(1.0, 1.0, 0.0);
    let drawn = |yours: Vec3| {
        let shown = ShownRay {
            points: Some([right, yours]),
            ..triangle(ray, Some(1.0), Some(1.0))
        };
        let call = ShownCall::Ray(shown);
        assert_eq!(claims::false_of_drawing(&call), [""; 0]);
        text(call)
    };
    assert!(drawn(right).contains("* expected and yours"));
    // In the plane, and off it along the ray, where it is seen from the side.
    for wrong in [Vec3::new(3.0, 1.0, 0.0), Vec3::new(1.0, 1.0, 1.5)] {
        let drawn = drawn(wrong);
        assert!(!drawn.contains('*'), "{drawn}");
        let [o, x] = ['o', 'x'].map(|sign| place(&drawn, sign));
        assert!(o.is_some() && x.is_some() && o != x, "{drawn}");
    }
}

/// Two answers in one place have a sign of their own, an answer and the ray's origin have not, and
/// only what is drawn is explained.
#[test]
fn an_answer_at_the_origin_is_no_second_answer() {
    let ray = Ray::new(Vec3::new(1.0, 1.0, 0.0), Vec3::X);
    let drawn = text(ShownCall::Ray(triangle(ray, Some(0.0), None)));
    assert!(
        !drawn.contains('*') && !drawn.contains("@ origin"),
        "{drawn}"
    );
    assert!(
        drawn.contains("o expected") && !drawn.contains("x yours"),
        "{drawn}"
    );
    let near = Ray::new(Vec3::new(1.0, 1.0, -1.0), Vec3::Z);
    let both = text(ShownCall::Ray(triangle(near, Some(1.0), Some(1.0))));
    assert!(
        both.contains("* expected and yours") && !both.contains("x yours"),
        "{both}"
    );
    let bounded = Ray { min_t: 1.0, ..near };
    let axis = text(ShownCall::Ray(triangle(bounded, Some(1.0), Some(2.0))));
    assert!(
        axis.contains("=  = range") || axis.contains(">  = range"),
        "{axis}"
    );
}

#[test]
fn a_sphere_and_a_box_show_where_the_ray_ends_and_begins() {
    let ray = Ray::new(Vec3::new(0.0, 0.0, -3.0), Vec3::Z);
    let sphere = text(ShownCall::Ray(ShownRay {
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
        ..ShownRay::new(ray)
    }));
    assert!(!sphere.contains("normal"), "{sphere}");
    let [origin, near, far] = ['@', 'o', 'x'].map(|sign| place(&sphere, sign));
    let [origin, near, far] = [origin, near, far].map(|at| at.expect("it is drawn")[1]);
    assert!(origin < near && near < far, "{sphere}");
    // The ray misses in y, which is not its next axis.
    let beside = text(ShownCall::Ray(ShownRay {
        boxes: vec![Aabb {
            min: Vec3::ZERO,
            max: Vec3::ONE,
        }],
        yours: vec![1.0],
        ..ShownRay::new(Ray::new(Vec3::new(0.5, 2.0, -1.0), Vec3::Z))
    }));
    assert!(beside.contains("y to the right, z up"), "{beside}");
}

#[test]
fn samples_where_they_should_be_are_not_drawn() {
    let pixel = |yours: [f64; 2]| {
        ShownCall::Pixel(ShownPixel {
            film: [2, 1],
            pixel: [1, 0],
            samples: 1,
            seed: 0,
            yours: vec![yours],
        })
    };
    assert_eq!(Sketch::of(&pixel([0.75, 0.5])), None);
    let drawn = text(pixel([0.5, 0.0]));
    assert!(drawn.contains('o') && drawn.contains('x'), "{drawn}");
}

#[test]
fn a_tree_is_drawn_level_by_level_and_what_is_not_finite_is_left_out() {
    let span = |from: f64, to: f64, label: &str| Span {
        ends: [from, to],
        label: label.into(),
    };
    let spans = |last: Span| {
        ShownCall::Spans(ShownSpans {
            along: "x",
            about: "the boxes",
            rows: vec![vec![span(0.0, 9.0, "")], vec![span(0.0, 1.0, "0"), last]],
            expected: None,
            yours: None,
        })
    };
    let drawn = text(spans(span(8.0, 9.0, "1")));
    let lines: Vec<&str> = drawn.lines().collect();
    assert!(lines[0].trim().starts_with('|') && lines[0].trim().ends_with('|'));
    assert!(lines[1].contains('0') && lines[1].contains('1'), "{drawn}");
    let without = text(spans(span(f64::NAN, 9.0, "1")));
    assert!(!without.contains('1'), "{without}");
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

#[test]
fn directions_are_drawn_from_their_surface() {
    let drawn = text(ShownCall::Bounce(ShownBounce {
        wo: [0.6, 0.0, 0.8],
        expected: Some([-0.6, 0.0, 0.8]),
        yours: Some([0.6, 0.0, -0.8]),
    }));
    let line = |word: &str| drawn.lines().position(|line| line.contains(word));
    assert_eq!(line("wo"), line("expected"), "{drawn}");
    assert!(line("wo") < line("yours"), "{drawn}");
    let none = ShownBounce {
        wo: [f64::NAN; 3],
        expected: None,
        yours: None,
    };
    assert_eq!(Sketch::of(&ShownCall::Bounce(none)), None);
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
