//! The picture of a task: what the worker renders with the stage of the task, for people to look
//! at. Nothing in it scores.

use crate::direct::Strategy;
use crate::light::LitWorld;
use crate::work::{Camera, SceneSource, Tree, Xyz};
use serde::{Deserialize, Serialize};

/// A picture to render: panels of one size, one below the other.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PictureWork {
    /// Width and height of each panel in pixels.
    pub size: [u32; 2],
    /// The number of panels.
    pub panels: u32,
    /// What they show.
    pub subject: Subject,
}

/// What a picture shows. Each variant calls the functions of one task; all else that it takes (the
/// scene, its intersection tests) is given.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Subject {
    /// `raytrace_pixel`: a world of rings and edges. A panel for each number of samples per pixel.
    SampleLoop {
        /// Samples per pixel of each panel.
        samples: Vec<u32>,
    },
    /// `generate_ray`: the directions of a camera's rays, with a line every 10 degrees of longitude
    /// and latitude.
    CameraRays(Camera),
    /// `intersect_triangle` or `intersect_sphere`, called for every shape: the normals of the
    /// closest hits, then their distances.
    Shapes {
        /// Vertices `p0 p1 p2`, then vertex normals `n0 n1 n2`. Numbered first.
        triangles: Vec<[Xyz; 6]>,
        /// Centre and radius. Numbered after the triangles.
        spheres: Vec<(Xyz, f64)>,
        /// The eye.
        view: View,
        /// The distances at which the second panel is brightest and darkest.
        range: [f64; 2],
    },
    /// `construct_bvh`: each point of a mesh in the colour of its leaf's place, then of its leaf's
    /// depth, with the boxes of the top of the tree.
    Leaves {
        /// The vertices of the mesh's triangles; it is seen along -z.
        triangles: Vec<[Xyz; 3]>,
        /// The largest number of primitives in a leaf.
        max_leaf_size: u32,
    },
    /// `intersect_bbox`, called for every box: the nearest distance at which the ray enters one,
    /// then the length of the ray inside all of them.
    Boxes {
        /// Corners `min` and `max`.
        boxes: Vec<[Xyz; 2]>,
        /// The eye.
        view: View,
        /// The distances at which the first panel is brightest and darkest.
        range: [f64; 2],
    },
    /// `intersect_bvh`: the normals of the closest hits, then the number of tests per ray.
    Traversal {
        /// The scene.
        scene: SceneSource,
        /// A tree over it.
        tree: Tree,
        /// The eye.
        view: View,
        /// The number of tests that has the hottest colour.
        hottest: u32,
    },
    /// The Lambertian functions: a lit ball and a lit bowl, then the density over the hemisphere
    /// and the sampled directions, seen from above.
    Lambert,
    /// Direct light and emission in a world of rectangles.
    Direct {
        /// The world.
        world: LitWorld,
        /// The eye.
        view: View,
        /// Which function estimates the light.
        strategy: Strategy,
        /// Samples per pixel.
        samples: u32,
        /// The scattering of its surfaces.
        scattering: GivenScattering,
    },
    /// The functions of mirrors and glass: a mirror ball and a glass ball on a chequered floor,
    /// then the Fresnel reflectance and the refracted direction over the angle.
    Specular,
    /// `estimate_radiance`: indirect light in a world of rectangles.
    Paths {
        /// The world.
        world: LitWorld,
        /// The eye.
        view: View,
        /// The largest number of rays of a path.
        max_depth: u32,
        /// Paths per pixel.
        samples: u32,
        /// The scattering of its surfaces.
        scattering: GivenScattering,
    },
    /// `play_roulette`, in a column for each number of bounces: the result for each throughput (to
    /// the right) and `u` (upwards), then its mean over all `u` beside the throughput itself.
    Roulette {
        /// The number of bounces of each column.
        bounces: Vec<u32>,
    },
    /// `raytrace_pixel_adaptive` with `has_converged`: a world of rectangles lit by a large lamp,
    /// then the sampling rate.
    Adaptive {
        /// The world.
        world: LitWorld,
        /// The eye.
        view: View,
        /// The largest number of samples.
        ns_aa: u32,
        /// Samples between two calls of the rule.
        batch: u32,
        /// Error that is good enough, as a share of the mean.
        tolerance: f64,
        /// The scattering of its surfaces.
        scattering: GivenScattering,
    },
    /// The same with `has_surely_converged`: a light that is hit more and more rarely to the left.
    RareLight {
        /// The largest number of samples.
        ns_aa: u32,
        /// Samples between two calls of the rule.
        batch: u32,
        /// Error that is good enough, as a share of the mean.
        tolerance: f64,
    },
}

/// The brightness of a hit at the near and at the far end of a panel's range of distances: no hit
/// is as black as a miss.
pub const NEAR_AND_FAR: [f64; 2] = [0.7, 0.02];

/// An eye, and a panel in front of it, as vectors: the ray through the point `x`, `y`, in pixels from
/// the bottom left, has the direction `corner + x right + y up`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct View {
    /// Position.
    pub eye: Xyz,
    /// From the eye to the bottom left corner of the panel.
    pub corner: Xyz,
    /// From a pixel to the next one on its right.
    pub right: Xyz,
    /// From a pixel to the next one above.
    pub up: Xyz,
}

/// The given scattering of pictures whose task is about something else, in numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct GivenScattering {
    /// The BSDF of a white diffuse surface, in 1/sr.
    pub white: f64,
    /// By what the components of a local direction are multiplied in a mirror.
    pub mirror: Xyz,
}

/// The panels of a picture, each row by row from the bottom left. Channels are linear, from 0 to 1.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PictureAnswer {
    /// The colours of each panel's pixels.
    pub panels: Vec<Vec<[f32; 3]>>,
}
