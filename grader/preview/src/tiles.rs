//! The film in tiles, each a picture of its own: of the shapes that its rays may hit.

use judge::pictures::TaskPicture;
use kit::camera::half_tan;
use kit::{Camera, FilmSize, Scene, Vec3};
use scenes::placement;
use wire::picture::{PictureAnswer, PictureWork, Subject, View};
use wire::work::Xyz;

/// Width and height of a tile in pixels: both divide those of the film.
const TILE: u32 = 16;

/// The most shapes of all tiles together: some seconds, and 150 MB of questions.
const MOST_SHAPES: usize = 1_000_000;

/// The tiles of a film.
pub(crate) struct Tiles {
    /// The whole picture, without its shapes.
    pub(crate) work: PictureWork,
    /// The picture of each tile, row by row from the bottom left.
    pub(crate) pictures: Vec<TaskPicture>,
}

/// The tiles of the default view of `scene`, as pictures of `task`; `None` if there are too many
/// shapes.
pub(crate) fn of(scene: &Scene, film: FilmSize, task: &'static str) -> Option<Tiles> {
    let camera = placement::place(scene, film).camera;
    let range = range_of(scene, camera.pos);
    let count = [film.w / TILE, film.h / TILE];
    let mut lists = vec![(Vec::new(), Vec::new()); (count[0] * count[1]) as usize];
    let mut shapes = 0;
    let mut put = |points: &[Vec3], put: &dyn Fn(&mut Lists)| {
        for (x, y) in tiles_of(points, &camera, count) {
            put(&mut lists[(y * count[0] + x) as usize]);
            shapes += 1;
            if shapes > MOST_SHAPES {
                return false;
            }
        }
        true
    };
    for t in &scene.triangles {
        let vectors = [t.p0, t.p1, t.p2, t.n0, t.n1, t.n2].map(|v| v.to_array());
        if !put(&[t.p0, t.p1, t.p2], &|lists| lists.0.push(vectors)) {
            return None;
        }
    }
    for sphere in &scene.spheres {
        let bounds = sphere.bounds();
        let corner = |i: usize| {
            let side = |axis: usize| [bounds.min, bounds.max][i >> axis & 1][axis];
            Vec3::new(side(0), side(1), side(2))
        };
        let corners: [Vec3; 8] = std::array::from_fn(corner);
        let whole = (sphere.center.to_array(), sphere.radius);
        if !put(&corners, &|lists| lists.1.push(whole)) {
            return None;
        }
    }
    let whole = judge::pictures::of(task)?;
    let view = view_of(&camera, film);
    let work = |size, view, (triangles, spheres): Lists| PictureWork {
        size,
        panels: 2,
        subject: Subject::Shapes {
            triangles,
            spheres,
            view,
            range,
        },
    };
    let pictures = lists.into_iter().zip(0..).map(|(lists, i)| {
        let at = [i % count[0], i / count[0]].map(|tile| f64::from(tile * TILE));
        let corner =
            Vec3::from(view.corner) + at[0] * Vec3::from(view.right) + at[1] * Vec3::from(view.up);
        let view = View {
            corner: corner.to_array(),
            ..view
        };
        TaskPicture {
            work: work([TILE; 2], view, lists),
            ..whole.clone()
        }
    });
    Some(Tiles {
        pictures: pictures.collect(),
        work: work([film.w, film.h], view, Lists::default()),
    })
}

/// Triangles and spheres as questions have them.
type Lists = (Vec<[Xyz; 6]>, Vec<(Xyz, f64)>);

impl Tiles {
    /// The answer to the whole picture, from those to the tiles.
    pub(crate) fn whole(&self, answers: &[PictureAnswer]) -> PictureAnswer {
        let [w, h] = self.work.size;
        let pixels = || (0..h).flat_map(|y| (0..w).map(move |x| (x, y)));
        let panel = |panel: usize| {
            let colour = |(x, y): (u32, u32)| {
                let tile = (y / TILE * (w / TILE) + x / TILE) as usize;
                let pixel = (y % TILE * TILE + x % TILE) as usize;
                answers[tile].panels[panel][pixel]
            };
            pixels().map(colour).collect()
        };
        PictureAnswer {
            panels: (0..self.work.panels as usize).map(panel).collect(),
        }
    }
}

/// The tiles that the convex hull of `points` may be seen in: all, if a point is not in front of the
/// camera.
fn tiles_of(
    points: &[Vec3],
    camera: &Camera,
    count: [u32; 2],
) -> impl Iterator<Item = (u32, u32)> + use<> {
    let extent = [half_tan(camera.h_fov), half_tan(camera.v_fov)];
    let mut range = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
    let mut is_in_front = true;
    for point in points {
        let place = camera.c2w.transpose() * (*point - camera.pos);
        is_in_front &= place.z < 0.0;
        for axis in 0..2 {
            let sensor = (place[axis] / (-place.z * extent[axis]) + 1.0) / 2.0;
            let at = sensor * f64::from(count[axis]);
            range[axis] = [range[axis][0].min(at), range[axis][1].max(at)];
        }
    }
    // What rounding may move is far below this part of a tile.
    let slack = 1e-3;
    let [columns, rows] = [0, 1].map(|axis| match is_in_front {
        true => {
            let [min, max] = range[axis];
            let first = (min - slack).max(0.0) as u32;
            first..((max + slack).ceil().max(0.0) as u32).min(count[axis])
        }
        false => 0..count[axis],
    });
    rows.flat_map(move |y| columns.clone().map(move |x| (x, y)))
}

/// The eye of the worker's pictures that sees what `camera` sees.
fn view_of(camera: &Camera, film: FilmSize) -> View {
    let [x, y] = [half_tan(camera.h_fov), half_tan(camera.v_fov)];
    let axes = camera.c2w;
    View {
        eye: camera.pos.to_array(),
        corner: (-x * axes.x_axis - y * axes.y_axis - axes.z_axis).to_array(),
        right: (2.0 * x / f64::from(film.w) * axes.x_axis).to_array(),
        up: (2.0 * y / f64::from(film.h) * axes.y_axis).to_array(),
    }
}

/// The distances of the nearest and the farthest point of the scene's bounding box.
fn range_of(scene: &Scene, eye: Vec3) -> [f64; 2] {
    let bounds = scene.bounds();
    let near = eye.clamp(bounds.min, bounds.max);
    let far = (eye - bounds.min).abs().max((eye - bounds.max).abs());
    [(near - eye).length(), far.length()]
}

#[cfg(test)]
mod tests {
    use super::*;
    use kit::{Mat3, Sphere, Triangle};

    const FILM: FilmSize = FilmSize { w: 64, h: 32 };

    /// A camera at the origin that looks along -z, with 4 by 2 tiles.
    fn camera() -> Camera {
        Camera {
            pos: Vec3::ZERO,
            c2w: Mat3::IDENTITY,
            h_fov: 90.0,
            v_fov: 2.0 * 0.5_f64.atan().to_degrees(),
            n_clip: 0.0,
            f_clip: f64::INFINITY,
        }
    }

    fn tiles(points: &[Vec3]) -> Vec<(u32, u32)> {
        tiles_of(points, &camera(), [4, 2]).collect()
    }

    #[test]
    fn a_shape_is_in_the_tiles_that_show_it() {
        let at = |x, y| Vec3::new(x, y, -1.0);
        assert_eq!(
            tiles(&[at(-0.9, -0.4), at(-0.6, -0.4), at(-0.6, -0.1)]),
            [(0, 0)]
        );
        let long = [at(-0.9, 0.1), at(0.9, 0.1), at(0.9, 0.4)];
        assert_eq!(tiles(&long), [(0, 1), (1, 1), (2, 1), (3, 1)]);
        // On an edge of tiles: both. Outside: none.
        assert_eq!(tiles(&[at(0.0, 0.2)]), [(1, 1), (2, 1)]);
        assert_eq!(tiles(&[at(3.0, 0.2), at(4.0, 0.2)]), []);
        // Partly behind the camera, or with a coordinate that is no number: in every tile.
        assert_eq!(tiles(&[at(0.0, 0.0), Vec3::Z]).len(), 8);
        assert_eq!(tiles(&[Vec3::NAN]).len(), 8);
    }

    #[test]
    fn a_whole_picture_has_the_pixels_of_its_tiles() {
        let mut scene = Scene {
            triangles: vec![Triangle::flat(Vec3::ZERO, Vec3::X, Vec3::Y)],
            spheres: vec![Sphere {
                center: Vec3::ZERO,
                radius: 1.0,
            }],
            ..Scene::default()
        };
        scene.camera = Some(Camera {
            pos: Vec3::new(0.0, 0.0, 4.0),
            ..camera()
        });
        let tiles = of(&scene, FILM, "part1.task3").expect("few shapes");
        assert_eq!(tiles.pictures.len(), 8);
        let direction = |work: &PictureWork, x: f64, y: f64| {
            let Subject::Shapes { view, .. } = &work.subject else {
                panic!("it shows shapes");
            };
            let [corner, right, up] = [view.corner, view.right, view.up].map(Vec3::from);
            corner + x * right + y * up
        };
        // Pixel (39, 20) is pixel (7, 4) of tile (2, 1).
        let far = direction(&tiles.work, 39.0, 20.0) - direction(&tiles.pictures[6].work, 7.0, 4.0);
        assert!(far.length() < 1e-12, "{far}");
        let corner = direction(&tiles.work, 0.0, 0.0);
        assert!(
            (corner - Vec3::new(-1.0, -0.5, -1.0)).length() < 1e-12,
            "{corner}"
        );
        let answer = |tile: usize| PictureAnswer {
            panels: vec![vec![[tile as f32; 3]; 256], vec![[0.5; 3]; 256]],
        };
        let answers: Vec<_> = (0..8).map(answer).collect();
        let whole = tiles.whole(&answers);
        assert_eq!(whole.panels[0][20 * 64 + 39], [6.0; 3]);
        assert_eq!([whole.panels[0].len(), whole.panels[1].len()], [2048; 2]);
    }

    #[test]
    fn fog_is_from_the_nearest_to_the_farthest_point() {
        let scene = Scene {
            triangles: vec![Triangle::flat(Vec3::ZERO, Vec3::X, Vec3::Y)],
            ..Scene::default()
        };
        assert_eq!(
            range_of(&scene, Vec3::new(0.0, 0.0, 2.0)),
            [2.0, 6.0_f64.sqrt()]
        );
        assert_eq!(range_of(&scene, Vec3::new(0.5, 0.5, 0.0))[0], 0.0);
    }
}
