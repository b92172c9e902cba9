//! One case in 3D: its shape, the worst ray, what the stage answers now, and the exact answer.
//!
//! The stage's answer is computed by the stage that this program contains, not read from the
//! report: after an edit and a new start of the window it is the new one.

use super::file::FailedCase;
use crate::project::Projection;
use crate::task::{StageFailure, guarded};
use judge::expected::Expected;
use judge::{convert, truth};
use kit::{Aabb, Camera, Hit, Interval, Mat3, PrimId, Primitive, Ray, Scene, Vec2, Vec3};
use pathtracer::replay::text::vector;
use wire::Work;
use wire::work::Xyz;

/// A case with its worst ray.
#[derive(Clone, Debug)]
pub struct CaseView {
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
}

impl Row {
    /// Whether both are the same text.
    pub fn is_same(&self) -> bool {
        self.student == self.right
    }
}

impl CaseView {
    /// The view of the worst answer of a case; `None` if the case is not about a single ray and
    /// shapes.
    pub fn of(case: &FailedCase) -> Option<CaseView> {
        let (call, message) = case.worst_call()?;
        let spec = case.spec.as_ref()?;
        let call = call as usize;
        let tier = case.tier;
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
                CaseView::of_hits(scene, ray, answer, &expected)
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
                CaseView::of_hits(scene, ray, answer, &expected)
            }
            Work::BruteForce(work) => {
                let scene = convert::scene(&work.triangles, &work.spheres);
                let ray = convert::ray(work.rays.get(call)?);
                let shapes: Vec<Primitive<'_>> = scene.primitives().collect();
                let expected = truth::first_of(tier, &shapes, &ray, spec.enclosed);
                let answer = guarded(|| closest(&shapes, ray));
                CaseView::of_hits(scene.clone(), ray, answer, &expected)
            }
            Work::Boxes(work) => {
                let probe = work.probes.get(call)?;
                CaseView::of_box(
                    work.boxes.get(probe.shape as usize)?,
                    &convert::ray(&probe.ray),
                )
            }
            Work::CameraRays(work) => {
                let camera = work.cameras.get(call / work.sensor.len())?;
                let sensor = work.sensor[call % work.sensor.len()];
                CaseView::of_camera(&camera_of(camera), sensor.into())
            }
            _ => return None,
        };
        let o = view.camera.map_or(view.ray.o, |camera| camera.pos);
        view.is_of_report = message.contains(&format!("{:?}", o.x));
        Some(view)
    }

    fn new(ray: Ray) -> CaseView {
        CaseView {
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
    ) -> CaseView {
        let right = expected.hits.first();
        let answered = answer.as_ref().ok().copied().flatten();
        let mut rows = Vec::new();
        let mut row = |name, student: Option<String>, right: Option<String>| {
            let none = || "-".to_owned();
            rows.push(Row {
                name,
                student: student.unwrap_or_else(none),
                right: right.unwrap_or_else(none),
            });
        };
        let said = |hit: bool| Some(if hit { "hit" } else { "miss" }.to_owned());
        let right_says = match (right.is_some(), expected.miss) {
            (true, true) => Some("hit or miss".to_owned()),
            (hit, _) => said(hit),
        };
        row(
            "result",
            answer.as_ref().ok().and_then(|hit| said(hit.is_some())),
            right_says,
        );
        let number = |x: f64| format!("{x:?}");
        row(
            "t",
            answered.map(|hit| number(hit.t)),
            right.map(|hit| number(hit.t)),
        );
        row(
            "primitive",
            answered.map(|hit| hit.prim.0.to_string()),
            right.map(|hit| hit.prim.to_string()),
        );
        row(
            "p",
            answered.map(|hit| vector(hit.p)),
            right.map(|hit| vector(hit.p)),
        );
        row(
            "n",
            answered.map(|hit| vector(hit.n)),
            right.and_then(|hit| hit.n).map(vector),
        );
        row(
            "ng",
            answered.map(|hit| vector(hit.ng)),
            right.and_then(|hit| hit.ng).map(vector),
        );
        CaseView {
            scene,
            student: answered.map(|hit| hit.t).into_iter().collect(),
            right: right.map(|hit| hit.t).into_iter().collect(),
            rows,
            failure: answer.err(),
            ..CaseView::new(ray)
        }
    }

    fn of_box([min, max]: &[Xyz; 2], ray: &Ray) -> CaseView {
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
        CaseView {
            boxes: vec![bounds],
            student: ends(answered),
            right: ends(exact),
            rows: vec![Row {
                name: "interval",
                student: answer
                    .as_ref()
                    .map_or("-".to_owned(), |interval| text(*interval)),
                right: text(exact),
            }],
            failure: answer.err(),
            ..CaseView::new(*ray)
        }
    }

    fn of_camera(camera: &Camera, sensor: Vec2) -> CaseView {
        let answer = guarded(|| raygen::generate_ray(camera, sensor));
        let text = |x: f64| format!("{x:?}");
        let point = |p: Option<Vec2>| {
            p.map_or("behind the camera".to_owned(), |p| {
                format!("({:?}, {:?})", p.x, p.y)
            })
        };
        let row = |name, student: &dyn Fn(&Ray) -> String, right: String| Row {
            name,
            student: answer.as_ref().map_or("-".to_owned(), student),
            right,
        };
        let seen = |ray: &Ray| Projection::new(camera).point(ray.o + ray.d);
        let rows = vec![
            row("o", &|ray| vector(ray.o), vector(camera.pos)),
            row(
                "point on the film",
                &|ray| point(seen(ray)),
                point(Some(sensor)),
            ),
            row("length of d", &|ray| text(ray.d.length()), text(1.0)),
            row("min_t", &|ray| text(ray.min_t), text(camera.n_clip)),
            row("max_t", &|ray| text(ray.max_t), text(camera.f_clip)),
        ];
        CaseView {
            camera: Some(*camera),
            rows,
            failure: answer.as_ref().err().cloned(),
            ..CaseView::new(answer.unwrap_or(Ray::new(camera.pos, -camera.c2w.z_axis)))
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
