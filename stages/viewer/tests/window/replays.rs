//! Replays in the window, and where the stages and the truth part.

use super::common::session;
use kit::{PrimId, Primitive, Ray, Vec3};
use pathtracer::RayRole;
use pathtracer::replay::{Outcome, PrimAnswer, RayRecord, Test, Visit};
use std::time::Instant;
use viewer::command::Command;
use viewer::session::Session;
use viewer::truth::{check_pixel, check_ray};

fn replayed(flags: &str, name: &str) -> Session {
    let mut session = session(flags, name);
    session.update(Instant::now());
    session.apply(Command::Render);
    session.update(Instant::now());
    session.apply(Command::Inspect(12, 9));
    session.update(Instant::now());
    session
}

#[test]
fn replays_agree_with_the_picture_and_with_the_oracle() {
    for name in [
        "cornell_mirror_glass.dae",
        "gems.dae",
        "stairs_sky.dae",
        "spheres.dae",
    ] {
        let session = replayed("-r 24 18 -s 4 -m 4", name);
        let inspected = session.inspector.inspected().expect("a replay");
        assert_eq!(inspected.agrees(), Some(true), "{name}");
        assert_eq!(inspected.truth.first_wrong, None, "{name}");
        assert_eq!(inspected.truth.checked, inspected.truth.recorded);
    }
}

/// The rays of the middle row and column are in planes of the grid, and the others meet diagonals:
/// boxes contain them in a face, and a component of the direction is 0.
#[test]
fn rays_along_edges_and_diagonals_agree_with_the_oracle() {
    const SIZE: u32 = 21;
    let mut session = session("-r 21 21 -s 1", "integer_terrain.dae");
    session.update(Instant::now());
    session.apply(Command::Render);
    session.update(Instant::now());
    let mut hits = 0;
    for i in 0..SIZE {
        for (x, y) in [(i, SIZE / 2), (SIZE / 2, i), (i, i)] {
            session.apply(Command::Inspect(x, y));
            session.update(Instant::now());
            let inspected = session.inspector.inspected().expect("a replay");
            assert_eq!(inspected.agrees(), Some(true), "{x} {y}");
            assert_eq!(inspected.truth.first_wrong, None, "{x} {y}");
            let record = &inspected.replay.samples[0].rays[0];
            let d = record.ray.d.abs();
            assert!(d.x == 0.0 || d.z == 0.0 || d.x == d.z, "{x} {y}: {d}");
            hits += usize::from(matches!(record.outcome, Outcome::Hit(_)));
        }
    }
    assert!(hits > 50, "{hits}");
}

/// After two passes the pixel is the mean of both, and so is the replay.
#[test]
fn replays_agree_after_more_samples() {
    let mut session = replayed("-r 24 18 -s 4 -m 4", "cornell_whale.dae");
    session.apply(Command::AddSamples);
    session.update(Instant::now());
    session.apply(Command::Inspect(12, 9));
    session.update(Instant::now());
    let inspected = session.inspector.inspected().expect("a replay");
    assert_eq!(inspected.replay.samples.len(), 8);
    assert_eq!(inspected.agrees(), Some(true));
}

/// The first sample's camera ray of a replay, and the primitives of its scene.
fn with_ray(check: impl FnOnce(&[Primitive<'_>], RayRecord)) {
    let session = replayed("-r 24 18", "cornell_whale.dae");
    let inspected = session.inspector.inspected().expect("a replay");
    let primitives: Vec<Primitive<'_>> = inspected.scene.scene().primitives().collect();
    let record = inspected.replay.samples[0].rays[0].clone();
    assert_eq!(record.role, RayRole::Camera);
    assert!(matches!(record.outcome, Outcome::Hit(_)));
    assert_eq!(check_ray(&primitives, &record).parting, None);
    check(&primitives, record);
}

#[test]
fn a_wrong_primitive_test_is_found() {
    with_ray(|primitives, mut record| {
        let hit = |test: &Test| {
            matches!(
                test,
                Test::Primitive {
                    answer: PrimAnswer::Hit(_),
                    ..
                }
            )
        };
        let at = record.tests.iter().rposition(hit).expect("a hit");
        if let Test::Primitive { answer, .. } = &mut record.tests[at] {
            *answer = PrimAnswer::Miss;
        }
        record.outcome = Outcome::Miss;
        let parting = check_ray(primitives, &record).parting.expect("it is wrong");
        assert_eq!(parting.test, Some(at));
        assert!(
            parting
                .sentence
                .contains("the test says a miss; exactly, the ray hits it"),
            "{}",
            parting.sentence
        );
    });
}

#[test]
fn a_wrong_box_test_is_found() {
    with_ray(|primitives, mut record| {
        if let Test::Box { visit, .. } = &mut record.tests[0] {
            *visit = Visit::Missed;
        }
        record.tests.truncate(1);
        record.outcome = Outcome::Miss;
        let parting = check_ray(primitives, &record).parting.expect("it is wrong");
        assert_eq!(parting.test, Some(0));
        assert!(
            parting
                .sentence
                .contains("intersect_bbox: box 0 is missed; exactly, the ray enters it"),
            "{}",
            parting.sentence
        );
    });
}

#[test]
fn a_primitive_that_was_never_tested_is_named() {
    with_ray(|primitives, mut record| {
        let Outcome::Hit(hit) = record.outcome else {
            panic!("a hit")
        };
        record
            .tests
            .retain(|test| !matches!(test, Test::Primitive { prim, .. } if *prim == hit.prim));
        record.outcome = Outcome::Miss;
        let parting = check_ray(primitives, &record).parting.expect("it is wrong");
        assert!(
            parting
                .sentence
                .contains(&format!("primitive {} is never tested", hit.prim.0)),
            "{}",
            parting.sentence
        );
    });
}

#[test]
fn a_wrong_normal_is_found() {
    with_ray(|primitives, mut record| {
        let Outcome::Hit(hit) = &mut record.outcome else {
            panic!("a hit")
        };
        hit.n = -hit.n;
        let parting = check_ray(primitives, &record).parting.expect("it is wrong");
        assert!(
            parting.sentence.starts_with("the normal is"),
            "{}",
            parting.sentence
        );
    });
}

/// Camera rays are checked against the position of their sample on the film.
#[test]
fn a_wrong_camera_ray_is_found() {
    let session = replayed("-r 24 18", "cornell_whale.dae");
    let inspected = session.inspector.inspected().expect("a replay");
    let mut replay = inspected.replay.clone();
    let ray = &mut replay.samples[0].rays[0].ray;
    *ray = Ray {
        d: (ray.d + 1e-3 * Vec3::X).normalize(),
        ..*ray
    };
    let scene = inspected.scene.scene();
    let truth = check_pixel(scene, &inspected.job.camera, false, &replay);
    let (sample, index, of_ray) = truth.first_wrong.expect("it is wrong");
    assert_eq!((sample, index), (0, 0));
    let parting = of_ray.parting.expect("where");
    assert!(
        parting
            .sentence
            .starts_with("generate_ray: the sample is at"),
        "{}",
        parting.sentence
    );
}

/// A ray never hits the triangle that it starts on, and that is right.
#[test]
fn skipped_primitives_are_not_missed() {
    with_ray(|primitives, record| {
        let Outcome::Hit(hit) = record.outcome else {
            panic!("a hit")
        };
        let skip = Some(PrimId(hit.prim.0));
        let skipping = RayRecord { skip, ..record };
        let truth = check_ray(primitives, &skipping);
        assert_ne!(truth.right.map(|(id, _)| id), Some(hit.prim));
    });
}
