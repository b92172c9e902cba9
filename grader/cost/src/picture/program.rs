//! The `pathtracer` program, run as a person would run it.

use grader::child_processes;
use grader::compile;
use grader::error::GraderError;
use grader::interrupt::{self, TempFolder};
use grader::runner::tail;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// The program, and a folder for its pictures.
#[derive(Debug)]
pub struct Program {
    path: PathBuf,
    folder: TempFolder,
}

/// What to render.
#[derive(Clone, Copy, Debug)]
pub struct Order<'a> {
    /// The scene file.
    pub scene: &'a Path,
    /// Pixels across and up.
    pub film: [u32; 2],
    /// The part that is rendered: left, bottom, width, height.
    pub cell: [u32; 4],
    /// Further flags, separated by blanks.
    pub flags: &'a str,
    /// Of the random numbers.
    pub seed: u64,
    /// Threads to render on.
    pub threads: usize,
}

/// A picture and what it took.
#[derive(Clone, Debug, PartialEq)]
pub struct Shot {
    /// Linear radiance, pixel by pixel.
    pub pixels: Vec<[f64; 3]>,
    /// Seconds to render, loading and building left aside.
    pub seconds: f64,
    /// Samples a pixel, on average, if the program tells.
    pub samples: Option<f64>,
}

/// A picture that is not there after this time never will be: the reference needs about 3 s for the longest.
const LIMIT: Duration = Duration::from_secs(60);

/// How often to look whether it is there. Times are the program's own.
const LOOK: Duration = Duration::from_millis(2);

impl Program {
    /// Builds the program of the workspace `root`; or why not, in words that end a sentence.
    pub fn build(root: &Path) -> Result<Result<Program, String>, GraderError> {
        match compile::build_program_with_stages(root, "pathtracer")? {
            Ok(path) => Ok(Ok(Program {
                path,
                folder: interrupt::temp_folder()?,
            })),
            Err(_) => Ok(Err("the program pathtracer does not compile".into())),
        }
    }

    /// Renders a picture; or why not, in words that end a sentence.
    pub fn render(&self, order: &Order) -> Result<Result<Shot, String>, GraderError> {
        let picture = self.folder.path().join("picture.exr");
        let [w, h] = order.film.map(|edge| edge.to_string());
        let mut command = Command::new(&self.path);
        command
            .arg("-f")
            .arg(&picture)
            .args(["-r", &w, &h])
            .arg("-p")
            .args(order.cell.map(|edge| edge.to_string()))
            .args(["-t", &order.threads.to_string()])
            .args(["--seed", &order.seed.to_string()])
            .args(order.flags.split_whitespace())
            .arg(order.scene)
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        let (child, _running) = child_processes::start(&mut command)
            .map_err(|e| GraderError::file("start", &self.path, e))?;
        let said = match finish(child).map_err(|e| GraderError::file("wait for", &self.path, e))? {
            Ok((status, said, _)) if status.success() => said,
            Ok((_, _, complaint)) => {
                let last = complaint
                    .lines()
                    .last()
                    .unwrap_or("it ended without a picture");
                return Ok(Err(last.to_string()));
            }
            Err(limit) => return Ok(Err(limit)),
        };
        let Some(seconds) = seconds(&said) else {
            return Ok(Err("the program does not tell how long it rendered".into()));
        };
        let pixels = match image::open(&picture) {
            Ok(read) => read
                .to_rgb32f()
                .pixels()
                .map(|p| p.0.map(f64::from))
                .collect(),
            Err(why) => return Ok(Err(format!("its picture cannot be read: {why}"))),
        };
        Ok(Ok(Shot {
            pixels,
            seconds,
            samples: samples(&said),
        }))
    }
}

/// How a program ended, and the last that it wrote to stdout and stderr; or that it took too long.
type Finished = Result<(ExitStatus, String, String), String>;

fn finish(mut child: Child) -> std::io::Result<Finished> {
    let stdout = child
        .stdout
        .take()
        .map(|pipe| std::thread::spawn(move || tail(pipe)));
    let stderr = child
        .stderr
        .take()
        .map(|pipe| std::thread::spawn(move || tail(pipe)));
    let start = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait()? {
            break Some(status);
        }
        if start.elapsed() > LIMIT {
            child.kill()?;
            child.wait()?;
            break None;
        }
        std::thread::sleep(LOOK);
    };
    let [said, complaint] =
        [stdout, stderr].map(|reader| reader.and_then(|r| r.join().ok()).unwrap_or_default());
    Ok(match status {
        Some(status) => Ok((status, said, complaint)),
        None => Err(format!("a picture takes more than {} s", LIMIT.as_secs())),
    })
}

/// From the line `Rendering   48 x 36 pixels, -s 16 -t 1: 0.0123 s`.
fn seconds(said: &str) -> Option<f64> {
    let line = said.lines().rfind(|line| line.starts_with("Rendering "))?;
    let (_, time) = line.rsplit_once(": ")?;
    time.strip_suffix(" s")?.parse().ok()
}

/// From the line `Noise       1.23 % of the mean in a pixel, 16.0 samples each`.
fn samples(said: &str) -> Option<f64> {
    let line = said.lines().rfind(|line| line.starts_with("Noise "))?;
    let (_, samples) = line.strip_suffix(" samples each")?.rsplit_once(' ')?;
    samples.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_the_program_says_is_understood() {
        let said = "Rendering   of mine\nScene       a.dae: 2 primitives, loaded in 0.0004 s\n\
                    Rendering   48 x 36 pixels, -s 16 -t 1: 0.0123 s\n\
                    Noise       1.23 % of the mean in a pixel, 272.5 samples each\n";
        assert_eq!(seconds(said), Some(0.0123));
        assert_eq!(samples(said), Some(272.5));
        assert_eq!(seconds("no line"), None);
    }
}
