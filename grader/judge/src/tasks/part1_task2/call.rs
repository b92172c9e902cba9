//! One call in words and shown.

use crate::tools::aspects::hits::show;
use crate::tools::call_text::{holding, point};
use crate::tools::convert;
use crate::tools::shown::{ComparedNumber, ShownCall, ShownRay};
use kit::camera::half_tan;
use kit::{Mat3, Ray, Vec2, Vec3};
use wire::work::{self, Camera, CameraWork, Xyz};

/// The camera and the point of the sensor of a call.
fn inputs(work: &CameraWork, call: usize) -> Option<(&Camera, [f64; 2])> {
    let points = work.sensor.len().max(1);
    Some((
        work.cameras.get(call / points)?,
        *work.sensor.get(call % points)?,
    ))
}

/// The axes of a camera that is not turned.
const STRAIGHT: [Xyz; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

pub(super) fn input(work: &CameraWork, call: usize) -> Option<String> {
    let (camera, [x, y]) = inputs(work, call)?;
    let turned = match camera.c2w == STRAIGHT {
        true => String::new(),
        false => {
            let [right, up, back] = camera.c2w.map(point);
            format!(", c2w = [{right}, {up}, {back}]")
        }
    };
    Some(format!(
        "sensor = ({x:?}, {y:?}), camera at {}{turned}, h_fov = {:?}, v_fov = {:?}",
        point(camera.pos),
        camera.h_fov,
        camera.v_fov
    ))
}

/// The circumstances of a call.
pub(super) fn circumstances(work: &CameraWork, call: usize) -> Option<Vec<&'static str>> {
    let (camera, [u, v]) = inputs(work, call)?;
    let Camera {
        c2w,
        pos,
        h_fov,
        v_fov,
        ..
    } = camera;
    Some(holding(&[
        (*c2w != STRAIGHT, "the camera is turned"),
        (*pos != [0.0; 3], "the camera is not at the world's origin"),
        (h_fov != v_fov, "h_fov and v_fov differ"),
        (u < 0.5, "the sensor point is left of the middle"),
        (u > 0.5, "the sensor point is right of the middle"),
        (v < 0.5, "the sensor point is below the middle"),
        (v > 0.5, "the sensor point is above the middle"),
        (u != 0.5 || v != 0.5, "the sensor point is not the middle"),
        (
            u != 0.5 && v != 0.5,
            "the sensor point is off the middle along both axes",
        ),
        (
            [u, v].iter().any(|x| !(0.0..=1.0).contains(x)),
            "the sensor point is beyond the film",
        ),
    ]))
}

/// The largest distance on the film between a sample and the point where its ray goes.
const SENSOR_TOLERANCE: f64 = 1e-9;

/// The largest difference of the length of a unit vector from 1: a normalisation has about 4
/// roundings.
const UNIT_TOLERANCE: f64 = 1e-14;

/// The camera, and the ray that the code generated; without it, the camera's axis.
pub(super) fn shown(
    work: &CameraWork,
    call: usize,
    answers: Option<&Vec<work::Ray>>,
) -> Option<ShownCall> {
    let (camera, sensor) = inputs(work, call)?;
    let camera = camera_of(camera);
    let yours = answers.and_then(|rays| rays.get(call)).map(convert::ray);
    let axis = Ray::new(camera.pos, -camera.c2w.z_axis);
    Some(ShownCall::Ray(ShownRay {
        camera: Some((camera, sensor.into())),
        rows: rows(&camera, sensor.into(), yours.as_ref()),
        ..ShownRay::new(yours.unwrap_or(axis))
    }))
}

/// The point of the film where the ray goes; `None` behind the camera.
fn film_point(camera: &kit::Camera, ray: &Ray) -> Option<Vec2> {
    let local = camera.c2w.transpose() * (ray.o + ray.d - camera.pos);
    let half = [camera.h_fov, camera.v_fov].map(half_tan);
    let at = |along: f64, half: f64| 0.5 + 0.5 * along / -local.z / half;
    (local.z < 0.0).then(|| Vec2::new(at(local.x, half[0]), at(local.y, half[1])))
}

fn rows(camera: &kit::Camera, sensor: Vec2, yours: Option<&Ray>) -> Vec<ComparedNumber> {
    let text = |at: Option<Vec2>| {
        at.map_or("behind the camera".to_owned(), |p| {
            format!("({:?}, {:?})", p.x, p.y)
        })
    };
    let row = |name,
               yours_text: &dyn Fn(&Ray) -> String,
               expected: String,
               is_right: &dyn Fn(&Ray) -> bool| ComparedNumber {
        name,
        yours: yours.map(yours_text),
        expected: Some(expected),
        is_right: yours.is_some_and(is_right),
    };
    let is_there = |ray: &Ray| {
        film_point(camera, ray).is_some_and(|at| at.distance(sensor) <= SENSOR_TOLERANCE)
    };
    let length = |ray: &Ray| ray.d.length();
    vec![
        row("o", &|ray| show(ray.o), show(camera.pos), &|ray| {
            ray.o == camera.pos
        }),
        row(
            "point on the film",
            &|ray| text(film_point(camera, ray)),
            text(Some(sensor)),
            &is_there,
        ),
        row(
            "length of d",
            &|ray| format!("{:?}", length(ray)),
            "1.0".to_owned(),
            &|ray| (length(ray) - 1.0).abs() <= UNIT_TOLERANCE,
        ),
        row(
            "min_t",
            &|ray| format!("{:?}", ray.min_t),
            format!("{:?}", camera.n_clip),
            &|ray| ray.min_t == camera.n_clip,
        ),
        row(
            "max_t",
            &|ray| format!("{:?}", ray.max_t),
            format!("{:?}", camera.f_clip),
            &|ray| ray.max_t == camera.f_clip,
        ),
    ]
}

fn camera_of(camera: &Camera) -> kit::Camera {
    let [x, y, z] = camera.c2w.map(Vec3::from);
    kit::Camera {
        pos: camera.pos.into(),
        c2w: Mat3::from_cols(x, y, z),
        h_fov: camera.h_fov,
        v_fov: camera.v_fov,
        n_clip: camera.n_clip,
        f_clip: camera.f_clip,
    }
}

/// A sentence about all cameras and points.
pub(super) fn overview(work: &CameraWork) -> String {
    let range = |angle: fn(&Camera) -> f64| {
        let angles = work.cameras.iter().map(angle);
        let (low, high) = angles.fold((f64::INFINITY, 0.0_f64), |(low, high), angle| {
            (low.min(angle), high.max(angle))
        });
        match low == high {
            true => format!("{low:.1}"),
            false => format!("{low:.1} to {high:.1}"),
        }
    };
    format!(
        "{}, fields of view {} degrees across and {} degrees up; {} of the sensor, for each camera",
        crate::tools::plural(work.cameras.len(), "camera", "cameras"),
        range(|camera| camera.h_fov),
        range(|camera| camera.v_fov),
        crate::tools::plural(work.sensor.len(), "point", "points")
    )
}
