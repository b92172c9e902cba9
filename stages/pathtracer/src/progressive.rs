//! Rendering that can be watched, stopped, resumed, and continued with more samples.

use crate::pixel_contents::PixelContents;
use crate::rendered::RenderedTile;
use crate::{Job, LightSettings, PreparedScene, Rendered};
use kit::film::Cell;
use std::cell::OnceCell;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

/// A picture in progress.
///
/// The first pass renders the picture of `job`, tile by tile, with the same pixels as
/// [`render_lit`](crate::render_lit), whenever it is stopped and resumed. Each further pass takes
/// as many samples again, with other random numbers, and is averaged with those before it.
/// [`Passes`](crate::Passes) chooses the samples of each pass instead.
#[derive(Debug)]
pub struct ProgressiveRender {
    job: Job,
    settings: LightSettings,
    /// The number of passes, with the one in progress.
    passes: u32,
    /// The job of the pass in progress: `job` with other samples.
    current: Job,
    /// The tiles of this pass that are still to be rendered.
    pending: Vec<Cell>,
    /// What the pixels of all passes can show, known once the first tile is rendered.
    contents: OnceCell<PixelContents>,
    so_far: Rendered,
}

impl ProgressiveRender {
    /// A picture of which nothing is rendered yet. Tiles near the centre of the cell come first.
    pub fn new(scene: &PreparedScene, job: Job, settings: LightSettings) -> ProgressiveRender {
        let so_far = Rendered::black(job.film, scene.picture.is_lit());
        ProgressiveRender::from_picture(so_far, job, settings)
    }

    /// As [`ProgressiveRender::new`], but the samples of all passes are added exactly: the picture
    /// does not depend on how they are divided into passes. Its film must be updated
    /// ([`Rendered::update_film`]) after a pass.
    pub(crate) fn exact(
        scene: &PreparedScene,
        job: Job,
        settings: LightSettings,
    ) -> ProgressiveRender {
        let so_far = Rendered::exact(job.film, scene.picture.is_lit());
        ProgressiveRender::from_picture(so_far, job, settings)
    }

    fn from_picture(so_far: Rendered, job: Job, settings: LightSettings) -> ProgressiveRender {
        ProgressiveRender {
            job,
            settings,
            passes: 1,
            current: job,
            pending: centre_first(job.cell),
            contents: OnceCell::new(),
            so_far,
        }
    }

    /// The job of the first pass.
    pub fn job(&self) -> &Job {
        &self.job
    }

    /// The settings of all passes.
    pub fn settings(&self) -> &LightSettings {
        &self.settings
    }

    /// The number of passes so far, including the one in progress.
    pub fn passes(&self) -> u32 {
        self.passes
    }

    /// The number of samples of all passes, with the one in progress.
    pub(crate) fn samples(&self) -> u32 {
        self.current.sampling.first_sample - self.job.sampling.first_sample + self.current.samples
    }

    /// The picture so far. Pixels without samples are black.
    pub fn rendered(&self) -> &Rendered {
        &self.so_far
    }

    /// The picture so far, to finish it.
    pub(crate) fn rendered_mut(&mut self) -> &mut Rendered {
        &mut self.so_far
    }

    /// The picture so far, when no more is rendered.
    pub(crate) fn into_rendered(self) -> Rendered {
        self.so_far
    }

    /// Whether all tiles of all passes are rendered.
    pub fn is_done(&self) -> bool {
        self.pending.is_empty()
    }

    /// The share of the pixels of this pass that are rendered, in [0, 1].
    pub fn progress(&self) -> f64 {
        let pending: u64 = self.pending.iter().map(|tile| tile.area()).sum();
        1.0 - pending as f64 / self.job.cell.area() as f64
    }

    /// Adds a pass with as many samples again. Does nothing while a pass is unfinished, or if the
    /// numbers of samples would no longer fit.
    pub fn add_pass(&mut self) {
        self.add_pass_of(self.job.samples);
    }

    /// As [`ProgressiveRender::add_pass`], with `samples` for each pixel.
    pub(crate) fn add_pass_of(&mut self, samples: u32) {
        if self.is_done() && self.has_room(samples) {
            self.passes += 1;
            self.current.sampling.first_sample += self.current.samples;
            self.current.samples = samples;
            self.pending = centre_first(self.job.cell);
        }
    }

    /// Whether the numbers of `samples` more would fit.
    pub(crate) fn has_room(&self, samples: u32) -> bool {
        let taken = self.current.sampling.first_sample + self.current.samples;
        u64::from(taken) + u64::from(samples) <= u64::from(MAX_SAMPLES)
    }

    /// Renders the next `count` pending tiles on rayon's current thread pool, or fewer if `stop` is
    /// set: call it until [`ProgressiveRender::is_done`]. A tile that `stop` interrupts is rendered
    /// again later. Returns the tiles that were rendered.
    pub fn run(&mut self, scene: &PreparedScene, count: usize, stop: &AtomicBool) -> Vec<Cell> {
        self.run_with(scene, count, stop, &|_| ())
    }

    /// As [`ProgressiveRender::run`]. Calls `tile_done`, which may set `stop`, with each tile that
    /// was rendered.
    pub(crate) fn run_with(
        &mut self,
        scene: &PreparedScene,
        count: usize,
        stop: &AtomicBool,
        tile_done: &(dyn Fn(TileDone) + Sync),
    ) -> Vec<Cell> {
        let samples = u64::from(self.current.samples);
        let tiles: Vec<Cell> = self.pending.iter().copied().take(count).collect();
        let finished = Mutex::new((&mut self.so_far, Vec::with_capacity(tiles.len())));
        let finish = |tile: RenderedTile| {
            // `stop` is never reset during a run: if it is not set now, it was not set while the
            // tile was rendered.
            if !stop.load(Ordering::Relaxed) {
                let mut finished = finished.lock().expect("adding a tile does not panic");
                finished.0.add_tile(&tile);
                finished.1.push(tile.cell);
                drop(finished);
                tile_done(TileDone {
                    samples: tile.cell.area() * samples,
                    rays: tile.counters.rays,
                });
            }
        };
        let (job, settings) = (&self.current, &self.settings);
        let contents = self
            .contents
            .get_or_init(|| scene.picture.pixel_contents(job, settings));
        scene.render_tiles(job, settings, contents, &tiles, stop, &finish);
        let (_, finished) = finished.into_inner().expect("adding a tile does not panic");
        let (rendered, mut pending): (Vec<Cell>, Vec<Cell>) =
            tiles.iter().partition(|tile| finished.contains(tile));
        pending.extend(self.pending.drain(tiles.len()..));
        self.pending = pending;
        rendered
    }
}

/// A finished tile.
#[derive(Clone, Copy, Debug)]
pub struct TileDone {
    /// Its pixels times their samples; with adaptive sampling times their largest number.
    pub samples: u64,
    /// The rays that were traced for it.
    pub rays: u64,
}

/// The largest number of samples of a pixel: sample numbers have 32 bits.
const MAX_SAMPLES: u32 = 1 << 30;

/// The job of one of several passes: the same, with other samples.
pub(crate) fn job_of_pass(job: &Job, pass: u32) -> Job {
    let mut job = *job;
    job.sampling.first_sample += pass * job.samples;
    job
}

/// The tiles of `cell`, sorted by their distance from its centre.
fn centre_first(cell: Cell) -> Vec<Cell> {
    let twice_centre = |cell: &Cell| {
        let [x0, y0, x1, y1] = [cell.x0, cell.y0, cell.x1, cell.y1].map(i64::from);
        (x0 + x1, y0 + y1)
    };
    let (x, y) = twice_centre(&cell);
    let mut tiles = cell.tiles();
    tiles.sort_by_key(|tile| {
        let (tx, ty) = twice_centre(tile);
        (tx - x).pow(2) + (ty - y).pow(2)
    });
    tiles
}
