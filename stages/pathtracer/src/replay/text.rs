//! A replay as text, for `--pixel` and for the list of the window.

use super::record::{
    Outcome, PixelReplay, PrimAnswer, RayRecord, Roulette, SampleRecord, Test, Visit,
};
use crate::tone;
use crate::tracer::RayRole;
use kit::{FilmSize, PixelEstimate, PrimId, Ray, Scene, Vec3};
use std::fmt::Write;

/// The pixel and all its recorded samples.
///
/// `rendered` is the pixel of the picture, which is compared with the mean of the samples. All
/// numbers are written in full: reading them back gives the same values.
pub fn replay(
    scene: &Scene,
    film: FilmSize,
    replay: &PixelReplay,
    rendered: PixelEstimate,
) -> String {
    let mut text = pixel(scene, film, replay);
    let same = if is_same(replay.estimate, rendered) {
        "their mean is the pixel of the picture, bit for bit".to_owned()
    } else {
        format!(
            "their mean is not the pixel of the picture, which is {} with {} samples: two ways to find hits disagree",
            numbers(rendered.radiance.to_array()),
            rendered.samples
        )
    };
    let _ = writeln!(text, "Replay      {} samples: {same}", replay.samples.len());
    for (i, record) in replay.samples.iter().enumerate() {
        text.push('\n');
        text += &sample(scene, film, i, record);
    }
    text
}

/// Whether two estimates are equal, bit for bit. NaN equals the same NaN.
pub fn is_same(a: PixelEstimate, b: PixelEstimate) -> bool {
    let bits = |e: PixelEstimate| (e.radiance.to_array().map(f64::to_bits), e.samples);
    bits(a) == bits(b)
}

/// What is known about the pixel: values, samples, variance, primitive, tests.
pub fn pixel(scene: &Scene, film: FilmSize, replay: &PixelReplay) -> String {
    let (x, y) = replay.pixel;
    let PixelEstimate { radiance, samples } = replay.estimate;
    let [r, g, b] = tone::to_bytes(radiance);
    let mut text = String::new();
    let _ = writeln!(
        text,
        "Pixel       {x} {y} of {} x {}, counted from the bottom left",
        film.w, film.h
    );
    let _ = writeln!(text, "Linear      {}", numbers(radiance.to_array()));
    let _ = writeln!(text, "8 bit       {r} {g} {b}");
    let _ = writeln!(
        text,
        "Samples     {samples}{}",
        match &replay.luminance {
            Some(tally) => format!(", variance of their luminances {:?}", tally.variance()),
            None => String::new(),
        }
    );
    let first = replay.samples.iter().find_map(|sample| sample.rays.first());
    let seen = match first.map(|ray| ray.outcome) {
        Some(Outcome::Hit(hit)) => primitive(scene, hit.prim),
        _ => "none: the first camera ray misses".to_owned(),
    };
    let _ = writeln!(text, "Primitive   {seen}");
    let counts = replay.counters;
    let _ = writeln!(
        text,
        "Tests       {} boxes and {} primitives by {} rays",
        counts.box_tests, counts.prim_tests, counts.rays
    );
    text
}

/// One sample: its rays as a tree, and their tests.
pub fn sample(scene: &Scene, film: FilmSize, index: usize, record: &SampleRecord) -> String {
    let mut text = format!(
        "Sample {}    at {} {} of the film: {}\n",
        index + 1,
        record.sensor.x * f64::from(film.w),
        record.sensor.y * f64::from(film.h),
        numbers(record.radiance.to_array())
    );
    if record.of_path != record.radiance {
        let _ = writeln!(
            text,
            "  with the lamps as other camera rays see them; along this path: {}",
            numbers(record.of_path.to_array())
        );
    }
    for (i, of) in record.rays.iter().enumerate() {
        let indent = "  ".repeat(of.depth as usize + 1);
        let _ = writeln!(text, "{indent}{}", ray(scene, of));
        let played = record.roulette_after(i).map(roulette);
        for line in surface(of).into_iter().chain(played) {
            let _ = writeln!(text, "{indent}  {line}");
        }
        for found in &of.tests {
            let _ = writeln!(text, "{indent}  {}", test(scene, found));
        }
    }
    text
}

/// What a roulette did, in one line.
pub fn roulette(played: &Roulette) -> String {
    let before = numbers(played.throughput.to_array());
    match played.survivor {
        None => format!("roulette: throughput {before}: the path ends"),
        Some(after) if after == played.throughput => {
            format!("roulette: throughput {before}: the path goes on unchanged")
        }
        Some(after) => format!(
            "roulette: throughput {before}: the path goes on with {}",
            numbers(after.to_array())
        ),
    }
}

/// The name of a role.
pub fn role(role: RayRole) -> &'static str {
    match role {
        RayRole::Camera => "camera",
        RayRole::Bounce => "bounce",
        RayRole::Shadow => "shadow",
        RayRole::Light => "light",
    }
}

/// A ray and what it found, in one line.
pub fn ray(scene: &Scene, record: &RayRecord) -> String {
    let Ray { o, d, min_t, max_t } = record.ray;
    format!(
        "{} ray: o = {}, d = {}, t in [{min_t:?}, {max_t:?}]: {}",
        role(record.role),
        vector(o),
        vector(d),
        outcome(scene, record.outcome)
    )
}

/// What a ray found.
pub fn outcome(scene: &Scene, outcome: Outcome) -> String {
    match outcome {
        Outcome::Hit(hit) => format!("hits {} at t = {:?}", primitive(scene, hit.prim), hit.t),
        Outcome::Miss => "misses everything".to_owned(),
        Outcome::Blocked => "blocked".to_owned(),
        Outcome::Unblocked => "reaches the light".to_owned(),
    }
}

/// The point and the normals of a hit, if there is one.
pub fn surface(record: &RayRecord) -> Vec<String> {
    let Outcome::Hit(hit) = record.outcome else {
        return Vec::new();
    };
    vec![
        format!("p = {}", vector(hit.p)),
        format!("n = {} (shading normal)", vector(hit.n)),
        format!("ng = {} (geometric normal)", vector(hit.ng)),
    ]
}

/// A test in one line.
pub fn test(scene: &Scene, test: &Test) -> String {
    match test {
        Test::Box {
            node,
            bounds,
            max_t,
            visit,
        } => {
            let name = match node {
                Some(node) => format!("box {node}"),
                None => format!("box {} to {}", vector(bounds.min), vector(bounds.max)),
            };
            match visit {
                Visit::Entered { entry, exit } => {
                    format!("{name}: entered, t in [{entry:?}, {exit:?}]")
                }
                Visit::Missed => format!("{name}: missed"),
                Visit::Behind { entry } => {
                    format!("{name}: behind max_t = {max_t:?}, would be entered at t = {entry:?}")
                }
                Visit::Pruned { entry, .. } => {
                    format!("{name}: skipped, hit at t = {entry:?} but nothing in it was tested")
                }
            }
        }
        Test::Primitive { prim, answer, .. } => {
            let name = primitive(scene, *prim);
            match answer {
                PrimAnswer::Miss => format!("{name}: miss"),
                PrimAnswer::Hit(t) => format!("{name}: hit at t = {t:?}"),
                PrimAnswer::Blocks => format!("{name}: blocks the ray"),
                PrimAnswer::Skipped => format!("{name}: skipped, the ray starts on it"),
            }
        }
    }
}

/// A primitive and the node of the scene that it belongs to.
pub fn primitive(scene: &Scene, prim: PrimId) -> String {
    let index = prim.0 as usize;
    let kind = match index {
        _ if index < scene.triangles.len() => "triangle",
        _ if index < scene.len() => "sphere",
        // In a case whose test results are given there are no shapes.
        _ => "primitive",
    };
    let object = scene
        .object_of
        .get(index)
        .and_then(|&object| scene.objects.get(object as usize));
    match object {
        Some(object) => format!("{kind} {} of `{}`", prim.0, object.name),
        None => format!("{kind} {}", prim.0),
    }
}

/// A vector, in full.
pub fn vector(v: Vec3) -> String {
    format!("({:?}, {:?}, {:?})", v.x, v.y, v.z)
}

fn numbers(values: [f64; 3]) -> String {
    values.map(|value| format!("{value:?}")).join(" ")
}
