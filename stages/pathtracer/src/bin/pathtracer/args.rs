//! The command line: the assignment's flags under its names, with long names beside them.

use crate::values::{
    depth, edge, length, pixels, positive, positive_length, samples, seed, threads,
};
use clap::{Parser, ValueEnum};
use pathtracer::AccelKind;
use std::path::PathBuf;

/// Renders a scene file.
#[derive(Debug, Parser)]
#[command(
    name = "pathtracer",
    version,
    max_term_width = 100,
    allow_negative_numbers = true
)]
pub(crate) struct Args {
    /// The scene: a COLLADA file
    #[arg(value_name = "SCENE.dae")]
    pub(crate) scene: PathBuf,

    /// Camera rays per pixel (should be a power of 2)
    #[arg(short = 's', long, value_name = "INT", default_value_t = 1, value_parser = samples)]
    pub(crate) samples: u32,

    /// Samples per area light [default: 1]
    #[arg(short = 'l', long, value_name = "INT", value_parser = samples)]
    pub(crate) light_samples: Option<u32>,

    /// Render threads
    #[arg(short = 't', long, value_name = "INT", default_value_t = 1, value_parser = threads)]
    pub(crate) threads: usize,

    /// Maximum ray depth: 0 is emission only, 1 is direct light [default: 1]
    #[arg(short = 'm', long, value_name = "INT", value_parser = depth)]
    pub(crate) max_depth: Option<u32>,

    /// The picture to write: .png as a screen shows it, .exr with linear radiance
    #[arg(short = 'f', long = "file", value_name = "FILENAME")]
    pub(crate) file: Option<PathBuf>,

    /// Width and height of the picture in pixels [default: the camera file's, else 480 360]
    #[arg(short = 'r', long, num_args = 2, value_names = ["W", "H"], value_parser = edge)]
    pub(crate) resolution: Option<Vec<u32>>,

    /// Render a cell only: its bottom left pixel, counted from the picture's bottom left, and its size, which is
    /// also the written picture's
    #[arg(short = 'p', long = "cell", num_args = 4, value_names = ["X", "Y", "DX", "DY"], value_parser = pixels)]
    pub(crate) cell: Option<Vec<u32>>,

    /// Camera file [default: the scene's camera, else one that sees all of the scene]
    #[arg(short = 'c', long, value_name = "FILENAME")]
    pub(crate) camera: Option<PathBuf>,

    /// Samples per batch and tolerance for adaptive sampling
    #[arg(short = 'a', long, num_args = 2, value_names = ["INT", "FLOAT"])]
    pub(crate) adaptive: Option<Vec<String>>,

    /// Sample the hemisphere for direct lighting
    #[arg(short = 'H', long)]
    pub(crate) hemisphere: bool,

    /// Sample lights and surfaces for direct lighting, weighed by how good each is
    #[arg(long, conflicts_with = "hemisphere")]
    pub(crate) mis: bool,

    /// Follow dim paths to their end instead of playing Russian roulette
    #[arg(long)]
    pub(crate) no_roulette: bool,

    /// How the samples of a pixel lie to each other
    // At equal noise Sobol points take less than half of the time of independent ones.
    #[arg(long, value_enum, default_value_t = SamplerName::Sobol)]
    pub(crate) sampler: SamplerName,

    /// Environment map (.exr or .hdr) that lights the scene
    #[arg(short = 'e', long, value_name = "FILENAME")]
    pub(crate) environment: Option<PathBuf>,

    /// Radius of the camera's lens, for depth of field: 0 is a pinhole
    #[arg(long, value_name = "LENGTH", default_value_t = 0.0, value_parser = length)]
    pub(crate) lens_radius: f64,

    /// Distance from the lens to the plane that is sharp
    #[arg(long, value_name = "LENGTH", value_parser = positive_length, requires = "lens_radius")]
    pub(crate) focus: Option<f64>,

    /// What a surface shows
    #[arg(long, value_enum, default_value_t = DEFAULT_SHADE)]
    pub(crate) shade: Shade,

    /// Render in rounds of -s samples (16 if that is 1) for so many seconds
    #[arg(long, value_name = "SECONDS", value_parser = positive, conflicts_with = "adaptive")]
    pub(crate) time: Option<f64>,

    /// Render in rounds of -s samples (16 if that is 1) until the noise of a pixel, on average, is this share of the
    /// picture's mean, such as 0.02; with --time whichever comes first
    #[arg(long, value_name = "TARGET", value_parser = positive, conflicts_with = "adaptive")]
    pub(crate) error: Option<f64>,

    /// An .exr to write beside the picture, with albedo, normal, depth, primitive number and variance
    #[arg(long, value_name = "FILENAME")]
    pub(crate) layers: Option<PathBuf>,

    /// Write the scene for another renderer instead of a picture; the only one is mitsuba
    #[arg(long, num_args = 2, value_names = ["mitsuba", "OUT.xml"])]
    pub(crate) export: Option<Vec<String>>,

    /// Tell where the time went
    #[arg(long)]
    pub(crate) stats: bool,

    /// Tell which effects the scene calls for, why, what they took, and what they would take if all were forced on: the
    /// picture is made once more, to count
    #[arg(long)]
    pub(crate) explain: bool,

    /// Simulate every effect, called for or not: the same picture, more work
    #[arg(long)]
    pub(crate) force_effects: bool,

    /// How hits are found
    #[arg(long, value_enum, default_value_t = DEFAULT_ACCEL)]
    pub(crate) accel: AccelName,

    /// Which random numbers to take: another seed gives another noise
    #[arg(long, value_name = "INT", default_value_t = 0, value_parser = seed)]
    pub(crate) seed: u64,
}

/// What a surface shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Shade {
    /// Light if the scene has any, else normals
    Auto,
    /// Which way it faces
    Normals,
    /// The light that it sends to the camera
    Lit,
}

// What a project can do without asking for it: who has finished part 2 goes on to light.
// BEGIN SOLUTION(part2.task3)
const DEFAULT_SHADE: Shade = Shade::Auto;
// STUB: const DEFAULT_SHADE: Shade = Shade::Normals;
// END SOLUTION(part2.task3)

// The same hits either way; the wide tree is the last thing that a student writes.
// BEGIN SOLUTION(part6.task1)
const DEFAULT_ACCEL: AccelName = AccelName::Simd;
// STUB: const DEFAULT_ACCEL: AccelName = AccelName::Bvh;
// END SOLUTION(part6.task1)

/// How the samples of a pixel lie to each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum SamplerName {
    /// None knows of another
    Independent,
    /// One in each of -s cells of the pixel (jittered)
    Stratified,
    /// Evenly (Owen-scrambled Sobol points): less noise
    Sobol,
}

/// How hits are found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum AccelName {
    /// Every ray asks every primitive
    Brute,
    /// Through a bounding volume hierarchy
    Bvh,
    /// Through a wide one, eight boxes or triangles at a time; and eight paths of light at a time where they fit
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
