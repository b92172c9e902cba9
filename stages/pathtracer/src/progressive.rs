//! Rendering that can be watched, stopped, resumed, and continued with more samples.

use crate::rendered::RenderedTile;
use crate::{Job, LightSettings, PreparedScene, Rendered};
use kit::film::Cell;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

/// A picture in progress.
///
/// The first pass renders the picture of `job`, tile by tile, with the same pixels as
/// [`render_lit`](crate::render_lit), whenever it is stopped and resumed. Each further pass takes
/// as many samples again, with other random numbers, and is averaged with those before it.
#[derive(Debug)]
pub struct ProgressiveRender {
    job: Job,
    settings: LightSettings,
    /// The pass in progress, from 0.
    pass: u32,
    /// The tiles of this pass that are still to be rendered.
    pending: Vec<Cell>,
    so_far: Rendered,
}

impl ProgressiveRender {
    /// A picture of which nothing is rendered yet. Tiles near the centre of the cell come first.
    pub fn new(scene: &PreparedScene, job: Job, settings: LightSettings) -> ProgressiveRender {
        ProgressiveRender {
            job,
            settings,
            pass: 0,
            pending: centre_first(job.cell),
            so_far: Rendered::black(job.film, scene.picture.is_lit()),
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
        self.pass + 1
    }

    /// The picture so far. Pixels without samples are black.
    pub fn rendered(&self) -> &Rendered {
        &self.so_far
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
        if self.is_done() && self.first_sample(self.pass + 1).is_some() {
            self.pass += 1;
            self.pending = centre_first(self.job.cell);
        }
    }

    /// Renders the next `count` pending tiles on rayon's current thread pool, or fewer if `stop` is
    /// set: call it until [`ProgressiveRender::is_done`]. A tile that `stop` interrupts is rendered
    /// again later. Returns the tiles that were rendered.
    pub fn run(&mut self, scene: &PreparedScene, count: usize, stop: &AtomicBool) -> Vec<Cell> {
        let job = job_of_pass(&self.job, self.pass);
        let tiles: Vec<Cell> = self.pending.iter().copied().take(count).collect();
        let finished = Mutex::new(Vec::with_capacity(tiles.len()));
        let finish = |tile: RenderedTile| {
            // `stop` is never reset during a run: if it is not set now, it was not set while the
            // tile was rendered.
            if !stop.load(Ordering::Relaxed) {
                finished.lock().expect("no thread panics here").push(tile);
            }
        };
        scene.render_tiles(&job, &self.settings, &tiles, stop, &finish);
        let finished = finished.into_inner().expect("no thread panics here");
        finished.iter().for_each(|tile| self.so_far.add_tile(tile));
        let finished: Vec<Cell> = finished.iter().map(|tile| tile.cell).collect();
        let (rendered, mut pending): (Vec<Cell>, Vec<Cell>) =
            tiles.iter().partition(|tile| finished.contains(tile));
        pending.extend(self.pending.drain(tiles.len()..));
        self.pending = pending;
        rendered
    }

    /// The index of the first sample of a pass; `None` if it has no room for all its samples.
    fn first_sample(&self, pass: u32) -> Option<u32> {
        let end = u64::from(pass + 1) * u64::from(self.job.samples);
        let end = end + u64::from(self.job.sampling.first_sample);
        (end <= u64::from(MAX_SAMPLES)).then_some(end as u32 - self.job.samples)
    }
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
pub(crate) fn centre_first(cell: Cell) -> Vec<Cell> {
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
