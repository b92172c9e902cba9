//! The command line: the assignment's flags with its short names, and long names.

use self::values::{
    depth, edge, first_sample, length, pixels, positive, positive_length, samples, seed, threads,
};
use clap::{Parser, ValueEnum};
mod settings;
mod usage;
mod values;
mod view;

use crate::{AccelKind, RateScale, ToneCurve};
use std::path::PathBuf;

pub use usage::with_advice;
pub use values::stops;
pub use view::ViewError;

/// Renders a scene file. `pathtracer merge --help` tells how to merge parts of a picture.
#[derive(Clone, Debug, Parser)]
#[command(
    name = "pathtracer",
    version,
    max_term_width = 100,
    allow_negative_numbers = true
)]
pub struct Args {
    /// The scene: a COLLADA file, or a glTF (.glb, .gltf), OBJ or PLY file
    #[arg(value_name = "SCENE.dae")]
    pub scene: PathBuf,

    /// Camera rays per pixel (should be a power of 2)
    #[arg(short = 's', long, value_name = "INT", default_value_t = 1, value_parser = samples)]
    pub samples: u32,

    /// Samples per area light; of more than eight area lights together [default: 1]
    #[arg(short = 'l', long, value_name = "INT", value_parser = samples)]
    pub light_samples: Option<u32>,

    /// Render threads [default: one for each core]
    // The assignment's default is 1. The picture is the same for any number, bit for bit, so the
    // default is the fastest; `-t 1` is the assignment's.
    #[arg(short = 't', long, value_name = "INT", value_parser = threads)]
    pub threads: Option<usize>,

    /// Maximum ray depth: 0 is emission only, 1 is direct light [default: 1]
    #[arg(short = 'm', long, value_name = "INT", value_parser = depth)]
    pub max_depth: Option<u32>,

    /// The picture to write: .png (tone-mapped), .exr or .hdr (linear radiance); or .sums, a part
    /// of a picture for `pathtracer merge`
    #[arg(short = 'f', long = "file", value_name = "FILENAME")]
    pub file: Option<PathBuf>,

    /// Width and height of the picture in pixels [default: the camera file's, else 480 360]
    #[arg(short = 'r', long, num_args = 2, value_names = ["W", "H"], value_parser = edge)]
    pub resolution: Option<Vec<u32>>,

    /// Exposure of a .png in stops: 1 is twice as bright
    #[arg(long, value_name = "STOPS", default_value_t = 0.0, value_parser = stops)]
    pub exposure: f64,

    /// Tone curve of a .png
    #[arg(long, value_enum, default_value_t = ToneName::Assignment)]
    pub tone: ToneName,

    /// Render only a cell of the picture: its bottom left pixel, counted from the bottom left of
    /// the picture, and its size, which is also the size of the written picture
    #[arg(short = 'p', long = "cell", num_args = 4, value_names = ["X", "Y", "DX", "DY"], value_parser = pixels)]
    pub cell: Option<Vec<u32>>,

    /// Index of the first sample of each pixel: with -s a range of the samples of a picture, whose
    /// other samples other runs render
    #[arg(long, value_name = "INT", value_parser = first_sample,
        conflicts_with_all = ["adaptive", "time", "error"])]
    pub first_sample: Option<u32>,

    /// Camera file [default: the scene's camera, else one that shows the whole scene]
    #[arg(short = 'c', long, value_name = "FILENAME")]
    pub camera: Option<PathBuf>,

    /// Samples per batch and tolerance for adaptive sampling
    #[arg(short = 'a', long, num_args = 2, value_names = ["INT", "FLOAT"])]
    pub adaptive: Option<Vec<String>>,

    /// Colours of the sample counts that -a writes to NAME_rate.png
    #[arg(long, value_enum, default_value_t = RateScaleName::Viridis, requires = "adaptive")]
    pub rate_scale: RateScaleName,

    /// Sample the hemisphere uniformly for direct lighting
    #[arg(short = 'H', long)]
    pub hemisphere: bool,

    /// Sample the lights and the BSDF for direct lighting (multiple importance sampling); needs
    /// `estimate_direct_lighting_mis` of part3.task3, in stages/direct/src/mis.rs
    #[arg(long, conflicts_with = "hemisphere")]
    pub mis: bool,

    /// Trace dim paths to the maximum depth, without Russian roulette
    #[arg(long)]
    pub no_roulette: bool,

    /// Let paths survive Russian roulette FACTOR times as often as their throughput says: with 1
    /// they are somewhat shorter, and pictures noisier
    #[arg(long, value_name = "FACTOR", default_value_t = DEFAULT_ROULETTE, value_parser = samples, conflicts_with = "no_roulette")]
    pub roulette: u32,

    /// Camera rays by which each sample finds the lamps' own light in a pixel at the edge of a
    /// lamp: with 1 these edges are noisier. Without effect with -s 1, or if there is a lens
    #[arg(long, value_name = "INT", default_value_t = DEFAULT_LAMP_RAYS, value_parser = samples)]
    pub lamp_rays: u32,

    /// Let eight neighbouring pixels share what their paths find beyond the first diffuse surface:
    /// less noise in the same time where most light is diffuse, but neighbours have the same noise.
    /// Needs `--accel simd`
    #[arg(long, conflicts_with_all = ["adaptive", "clamp", "hemisphere", "soft_terminator", "pixel", "force_effects"])]
    pub reuse_paths: bool,

    /// Send rays where mirrors and smooth glass lead light of lamps to diffuse surfaces: less noise
    /// in the same time where few objects are mirrors or glass. Without effect with -m 2 or less.
    /// Needs `--accel simd`
    #[arg(long, conflicts_with_all = ["clamp", "hemisphere", "soft_terminator", "pixel", "force_effects"])]
    pub guide_caustics: bool,

    /// The largest luminance of a sample's indirect light: removes fireflies, and light. Indirect
    /// is what reaches the first surface that is neither a mirror nor smooth glass from other
    /// surfaces
    #[arg(long, value_name = "LUMINANCE", value_parser = positive)]
    pub clamp: Option<f64>,

    /// Let light fade where it grazes the triangles of a smooth mesh, so that the edge of its dark
    /// side shows no facets: the picture gets darker
    #[arg(long)]
    pub soft_terminator: bool,

    /// The distribution of a pixel's samples
    // At equal noise, Sobol points need less than half the time of independent samples.
    #[arg(long, value_enum, default_value_t = DEFAULT_SAMPLER)]
    pub sampler: SamplerName,

    /// Environment map (.exr or .hdr) that lights the scene
    #[arg(short = 'e', long, value_name = "FILENAME")]
    pub environment: Option<PathBuf>,

    /// Radius of the camera's lens for depth of field; 0 is a pinhole
    #[arg(long, value_name = "LENGTH", default_value_t = 0.0, value_parser = length)]
    pub lens_radius: f64,

    /// Distance from the lens to the plane of focus
    #[arg(long, value_name = "LENGTH", value_parser = positive_length, requires = "lens_radius")]
    pub focus: Option<f64>,

    /// What the picture shows
    #[arg(long, value_enum, default_value_t = Shade::Auto)]
    pub shade: Shade,

    /// The normals that shade the triangles
    #[arg(long, value_enum, default_value_t = NormalsName::File)]
    pub normals: NormalsName,

    /// Render passes of -s samples (16 if that is 1) for this many seconds
    #[arg(long, value_name = "SECONDS", value_parser = positive, conflicts_with = "adaptive")]
    pub time: Option<f64>,

    /// Render passes of -s samples (16 if that is 1) until the noise, as it is printed, is at most
    /// this fraction of the mean luminance, such as 0.02; with --time until either limit is reached
    #[arg(long, value_name = "TARGET", value_parser = positive, conflicts_with = "adaptive")]
    pub error: Option<f64>,

    /// Also write an .exr with albedo, normal, depth, primitive number and variance
    #[arg(long, value_name = "FILENAME")]
    pub layers: Option<PathBuf>,

    /// Export the scene for another renderer instead of rendering; only mitsuba is supported
    #[arg(long, num_args = 2, value_names = ["mitsuba", "OUT.xml"])]
    pub export: Option<Vec<String>>,

    /// Print a pixel, counted from the bottom left, instead of writing a picture: its values, and a
    /// replay of its samples with every ray and every box and primitive test
    #[arg(long, num_args = 2, value_names = ["X", "Y"], value_parser = pixels)]
    pub pixel: Option<Vec<u32>>,

    /// Print how the time was spent
    #[arg(long)]
    pub stats: bool,

    /// Print which effects the scene calls for and why, how many operations they take, and how many
    /// all effects would take (the picture is rendered a second time to count these)
    #[arg(long)]
    pub explain: bool,

    /// Simulate every effect, called for or not: the same picture with more operations
    #[arg(long)]
    pub force_effects: bool,

    /// How ray intersections are found
    #[arg(long, value_enum, default_value_t = DEFAULT_ACCEL)]
    pub accel: AccelName,

    /// Seed of the random numbers
    #[arg(long, value_name = "INT", default_value_t = 0, value_parser = seed)]
    pub seed: u64,
}

/// What the picture shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Shade {
    /// Light if the scene has any and your stages can compute it, else normals
    Auto,
    /// Surface normals as colours
    Normals,
    /// Light
    Lit,
}

/// The normals that shade the triangles.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum NormalsName {
    /// Those of the scene file; for a COLLADA, OBJ or PLY mesh without normals, smooth ones
    File,
    /// Those of the planes of the triangles: every mesh has facets
    Flat,
}

// All choices find the same hits. The wide tree is the last task of the course.
// BEGIN SOLUTION(part6.task1)
const DEFAULT_ACCEL: AccelName = AccelName::Simd;
// STUB: const DEFAULT_ACCEL: AccelName = AccelName::Bvh;
// END SOLUTION(part6.task1)

// At equal noise, both together need 0.75 to 1.00 of the time of `sobol` and 1.
/// The distribution of samples without `--sampler`.
pub const DEFAULT_SAMPLER: SamplerName = SamplerName::Sobol4;
/// The factor of Russian roulette without `--roulette`.
pub const DEFAULT_ROULETTE: u32 = 4;

/// Camera rays for each sample at the edge of a lamp without `--lamp-rays`.
pub const DEFAULT_LAMP_RAYS: u32 = 8;

/// The distribution of a pixel's samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SamplerName {
    /// Independent random samples
    Independent,
    /// One random sample in each of -s cells of the pixel (jittered)
    Stratified,
    /// Owen-scrambled Sobol points: less noise
    Sobol,
    /// Sobol points whose pairs are spread evenly together: less noise in soft shadows
    Sobol4,
}

/// The tone curve of a `.png`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ToneName {
    /// A power of the radiance, cut off at white
    Assignment,
    /// Contrast of film: bright parts keep detail
    Filmic,
    /// AgX: like film, and bright colours fade to white
    Agx,
}

impl From<ToneName> for ToneCurve {
    fn from(name: ToneName) -> ToneCurve {
        match name {
            ToneName::Assignment => ToneCurve::Assignment,
            ToneName::Filmic => ToneCurve::Filmic,
            ToneName::Agx => ToneCurve::Agx,
        }
    }
}

/// The colours of sample counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum RateScaleName {
    /// Dark blue, green, yellow, readable without colour vision; with a legend
    Viridis,
    /// Blue, green, red
    Assignment,
}

impl From<RateScaleName> for RateScale {
    fn from(name: RateScaleName) -> RateScale {
        match name {
            RateScaleName::Viridis => RateScale::Viridis,
            RateScaleName::Assignment => RateScale::Assignment,
        }
    }
}

/// How ray intersections are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum AccelName {
    /// Every ray tests every primitive
    Brute,
    /// A binary bounding volume hierarchy
    Bvh,
    /// A wide bounding volume hierarchy that tests eight boxes or triangles at a time; traces paths
    /// in packets of eight where possible
    Simd,
}

impl From<AccelName> for AccelKind {
    fn from(name: AccelName) -> AccelKind {
        match name {
            AccelName::Brute => AccelKind::Brute,
            AccelName::Bvh => AccelKind::Bvh,
            AccelName::Simd => AccelKind::Simd,
        }
    }
}

/// Whether a window can be opened: on Linux and other Unix systems apart from macOS, whether the
/// variable `DISPLAY` or `WAYLAND_DISPLAY` is set.
pub fn has_display() -> bool {
    let is_set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    let needs_server = cfg!(unix) && !cfg!(target_os = "macos");
    !needs_server || is_set("DISPLAY") || is_set("WAYLAND_DISPLAY")
}
