//! The pictures of Part 1, tasks 1 and 2.

use super::{Panel, direction_colour, panel};
use crate::raygen::kit_camera;
use crate::stages::Raygen;
use kit::{FilmSize, PixelSampler, Ray, Spectrum, Vec2, Vec3, math};
use wire::work::Camera;

/// A panel for each number of samples.
pub(super) fn sample_loop(stage: &Raygen, size: [u32; 2], samples: &[u32]) -> Vec<Panel> {
    let film = FilmSize {
        w: size[0],
        h: size[1],
    };
    let mut of_point = |ray: &Ray, _: &mut PixelSampler| world(Vec2::new(ray.o.x, ray.o.y));
    let each = samples.iter().map(|&ns_aa| {
        panel(size, |x, y| {
            let estimate = (stage.raytrace_pixel)(
                x,
                y,
                film,
                ns_aa,
                &mut PixelSampler::new(x, y, 0),
                &mut |point| Ray::new(Vec3::new(point.x, point.y, 1.0), Vec3::NEG_Z),
                &mut of_point,
            );
            estimate.radiance.to_array()
        })
    });
    each.collect()
}

/// Rings around a point that is not the centre; redder to the right, bluer to the left, black
/// outside of the film.
fn world(point: Vec2) -> Spectrum {
    if !(0.0..=1.0).contains(&point.x) || !(0.0..=1.0).contains(&point.y) {
        return Spectrum::BLACK;
    }
    let from_centre = (point - Vec2::new(0.35, 0.4)) * Vec2::new(4.0 / 3.0, 1.0);
    let wave = math::cos(110.0 * from_centre.length_squared());
    let ring = (0.5 + 1.5 * wave).clamp(0.0, 1.0);
    Spectrum::new(0.05 + 0.55 * point.x, 0.25, 0.6 - 0.55 * point.x) * ring
}

/// Degrees between two lines of longitude or latitude.
const GRID: f64 = 10.0;

/// The width of a line in degrees.
const LINE: f64 = 0.5;

/// The directions of a camera's rays.
pub(super) fn camera_rays(stage: &Raygen, size: [u32; 2], camera: &Camera) -> Vec<Panel> {
    let camera = kit_camera(camera);
    let share = |place: u32, count: u32| (f64::from(place) + 0.5) / f64::from(count);
    vec![panel(size, |x, y| {
        let sensor = Vec2::new(share(x, size[0]), share(y, size[1]));
        let d = (stage.generate_ray)(&camera, sensor).d;
        let level = Vec2::new(d.x, d.z).length();
        let latitude = math::atan2(d.y, level).to_degrees();
        let longitude = math::atan2(d.x, -d.z).to_degrees();
        let beside = |angle: f64| (angle - GRID * (angle / GRID).round()).abs();
        let off_line = beside(latitude).min(beside(longitude) * level / d.length());
        let shade = if latitude.abs() < LINE {
            0.0
        } else if off_line < 0.5 * LINE {
            0.4
        } else {
            1.0
        };
        direction_colour(d).map(|channel| shade * channel)
    })]
}
