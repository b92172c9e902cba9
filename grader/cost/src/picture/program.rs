//! Runs the `pathtracer` program from the command line.

use crate::timing::{Measured, missing};
use base::GraderError;
use base::child_processes::{self, tail};
use base::interrupt::{self, TempFolder};
use grader::build;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// The built program, and a directory for its pictures.
#[derive(Debug)]
pub struct Program {
    path: PathBuf,
    folder: TempFolder,
}

/// The arguments of one rendering.
#[derive(Clone, Copy, Debug)]
pub struct RenderRequest<'a> {
    /// The scene file.
    pub scene: &'a Path,
    /// Width and height in pixels.
    pub film: [u32; 2],
    /// The part that is rendered: left, bottom, width, height.
    pub cell: [u32; 4],
    /// Further flags, separated by spaces.
    pub flags: &'a str,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Threads to render on.
    pub threads: usize,
}

/// A picture with its rendering time.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderedPicture {
    /// Linear radiance of each pixel.
    pub pixels: Vec<[f64; 3]>,
    /// Seconds to render, without loading and tree construction.
    pub seconds: f64,
    /// Mean number of samples per pixel, if the program prints it.
    pub samples: Option<f64>,
}

/// Time limit for one picture: the reference needs about 3 s for the slowest.
const TIME_LIMIT: Duration = Duration::from_secs(60);

/// Interval at which the process is polled. Rendering times are printed by the program itself.
const POLL_INTERVAL: Duration = Duration::from_millis(2);

impl Program {
    /// Builds the program of the workspace `root`; the inner error is the reason why it cannot, as
    /// the end of a sentence.
    pub fn build(root: &Path) -> Measured<Program> {
        match build::build_program_with_stages(root, "pathtracer")? {
            Ok(path) => Ok(Program {
                path,
                folder: interrupt::temp_folder()?,
            }),
            Err(_) => missing("the program pathtracer does not compile"),
        }
    }

    /// Renders a picture; the inner error is the reason why it cannot, as the end of a sentence.
    pub fn render(&self, request: &RenderRequest) -> Measured<RenderedPicture> {
        let picture = self.folder.path().join("picture.exr");
        let [w, h] = request.film.map(|edge| edge.to_string());
        let mut command = Command::new(&self.path);
        command
            .arg("-f")
            .arg(&picture)
            .args(["-r", &w, &h])
            .arg("-p")
            .args(request.cell.map(|edge| edge.to_string()))
            .args(["-t", &request.threads.to_string()])
            .args(["--seed", &request.seed.to_string()])
            .args(request.flags.split_whitespace())
            .arg(request.scene)
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        let (child, _running) = child_processes::start(&mut command)
            .map_err(|e| GraderError::file("start", &self.path, e))?;
        let finished = finish(child).map_err(|e| GraderError::file("wait for", &self.path, e))?;
        let Some((status, output, errors)) = finished else {
            let limit = TIME_LIMIT.as_secs();
            return missing(format!("a picture takes more than {limit} s"));
        };
        if !status.success() {
            let last = errors.lines().last();
            return missing(last.unwrap_or("the program ended without a picture"));
        }
        let Some(seconds) = seconds(&output) else {
            return missing("the program does not print its rendering time");
        };
        let picture = match image::open(&picture) {
            Ok(read) => read.to_rgb32f(),
            Err(why) => return missing(format!("its picture cannot be read: {why}")),
        };
        Ok(RenderedPicture {
            pixels: picture.pixels().map(|p| p.0.map(f64::from)).collect(),
            seconds,
            samples: samples(&output),
        })
    }
}

/// The exit status and the last output of a program on stdout and stderr; `None` if it exceeded the
/// time limit.
type Finished = Option<(ExitStatus, String, String)>;

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
        if start.elapsed() > TIME_LIMIT {
            child.kill()?;
            child.wait()?;
            break None;
        }
        std::thread::sleep(POLL_INTERVAL);
    };
    let [output, errors] =
        [stdout, stderr].map(|reader| reader.and_then(|r| r.join().ok()).unwrap_or_default());
    Ok(status.map(|status| (status, output, errors)))
}

/// Parses the line `Rendering   48 x 36 pixels, -s 16 -t 1: 0.0123 s`.
fn seconds(output: &str) -> Option<f64> {
    let line = output
        .lines()
        .rfind(|line| line.starts_with("Rendering "))?;
    let (_, time) = line.rsplit_once(": ")?;
    time.strip_suffix(" s")?.parse().ok()
}

/// Parses the line `Noise       at most 1.23 % of the mean in a pixel, 16.0 samples each`.
fn samples(output: &str) -> Option<f64> {
    let line = output.lines().rfind(|line| line.starts_with("Noise "))?;
    let (_, samples) = line.strip_suffix(" samples each")?.rsplit_once(' ')?;
    samples.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Guards against a build of this crate alone: the feature is also one of `pathtracer`.
    #[test]
    fn pictures_of_the_program_can_be_read() {
        assert!(image::ImageFormat::OpenExr.reading_enabled());
    }

    #[test]
    fn times_and_samples_are_parsed_from_the_output() {
        let output = "Rendering   of mine\nScene       a.dae: 2 primitives, loaded in 0.0004 s\n\
                    Rendering   48 x 36 pixels, -s 16 -t 1: 0.0123 s\n\
                    Noise       at most 1.23 % of the mean in a pixel, 272.5 samples each\n";
        assert_eq!(seconds(output), Some(0.0123));
        assert_eq!(samples(output), Some(272.5));
        assert_eq!(seconds("no line"), None);
    }
}
