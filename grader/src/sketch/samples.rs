//! Draws the samples of a pixel, and where the ray of a camera goes.

use super::model::{Ink, Layout, Sketch, Stroke, sides};
use judge::shown::ShownPixel;
use kit::camera::half_tan;
use kit::{Camera, PixelSampler, Ray, Vec2};

/// The most samples and the largest film that are drawn.
const SAMPLES: u32 = 16;
const FILM: u32 = 4;

/// The film with the samples of a pixel; `None` if the code's samples are where they should be, or
/// cannot be drawn.
pub(super) fn pixel(shown: &ShownPixel) -> Option<Sketch> {
    let ShownPixel {
        film,
        pixel: [x, y],
        samples,
        seed,
        yours,
    } = shown;
    if *samples > SAMPLES || film.iter().any(|side| *side > FILM) || yours.is_empty() {
        return None;
    }
    let [w, h] = film.map(f64::from);
    let corner = [f64::from(*x), f64::from(*y)];
    let mut sampler = PixelSampler::new(*x, *y, *seed);
    let right = (0..*samples).map(|_| match samples {
        1 => [0.5; 2],
        _ => sampler.get_sample().to_array(),
    });
    let right: Vec<[f64; 2]> = right.map(|p| [0, 1].map(|i| corner[i] + p[i])).collect();
    let yours: Vec<[f64; 2]> = yours.iter().map(|[x, y]| [x * w, y * h]).collect();
    let is_near = |a: &[f64; 2], b: &[f64; 2]| (0..2).all(|i| (a[i] - b[i]).abs() < 1e-9);
    if right.len() == yours.len() && right.iter().zip(&yours).all(|(a, b)| is_near(a, b)) {
        return None;
    }
    let mut strokes = Vec::new();
    let (columns, rows) = (film[0], film[1]);
    for i in 0..=columns {
        let at = f64::from(i);
        strokes.push(Stroke::Line(Ink::Shape, [[at, 0.0], [at, h]]));
    }
    for i in 0..=rows {
        let at = f64::from(i);
        strokes.push(Stroke::Line(Ink::Shape, [[0.0, at], [w, at]]));
    }
    strokes.extend(right.into_iter().map(|at| Stroke::Mark(Ink::Expected, at)));
    let all_finite = yours.as_flattened().iter().all(|x| x.is_finite());
    let near = yours
        .into_iter()
        .filter(|p| p[0].abs() < 3.0 * w && p[1].abs() < 3.0 * h);
    strokes.extend(near.map(|at| Stroke::Mark(Ink::Yours, at)));
    let beyond = match all_finite {
        true => "",
        false => "; a sample of yours is not finite",
    };
    let caption =
        format!("the film, (0, 0) at the bottom left; samples of pixel ({x}, {y}){beyond}");
    Some(Sketch::new(strokes, &caption, Layout::Shape))
}

/// The sensor, with the point through which the ray should go and the point through which it goes.
pub(super) fn camera(camera: &Camera, sensor: Vec2, ray: &Ray) -> Sketch {
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let edges = sides(corners).map(|ends| Stroke::Line(Ink::Shape, ends));
    let mut strokes = edges.to_vec();
    strokes.push(Stroke::Mark(Ink::Expected, sensor.to_array()));
    let local = camera.c2w.transpose() * (ray.o + ray.d - camera.pos);
    let half = [camera.h_fov, camera.v_fov].map(half_tan);
    let place: Vec<f64> = [local.x, local.y]
        .into_iter()
        .zip(half)
        .map(|(along, half)| 0.5 + 0.5 * along / -local.z / half)
        .collect();
    let at = [place[0], place[1]];
    let seen = "the sensor, (0, 0) at the bottom left";
    let caption = match local.z < 0.0 && at.iter().all(|x| x.abs() < 4.0) {
        true => {
            strokes.push(Stroke::Mark(Ink::Yours, at));
            seen.to_owned()
        }
        false if !local.is_finite() => format!("{seen}; your ray is not finite"),
        false => format!("{seen}; your ray does not cross it"),
    };
    Sketch::new(strokes, &caption, Layout::Shape)
}
