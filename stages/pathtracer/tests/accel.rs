//! Pictures do not depend on the acceleration structure, bit for bit.
// BEGIN SOLUTION(part6.task1)

use crate::common::{own_scenes, scene_files};
use kit::{FilmSize, LitScene};
use pathtracer::{Accel, AccelKind, Job, LightSettings, Rendered, Textures, render_lit};
use scenes::placement;
use std::sync::atomic::AtomicBool;

fn render(lit: &LitScene, kind: AccelKind) -> Rendered {
    let film = FilmSize { w: 24, h: 18 };
    let job = Job {
        camera: placement::place(&lit.scene, film).camera,
        film,
        cell: film.whole(),
        samples: 4,
        sampling: 5.into(),
    };
    let settings = LightSettings {
        max_depth: 5,
        ..LightSettings::default()
    };
    let accel = Accel::build(kind, &lit.scene);
    let (stop, textures) = (AtomicBool::new(false), Textures::default());
    render_lit(lit, &textures, &accel, &job, &settings, &stop, &|_, _| {})
}

#[test]
fn pictures_do_not_depend_on_the_acceleration_structure() {
    for file in scene_files(&[own_scenes()]) {
        let mut scene = scenes::load(&file).expect("a scene").scene;
        scene.textures = Default::default();
        let lit = LitScene::new(scene, None);
        let [brute, bvh, simd] =
            [AccelKind::Brute, AccelKind::Bvh, AccelKind::Simd].map(|kind| render(&lit, kind));
        let name = file.display();
        for (accel, other) in [("bvh", &bvh), ("simd", &simd)] {
            assert!(other.film == brute.film, "{name}: --accel {accel} differs");
            assert_eq!(other.counters.rays, brute.counters.rays, "{name}");
            // A scene of few blocks has no box tests.
            let tests = other.counters.prim_tests;
            assert!(tests > 0, "{name}: --accel {accel} counts no tests");
        }
    }
}
// END SOLUTION(part6.task1)
