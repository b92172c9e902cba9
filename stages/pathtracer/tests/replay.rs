//! Replays of pixels: the mean of the recorded samples is the rendered pixel, bit for bit.

use crate::common::{own_scenes, scene_files};
use kit::film::Cell;
use kit::sampler::{Pattern, Sampling};
use kit::{FilmSize, NodeKind, PrimId};
use pathtracer::args::Shade;
use pathtracer::replay::text::is_same;
use pathtracer::replay::{
    MAX_RECORDED_SAMPLES, Outcome, PixelReplay, PrimAnswer, RayRecord, Test, Visit, heat_map,
};
use pathtracer::{
    Accel, AccelKind, DirectSampling, Job, LightSettings, Picture, PreparedScene,
    ProgressiveRender, RayRole, Textures, replay_pixel,
};
use std::path::Path;
use std::sync::atomic::AtomicBool;

const FILM: FilmSize = FilmSize { w: 24, h: 18 };

fn prepared(path: &Path, shade: Shade, kind: AccelKind) -> PreparedScene {
    let scene = scenes::load(path).expect("a scene").scene;
    let picture = Picture::new(shade, scene, None);
    let folder = path.parent().expect("a folder");
    let (textures, _) = Textures::load(picture.scene(), folder);
    PreparedScene::new(picture, textures, kind)
}

fn job(scene: &PreparedScene, samples: u32) -> Job {
    Job {
        camera: scenes::placement::place(scene.scene(), FILM).camera,
        film: FILM,
        cell: FILM.whole(),
        samples,
        sampling: Sampling {
            pattern: Pattern::Sobol,
            seed: 3,
            first_sample: 0,
        },
    }
}

fn rendered(scene: &PreparedScene, job: Job, light: LightSettings) -> ProgressiveRender {
    let mut render = ProgressiveRender::new(scene, job, light);
    render.run(scene, usize::MAX, &AtomicBool::new(false));
    render
}

fn replayed(
    scene: &PreparedScene,
    accel: &Accel,
    job: &Job,
    light: &LightSettings,
    passes: u32,
    pixel: (u32, u32),
) -> PixelReplay {
    replay_pixel(
        &scene.picture,
        &scene.textures,
        accel,
        job,
        light,
        passes,
        pixel,
    )
}

/// Pixels spread over the film.
fn some_pixels() -> impl Iterator<Item = (u32, u32)> {
    (0..FILM.h)
        .step_by(4)
        .flat_map(|y| (y % 3..FILM.w).step_by(5).map(move |x| (x, y)))
}

/// The picture is rendered with the fastest tree and packets, the replay with the binary tree.
fn assert_replays_every_pixel(scene: &PreparedScene, job: Job, light: LightSettings, name: &str) {
    let tree = Accel::build(AccelKind::Bvh, scene.scene());
    let mut render = rendered(scene, job, light);
    for passes in 1..=2 {
        for (x, y) in some_pixels() {
            let replay = replayed(scene, &tree, &job, &light, passes, (x, y));
            let pixel = render.rendered().film.get(x, y);
            assert!(
                is_same(replay.estimate, pixel),
                "{name}, pixel {x} {y} after {passes} passes: {:?} is not {pixel:?}",
                replay.estimate
            );
            if let Some(tally) = &replay.luminance {
                let i = (y * FILM.w + x) as usize;
                assert_eq!(*tally, render.rendered().luminance[i], "{name} {x} {y}");
            }
        }
        render.add_pass();
        render.run(scene, usize::MAX, &AtomicBool::new(false));
    }
}

#[test]
fn the_mean_of_a_replay_is_the_pixel_in_every_scene() {
    for path in scene_files(&[own_scenes()]) {
        let name = path.display().to_string();
        let scene = prepared(&path, Shade::Auto, AccelKind::Simd);
        let light = LightSettings {
            max_depth: 5,
            light_samples: 2,
            ..LightSettings::default()
        };
        assert_replays_every_pixel(&scene, job(&scene, 3), light, &name);
    }
}

#[test]
fn the_mean_of_a_replay_is_the_pixel_with_every_setting() {
    let path = own_scenes().join("cornell_mirror_glass.dae");
    let scene = prepared(&path, Shade::Auto, AccelKind::Bvh);
    let default = LightSettings {
        max_depth: 4,
        ..LightSettings::default()
    };
    let settings = [
        LightSettings {
            direct_sampling: DirectSampling::Hemisphere,
            ..default
        },
        LightSettings {
            direct_sampling: DirectSampling::Mis,
            ..default
        },
        LightSettings {
            adaptive: Some((4, 0.2)),
            ..default
        },
        LightSettings {
            max_depth: 0,
            ..default
        },
        LightSettings {
            roulette: false,
            ..default
        },
        LightSettings {
            lamp_rays: 4,
            ..default
        },
    ];
    for light in settings {
        let name = format!("{light:?}");
        assert_replays_every_pixel(&scene, job(&scene, 8), light, &name);
        assert_replays_every_pixel(&scene, job(&scene, 1), light, &name);
    }
    let normals = prepared(&path, Shade::Normals, AccelKind::Brute);
    assert_replays_every_pixel(&normals, job(&normals, 4), default, "normals");
}

/// A replay of the middle of a Cornell box, with the tree that it went through.
fn cornell() -> (PreparedScene, Accel, PixelReplay) {
    let path = own_scenes().join("cornell_whale.dae");
    let scene = prepared(&path, Shade::Auto, AccelKind::Bvh);
    let light = LightSettings {
        max_depth: 3,
        ..LightSettings::default()
    };
    let tree = scene.accel.clone();
    let job = job(&scene, 16);
    let replay = replayed(&scene, &tree, &job, &light, 1, (12, 8));
    (scene, tree, replay)
}

fn rays(replay: &PixelReplay) -> impl Iterator<Item = &RayRecord> {
    replay.samples.iter().flat_map(|sample| &sample.rays)
}

#[test]
fn rays_form_a_tree_by_role() {
    let (_, _, replay) = cornell();
    for sample in &replay.samples {
        for (i, ray) in sample.rays.iter().enumerate() {
            let Some(parent) = ray.parent else {
                assert_eq!((i, ray.role, ray.depth), (0, RayRole::Camera, 0));
                continue;
            };
            assert!(parent < i);
            let parent = &sample.rays[parent];
            assert_eq!(ray.depth, parent.depth + 1);
            let Outcome::Hit(hit) = parent.outcome else {
                panic!("a ray starts where no surface was hit: {ray:?}");
            };
            assert!(
                ray.ray.o.distance(hit.p) < 1e-6,
                "{ray:?} starts at {hit:?}"
            );
        }
    }
    for role in [RayRole::Camera, RayRole::Bounce, RayRole::Shadow] {
        assert!(rays(&replay).any(|ray| ray.role == role), "no {role:?}");
    }
}

/// A path that survives goes on from the surface where roulette was played, and one that ends does
/// not.
#[test]
fn roulettes_stand_where_paths_go_on_or_end() {
    let (scene, tree, _) = cornell();
    let light = LightSettings {
        max_depth: 12,
        ..LightSettings::default()
    };
    let replay_with = |light| {
        let picture = &scene.picture;
        let job = job(&scene, 32);
        replay_pixel(picture, &scene.textures, &tree, &job, &light, 1, (11, 4))
    };
    let (mut ended, mut weighted) = (0, 0);
    for sample in &replay_with(light).samples {
        for played in &sample.roulettes {
            let goes_on = sample
                .rays
                .iter()
                .any(|ray| ray.role == RayRole::Bounce && ray.parent == Some(played.ray));
            assert_eq!(goes_on, played.survivor.is_some());
            assert!(matches!(sample.rays[played.ray].outcome, Outcome::Hit(_)));
            ended += usize::from(!goes_on);
            weighted += usize::from(
                played
                    .survivor
                    .is_some_and(|after| after != played.throughput),
            );
        }
    }
    assert!(
        ended > 0 && weighted > 0,
        "{ended} ended, {weighted} weighted"
    );
    let without = LightSettings {
        roulette: false,
        ..light
    };
    let none = replay_with(without);
    assert!(
        none.samples
            .iter()
            .all(|sample| sample.roulettes.is_empty())
    );
}

#[test]
fn recorded_tests_are_those_that_were_counted() {
    let (scene, tree, replay) = cornell();
    let (mut boxes, mut prims) = (0, 0);
    for ray in rays(&replay) {
        let (of_boxes, of_prims) = ray.test_counts();
        boxes += of_boxes as u64;
        prims += of_prims as u64;
    }
    assert_eq!(boxes, replay.counters.box_tests);
    assert_eq!(prims, replay.counters.prim_tests);
    assert_eq!(rays(&replay).count() as u64, replay.counters.rays);

    let light = LightSettings {
        max_depth: 3,
        ..LightSettings::default()
    };
    let stop = AtomicBool::new(false);
    let job = job(&scene, 16);
    let map = heat_map(&scene.picture, &scene.textures, &tree, &job, &light, &stop);
    assert_eq!(map.get(12, 8), replay.counters);
    let (x, y) = map.costliest(|pixel| pixel.box_tests).expect("pixels");
    let most = map.pixels.iter().map(|pixel| pixel.box_tests).max();
    assert_eq!(Some(map.get(x, y).box_tests), most);
}

/// The reference visits children of visited nodes only, and tests the primitives of visited leaves.
#[test]
fn boxes_say_whether_they_were_visited() {
    let (_, tree, replay) = cornell();
    let Accel::Bvh(tree) = tree else {
        panic!("a binary tree")
    };
    let mut kinds = [0; 4];
    for ray in rays(&replay) {
        let mut visited = Vec::new();
        let mut leaf_prims: Vec<PrimId> = Vec::new();
        for test in &ray.tests {
            match test {
                Test::Box {
                    node,
                    bounds,
                    visit,
                    ..
                } => {
                    let node = node.expect("every box is that of a node");
                    assert_eq!(tree.nodes[node as usize].bounds, *bounds);
                    kinds[match visit {
                        Visit::Entered { .. } => 0,
                        Visit::Missed => 1,
                        Visit::Behind { .. } => 2,
                        Visit::Pruned { .. } => 3,
                    }] += 1;
                    if matches!(visit, Visit::Entered { .. }) {
                        visited.push(node);
                    }
                }
                Test::Primitive { prim, .. } => leaf_prims.push(*prim),
            }
        }
        let mut in_visited_leaves: Vec<PrimId> = visited
            .iter()
            .filter_map(|&node| match tree.nodes[node as usize].kind {
                NodeKind::Leaf { first, count } => Some(tree.leaf(first, count)),
                NodeKind::Interior { .. } => None,
            })
            .flatten()
            .copied()
            .collect();
        if ray.role != RayRole::Shadow {
            in_visited_leaves.sort();
            leaf_prims.sort();
            assert_eq!(leaf_prims, in_visited_leaves);
        }
    }
    assert!(kinds.iter().all(|&count| count > 0), "{kinds:?}");
}

#[test]
fn a_ray_skips_the_triangle_that_it_starts_on() {
    let (_, _, replay) = cornell();
    let mut skipped = 0;
    for ray in rays(&replay) {
        for test in &ray.tests {
            if let Test::Primitive { prim, answer, .. } = test {
                assert_eq!(*answer == PrimAnswer::Skipped, ray.skip == Some(*prim));
                skipped += usize::from(*answer == PrimAnswer::Skipped);
            }
        }
    }
    assert!(skipped > 0);
}

#[test]
fn rays_of_many_samples_are_not_all_kept() {
    let path = own_scenes().join("spheres.dae");
    let scene = prepared(&path, Shade::Normals, AccelKind::Bvh);
    let job = job(&scene, MAX_RECORDED_SAMPLES as u32 + 10);
    let light = LightSettings::default();
    let replay = replayed(&scene, &scene.accel, &job, &light, 1, (12, 9));
    assert_eq!(replay.samples.len(), MAX_RECORDED_SAMPLES + 10);
    let with_rays = replay
        .samples
        .iter()
        .filter(|sample| !sample.rays.is_empty());
    assert_eq!(with_rays.count(), MAX_RECORDED_SAMPLES);
}

/// Stopping and resuming changes no bit, and a stopped tile is rendered again.
#[test]
fn a_stopped_render_resumes_to_the_same_picture() {
    let path = own_scenes().join("cornell_spheres.dae");
    let scene = prepared(&path, Shade::Auto, AccelKind::Simd);
    let cell = Cell {
        x0: 3,
        y0: 1,
        x1: 23,
        y1: 17,
    };
    let job = Job {
        cell,
        ..job(&scene, 4)
    };
    let light = LightSettings::default();
    let whole = rendered(&scene, job, light);
    assert!(whole.is_done());

    let mut parts = ProgressiveRender::new(&scene, job, light);
    assert_eq!(parts.progress(), 0.0);
    parts.run(&scene, 1, &AtomicBool::new(false));
    assert!(parts.progress() > 0.0 && !parts.is_done());
    let before = parts.rendered().clone();
    parts.run(&scene, 100, &AtomicBool::new(true));
    assert_eq!(
        before.film,
        parts.rendered().film,
        "a stopped run adds nothing"
    );
    while !parts.is_done() {
        parts.run(&scene, 1, &AtomicBool::new(false));
    }
    assert_eq!(parts.rendered().film, whole.rendered().film);
    assert_eq!(parts.rendered().luminance, whole.rendered().luminance);
    assert_eq!(parts.rendered().counters, whole.rendered().counters);
}
