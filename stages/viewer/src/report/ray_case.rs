//! One ray of a case in 3D: its shape, the worst ray, what the stage answers now, and the exact answer.
//!
//! The stage's answer is computed by the stage that this program contains, not read from the
//! report: after an edit and a new start of the window it is the new one.

use crate::project::Projection;
use crate::task::{StageFailure, guarded};
use judge::cases::Spec;
use judge::expected::Expected;
use judge::{Tier, convert, truth};
use kit::{Aabb, Camera, Hit, Interval, Mat3, PrimId, Primitive, Ray, Scene, Vec2, Vec3};
use pathtracer::replay::text::vector;
use wire::Work;
use wire::work::Xyz;

/// A case with its worst ray.
#[derive(Clone, Debug)]
pub struct RayCase {
    /// The triangles and spheres.
    pub scene: Scene,
    /// The boxes.
    pub boxes: Vec<Aabb>,
    /// The ray; a camera ray is the one that the stage generates.
    pub ray: Ray,
    /// The camera of a case about camera rays.
    pub camera: Option<Camera>,
    /// Where the stage says that the ray hits: `t` of each hit point.
    pub student: Vec<f64>,
    /// Where it hits exactly.
    pub right: Vec<f64>,
    /// The numbers side by side.
    pub rows: Vec<Row>,
    /// The stage has no answer, because of this.
    pub failure: Option<StageFailure>,
    /// Whether the ray is that of the report's sentence: with another seed, cases have other rays.
    pub is_of_report: bool,
}

/// One line of the comparison.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// What is compared.
    pub name: &'static str,
    /// The stage's answer.
    pub student: String,
    /// The exact one.
    pub right: String,
    /// Whether the stage's answer scores: it may be off by the rounding errors of correct code.
    pub is_right: bool,
}

/// The largest distance on the film between a sample and the point where its ray goes.
const SENSOR_TOLERANCE: f64 = 1e-9;
/// The largest difference of the length of a unit vector from 1: a normalisation has about 4
/// roundings.
const UNIT_TOLERANCE: f64 = 1e-14;

impl RayCase {
    /// The view of call number `call` of a case; `None` if the case is not about single rays and shapes.
    /// `message` is the grader's sentence about the call.
    pub fn of(spec: &Spec, tier: Tier, call: usize, message: &str) -> Option<RayCase> {
        let mut view = match &spec.work {
            Work::Triangles(work) => {
                let probe = work.probes.get(call)?;
                let vertices = work.triangles.get(probe.shape as usize)?;
                let scene = convert::scene(std::slice::from_ref(vertices), &[]);
                let ray = convert::ray(&probe.ray);
                let triangle = scene.triangles[0];
                let expected = truth::triangle(tier, probe.shape, &triangle, &ray);
                let id = PrimId(probe.shape);
                let answer = guarded(|| intersect::intersect_triangle(&triangle, id, &mut { ray }));
                RayCase::of_hits(scene, ray, answer, &expected)
            }
            Work::Spheres(work) => {
                let probe = work.probes.get(call)?;
                let sphere = work.spheres.get(probe.shape as usize)?;
                let scene = convert::scene(&[], std::slice::from_ref(sphere));
                let ray = convert::ray(&probe.ray);
                let shape = scene.spheres[0];
                let expected = truth::sphere(tier, probe.shape, &shape, &ray);
                let id = PrimId(probe.shape);
                let answer = guarded(|| intersect::intersect_sphere(&shape, id, &mut { ray }));
                RayCase::of_hits(scene, ray, answer, &expected)
            }
            Work::BruteForce(work) => {
                let scene = convert::scene(&work.triangles, &work.spheres);
                let ray = convert::ray(work.rays.get(call)?);
                let shapes: Vec<Primitive<'_>> = scene.primitives().collect();
                let expected = truth::first_of(tier, &shapes, &ray, spec.enclosed);
                let answer = guarded(|| closest(&shapes, ray));
                RayCase::of_hits(scene.clone(), ray, answer, &expected)
            }
            Work::Boxes(work) => {
                let probe = work.probes.get(call)?;
                RayCase::of_box(
                    work.boxes.get(probe.shape as usize)?,
                    &convert::ray(&probe.ray),
                )
            }
            Work::CameraRays(work) => {
                let camera = work.cameras.get(call / work.sensor.len())?;
                let sensor = work.sensor[call % work.sensor.len()];
                RayCase::of_camera(&camera_of(camera), sensor.into())
            }
            _ => return None,
        };
        let o = view.camera.map_or(view.ray.o, |camera| camera.pos);
        view.is_of_report = message.contains(&format!("{:?}", o.x));
        Some(view)
    }

    fn new(ray: Ray) -> RayCase {
        RayCase {
            scene: Scene::default(),
            boxes: Vec::new(),
            ray,
            camera: None,
            student: Vec::new(),
            right: Vec::new(),
            rows: Vec::new(),
            failure: None,
            is_of_report: false,
        }
    }

    fn of_hits(
        scene: Scene,
        ray: Ray,
        answer: Result<Option<Hit>, StageFailure>,
        expected: &Expected,
    ) -> RayCase {
        let right = expected.hits.first();
        let answered = answer.as_ref().ok().copied().flatten();
        let mut rows = Vec::new();
        let mut row = |name, student: Option<String>, right: Option<String>, is_right| {
            let none = || "-".to_owned();
            rows.push(Row {
                name,
                student: student.unwrap_or_else(none),
                right: right.unwrap_or_else(none),
                is_right,
            });
        };
        let said = |hit: bool| Some(if hit { "hit" } else { "miss" }.to_owned());
        let right_says = match (right.is_some(), expected.miss) {
            (true, true) => Some("hit or miss".to_owned()),
            (hit, _) => said(hit),
        };
        let student_says = answer.as_ref().ok().and_then(|hit| said(hit.is_some()));
        let scores = answer.as_ref().is_ok_and(|hit| match hit {
            Some(_) => right.is_some(),
            None => expected.miss || right.is_none(),
        });
        row("result", student_says, right_says, scores);
        if let (Some(hit), Some(right)) = (answered, right) {
            let number = |x: f64| Some(format!("{x:?}"));
            let is_near = |a: Vec3, b: Vec3, bound: f64| (a - b).abs().max_element() <= bound;
            let is_right = (hit.t - right.t).abs() <= right.t_bound;
            row("t", number(hit.t), number(right.t), is_right);
            let is_right = expected.hits.iter().any(|one| one.prim == hit.prim.0);
            let prims = (hit.prim.0.to_string(), right.prim.to_string());
            row("primitive", Some(prims.0), Some(prims.1), is_right);
            let is_right = is_near(hit.p, right.p, right.p_bound);
            row("p", Some(vector(hit.p)), Some(vector(right.p)), is_right);
            for (name, n, right, bound) in [
                ("n", hit.n, right.n, right.n_bound),
                ("ng", hit.ng, right.ng, right.ng_bound),
            ] {
                let is_right = right.is_none_or(|right| is_near(n, right, bound));
                row(name, Some(vector(n)), right.map(vector), is_right);
            }
        }
        RayCase {
            scene,
            student: answered.map(|hit| hit.t).into_iter().collect(),
            right: right.map(|hit| hit.t).into_iter().collect(),
            rows,
            failure: answer.err(),
            ..RayCase::new(ray)
        }
    }

    fn of_box([min, max]: &[Xyz; 2], ray: &Ray) -> RayCase {
        let bounds = Aabb {
            min: (*min).into(),
            max: (*max).into(),
        };
        let answer = guarded(|| bbox::intersect_bbox(&bounds, ray));
        let exact = oracle::bbox(&bounds, ray).inside.ok();
        let exact = exact.map(|inside| Interval {
            min: inside.min.to_f64(),
            max: inside.max.to_f64(),
        });
        let text = |interval: Option<Interval>| match interval {
            Some(Interval { min, max }) => format!("[{min:?}, {max:?}]"),
            None => "miss".to_owned(),
        };
        let ends = |interval: Option<Interval>| {
            interval.map_or_else(Vec::new, |Interval { min, max }| vec![min, max])
        };
        let answered = answer.as_ref().ok().copied().flatten();
        RayCase {
            boxes: vec![bounds],
            student: ends(answered),
            right: ends(exact),
            rows: vec![Row {
                name: "interval",
                is_right: answer.as_ref().is_ok_and(|interval| {
                    let verdict = oracle::bbox(&bounds, ray);
                    verdict
                        .judge(oracle::KernelClass::Textbook, *interval)
                        .scores()
                }),
                student: answer
                    .as_ref()
                    .map_or("-".to_owned(), |interval| text(*interval)),
                right: text(exact),
            }],
            failure: answer.err(),
            ..RayCase::new(*ray)
        }
    }

    fn of_camera(camera: &Camera, sensor: Vec2) -> RayCase {
        let answer = guarded(|| raygen::generate_ray(camera, sensor));
        let text = |x: f64| format!("{x:?}");
        let point = |p: Option<Vec2>| {
            p.map_or("behind the camera".to_owned(), |p| {
                format!("({:?}, {:?})", p.x, p.y)
            })
        };
        let row = |name,
                   student: &dyn Fn(&Ray) -> String,
                   right: String,
                   judge: &dyn Fn(&Ray) -> bool| Row {
            name,
            student: answer.as_ref().map_or("-".to_owned(), student),
            right,
            is_right: answer.as_ref().is_ok_and(judge),
        };
        let seen = |ray: &Ray| Projection::new(camera).point(ray.o + ray.d);
        let is_seen =
            |ray: &Ray| seen(ray).is_some_and(|at| at.distance(sensor) <= SENSOR_TOLERANCE);
        let is_unit = |ray: &Ray| (ray.d.length() - 1.0).abs() <= UNIT_TOLERANCE;
        let rows = vec![
            row("o", &|ray| vector(ray.o), vector(camera.pos), &|ray| {
                ray.o == camera.pos
            }),
            row(
                "point on the film",
                &|ray| point(seen(ray)),
                point(Some(sensor)),
                &is_seen,
            ),
            row(
                "length of d",
                &|ray| text(ray.d.length()),
                text(1.0),
                &is_unit,
            ),
            row(
                "min_t",
                &|ray| text(ray.min_t),
                text(camera.n_clip),
                &|ray| ray.min_t == camera.n_clip,
            ),
            row(
                "max_t",
                &|ray| text(ray.max_t),
                text(camera.f_clip),
                &|ray| ray.max_t == camera.f_clip,
            ),
        ];
        RayCase {
            camera: Some(*camera),
            rows,
            failure: answer.as_ref().err().cloned(),
            ..RayCase::new(answer.unwrap_or(Ray::new(camera.pos, -camera.c2w.z_axis)))
        }
    }

    /// A box around the shapes, the ray's origin and its hits.
    pub fn bounds(&self) -> Aabb {
        let mut bounds = self.scene.bounds();
        bounds = self.boxes.iter().fold(bounds, |all, b| all.union(*b));
        bounds = bounds.grown_by(self.ray.o);
        let at = self
            .student
            .iter()
            .chain(&self.right)
            .map(|&t| self.ray.at(t));
        at.filter(|p| p.is_finite()).fold(bounds, Aabb::grown_by)
    }
}

/// The closest hit among `shapes`, as brute force finds it.
fn closest(shapes: &[Primitive<'_>], mut ray: Ray) -> Option<Hit> {
    let mut closest: Option<Hit> = None;
    for (id, shape) in (0..).map(PrimId).zip(shapes) {
        let hit = match shape {
            Primitive::Triangle(triangle) => intersect::intersect_triangle(triangle, id, &mut ray),
            Primitive::Sphere(sphere) => intersect::intersect_sphere(sphere, id, &mut ray),
        };
        closest = hit.or(closest);
    }
    closest
}

fn camera_of(camera: &wire::work::Camera) -> Camera {
    let [x, y, z] = camera.c2w.map(Vec3::from);
    Camera {
        pos: camera.pos.into(),
        c2w: Mat3::from_cols(x, y, z),
        h_fov: camera.h_fov,
        v_fov: camera.v_fov,
        n_clip: camera.n_clip,
        f_clip: camera.f_clip,
    }
}
