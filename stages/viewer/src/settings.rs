//! What is rendered, and how: the flags of the program, as the window changes them.

use clap::ValueEnum;
use kit::film::Cell;
use kit::sampler::{Pattern, Sampling};
use kit::{Camera, FilmSize};
use pathtracer::args::{Args, DEFAULT_LAMP_RAYS, DEFAULT_ROULETTE, DEFAULT_SAMPLER, SamplerName};
use pathtracer::{DirectSampling, Job, LightSettings};

/// The settings of a render.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RenderSettings {
    /// The size of the picture (`-r`).
    pub film: FilmSize,
    /// The part that is rendered (`-p`).
    pub cell: Option<Cell>,
    /// Camera rays per pixel (`-s`).
    pub samples: u32,
    /// The distribution of samples (`--sampler`).
    pub sampler: SamplerName,
    /// The seed (`--seed`).
    pub seed: u64,
    /// Light transport (`-l`, `-m`, `-a`, `-H`, `--mis`, ...).
    pub light: LightSettings,
}

/// Twice or half as much, or one more or less.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// Half, or one less.
    Less,
    /// Twice, or one more.
    More,
}

/// The most samples of a pixel or a light that the keys set.
const MAX_SAMPLES: u32 = 1 << 20;
/// The largest ray depth that the keys set.
const MAX_DEPTH: u32 = 10_000;
/// The batch and the tolerance of adaptive sampling when it is switched on without the flag `-a`:
/// the assignment's example.
const ADAPTIVE: (u32, f64) = (64, 0.05);

impl RenderSettings {
    /// The settings that the flags ask for, with a film of `film` pixels.
    pub fn new(args: &Args, film: FilmSize) -> Result<RenderSettings, String> {
        let cell = args.cell_of(film)?;
        Ok(RenderSettings {
            film,
            cell: (cell != film.whole()).then_some(cell),
            samples: args.samples,
            sampler: args.sampler,
            seed: args.seed,
            light: args.light()?,
        })
    }

    /// The job of a picture: that of the program with the same flags.
    pub fn job(&self, camera: Camera) -> Job {
        Job {
            camera,
            film: self.film,
            cell: self.cell.unwrap_or(self.film.whole()),
            samples: self.samples,
            sampling: Sampling {
                pattern: match self.sampler {
                    SamplerName::Independent => Pattern::Independent,
                    SamplerName::Stratified => Pattern::Stratified {
                        samples: self.samples,
                    },
                    SamplerName::Sobol => Pattern::Sobol,
                    SamplerName::Sobol4 => Pattern::Sobol4,
                },
                seed: self.seed,
                first_sample: 0,
            },
        }
    }

    /// Halves or doubles the camera rays per pixel.
    pub fn change_samples(&mut self, change: Change) {
        self.samples = scaled(self.samples, change);
    }

    /// Halves or doubles the samples per light.
    pub fn change_light_samples(&mut self, change: Change) {
        self.light.light_samples = scaled(self.light.light_samples, change);
    }

    /// Changes the ray depth by one.
    pub fn change_depth(&mut self, change: Change) {
        let depth = &mut self.light.max_depth;
        *depth = match change {
            Change::Less => depth.saturating_sub(1),
            Change::More => (*depth + 1).min(MAX_DEPTH),
        };
    }

    /// Samples the hemisphere for direct light, or the lights again.
    pub fn toggle_hemisphere(&mut self) {
        self.toggle_sampling(DirectSampling::Hemisphere);
    }

    /// Uses multiple importance sampling for direct light, or samples the lights again.
    pub fn toggle_mis(&mut self) {
        self.toggle_sampling(DirectSampling::Mis);
    }

    fn toggle_sampling(&mut self, sampling: DirectSampling) {
        let current = &mut self.light.direct_sampling;
        *current = if *current == sampling {
            DirectSampling::Lights
        } else {
            sampling
        };
    }

    /// Switches adaptive sampling on or off.
    pub fn toggle_adaptive(&mut self) {
        self.light.adaptive = match self.light.adaptive {
            None => Some(ADAPTIVE),
            Some(_) => None,
        };
    }

    /// The next distribution of samples.
    pub fn next_sampler(&mut self) {
        self.sampler = match self.sampler {
            SamplerName::Sobol | SamplerName::Sobol4 => SamplerName::Stratified,
            SamplerName::Stratified => SamplerName::Independent,
            SamplerName::Independent => DEFAULT_SAMPLER,
        };
    }

    /// The flags of the program that give the same picture, apart from the scene and the camera.
    pub fn flags(&self) -> String {
        let mut flags = format!(
            "-r {} {} -s {} -l {} -m {}",
            self.film.w, self.film.h, self.samples, self.light.light_samples, self.light.max_depth
        );
        if let Some(Cell { x0, y0, x1, y1 }) = self.cell {
            flags += &format!(" -p {x0} {y0} {} {}", x1 - x0, y1 - y0);
        }
        match self.light.direct_sampling {
            DirectSampling::Lights => {}
            DirectSampling::Hemisphere => flags += " -H",
            DirectSampling::Mis => flags += " --mis",
        }
        if let Some((batch, tolerance)) = self.light.adaptive {
            flags += &format!(" -a {batch} {tolerance}");
        }
        let sampler = self.sampler.to_possible_value();
        if let Some(name) = sampler.filter(|_| self.sampler != DEFAULT_SAMPLER) {
            flags += &format!(" --sampler {}", name.get_name());
        }
        match (self.light.roulette, self.light.roulette_factor) {
            (false, _) => flags += " --no-roulette",
            (true, DEFAULT_ROULETTE) => {}
            (true, factor) => flags += &format!(" --roulette {factor}"),
        }
        if self.light.lamp_rays != DEFAULT_LAMP_RAYS {
            flags += &format!(" --lamp-rays {}", self.light.lamp_rays);
        }
        if self.light.reuse_paths {
            flags += " --reuse-paths";
        }
        if self.light.guide_caustics {
            flags += " --guide-caustics";
        }
        if self.seed != 0 {
            flags += &format!(" --seed {}", self.seed);
        }
        flags
    }
}

fn scaled(samples: u32, change: Change) -> u32 {
    match change {
        Change::Less => (samples / 2).max(1),
        Change::More => samples.saturating_mul(2).min(MAX_SAMPLES.max(samples)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[test]
    fn flags_name_what_is_not_the_default() {
        let flags = |given: &str| {
            let words = format!("viewer {given} a.dae");
            let args = Args::parse_from(words.split_whitespace());
            let settings = RenderSettings::new(&args, FilmSize { w: 4, h: 3 });
            settings.expect("settings").flags()
        };
        let default = "-r 4 3 -s 1 -l 1 -m 1";
        assert_eq!(
            flags("--sampler sobol4 --roulette 4 --lamp-rays 8"),
            default
        );
        for given in [
            "--sampler sobol",
            "--sampler stratified",
            "--roulette 1",
            "--no-roulette",
            "--lamp-rays 1",
        ] {
            assert_eq!(flags(given), format!("{default} {given}"));
        }
    }
}
