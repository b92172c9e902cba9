//! Runs Part 1, tasks 1 and 2, with a camera and a world that record their calls.

use crate::convert;
use crate::stages::Raygen;
use kit::{FilmSize, Mat3, PixelSampler, Spectrum, Vec2, Vec3};
use wire::answer::PixelAnswer;
use wire::work::{CameraWork, PixelWork, PixelWorld};

pub(crate) fn pixels(stage: &Raygen, work: &PixelWork) -> Vec<PixelAnswer> {
    let calls: Vec<_> = work.calls().collect();
    harness::each_call(&calls, |_, &(place, seed)| pixel(stage, work, place, seed))
}

fn pixel(stage: &Raygen, work: &PixelWork, [x, y]: [u32; 2], seed: u64) -> PixelAnswer {
    let film = FilmSize {
        w: work.film[0],
        h: work.film[1],
    };
    let mut points: Vec<Vec2> = Vec::new();
    let mut traced_points: Vec<Option<Vec2>> = Vec::new();
    let mut traced_radiance: Vec<Spectrum> = Vec::new();
    let asked_for = || samples(work.ns_aa);
    let estimate = (stage.raytrace_pixel)(
        x,
        y,
        film,
        work.ns_aa,
        &mut PixelSampler::new(x, y, seed),
        &mut |point| {
            harness::limit_calls("camera_ray", points.len(), asked_for);
            points.push(point);
            camera_stub(point)
        },
        &mut |ray, sampler| {
            harness::limit_calls("trace_ray", traced_points.len(), asked_for);
            let point = Vec2::new(ray.o.x, ray.o.y);
            let from_camera = *ray == camera_stub(point);
            let world = radiance(work.world, point, traced_radiance.len(), sampler);
            let radiance = world * Spectrum::from(work.gain);
            traced_points.push(from_camera.then_some(point));
            traced_radiance.push(radiance);
            radiance
        },
    );
    let index = |point: &Vec2| {
        points
            .iter()
            .position(|p| p == point)
            .and_then(|i| u32::try_from(i).ok())
    };
    PixelAnswer {
        traced: traced_points
            .iter()
            .map(|point| point.as_ref().and_then(index))
            .collect(),
        points: points.iter().map(|&p| p.into()).collect(),
        traced_radiance: traced_radiance.iter().map(|s| s.to_array()).collect(),
        radiance: estimate.radiance.to_array(),
        samples: estimate.samples,
    }
}

fn samples(count: u32) -> String {
    match count {
        1 => "1 sample".into(),
        _ => format!("{count} samples"),
    }
}

/// A ray whose origin identifies the film point it was made for.
fn camera_stub(point: Vec2) -> kit::Ray {
    kit::Ray {
        o: Vec3::new(point.x, point.y, 2.0),
        d: Vec3::NEG_Z,
        min_t: 0.25,
        max_t: 64.0,
    }
}

fn radiance(world: PixelWorld, point: Vec2, call: usize, sampler: &mut PixelSampler) -> Spectrum {
    match world {
        PixelWorld::Constant(radiance) => radiance.into(),
        PixelWorld::Ramp => Spectrum::new(point.x, point.y, point.x * point.y),
        PixelWorld::Flicker(radiance) if call.is_multiple_of(2) => radiance.into(),
        PixelWorld::Flicker(_) => Spectrum::BLACK,
        PixelWorld::Numbers => {
            let number = sampler.next_1d();
            Spectrum::new(number, number, number)
        }
        PixelWorld::Rings => rings(point),
    }
}

/// `0.35 (1 + cos(k r²))` at the distance `r` from the centre of the film, with a `k` for each
/// channel.
fn rings(point: Vec2) -> Spectrum {
    let squared = (point - 0.5).length_squared();
    let ring = |k: f64| 0.35 + 0.35 * kit::math::cos(k * squared);
    Spectrum::new(ring(300.0), ring(330.0), ring(360.0))
}

pub(crate) fn camera_rays(stage: &Raygen, work: &CameraWork) -> Vec<wire::work::Ray> {
    let cameras = work.cameras.iter();
    let pairs = cameras.flat_map(|camera| work.sensor.iter().map(move |point| (camera, point)));
    harness::each_call(&pairs.collect::<Vec<_>>(), |_, (camera, point)| {
        let ray = (stage.generate_ray)(&kit_camera(camera), Vec2::from(**point));
        convert::wire_ray(&ray)
    })
}

pub(crate) fn kit_camera(c: &wire::work::Camera) -> kit::Camera {
    let [right, up, backward] = c.c2w.map(Vec3::from);
    kit::Camera {
        pos: Vec3::from(c.pos),
        c2w: Mat3::from_cols(right, up, backward),
        h_fov: c.h_fov,
        v_fov: c.v_fov,
        n_clip: c.n_clip,
        f_clip: c.f_clip,
    }
}
