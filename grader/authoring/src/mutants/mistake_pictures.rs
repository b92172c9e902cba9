//! Pictures of mistakes for the book: the picture of a task as the reference renders it, and as
//! mutants do, beside each other in one small file, and in a large one.
//!
//! `grader/mutants/pictures.toml` lists them. `grader mutants TASK --pictures` makes the files
//! below `stages/book/src/mistakes`, which the chapters and the gym show and every handout has, and
//! those below `stages/book/src/mistakes-large`, which the published book shows.

use super::corpus::{Corpus, Sources, reference_sources};
use super::few_colours::few_colours;
use super::run::{Kind, versions};
use super::versions_crate::{self, VERSION_VARIABLE};
use base::{GraderError, Workspace, write_whole};
use grader::course::{Course, Task};
use grader::grade::picture;
use grader::gym::mistake_sheet::{self, GAP, TILE};
use grader::workers::runner::Worker;
use judge::pictures::{NAME, TaskPicture};
use pictures::image::Rgb;
use pictures::{Image, png};
use serde::Deserialize;
use std::path::PathBuf;
use tempfile::TempPath;

/// The colour of the gaps, visible on white and on dark paper.
const PAPER: Rgb = [128, 128, 128];

/// The mistakes of a task that its chapter shows.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sheet {
    /// Key of the task.
    pub task: String,
    /// The panel of the task's picture, counted from the top.
    #[serde(default)]
    pub panel: u32,
    /// Column and row, from the top left of the panel, of the top left corner of the part that is
    /// shown as it is. Without it the whole panel is shown at half its size.
    #[serde(default)]
    pub corner: Option<[u32; 2]>,
    /// The largest number of colours of each picture.
    pub colours: usize,
    /// The names of the mutants, in the order in which they are shown.
    pub mutants: Vec<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct List {
    sheet: Vec<Sheet>,
}

impl Sheet {
    /// The sheets of all tasks. Fails if the list cannot be read or shows a place outside of a
    /// panel.
    pub fn all(workspace: &Workspace) -> Result<Vec<Sheet>, GraderError> {
        workspace.ensure_full("it does not contain the list of typical mistakes")?;
        let path = workspace.root().join("grader/mutants/pictures.toml");
        let text =
            std::fs::read_to_string(&path).map_err(|e| GraderError::file("read", &path, e))?;
        let list: List = toml::from_str(&text).map_err(|e| GraderError::file("parse", &path, e))?;
        for sheet in &list.sheet {
            sheet
                .check()
                .map_err(|message| GraderError::file("use", &path, message))?;
        }
        Ok(list.sheet)
    }

    fn check(&self) -> Result<(), String> {
        let task = &self.task;
        let picture = judge::pictures::of(task)
            .ok_or_else(|| format!("`{task}` has no picture: use a task's key"))?;
        let panels = picture.work.panels;
        if self.panel >= panels {
            let panel = self.panel;
            return Err(format!(
                "the picture of `{task}` has {panels} panels, counted from 0: there is no panel {panel}"
            ));
        }
        let [w, h] = picture.work.size;
        let corner = self.corner.unwrap_or_default();
        if corner[0] > w - TILE[0] || corner[1] > h - TILE[1] {
            return Err(format!(
                "`{task}`: the corner {corner:?} leaves less than {TILE:?} of a panel of {w} x {h} pixels"
            ));
        }
        Ok(())
    }

    /// The file of the sheet.
    pub fn file(&self, workspace: &Workspace) -> PathBuf {
        mistake_sheet::file(workspace, &self.task)
    }

    /// The file with whole panels in all their colours.
    pub fn large_file(&self, workspace: &Workspace) -> PathBuf {
        let file = self.file(workspace);
        let name = file.file_name().unwrap_or_default();
        let folder = workspace.root().join("stages/book/src/mistakes-large");
        folder.join(name)
    }

    /// What the large file shows of a picture of the task: its panel.
    pub fn panel(&self, picture: &Image) -> Image {
        let [width, height] = TILE.map(|side| 2 * side);
        let top = self.panel * height;
        Image::from_fn([width, height], |x, y| picture.get(x, top + y))
    }

    /// What the small file shows of a picture of the task.
    pub fn tile(&self, picture: &Image) -> Image {
        let top = self.panel * 2 * TILE[1];
        let tile = match self.corner {
            Some([x, y]) => Image::from_fn(TILE, |i, j| picture.get(x + i, top + y + j)),
            None => Image::from_fn(TILE, |i, j| mean_of_four(picture, 2 * i, top + 2 * j)),
        };
        few_colours(&tile, self.colours)
    }

    /// The picture that `tiles` make beside each other.
    fn compose(tiles: &[Image]) -> Image {
        let [width, height] = tiles.first().map_or(TILE, Image::size);
        let left = |number| mistake_sheet::left_among(width, number);
        let count = tiles.len() as u32;
        let mut sheet = Image::filled([left(count) - GAP, height], PAPER);
        for (i, tile) in (0..).zip(tiles) {
            sheet.paste(tile, left(i), 0);
        }
        sheet
    }
}

fn mean_of_four(picture: &Image, x: u32, y: u32) -> Rgb {
    let four = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(i, j)| picture.get(x + i, y + j));
    [0, 1, 2].map(|channel| {
        let sum: u32 = four.iter().map(|pixel| u32::from(pixel[channel])).sum();
        ((sum + 2) / 4) as u8
    })
}

/// The versions that sheets need, in one worker.
struct Versions {
    program: TempPath,
    /// The task and the name of each version from number 1 on. Number 0 is the reference.
    named: Vec<(String, String)>,
}

impl Versions {
    fn build(
        workspace: &Workspace,
        course: &Course,
        sheets: &[Sheet],
    ) -> Result<Versions, GraderError> {
        let mut named = Vec::new();
        let mut stages: Vec<(&str, Vec<Sources>)> = Vec::new();
        for stage in course.stages() {
            let mut sources = vec![reference_sources(workspace, stage)?];
            for task in course.tasks().filter(|task| task.stage == stage) {
                for sheet in sheets.iter().filter(|sheet| sheet.task == task.key) {
                    for (name, source) in mutants_of(workspace, task, sheet)? {
                        named.push((task.key.clone(), name));
                        sources.push(source);
                    }
                }
            }
            stages.push((stage, sources));
        }
        let program = versions_crate::worker_of_stages(workspace, "pictures", &stages)?;
        Ok(Versions { program, named })
    }

    /// The number of a version.
    fn number(&self, task: &str, name: &str) -> Result<usize, GraderError> {
        let is_it = |(of, called): &(String, String)| of == task && called == name;
        let found = self.named.iter().position(is_it);
        found
            .map(|i| i + 1)
            .ok_or_else(|| GraderError::new(format!("no mutant of `{task}` is called `{name}`")))
    }

    /// The picture of `task` that a version renders.
    fn render(
        &self,
        course: &Course,
        picture: &TaskPicture,
        number: usize,
    ) -> Result<Image, GraderError> {
        let worker = Worker {
            program: self.program.to_path_buf(),
            environment: vec![(VERSION_VARIABLE, number.to_string())],
            launcher: None,
            patience: Default::default(),
        };
        picture::rendered_by(course, picture, &worker)?.map_err(|status| {
            let name = &self.named[number - 1].1;
            GraderError::new(format!(
                "`{name}` renders no picture of {} ({status:?}): show another mistake",
                picture.task
            ))
        })
    }
}

/// The mutants that a sheet shows, in its order, with their sources.
fn mutants_of(
    workspace: &Workspace,
    task: &Task,
    sheet: &Sheet,
) -> Result<Vec<(String, Sources)>, GraderError> {
    let all = Corpus::read(workspace, task)?.mutants;
    let wanted = sheet.mutants.iter().map(|name| {
        let found = all.iter().find(|mutant| mutant.name() == *name);
        found.cloned().ok_or_else(|| {
            GraderError::new(format!(
                "grader/mutants/pictures.toml shows the mutant `{name}`, which grader/mutants/{}.txt does not have",
                task.key
            ))
        })
    });
    let (named, sources) = versions(workspace, task, wanted.collect::<Result<_, _>>()?)?;
    let both = named.into_iter().zip(sources);
    let mutants = both.filter(|((_, kind), _)| matches!(kind, Kind::Mutant(_)));
    Ok(mutants.map(|((name, _), source)| (name, source)).collect())
}

/// Renders the sheets of some tasks. Returns the path of each and its file's content.
pub fn render(
    workspace: &Workspace,
    course: &Course,
    tasks: &[&Task],
) -> Result<Vec<(PathBuf, Vec<u8>)>, GraderError> {
    let mut sheets = Sheet::all(workspace)?;
    sheets.retain(|sheet| tasks.iter().any(|task| task.key == sheet.task));
    let versions = Versions::build(workspace, course, &sheets)?;
    let mut files = Vec::new();
    for sheet in &sheets {
        let picture = judge::pictures::of(&sheet.task)
            .ok_or_else(|| GraderError::new(format!("`{}` has no picture", sheet.task)))?;
        let mut all = vec![golden(workspace, &sheet.task)?];
        for name in &sheet.mutants {
            let number = versions.number(&sheet.task, name)?;
            all.push(versions.render(course, &picture, number)?);
        }
        let tiles: Vec<Image> = all.iter().map(|picture| sheet.tile(picture)).collect();
        let panels: Vec<Image> = all.iter().map(|picture| sheet.panel(picture)).collect();
        for (path, shown) in [
            (sheet.file(workspace), tiles),
            (sheet.large_file(workspace), panels),
        ] {
            files.push((path, png::encode(&Sheet::compose(&shown))));
        }
    }
    Ok(files)
}

/// The golden picture of a task.
pub fn golden(workspace: &Workspace, task: &str) -> Result<Image, GraderError> {
    let path = workspace.golden_picture(task, NAME);
    png::read(&path).map_err(|e| GraderError::file("read", &path, e))
}

/// Renders the sheets of some tasks and writes their files. Returns the paths and their sizes in
/// bytes.
pub fn write(
    workspace: &Workspace,
    course: &Course,
    tasks: &[&Task],
) -> Result<Vec<(PathBuf, usize)>, GraderError> {
    let mut written = Vec::new();
    for (path, file) in render(workspace, course, tasks)? {
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder).map_err(|e| GraderError::file("create", folder, e))?;
        }
        write_whole(&path, &file)?;
        written.push((path, file.len()));
    }
    Ok(written)
}
