//! Clamping indirect light: what it removes is counted, and nothing else changes.

use crate::common::own_scenes;
use kit::FilmSize;
use pathtracer::args::Shade;
use pathtracer::{
    AccelKind, DirectSampling, Job, LightSettings, Passes, Picture, PreparedScene, Rendered,
    Textures,
};
use scenes::placement;
use std::sync::atomic::AtomicBool;

/// Glass above a diffuse floor: caustics have fireflies.
fn prepared(kind: AccelKind) -> PreparedScene {
    let file = own_scenes().join("cornell_mirror_glass.dae");
    let scene = scenes::load(&file).expect("a scene").scene;
    let picture = Picture::new(Shade::Lit, scene, None);
    PreparedScene::new(picture, Textures::default(), kind)
}

fn render(scene: &PreparedScene, settings: LightSettings, threads: usize) -> Rendered {
    let film = FilmSize { w: 24, h: 18 };
    let job = Job {
        camera: placement::place(scene.scene(), film).camera,
        film,
        cell: film.whole(),
        // Several passes.
        samples: 11,
        sampling: 3.into(),
    };
    let passes = Passes {
        scene,
        job,
        settings,
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let never = AtomicBool::new(false);
    let pool = pool.expect("threads");
    pool.install(|| passes.render(&never, &|_| (), &mut |_| true))
}

fn settings(direct_sampling: DirectSampling, clamp: Option<f64>) -> LightSettings {
    LightSettings {
        max_depth: 7,
        direct_sampling,
        clamp,
        ..LightSettings::default()
    }
}

#[test]
fn what_is_removed_is_what_is_missing() {
    let scene = prepared(AccelKind::Simd);
    for sampling in [
        DirectSampling::Lights,
        DirectSampling::Mis,
        DirectSampling::Hemisphere,
    ] {
        let whole = render(&scene, settings(sampling, None), 2);
        assert_eq!(whole.removed_luminance(), None);
        let whole = whole.mean_luminance();
        let mut last = 0.0;
        for limit in [1.0, 0.3, 0.1, 0.03] {
            let clamped = render(&scene, settings(sampling, Some(limit)), 2);
            let removed = clamped.removed_luminance().expect("it is counted");
            let sum = clamped.mean_luminance() + removed;
            assert!(
                (sum / whole - 1.0).abs() < 1e-12,
                "{sampling:?} {limit}: {sum} {whole}"
            );
            assert!(
                last < removed && removed < whole,
                "{sampling:?} {limit}: {removed}"
            );
            last = removed;
        }
    }
}

#[test]
fn a_limit_that_nothing_reaches_changes_no_bit() {
    let scene = prepared(AccelKind::Simd);
    let whole = render(&scene, settings(DirectSampling::Lights, None), 2);
    let limited = render(&scene, settings(DirectSampling::Lights, Some(1e100)), 2);
    assert!(limited.film == whole.film);
    assert_eq!(limited.removed_luminance(), Some(0.0));
}

#[test]
fn neither_the_picture_nor_the_count_depends_on_the_threads() {
    let scene = prepared(AccelKind::Simd);
    let [one, three] = [1, 3].map(|threads| {
        let settings = settings(DirectSampling::Lights, Some(0.2));
        render(&scene, settings, threads)
    });
    assert!(one.film == three.film && one.removed == three.removed);
    assert!(one.removed_luminance() > Some(0.0));
}

/// Direct light, and lamps in mirrors and behind glass, are far brighter than the limit.
#[test]
fn direct_light_is_not_clamped() {
    for kind in [AccelKind::Bvh, AccelKind::Simd] {
        let scene = prepared(kind);
        let at_depth = |max_depth, clamp| {
            let settings = LightSettings {
                max_depth,
                ..settings(DirectSampling::Lights, clamp)
            };
            render(&scene, settings, 2)
        };
        assert!(at_depth(1, None).film == at_depth(1, Some(1e-3)).film);
        // The first surface behind the mirror has direct light, too: only its indirect light is
        // clamped.
        let clamped = at_depth(7, Some(1e-3));
        let pixels = clamped.film.pixels().iter();
        let brightest = pixels.map(|p| p.radiance.luminance()).fold(0.0, f64::max);
        assert!(brightest > 1.0, "{brightest}");
    }
}
