//! Examples that students write before their code, in `stages/STAGE/examples.toml`: reads them, and
//! says which are right and which situations of the task they touch.

use base::GraderError;
use judge::examples::{
    CameraExample, Example, Expectation, RayExample, Shape, SpecularExample, SpecularFunction,
    situations_of, verdict,
};
use judge::plural;
use kit::{Aabb, Ray, Sphere, Triangle, Vec2};
use serde::Deserialize;
use std::fmt::Write;

/// The file of a stage.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    #[serde(default)]
    camera: Vec<OfCamera>,
    #[serde(default)]
    reflect: Vec<OfMirror>,
    #[serde(default)]
    refract: Vec<OfBoundary>,
    #[serde(default)]
    triangle: Vec<OfTriangle>,
    #[serde(default)]
    sphere: Vec<OfSphere>,
    #[serde(default, rename = "box")]
    boxes: Vec<OfBox>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct OfTriangle {
    p0: [f64; 3],
    p1: [f64; 3],
    p2: [f64; 3],
    o: [f64; 3],
    d: [f64; 3],
    #[serde(default)]
    min_t: f64,
    #[serde(default = "infinity")]
    max_t: f64,
    expected: Written,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct OfSphere {
    center: [f64; 3],
    radius: f64,
    o: [f64; 3],
    d: [f64; 3],
    #[serde(default)]
    min_t: f64,
    #[serde(default = "infinity")]
    max_t: f64,
    expected: Written,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct OfBox {
    min: [f64; 3],
    max: [f64; 3],
    o: [f64; 3],
    d: [f64; 3],
    #[serde(default)]
    min_t: f64,
    #[serde(default = "infinity")]
    max_t: f64,
    expected: Written,
}

/// A camera that is not turned if `axes` are not written.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct OfCamera {
    #[serde(default = "straight")]
    axes: [[f64; 3]; 3],
    h_fov: f64,
    v_fov: f64,
    sensor: [f64; 2],
    expected: [f64; 3],
}

fn straight() -> [[f64; 3]; 3] {
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct OfMirror {
    wo: [f64; 3],
    expected: [f64; 3],
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct OfBoundary {
    wo: [f64; 3],
    ior: f64,
    expected: Refracted,
}

#[derive(Debug, Deserialize)]
#[serde(
    untagged,
    expecting = "expected the direction as [x, y, z], or \"none\""
)]
enum Refracted {
    None(Nothing),
    Direction([f64; 3]),
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Nothing {
    None,
}

fn infinity() -> f64 {
    f64::INFINITY
}

/// A result as it is written: "miss", a `t`, or the two ends of an interval.
#[derive(Debug, Deserialize)]
#[serde(
    untagged,
    expecting = "expected \"miss\", the t of a hit, or [from, to] for a box"
)]
enum Written {
    Miss(Miss),
    Hit(f64),
    Inside([f64; 2]),
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Miss {
    Miss,
}

impl From<Written> for Expectation {
    fn from(written: Written) -> Expectation {
        match written {
            Written::Miss(Miss::Miss) => Expectation::Miss,
            Written::Hit(t) => Expectation::Hit(t),
            Written::Inside(ends) => Expectation::Inside(ends),
        }
    }
}

/// Reads the examples of a file, those of each kind in their order.
pub fn parse(text: &str) -> Result<Vec<Example>, GraderError> {
    let File {
        camera,
        reflect,
        refract,
        triangle,
        sphere,
        boxes,
    } = toml::from_str(text).map_err(|e| GraderError::new(e.to_string()))?;
    let ray = |o: [f64; 3], d: [f64; 3], min_t: f64, max_t: f64| Ray {
        o: o.into(),
        d: d.into(),
        min_t,
        max_t,
    };
    let cameras = camera.into_iter().map(|of| CameraExample {
        axes: of.axes.map(Into::into),
        fov: Vec2::new(of.h_fov, of.v_fov),
        film: of.sensor.into(),
        expected: of.expected.into(),
    });
    let mirrors = reflect.into_iter().map(|of| SpecularExample {
        function: SpecularFunction::Reflect,
        wo: of.wo.into(),
        expected: Some(of.expected.into()),
    });
    let boundaries = refract.into_iter().map(|of| SpecularExample {
        function: SpecularFunction::Refract(of.ior),
        wo: of.wo.into(),
        expected: match of.expected {
            Refracted::None(Nothing::None) => None,
            Refracted::Direction(wi) => Some(wi.into()),
        },
    });
    let triangles = triangle.into_iter().map(|of| RayExample {
        shape: Shape::Triangle(Triangle::flat(of.p0.into(), of.p1.into(), of.p2.into())),
        ray: ray(of.o, of.d, of.min_t, of.max_t),
        expected: of.expected.into(),
    });
    let spheres = sphere.into_iter().map(|of| RayExample {
        shape: Shape::Sphere(Sphere {
            center: of.center.into(),
            radius: of.radius,
        }),
        ray: ray(of.o, of.d, of.min_t, of.max_t),
        expected: of.expected.into(),
    });
    let boxes = boxes.into_iter().map(|of| RayExample {
        shape: Shape::Box(Aabb {
            min: of.min.into(),
            max: of.max.into(),
        }),
        ray: ray(of.o, of.d, of.min_t, of.max_t),
        expected: of.expected.into(),
    });
    let rays = triangles.chain(spheres).chain(boxes).map(Example::Ray);
    let specular = mirrors.chain(boundaries).map(Example::Specular);
    Ok(cameras
        .map(Example::Camera)
        .chain(rays)
        .chain(specular)
        .collect())
}

/// What the examples of a task are worth.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Review {
    /// For each example what is wrong with it; `None` if it is right.
    pub verdicts: Vec<Option<String>>,
    /// Each situation of the task, with the numbers of the right examples that touch it, from 1.
    pub situations: Vec<(&'static str, Vec<usize>)>,
}

/// Judges the examples of `task`, numbered in their order. An example that is wrong touches
/// nothing. `None` for a task whose examples cannot be judged.
pub fn review(task: &str, examples: &[Example]) -> Option<Review> {
    let of_task = examples.iter().filter(|of| of.task() == task);
    let of_task: Vec<&Example> = of_task.collect();
    let verdicts: Vec<Option<String>> = of_task.iter().map(|of| verdict(of)).collect();
    let touching = |situation: &str| {
        let right = of_task.iter().zip(&verdicts).enumerate();
        right
            .filter(|(_, (of, verdict))| verdict.is_none() && of.situations().contains(&situation))
            .map(|(at, _)| at + 1)
            .collect()
    };
    let situations = situations_of(task)?.iter();
    Some(Review {
        situations: situations.map(|of| (*of, touching(of))).collect(),
        verdicts,
    })
}

impl Review {
    /// Whether every example is right.
    pub fn is_right(&self) -> bool {
        self.verdicts.iter().all(Option::is_none)
    }

    /// The verdicts, then a table of the situations: by which examples each is touched.
    pub fn text(&self, file: &str, task: &str) -> String {
        let count = self.verdicts.len();
        let right = self
            .verdicts
            .iter()
            .filter(|verdict| verdict.is_none())
            .count();
        let mut text = format!(
            "{file}: {} of {task}, {right} right\n",
            plural(count, "example", "examples")
        );
        for (at, verdict) in self.verdicts.iter().enumerate() {
            if let Some(why) = verdict {
                let _ = writeln!(text, "  {} is wrong: {why}", at + 1);
            }
        }
        let touched = self
            .situations
            .iter()
            .filter(|(_, by)| !by.is_empty())
            .count();
        let _ = writeln!(
            text,
            "\nsituations: {touched} of {} touched",
            self.situations.len()
        );
        let widest = self.situations.iter().map(|(name, _)| name.len()).max();
        let width = widest.unwrap_or(0);
        for (name, by) in &self.situations {
            let by: Vec<String> = by.iter().map(usize::to_string).collect();
            let by = match by.is_empty() {
                true => "missing".to_owned(),
                false => format!("example {}", by.join(", ")),
            };
            let _ = writeln!(text, "  {name:width$}  {by}");
        }
        text
    }
}

/// What to write, for a task whose stage has no file yet.
pub fn sample(task: &str) -> &'static str {
    match task {
        "part1.task2" => {
            "[[camera]]\nh_fov = 90\nv_fov = 90\nsensor = [1, 0.5]    # from [0, 0], the bottom left, to [1, 1]\n\
             # axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1]] (right, up, backward) if they are not written\nexpected = [0.707, 0, -0.707]    # the direction, of length 1\n"
        }
        "part4.task1" => {
            "[[reflect]]\nwo = [0.6, 0, 0.8]\nexpected = [-0.6, 0, 0.8]\n\n\
             [[refract]]\nwo = [0.6, 0, -0.8]\nior = 2\nexpected = \"none\"    # or the direction, such as [-0.3, 0, -0.954]\n"
        }
        "part1.task3" => {
            "[[triangle]]\np0 = [0, 0, 0]\np1 = [4, 0, 0]\np2 = [0, 4, 0]\no = [1, 1, -1]\nd = [0, 0, 1]\n\
             # min_t = 0 and max_t = inf if they are not written\nexpected = 1        # the t of the hit, or \"miss\"\n"
        }
        "part1.task4" => {
            "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\no = [0, 0, -3]\nd = [0, 0, 1]\n\
             # min_t = 0 and max_t = inf if they are not written\nexpected = 2        # the t of the hit, or \"miss\"\n"
        }
        _ => {
            "[[box]]\nmin = [0, 0, 0]\nmax = [1, 1, 1]\no = [0.5, 0.5, -1]\nd = [0, 0, 1]\n\
             # min_t = 0 and max_t = inf if they are not written\nexpected = [1, 2]   # from where to where the ray is inside, or \"miss\"\n"
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_samples_are_right_and_touch_a_situation() {
        for task in judge::examples::TASKS {
            let examples = parse(sample(task)).expect("it can be read");
            let review = review(task, &examples).expect("the task has situations");
            assert!(review.is_right() && !review.verdicts.is_empty(), "{task}");
            let touched = |number: usize| {
                let by = review.situations.iter().map(|(_, by)| by);
                by.filter(|by| by.contains(&number)).count()
            };
            for number in 1..=review.verdicts.len() {
                assert_eq!(touched(number), 1, "{task}, example {number}");
            }
        }
    }

    #[test]
    fn a_wrong_example_is_explained_and_touches_nothing() {
        let text = sample("part1.task3").replace("expected = 1 ", "expected = \"miss\" ");
        let examples = parse(&text).expect("it can be read");
        let review = review("part1.task3", &examples).expect("the task has situations");
        assert!(!review.is_right());
        let text = review.text("examples.toml", "part1.task3");
        for line in [
            "examples.toml: 1 example of part1.task3, 0 right\n",
            "  1 is wrong: it says a miss; the ray hits at t = 1: it meets the triangle inside\n",
            "situations: 0 of 13 touched\n",
            "  inside, from the front             missing\n",
        ] {
            assert!(text.contains(line), "no {line:?} in\n{text}");
        }
    }

    #[test]
    fn what_cannot_be_read_is_named_with_its_line() {
        let unknown = parse("[[triangle]]\nq0 = [0, 0, 0]\n").expect_err("q0 is no field");
        let unknown = unknown.to_string();
        assert!(
            unknown.contains("line 2") && unknown.contains("q0"),
            "{unknown}"
        );
        let text = sample("part1.task4").replace("expected = 2 ", "expected = \"hit\" ");
        let word = parse(&text).expect_err("a hit needs its t").to_string();
        assert!(word.contains("expected \"miss\", the t of a hit"), "{word}");
        assert!(review("part2.task1", &[]).is_none());
    }
}
