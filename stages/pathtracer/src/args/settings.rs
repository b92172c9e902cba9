//! Converts flags to the settings of the renderer.

use super::values::samples;
use super::{
    Args, DEFAULT_LAMP_RAYS, DEFAULT_ROULETTE, DEFAULT_SAMPLER, SamplerName, Shade, ToneName,
};
use crate::{DirectSampling, Lens, LightSettings, Tone};
use kit::FilmSize;
use kit::film::Cell;
use kit::sampler::{Pattern, Sampling};

/// The size of the picture without `-r` and without a camera file.
const DEFAULT_SIZE: FilmSize = FilmSize { w: 480, h: 360 };

/// The largest number of pixels, so that a typing error does not use up all memory: 136 bytes each,
/// 8 more if there are lamps, and with `-a` twice as many.
const MAX_PIXELS: u64 = 100_000_000;

impl Args {
    /// The size of the picture. `of_camera_file` is the size in the camera file, if there is one.
    pub fn film(&self, of_camera_file: Option<FilmSize>) -> Result<FilmSize, String> {
        let size = match self.resolution.as_deref() {
            Some(&[w, h]) => FilmSize { w, h },
            _ => of_camera_file.unwrap_or(DEFAULT_SIZE),
        };
        if size.whole().area() > MAX_PIXELS {
            return Err(format!(
                "-r: a picture of {} x {} pixels is too large: choose at most {} million pixels",
                size.w,
                size.h,
                MAX_PIXELS / 1_000_000
            ));
        }
        Ok(size)
    }

    /// The part of the picture to render.
    pub fn cell_of(&self, film: FilmSize) -> Result<Cell, String> {
        let Some(&[x, y, dx, dy]) = self.cell.as_deref() else {
            return Ok(film.whole());
        };
        let (x1, y1) = (x.saturating_add(dx), y.saturating_add(dy));
        if dx == 0 || dy == 0 || x1 > film.w || y1 > film.h {
            return Err(format!(
                "-p {x} {y} {dx} {dy}: the cell is not in the picture: choose at least one pixel, x + dx at most {} and y + dy at most {}",
                film.w, film.h
            ));
        }
        Ok(Cell {
            x0: x,
            y0: y,
            x1,
            y1,
        })
    }

    /// The pixel of `--pixel`, if it is in the picture.
    pub fn pixel_of(&self, film: FilmSize) -> Result<Option<(u32, u32)>, String> {
        match self.pixel.as_deref() {
            Some(&[x, y]) if x >= film.w || y >= film.h => Err(format!(
                "--pixel {x} {y}: the pixel is not in the picture: choose X from 0 to {} and Y from 0 to {}",
                film.w - 1,
                film.h - 1
            )),
            Some(&[x, y]) => Ok(Some((x, y))),
            _ => Ok(None),
        }
    }

    /// The two values of `-a`: samples per batch and tolerance.
    pub fn adaptive(&self) -> Result<Option<(u32, f64)>, String> {
        let Some([batch, tolerance]) = self.adaptive.as_deref() else {
            return Ok(None);
        };
        let per_batch = samples(batch)
            .map_err(|why| format!("-a {batch} {tolerance}: samples per batch: {why}"))?;
        match tolerance.parse::<f64>() {
            Ok(t) if t.is_finite() && t >= 0.0 => Ok(Some((per_batch, t))),
            _ => Err(format!(
                "-a {batch} {tolerance}: the tolerance has to be a finite number of at least 0, such as 0.05"
            )),
        }
    }

    /// The settings of light transport.
    pub fn light(&self) -> Result<LightSettings, String> {
        let default = LightSettings::default();
        if self.lens_radius > 0.0 && self.focus.is_none() {
            return Err(format!(
                "--lens-radius {}: add the distance to the plane of focus, such as --focus 3.5",
                self.lens_radius
            ));
        }
        Ok(LightSettings {
            light_samples: self.light_samples.unwrap_or(default.light_samples),
            max_depth: self.max_depth.unwrap_or(default.max_depth),
            direct_sampling: match (self.hemisphere, self.mis) {
                (true, _) => DirectSampling::Hemisphere,
                (false, true) => DirectSampling::Mis,
                (false, false) => DirectSampling::Lights,
            },
            roulette: !self.no_roulette,
            roulette_factor: self.roulette,
            lamp_rays: self.lamp_rays,
            soft_terminator: self.soft_terminator,
            clamp: self.clamp,
            reuse_paths: self.reuse_paths,
            guide_caustics: self.guide_caustics,
            adaptive: self.adaptive()?,
            lens: Lens {
                radius: self.lens_radius,
                focus: self.focus.unwrap_or(default.lens.focus),
            },
            force_effects: self.force_effects,
            environment: self.environment.is_some(),
        })
    }

    /// The number of render threads: that of `-t`, else one for each core.
    pub fn thread_count(&self) -> usize {
        let cores = || std::thread::available_parallelism().map_or(1, usize::from);
        self.threads.unwrap_or_else(cores)
    }

    /// How radiance becomes the bytes of a `.png`.
    pub fn tone(&self) -> Tone {
        Tone {
            exposure: self.exposure,
            curve: self.tone.into(),
        }
    }

    /// Checks that the samples from `--first-sample` on are those of one larger run.
    pub fn check_part(&self) -> Result<(), String> {
        let Some(first) = self.first_sample else {
            return Ok(());
        };
        if self.sampler == SamplerName::Stratified {
            return Err(format!(
                "--first-sample {first}: the cells of --sampler stratified depend on the number of samples: use sobol or independent"
            ));
        }
        if self.samples == 1 {
            return Err(format!(
                "--first-sample {first} -s 1: a single sample goes through the centre of the pixel: use at least -s 2"
            ));
        }
        Ok(())
    }

    /// Checks that the number of samples in a `.sums` file is known in advance.
    pub fn check_sums(&self) -> Result<(), String> {
        let limits = given(&[
            (self.time.is_some(), "--time"),
            (self.error.is_some(), "--error"),
        ]);
        if limits.is_empty() {
            return Ok(());
        }
        Err(format!(
            "{}: a .sums file needs a fixed number of samples: use -s",
            limits.join(" ")
        ))
    }

    /// The source of random numbers for `samples` samples per pixel.
    pub fn sampling(&self, samples: u32) -> Sampling {
        Sampling {
            pattern: match self.sampler {
                SamplerName::Independent => Pattern::Independent,
                SamplerName::Stratified => Pattern::Stratified { samples },
                SamplerName::Sobol => Pattern::Sobol,
                SamplerName::Sobol4 => Pattern::Sobol4,
            },
            seed: self.seed,
            first_sample: self.first_sample.unwrap_or(0),
        }
    }

    /// The given flags that have no effect if no picture is written, as with `--export` and
    /// `--pixel`.
    pub fn unused_without_picture(&self) -> Vec<&'static str> {
        given(&[
            (self.file.is_some(), "-f"),
            (self.cell.is_some(), "-p"),
            (self.exposure != 0.0, "--exposure"),
            (self.tone != ToneName::Assignment, "--tone"),
            (self.layers.is_some(), "--layers"),
            (self.time.is_some(), "--time"),
            (self.error.is_some(), "--error"),
            (self.stats, "--stats"),
            (self.explain, "--explain"),
        ])
    }

    /// The given flags that have no effect on a scene that is exported for another renderer.
    pub fn unused_by_export(&self) -> Vec<&'static str> {
        let mut unused = self.unused_without_picture();
        unused.extend(given(&[
            (self.light_samples.is_some(), "-l"),
            (self.adaptive.is_some(), "-a"),
            (self.hemisphere, "-H"),
            (self.mis, "--mis"),
            (self.no_roulette, "--no-roulette"),
            (self.roulette != DEFAULT_ROULETTE, "--roulette"),
            (self.lamp_rays != DEFAULT_LAMP_RAYS, "--lamp-rays"),
            (self.soft_terminator, "--soft-terminator"),
            (self.clamp.is_some(), "--clamp"),
            (self.reuse_paths, "--reuse-paths"),
            (self.guide_caustics, "--guide-caustics"),
            (self.pixel.is_some(), "--pixel"),
            (self.shade == Shade::Normals, "--shade"),
            (self.seed != 0, "--seed"),
            (self.first_sample.is_some(), "--first-sample"),
            (self.sampler != DEFAULT_SAMPLER, "--sampler"),
            (self.force_effects, "--force-effects"),
        ]));
        unused
    }

    /// The given flags that have no effect on a file with linear radiance.
    pub fn unused_by_radiance(&self) -> Vec<&'static str> {
        given(&[
            (self.exposure != 0.0, "--exposure"),
            (self.tone != ToneName::Assignment, "--tone"),
        ])
    }

    /// The given flags that have no effect with normal shading.
    pub fn unused_by_normals(&self) -> Vec<&'static str> {
        given(&[
            (self.light_samples.is_some(), "-l"),
            (self.max_depth.is_some(), "-m"),
            (self.adaptive.is_some(), "-a"),
            (self.hemisphere, "-H"),
            (self.environment.is_some(), "-e"),
            (self.mis, "--mis"),
            (self.no_roulette, "--no-roulette"),
            (self.roulette != DEFAULT_ROULETTE, "--roulette"),
            (self.lamp_rays != DEFAULT_LAMP_RAYS, "--lamp-rays"),
            (self.soft_terminator, "--soft-terminator"),
            (self.clamp.is_some(), "--clamp"),
            (self.reuse_paths, "--reuse-paths"),
            (self.guide_caustics, "--guide-caustics"),
            (self.lens_radius > 0.0, "--lens-radius"),
            (self.time.is_some(), "--time"),
            (self.error.is_some(), "--error"),
        ])
    }
}

/// The names of the `flags` that are given.
fn given(flags: &[(bool, &'static str)]) -> Vec<&'static str> {
    let given = flags.iter().filter(|(given, _)| *given);
    given.map(|&(_, flag)| flag).collect()
}
