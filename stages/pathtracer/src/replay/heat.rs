//! The number of tests of every pixel.

use crate::integrator::PathIntegrator;
use crate::normals::normal_pixel;
use crate::tiles;
use crate::tracer::SceneTracer;
use crate::{Accel, Counters, Job, LightSettings, Picture, Textures};
use kit::film::Cell;
use kit::{FilmSize, PixelEstimate};
use std::sync::atomic::{AtomicBool, Ordering};

/// The rays and tests of each pixel of a film.
#[derive(Clone, Debug, PartialEq)]
pub struct HeatMap {
    /// The size of the film.
    pub size: FilmSize,
    /// The counts, row by row from the bottom left; zero outside the cell.
    pub pixels: Vec<Counters>,
}

impl HeatMap {
    /// The counts of the pixel in column `x` and row `y`, from the bottom left.
    pub fn get(&self, x: u32, y: u32) -> Counters {
        self.pixels[y as usize * self.size.w as usize + x as usize]
    }

    /// The pixel with the most of what `count` counts, the first one of several; `None` if the film
    /// has no pixels.
    pub fn costliest(&self, count: impl Fn(&Counters) -> u64) -> Option<(u32, u32)> {
        let (i, _) = self
            .pixels
            .iter()
            .enumerate()
            .rev()
            .max_by_key(|(_, pixel)| count(pixel))?;
        let w = self.size.w as usize;
        Some(((i % w) as u32, (i / w) as u32))
    }
}

/// Counts the rays and tests of each pixel of a job on rayon's current thread pool, with paths
/// traced one at a time through `accel`. Once `stop` is set, the remaining counts are 0.
pub fn heat_map(
    picture: &Picture,
    textures: &Textures,
    accel: &Accel,
    job: &Job,
    settings: &LightSettings,
    stop: &AtomicBool,
) -> HeatMap {
    let tiles = job.cell.tiles();
    let contents = picture.pixel_contents(job, settings);
    let counts: Vec<(Cell, Vec<Counters>)> = match picture {
        Picture::Normals(scene) => {
            let tracer = SceneTracer { scene, accel };
            tiles::render(
                &tiles,
                job.sampling,
                Vec::new,
                |counts, x, y, sampler| {
                    let mut counters = Counters::default();
                    if !stop.load(Ordering::Relaxed) {
                        normal_pixel(&tracer, job, (x, y), sampler, &mut counters);
                    }
                    counts.push(counters);
                    PixelEstimate::default()
                },
                |cell, _, counts| (cell, counts),
            )
        }
        Picture::Lit(lit) => tiles::render(
            &tiles,
            job.sampling,
            || {
                (
                    PathIntegrator::new(lit, textures, accel, settings),
                    Vec::new(),
                )
            },
            |(paths, counts), x, y, sampler| {
                let before = paths.counters();
                if !stop.load(Ordering::Relaxed) {
                    paths.pixel(job, &contents, (x, y), sampler);
                }
                counts.push(paths.counters() - before);
                PixelEstimate::default()
            },
            |cell, _, (_, counts)| (cell, counts),
        ),
    };
    let mut map = HeatMap {
        size: job.film,
        pixels: vec![Counters::default(); job.film.whole().area() as usize],
    };
    for (cell, counts) in counts {
        for ((x, y), count) in cell.pixels().zip(counts) {
            map.pixels[y as usize * job.film.w as usize + x as usize] = count;
        }
    }
    map
}
