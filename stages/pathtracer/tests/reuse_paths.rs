//! Pixels that share what their paths find, and caustic rays: less error in the same picture,
//! whatever its cells.
// BEGIN SOLUTION(part6.task2)

use crate::common::own_scenes;
use kit::film::Cell;
use kit::sampler::{Pattern, Sampling};
use kit::{Camera, FilmSize, LitScene};
use pathtracer::{Accel, AccelKind, Job, LightSettings, Rendered, Textures, render_lit};
use scenes::placement;
use std::sync::atomic::AtomicBool;

/// Neither a multiple of a tile nor of a block.
const FILM: FilmSize = FilmSize { w: 37, h: 35 };

struct Room {
    lit: LitScene,
    camera: Camera,
    accel: Accel,
}

fn room(file: &str) -> Room {
    let scene = scenes::load(own_scenes().join(file))
        .expect("a scene")
        .scene;
    let camera = placement::place(&scene, FILM).camera;
    let lit = LitScene::new(scene, None);
    let accel = Accel::build(AccelKind::Simd, &lit.scene);
    Room { lit, camera, accel }
}

impl Room {
    fn render(
        &self,
        cell: Cell,
        (samples, seed): (u32, u64),
        [reuse_paths, guide_caustics]: [bool; 2],
    ) -> Rendered {
        let job = Job {
            camera: self.camera,
            film: FILM,
            cell,
            samples,
            sampling: Sampling {
                pattern: Pattern::Sobol4,
                seed,
                first_sample: 0,
            },
        };
        let settings = LightSettings {
            max_depth: 4,
            lamp_rays: 4,
            reuse_paths,
            guide_caustics,
            ..LightSettings::default()
        };
        let (textures, stop) = (Textures::default(), AtomicBool::new(false));
        render_lit(
            &self.lit,
            &textures,
            &self.accel,
            &job,
            &settings,
            &stop,
            &|_, _| {},
        )
    }
}

/// The second room has a tree, and more samples than a block traces at once.
#[test]
fn a_pixel_is_the_same_in_every_cell() {
    for (file, samples) in [("cornell_mirror_glass.dae", 6), ("cornell_whale.dae", 521)] {
        let room = room(file);
        let cell = Cell {
            x0: 3,
            y0: 5,
            x1: 10,
            y1: 8,
        };
        let around = Cell {
            x0: 1,
            y0: 4,
            x1: 12,
            y1: 9,
        };
        let [part, whole] =
            [cell, around].map(|cell| room.render(cell, (samples, 1), [true, true]));
        for (x, y) in cell.pixels() {
            assert_eq!(
                part.film.get(x, y),
                whole.film.get(x, y),
                "{file}: ({x}, {y})"
            );
            assert_eq!(part.film.get(x, y).samples, samples);
        }
        assert!(whole.counters.reuse_rays > 0, "{file}");
    }
}

/// Pixels outside of a cell are traced at its border, not at that of each tile.
#[test]
fn cells_need_few_rays_more_than_their_part_of_the_film() {
    let room = room("cornell_spheres.dae");
    let [cell, whole] = [1, 0].map(|x0| Cell { x0, ..FILM.whole() });
    let [cell, whole] =
        [cell, whole].map(|cell| room.render(cell, (2, 1), [true, false]).counters.rays);
    assert!(cell <= whole, "{cell} {whole}");
}

/// Pictures of two seeds differ by the error of both.
fn squared_error_by(file: &str, flags: [bool; 2]) -> f64 {
    let room = room(file);
    let squared_error = |flags| -> f64 {
        let [a, b] = [1, 2].map(|seed| room.render(FILM.whole(), (32, seed), flags));
        let pairs = a.film.pixels().iter().zip(b.film.pixels());
        pairs
            .map(|(a, b)| (a.radiance.luminance() - b.radiance.luminance()).powi(2))
            .sum()
    };
    squared_error(flags) / squared_error([false, false])
}

#[test]
fn shared_paths_and_caustic_rays_have_less_error() {
    let shared = squared_error_by("cornell_spheres.dae", [true, false]);
    assert!(shared < 0.5, "{shared}");
    let guided = squared_error_by("cornell_mirror_glass.dae", [false, true]);
    assert!(guided < 0.7, "{guided}");
}
// END SOLUTION(part6.task2)
