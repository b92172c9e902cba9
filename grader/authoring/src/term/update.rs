//! Takes a newer First Light into a term: `grader course update`. Points that were given do not
//! change: what the newer version counts differently is kept as it was, in `kept.toml`, unless the
//! teacher wants the new points.

use super::build::{Applied, originals, remember};
use super::settings::{Changes, FILE, KEPT, Kept};
use super::{COPY, apply};
use crate::diff::{self, Change};
use base::{GraderError, VERSION, Workspace, write_whole};
use files::file_tree::Files;
use grader::course::{Course, Task};
use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// What an update would do.
#[derive(Debug)]
pub struct Update {
    folder: PathBuf,
    applied: Applied,
    kept: Kept,
    /// The newer version is there already, to be compared and then to take the old one's place.
    copy: base::interrupt::TempFolder,
    /// The version that the term uses.
    pub from: String,
    /// What changes for students.
    pub changes: Vec<Change>,
    /// Chapters, conventions and given code that change.
    pub texts: Vec<String>,
    /// What is kept as it was, as sentences.
    pub kept_points: Vec<String>,
    /// Points that change nevertheless, as sentences.
    pub lost_points: Vec<String>,
}

impl Update {
    /// Compares the term in `folder` with the newer First Light in `new`. With `take_points`, its
    /// points replace those of the term.
    pub fn plan(new: &Workspace, folder: &Path, take_points: bool) -> Result<Update, GraderError> {
        new.ensure_full("a term needs the whole course")?;
        let old = Workspace::of_any_version(&folder.join(COPY)).map_err(|_| {
            GraderError::new(format!(
                "{} has no {COPY}, so nothing can be compared. Run ./get-first-light there first",
                folder.display()
            ))
        })?;
        if old.root() == new.root() {
            return Err(GraderError::new(
                "this is the First Light that the course uses already. Run the command in a checkout of the newer version",
            ));
        }
        let before = Course::read(&old)?;
        let mut changes = Changes::read(folder)?;
        let files = originals(new)?;
        let mut kept_points = Vec::new();
        if !take_points {
            let is = apply::course(&files, &changes)?;
            kept_points = keep(&mut changes.kept, &before, &is);
        }
        let applied = Applied::new(files, &changes)?;
        let copy = base::interrupt::temp_folder_in(folder)?;
        applied.write(copy.path())?;
        let newer = Workspace::of_any_version(copy.path())?;
        let after = Course::read(&newer)?;
        Ok(Update {
            from: changes.settings.first_light.version.clone(),
            changes: diff::changes(&old, &newer)?,
            texts: texts(&old, &applied.files)?,
            kept: changes.kept,
            folder: folder.to_path_buf(),
            lost_points: lost(&before, &after),
            applied,
            copy,
            kept_points,
        })
    }

    /// The update for people.
    pub fn to_text(&self) -> String {
        let mut text = format!("First Light {} -> {VERSION}\n", self.from);
        let mut list = |heading: &str, lines: &[String]| {
            if !lines.is_empty() {
                let _ = writeln!(text, "\n{heading}");
                for line in lines {
                    let _ = writeln!(text, "  {line}");
                }
            }
        };
        let changes = self.changes.iter().map(|change| match &change.case {
            Some(case) => format!("{}/{case}: {}", change.task, change.what),
            None => format!("{}: {}", change.task, change.what),
        });
        list(
            "Tasks, cases, points and goldens that change:",
            &changes.collect::<Vec<_>>(),
        );
        list("Text and given code that change for students:", &self.texts);
        list(
            "Kept as it was (--new-points takes the new points):",
            &self.kept_points,
        );
        list("POINTS THAT WERE GIVEN CHANGE:", &self.lost_points);
        if self.changes.is_empty() && self.texts.is_empty() {
            text.push_str("\nNothing changes for students.\n");
        }
        text
    }

    /// Puts the newer version in the place of the old one.
    pub fn carry_out(self) -> Result<(), GraderError> {
        let file = self.folder.join(FILE);
        let settings =
            std::fs::read_to_string(&file).map_err(|e| GraderError::file("read", &file, e))?;
        let mut settings: toml_edit::DocumentMut = settings
            .parse()
            .map_err(|e| GraderError::new(format!("{}: {e}", file.display())))?;
        settings["first_light"]["version"] = toml_edit::value(VERSION);
        write_whole(&file, settings.to_string().as_bytes())?;
        let kept = self.folder.join(KEPT);
        match self.kept == Kept::default() {
            true if !kept.exists() => {}
            _ => write_whole(&kept, kept_text(&self.kept).as_bytes())?,
        }
        // In place, so that what was compiled is compiled again only where it changed.
        self.applied.write(&self.folder.join(COPY))?;
        drop(self.copy);
        remember(&self.folder)
    }
}

/// Adds to `kept` what makes the course `is` give the points of `was`. Returns what that is.
fn keep(kept: &mut Kept, was: &Course, is: &Course) -> Vec<String> {
    let mut sentences = Vec::new();
    for task in is.tasks() {
        let Some(before) = was.tasks().find(|other| other.key == task.key) else {
            kept.leave_out.push(task.key.clone());
            sentences.push(format!("{}, a new task, is left out", task.key));
            continue;
        };
        for case in &task.cases {
            let name = format!("{}/{}", task.key, case.name);
            match before.cases.iter().find(|other| other.name == case.name) {
                Some(earlier) if earlier.points != case.points => {
                    kept.points.insert(name.clone(), earlier.points);
                    sentences.push(format!(
                        "{name}: {} points, and not {}",
                        earlier.points, case.points
                    ));
                }
                Some(_) => {}
                // It cannot be left out: the change is told as one of points.
                None if task.cases_of_idea().any(|shown| *shown == case.name) => {}
                None => {
                    sentences.push(format!(
                        "{name}, a new case with {} points, is left out",
                        case.points
                    ));
                    kept.leave_out.push(name);
                }
            }
        }
    }
    sentences
}

/// The tasks whose points are others, as sentences.
fn lost(was: &Course, is: &Course) -> Vec<String> {
    use judge::Tier;
    let points = |task: &Task| [Tier::Core, Tier::Robust].map(|tier| task.points(tier));
    let mut sentences = Vec::new();
    for task in was.tasks() {
        match is.tasks().find(|other| other.key == task.key) {
            None => sentences.push(format!("{} does not exist any more", task.key)),
            Some(now) if points(now) != points(task) => {
                let ([core, extra], [now_core, now_extra]) = (points(task), points(now));
                sentences.push(format!(
                    "{}: {core} core points and {extra} extra -> {now_core} and {now_extra}",
                    task.key
                ));
            }
            Some(now) => {
                let names = |task: &Task| -> BTreeSet<String> {
                    let cases = task.cases.iter();
                    cases
                        .map(|case| format!("{} {} {:?}", case.name, case.points, case.tier))
                        .collect()
                };
                if names(task) != names(now) {
                    sentences.push(format!(
                        "{}: divided among its cases in another way",
                        task.key
                    ));
                }
            }
        }
    }
    sentences
}

/// Which chapters, and which given crates of the stages, differ.
fn texts(old: &Workspace, new: &Files) -> Result<Vec<String>, GraderError> {
    let mut changed = BTreeSet::new();
    let old_paths = files::file_tree::workspace_paths(old.root())?;
    let all = old_paths.iter().chain(new.keys());
    for path in all.filter(|path| path.starts_with("stages")) {
        let before = std::fs::read(old.root().join(path)).ok();
        if before.as_ref() == new.get(path) {
            continue;
        }
        let name = path.to_string_lossy();
        let is_text = name.ends_with(".md");
        if let Some(chapter) = name.strip_prefix("stages/book/src/").filter(|_| is_text) {
            changed.insert(format!("chapter {}", chapter.trim_end_matches(".md")));
        } else if name == "stages/course.toml" {
            continue;
        } else if let Some(stage) = path.iter().nth(1).filter(|stage| *stage != "book") {
            changed.insert(format!("stages/{}", stage.to_string_lossy()));
        }
    }
    Ok(changed.into_iter().collect())
}

/// The text of `kept.toml`.
fn kept_text(kept: &Kept) -> String {
    let mut list = toml_edit::DocumentMut::new();
    let names: toml_edit::Array = kept.leave_out.iter().map(String::as_str).collect();
    list.insert("leave_out", toml_edit::value(names));
    let mut points = toml_edit::Table::new();
    for (name, value) in &kept.points {
        points.insert(name, toml_edit::value(*value));
    }
    list.insert("points", toml_edit::Item::Table(points));
    format!(
        "# What updates of First Light kept as it was, so that no points that were given change. `cargo grader course update`\n\
         # writes this file. To take a new case or new points, remove its entry; what course.toml says counts more.\n{list}"
    )
}
