//! Examples of one ray and one shape. The oracle decides whether an example is right.

use super::by_hand::is_near;
use kit::{Aabb, Ray, Sphere, Triangle};
use oracle::{Miss, SphereClass, TriangleClass};
use wire::Work;
use wire::work::{BoxWork, Probe, SphereWork, TriangleWork};

/// The shape of an example. It decides to which task the example belongs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// In examples of `part1.task3`.
    Triangle(Triangle),
    /// In examples of `part1.task4`.
    Sphere(Sphere),
    /// In examples of `part2.task2`.
    Box(Aabb),
}

/// The result that an example expects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Expectation {
    /// No hit.
    Miss,
    /// A hit at this `t`.
    Hit(f64),
    /// The ray is inside the box from the first of these `t` to the second.
    Inside([f64; 2]),
}

/// A ray, a shape, and the result that a student expects of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayExample {
    /// The shape.
    pub shape: Shape,
    /// The ray.
    pub ray: Ray,
    /// The result.
    pub expected: Expectation,
}

/// The situations that examples with a triangle can touch.
const OF_TRIANGLES: &[&str] = &[
    "inside, from the front",
    "inside, from the back",
    "beyond the edge p0 p1",
    "beyond the edge p1 p2",
    "beyond the edge p2 p0",
    "on an edge or a vertex",
    "parallel to the plane",
    "in the plane",
    BEHIND,
    BEFORE,
    BEYOND,
    AT_END,
    LENGTH,
];

/// The situations that examples with a sphere can touch.
const OF_SPHERES: &[&str] = &[
    "both hits ahead: the nearer counts",
    "from inside",
    "the nearer hit out of range: the farther counts",
    "beside the sphere",
    "touches the sphere in a point",
    BEHIND,
    BEFORE,
    BEYOND,
    AT_END,
    LENGTH,
];

/// The situations that examples with a box can touch.
const OF_BOXES: &[&str] = &[
    "enters and leaves",
    "from inside",
    "beside the box in x",
    "beside the box in y",
    "beside the box in z",
    "slanted, between two of its planes but never all",
    "against an axis",
    "the range cuts the interval",
    "a flat box",
    BEHIND,
    BEYOND,
    LENGTH,
];

const BEHIND: &str = "the shape is behind the origin";
const BEFORE: &str = "the hit is before min_t";
const BEYOND: &str = "the shape is beyond max_t";
const AT_END: &str = "the hit is at an end of the range";
const LENGTH: &str = "d is not of length 1";

impl Shape {
    /// The key of the task that the shape belongs to.
    pub(super) fn task(&self) -> &'static str {
        match self {
            Shape::Triangle(_) => "part1.task3",
            Shape::Sphere(_) => "part1.task4",
            Shape::Box(_) => "part2.task2",
        }
    }
}

/// The situations of a task; `None` for tasks without rays at one shape.
pub(super) fn situations_of(task: &str) -> Option<&'static [&'static str]> {
    match task {
        "part1.task3" => Some(OF_TRIANGLES),
        "part1.task4" => Some(OF_SPHERES),
        "part2.task2" => Some(OF_BOXES),
        _ => None,
    }
}

/// What is wrong with `example`: a sentence without a full stop. `None` if the example is right.
pub(super) fn verdict(example: &RayExample) -> Option<String> {
    let RayExample {
        shape,
        ray,
        expected,
    } = example;
    let (hit, why, is_hit) = match shape {
        Shape::Triangle(triangle) => {
            let verdict = oracle::triangle(triangle, ray);
            let t = verdict.crossing.filter(|_| verdict.hits());
            let why = match verdict.class {
                TriangleClass::Inside => "it meets the triangle inside",
                TriangleClass::Edge(_) => "it meets an edge, which counts",
                TriangleClass::Vertex(_) => "it meets a vertex, which counts",
                TriangleClass::Miss(why) => why_it_misses(why),
            };
            (
                t.map(|crossing| [crossing.t.to_f64(); 2]),
                why,
                verdict.hits(),
            )
        }
        Shape::Sphere(sphere) => {
            let verdict = oracle::sphere(sphere, ray);
            let why = match verdict.class {
                SphereClass::Tangent => "it touches the sphere, which counts",
                SphereClass::Miss(why) => why_it_misses(why),
                SphereClass::Far => "the farther hit is the first in the range",
                _ => "the nearer hit is in the range",
            };
            let t = verdict.t.map(|t| [t.to_f64(); 2]);
            (t, why, verdict.hits())
        }
        Shape::Box(b) => {
            let verdict = oracle::bbox(b, ray);
            let ends = verdict
                .ends
                .map(|(near, far)| [near.to_f64(), far.to_f64()]);
            let is_hit = verdict.hits();
            let why = match is_hit {
                true => "it is inside all three pairs of planes there",
                false => "it is at no t of its range inside all three pairs of planes",
            };
            (ends.filter(|_| is_hit), why, is_hit)
        }
    };
    let right = match (hit, shape) {
        (Some([from, to]), Shape::Box(_)) => format!("is inside from t = {from} to t = {to}"),
        (Some([t, _]), _) => format!("hits at t = {t}"),
        (None, _) => "misses".to_owned(),
    };
    let says = match expected {
        Expectation::Miss => "a miss".to_owned(),
        Expectation::Hit(t) => format!("a hit at t = {t}"),
        Expectation::Inside([from, to]) => format!("t = {from} to t = {to}"),
    };
    let is_right = match (expected, hit, shape) {
        (Expectation::Miss, ..) => !is_hit,
        (Expectation::Hit(t), Some([right, _]), Shape::Triangle(_) | Shape::Sphere(_)) => {
            is_near(*t, right)
        }
        (Expectation::Inside([from, to]), Some([near, far]), Shape::Box(_)) => {
            is_near(*from, near) && is_near(*to, far)
        }
        _ => false,
    };
    (!is_right).then(|| format!("it says {says}; the ray {right}: {why}"))
}

fn why_it_misses(why: Miss) -> &'static str {
    match why {
        Miss::NotANumber => "a number is NaN",
        Miss::NotFinite => "a number is infinite",
        Miss::ZeroDirection => "the direction is 0",
        Miss::EmptyRange => "its range is empty",
        Miss::Degenerate => "the shape has no size",
        Miss::Coplanar => "it is in the plane of the triangle, which is a miss by convention",
        Miss::LineMisses => "the line of the ray does not meet the shape",
        Miss::OutOfRange => "the line meets the shape only outside of the ray's range",
    }
}

impl RayExample {
    /// The situations of its task that the example touches.
    pub(super) fn situations(&self) -> Vec<&'static str> {
        let mut touched = match &self.shape {
            Shape::Triangle(triangle) => of_triangle(triangle, &self.ray),
            Shape::Sphere(sphere) => of_sphere(sphere, &self.ray),
            Shape::Box(b) => of_box(b, &self.ray),
        };
        if (self.ray.d.length() - 1.0).abs() > 1e-9 {
            touched.push(LENGTH);
        }
        touched
    }

    /// The call that the example is about, as a question to a student's code.
    pub(super) fn work(&self) -> Work {
        let ray = wire::work::Ray {
            o: self.ray.o.into(),
            d: self.ray.d.into(),
            min_t: self.ray.min_t,
            max_t: self.ray.max_t,
        };
        let probes = vec![Probe { shape: 0, ray }];
        match self.shape {
            Shape::Triangle(of) => {
                let vectors = [of.p0, of.p1, of.p2, of.n0, of.n1, of.n2];
                Work::Triangles(TriangleWork {
                    triangles: vec![vectors.map(Into::into)],
                    probes,
                    by_record: false,
                })
            }
            Shape::Sphere(of) => Work::Spheres(SphereWork {
                spheres: vec![(of.center.into(), of.radius)],
                probes,
            }),
            Shape::Box(of) => Work::Boxes(BoxWork {
                boxes: vec![[of.min.into(), of.max.into()]],
                probes,
            }),
        }
    }
}

/// The situation of a ray whose line meets the shape at `t`, out of the ray's range: `t` is behind
/// the origin, before `min_t` or beyond `max_t`.
fn out_of_range(t: f64, ray: &Ray) -> &'static str {
    if t < 0.0 {
        BEHIND
    } else if t < ray.min_t {
        BEFORE
    } else {
        BEYOND
    }
}

fn of_triangle(triangle: &Triangle, ray: &Ray) -> Vec<&'static str> {
    let verdict = oracle::triangle(triangle, ray);
    let crossing = oracle::plane_crossing(triangle, ray);
    let mut touched = match (verdict.class, crossing) {
        (TriangleClass::Inside, Some(crossing)) => match crossing.on_the_front {
            true => vec![OF_TRIANGLES[0]],
            false => vec![OF_TRIANGLES[1]],
        },
        (TriangleClass::Edge(_) | TriangleClass::Vertex(_), _) => vec!["on an edge or a vertex"],
        (TriangleClass::Miss(Miss::Coplanar), _) => vec!["in the plane"],
        (TriangleClass::Miss(Miss::LineMisses), None) => vec!["parallel to the plane"],
        (TriangleClass::Miss(Miss::LineMisses), Some(crossing)) => {
            // The edges p0 p1, p1 p2 and p2 p0, each with the vertex that is opposite to it.
            let names = OF_TRIANGLES[2..5].iter().zip([2, 0, 1]);
            names
                .filter(|(_, opposite)| crossing.beyond[*opposite])
                .map(|(name, _)| *name)
                .collect()
        }
        (TriangleClass::Miss(Miss::OutOfRange), Some(crossing)) => {
            vec![out_of_range(crossing.t.to_f64(), ray)]
        }
        _ => Vec::new(),
    };
    if verdict.at_range_end {
        touched.push(AT_END);
    }
    touched
}

fn of_sphere(sphere: &Sphere, ray: &Ray) -> Vec<&'static str> {
    let verdict = oracle::sphere(sphere, ray);
    let roots = verdict.roots.map(|roots| roots.map(|t| t.to_f64()));
    let is_inside = ray.o.distance(sphere.center) < sphere.radius;
    let mut touched = match verdict.class {
        SphereClass::Tangent => vec!["touches the sphere in a point"],
        SphereClass::Miss(Miss::LineMisses) => vec!["beside the sphere"],
        SphereClass::Miss(Miss::OutOfRange) => match roots {
            Some([near, far]) if far < 0.0 || near > ray.max_t => vec![out_of_range(near, ray)],
            Some([_, far]) => vec![out_of_range(far, ray)],
            None => Vec::new(),
        },
        SphereClass::Miss(_) => Vec::new(),
        _ if is_inside => vec!["from inside"],
        SphereClass::Far => vec!["the nearer hit out of range: the farther counts"],
        _ => vec!["both hits ahead: the nearer counts"],
    };
    if verdict.at_range_end {
        touched.push(AT_END);
    }
    touched
}

fn of_box(b: &Aabb, ray: &Ray) -> Vec<&'static str> {
    let verdict = oracle::bbox(b, ray);
    let extent = b.max - b.min;
    let is_inside = (0..3).all(|i| (b.min[i]..=b.max[i]).contains(&ray.o[i]));
    let whole = Ray {
        min_t: f64::NEG_INFINITY,
        max_t: f64::INFINITY,
        ..*ray
    };
    let ends = |ray: &Ray| {
        let ends = oracle::bbox(b, ray).ends?;
        Some([ends.0.to_f64(), ends.1.to_f64()])
    };
    let line = ends(&whole).filter(|_| oracle::bbox(b, &whole).hits());
    let mut touched = Vec::new();
    match line {
        Some([near, far]) if verdict.hits() => {
            touched.push(if is_inside {
                "from inside"
            } else {
                OF_BOXES[0]
            });
            if near.max(0.0) < ray.min_t || far > ray.max_t {
                touched.push("the range cuts the interval");
            }
        }
        Some([_, far]) if far < 0.0 => touched.push(BEHIND),
        Some([near, _]) if near > ray.max_t => touched.push(BEYOND),
        Some(_) => {}
        None => {
            let beside = |i: usize| {
                let o = ray.o[i];
                ray.d[i] == 0.0 && (o < b.min[i] || o > b.max[i])
            };
            let names = OF_BOXES[2..5].iter().enumerate();
            touched.extend(names.filter(|(i, _)| beside(*i)).map(|(_, name)| *name));
            if touched.is_empty() {
                touched.push("slanted, between two of its planes but never all");
            }
        }
    }
    if ray.d.min_element() < 0.0 {
        touched.push("against an axis");
    }
    if extent.min_element() == 0.0 {
        touched.push("a flat box");
    }
    touched
}

#[cfg(test)]
mod tests {
    use super::*;
    use kit::Vec3;

    fn triangle(o: [f64; 3], d: [f64; 3], expected: Expectation) -> RayExample {
        let corners = [
            Vec3::ZERO,
            Vec3::new(4.0, 0.0, 0.0),
            Vec3::new(0.0, 4.0, 0.0),
        ];
        let [p0, p1, p2] = corners;
        RayExample {
            shape: Shape::Triangle(Triangle::flat(p0, p1, p2)),
            ray: Ray::new(o.into(), d.into()),
            expected,
        }
    }

    const UP: [f64; 3] = [0.0, 0.0, 1.0];

    #[test]
    fn an_example_is_right_or_says_why_it_is_not() {
        let inside = triangle([1.0, 1.0, -1.0], UP, Expectation::Hit(1.0));
        assert_eq!(verdict(&inside), None);
        let edge = triangle([2.0, 0.0, -1.0], UP, Expectation::Miss);
        assert_eq!(
            verdict(&edge).as_deref(),
            Some("it says a miss; the ray hits at t = 1: it meets an edge, which counts")
        );
        let beside = triangle([3.0, 3.0, -1.0], UP, Expectation::Hit(1.0));
        let why = verdict(&beside).expect("it is wrong");
        assert!(
            why.starts_with("it says a hit at t = 1; the ray misses"),
            "{why}"
        );
        // An interval is no result of a triangle test.
        let interval = triangle([1.0, 1.0, -1.0], UP, Expectation::Inside([1.0, 1.0]));
        assert!(verdict(&interval).is_some());
    }

    #[test]
    fn each_situation_of_triangles_is_touched_by_some_example() {
        let far = Ray {
            max_t: 0.5,
            ..Ray::new(Vec3::new(1.0, 1.0, -1.0), UP.into())
        };
        let late = Ray {
            min_t: 2.0,
            max_t: 9.0,
            ..far
        };
        let end = Ray { max_t: 1.0, ..far };
        let shape = triangle([0.0; 3], UP, Expectation::Miss);
        let plain = [
            ([1.0, 1.0, 1.0], [0.0, 0.0, -1.0]),
            ([1.0, 1.0, -1.0], UP),
            ([1.0, -1.0, -1.0], UP),
            ([3.0, 3.0, -1.0], UP),
            ([-1.0, 1.0, -1.0], UP),
            ([2.0, 0.0, -1.0], UP),
            ([1.0, 1.0, 1.0], [1.0, 0.0, 0.0]),
            ([1.0, 1.0, 0.0], [1.0, 0.0, 0.0]),
            ([1.0, 1.0, 1.0], UP),
            ([1.0, 1.0, -1.0], [0.0, 0.0, 2.0]),
        ];
        let plain = plain.map(|(o, d)| triangle(o, d, Expectation::Miss));
        let ranges = [far, late, end].map(|ray| RayExample { ray, ..shape });
        let all: Vec<&str> = plain
            .iter()
            .chain(&ranges)
            .flat_map(RayExample::situations)
            .collect();
        for situation in OF_TRIANGLES {
            assert!(all.contains(situation), "no {situation:?} in {all:?}");
        }
        // This example touches one situation only.
        assert_eq!(plain[2].situations(), ["beyond the edge p0 p1"]);
    }

    #[test]
    fn spheres_and_boxes_have_their_situations() {
        let sphere = |o: f64, expected| RayExample {
            shape: Shape::Sphere(Sphere {
                center: Vec3::ZERO,
                radius: 1.0,
            }),
            ray: Ray::new(Vec3::new(o, 0.0, -3.0), Vec3::Z),
            expected,
        };
        let through = sphere(0.0, Expectation::Hit(2.0));
        assert_eq!(verdict(&through), None);
        assert_eq!(through.situations(), ["both hits ahead: the nearer counts"]);
        let touching = sphere(1.0, Expectation::Hit(3.0));
        assert_eq!(verdict(&touching), None);
        assert_eq!(touching.situations(), ["touches the sphere in a point"]);
        let shape = Shape::Box(Aabb {
            min: Vec3::ZERO,
            max: Vec3::ONE,
        });
        let of_box = |o: [f64; 3], d: [f64; 3], expected| RayExample {
            shape,
            ray: Ray::new(o.into(), d.into()),
            expected,
        };
        let enters = of_box([0.5, 0.5, -1.0], UP, Expectation::Inside([1.0, 2.0]));
        assert_eq!(verdict(&enters), None);
        assert_eq!(enters.situations(), ["enters and leaves"]);
        let inside = of_box([0.5; 3], [0.0, 0.0, -1.0], Expectation::Inside([0.0, 0.5]));
        assert_eq!(verdict(&inside), None);
        assert_eq!(inside.situations(), ["from inside", "against an axis"]);
        let beside = of_box([0.5, 2.0, -1.0], UP, Expectation::Miss);
        assert_eq!(verdict(&beside), None);
        assert_eq!(beside.situations(), ["beside the box in y"]);
    }
}
