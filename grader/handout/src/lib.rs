//! Creates handouts: the projects that students receive.
//!
//! The handout of part N contains the reference's code of the parts before N. From part N on it
//! contains functions to write, and all that is needed to write and grade them. Read [`carve`] (one
//! file) first, then `file_selection` (which files) and [`Handout::carve`]. [`readme`] writes the
//! README.
//!
//! `grader start` makes the folder of somebody who learns alone, beside the checkout: a handout
//! that uses what cargo built of the checkout ([`built`]), and a [`repository`].

pub mod built;
pub mod carve;
mod editor_files;
mod file_selection;
pub mod output_folder;
pub mod readme;
pub mod repository;
mod unit_tests;
pub mod vendored;
mod whole_solutions;
mod worked_examples;

use base::{GraderError, Workspace, folder_of};
use carve::Carver;
use file_selection::FileSelection;
use files::file_tree::{self, Files};
use files::members;
use files::{lock, manifest};
use grader::book;
use grader::course::given::{self, GivenFiles};
use grader::course::packed;
use grader::course::{Course, stages_of};
use judge::{packed_truth, truth_tables};
use std::collections::{BTreeMap, BTreeSet};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// A handout: the files of the course without the solutions of some parts.
#[derive(Clone, Debug)]
pub struct Handout {
    /// All files of the handout.
    pub files: Files,
    /// The solutions that were removed.
    pub removed: Vec<RemovedSolution>,
    /// The files with solutions of earlier parts. The handout keeps these solutions.
    pub reference_files: BTreeSet<PathBuf>,
}

/// A solution that was removed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RemovedSolution {
    /// The file that contained it.
    pub path: PathBuf,
    /// The key of the task that it solves.
    pub key: String,
    /// Its text.
    pub text: String,
}

impl Handout {
    /// Creates the handout of `part` from the full checkout `workspace`.
    pub fn carve(workspace: &Workspace, part: u32) -> Result<Handout, GraderError> {
        let root = workspace.root();
        let course = Course::read(workspace)?;
        let carver = file_selection::carver(&course, part)?;
        let members = members::read(root)?;
        let selection = FileSelection::new(&members);
        let mut handout = Handout {
            files: Files::new(),
            removed: Vec::new(),
            reference_files: BTreeSet::new(),
        };
        let paths = file_tree::workspace_paths(root)?;
        for path in &paths {
            if selection.includes(path) {
                let contents = file_tree::read(root, path)?;
                let solution_of = course.whole_solution(path);
                handout.add(
                    &selection,
                    &carver,
                    path.clone(),
                    contents,
                    solution_of,
                    root,
                )?;
            }
        }
        if let Some(key) = carver
            .carved_keys
            .iter()
            .find(|key| !handout.has_removed(key))
        {
            return Err(GraderError::new(format!(
                "found no solution of {key} in {}. Is this a handout? Handouts are created from the course's \
                 full checkout, from files that git tracks",
                root.display()
            )));
        }
        whole_solutions::check(&course, &paths)?;
        handout.shorten_summary();
        handout.add_truth(&carver);
        handout.remove_unit_tests(&selection)?;
        handout.remove_tests(&selection)?;
        handout.test_only_stages(&course, part)?;
        handout.pack_goldens();
        editor_files::add(&mut handout.files);
        let readme = readme::write(&course, part, &handout.files)?;
        handout
            .files
            .insert("README.md".into(), readme.into_bytes());
        lock::remove_unused(&mut handout.files)?;
        handout.list_given(&selection, &course);
        Ok(handout)
    }

    /// Removes the lines of the book's table of contents whose chapters the handout does not have.
    fn shorten_summary(&mut self) {
        let book = Path::new("stages/book/src");
        let Some(summary) = self.files.get(&book.join("SUMMARY.md")) else {
            return;
        };
        let text = String::from_utf8_lossy(summary);
        let is_there = |line: &&str| {
            let target = line
                .rsplit_once("](")
                .and_then(|(_, rest)| rest.strip_suffix(')'));
            target.is_none_or(|target| self.files.contains_key(&book.join(target)))
        };
        let kept: String = text
            .lines()
            .filter(is_there)
            .flat_map(|line| [line, "\n"])
            .collect();
        self.files
            .insert(book.join("SUMMARY.md"), kept.into_bytes());
    }

    /// Makes cargo take all libraries from the folder that [`Handout::write`] can add.
    pub fn use_vendored_libraries(&mut self, workspace: &Workspace) -> Result<(), GraderError> {
        let settings = self.files.entry(".cargo/config.toml".into()).or_default();
        settings.extend_from_slice(vendored::SETTINGS.as_bytes());
        let members = members::read(workspace.root())?;
        self.files.remove(Path::new(given::LIST));
        self.list_given(&FileSelection::new(&members), &Course::read(workspace)?);
        Ok(())
    }

    /// Adds the rendered book, whose site is in the folder `site`, as one packed file. What it only
    /// copies from files of the handout, such as figures, is left out: unpacking copies them again.
    pub fn add_book(&mut self, site: &Path) -> Result<(), GraderError> {
        let mut files = Vec::new();
        for file in book::files_below(site)? {
            let path = file.strip_prefix(site).unwrap_or(&file);
            // The site of a handout says itself what it was made of.
            let is_hidden = path.to_string_lossy().starts_with('.');
            if is_hidden {
                continue;
            }
            let contents = std::fs::read(&file).map_err(|e| GraderError::file("read", &file, e))?;
            let original = book::original(path).and_then(|path| self.files.get(&path));
            if original != Some(&contents) {
                files.push((path.to_path_buf(), contents));
            }
        }
        files.sort();
        let pack = packed::pack(&files);
        if let Some(list) = self.files.get_mut(Path::new(given::LIST)) {
            let mut given = GivenFiles::parse(&String::from_utf8_lossy(list));
            given.add(Path::new(book::PACK), &pack, false);
            *list = given.to_text().into_bytes();
        }
        self.files.insert(book::PACK.into(), pack);
        Ok(())
    }

    /// Writes the handout to the new folder `out`, with the sources of all libraries if `vendor` is
    /// set. On an error the folder does not exist.
    pub fn write(&self, out: &Path, vendor: bool) -> Result<(), GraderError> {
        let temp = base::interrupt::temp_folder_in(folder_of(out)?)?;
        let complete = temp.path().join("handout");
        for (path, contents) in &self.files {
            file_tree::write(&complete.join(path), contents)?;
        }
        if vendor {
            vendored::add(&complete)?;
        }
        // Not all systems can rename a folder to the name of an empty one.
        let _ = std::fs::remove_dir(out);
        std::fs::rename(&complete, out).map_err(|e| GraderError::file("write", out, e))
    }

    /// The files that students do not write.
    pub fn given(&self) -> impl Iterator<Item = &Path> {
        let list = self.files.get(Path::new(given::LIST));
        let text = list.map(|list| String::from_utf8_lossy(list));
        let given = GivenFiles::parse(&text.unwrap_or_default());
        let files = self.files.iter();
        files
            .filter(move |(path, contents)| given.is_original(path, contents).is_some())
            .map(|(path, _)| path.as_path())
    }

    fn has_removed(&self, key: &str) -> bool {
        self.removed.iter().any(|removed| removed.key == key)
    }

    /// Adds a file of the workspace without the solutions to remove. All of it may be the solution
    /// of the task `solution_of`.
    fn add(
        &mut self,
        selection: &FileSelection,
        carver: &Carver,
        path: PathBuf,
        contents: Vec<u8>,
        solution_of: Option<&str>,
        root: &Path,
    ) -> Result<(), GraderError> {
        let is_rust = path.extension().is_some_and(|extension| extension == "rs");
        if !is_rust || selection.owner(&path).is_none() {
            self.files.insert(path, contents);
            return Ok(());
        }
        let text = text(&path, contents)?;
        let is_solution = solution_of.is_some() || text.contains("// BEGIN SOLUTION(");
        let name = path.to_string_lossy();
        let carved = match solution_of {
            Some(key) => carver.carve_whole(&name, key, text)?,
            None => carver.carve(&name, &text)?,
        };
        let text = if carved.removed.is_empty() || carved.text.is_empty() {
            carved.text
        } else {
            formatted(root, &path, &carved.text)?
        };
        if is_solution && carved.removed.is_empty() {
            self.reference_files.insert(path.clone());
        }
        let removed = carved
            .removed
            .into_iter()
            .map(|(key, text)| RemovedSolution {
                path: path.clone(),
                key,
                text,
            });
        self.removed.extend(removed);
        if !text.is_empty() {
            self.files.insert(path, text.into_bytes());
        }
        Ok(())
    }

    /// Adds the right results of the formulas that were removed from the judge.
    fn add_truth(&mut self, carver: &Carver) {
        let tables = truth_tables::of_seed_0().iter();
        let removed = tables.filter(|(task, _)| carver.carved_keys.contains(**task));
        let table = packed_truth::pack(removed.map(|(_, table)| table));
        self.files.insert(packed_truth::FILE.into(), table);
    }

    /// Removes the unit tests of crates that no student changes.
    fn remove_unit_tests(&mut self, selection: &FileSelection) -> Result<(), GraderError> {
        let mut removed = BTreeSet::new();
        for (path, contents) in &mut self.files {
            let is_rust = path.extension().is_some_and(|extension| extension == "rs");
            let is_given = selection.owner(path).is_some_and(file_selection::is_given);
            if is_rust && is_given {
                let without = unit_tests::remove(path, &text(path, contents.clone())?)?;
                *contents = without.text.into_bytes();
                removed.extend(without.files);
            }
        }
        self.files.retain(|path, _| !removed.contains(path));
        Ok(())
    }

    /// Removes the tests and benches that run removed solutions, because they would fail, but for the
    /// worked examples. Also removes them from the manifests.
    fn remove_tests(&mut self, selection: &FileSelection) -> Result<(), GraderError> {
        let owners = self
            .removed
            .iter()
            .filter_map(|removed| selection.owner(&removed.path));
        let carved: BTreeSet<&str> = owners.map(|owner| owner.name.as_str()).collect();
        let tests_holes = |path: &Path| {
            selection
                .owner(path)
                .is_some_and(|owner| selection.tests_carved_code(owner, &carved))
        };
        self.files.retain(|path, _| {
            let is_example = path
                .file_name()
                .is_some_and(|name| name == worked_examples::FILE);
            !(selection.is_test(path) && tests_holes(path)) || is_example
        });
        for (path, contents) in &mut self.files {
            if path.file_name().is_none_or(|name| name != "Cargo.toml") {
                continue;
            }
            let old = text(path, contents.clone())?;
            *contents = match selection.owner(path) {
                None => selection.with_members(&old),
                Some(_) if tests_holes(path) || selection.leaves_out_tests(path) => {
                    manifest::without_tests(&old)
                }
                Some(_) => old,
            }
            .into_bytes();
        }
        self.remove_unused_dev_dependencies(selection)
    }

    /// Removes the libraries that only removed tests used: `cargo test` would compile them.
    fn remove_unused_dev_dependencies(
        &mut self,
        selection: &FileSelection,
    ) -> Result<(), GraderError> {
        let mut manifests = Vec::new();
        for (path, contents) in &self.files {
            let is_manifest = path.file_name().is_some_and(|name| name == "Cargo.toml");
            let Some(owner) = selection.owner(path).filter(|_| is_manifest) else {
                continue;
            };
            let is_of_owner = |path: &Path| {
                path.extension().is_some_and(|extension| extension == "rs")
                    && selection.owner(path) == Some(owner)
            };
            let code: Vec<_> = self
                .files
                .iter()
                .filter(|(path, _)| is_of_owner(path))
                .map(|(_, text)| String::from_utf8_lossy(text))
                .collect();
            let is_used = |name: &str| {
                let name = name.replace('-', "_");
                let is_part = |c: char| c == '_' || c.is_alphanumeric();
                let mut words = code.iter().flat_map(|text| text.split(|c| !is_part(c)));
                words.any(|word| word == name)
            };
            let text = text(path, contents.clone())?;
            let text = manifest::without_unused_dev_dependencies(&text, is_used);
            manifests.push((path.clone(), text.into_bytes()));
        }
        self.files.extend(manifests);
        Ok(())
    }

    /// Makes `cargo test` test the stages that students write, and nothing else: of the worked
    /// examples those of tasks that are written.
    fn test_only_stages(&mut self, course: &Course, part: u32) -> Result<(), GraderError> {
        let to_write = course.parts.iter().filter(|p| p.number >= part);
        worked_examples::ignore_open(&mut self.files, to_write.clone().flat_map(|it| &it.tasks));
        let stages = stages_of(to_write.flat_map(|part| &part.tasks));
        let folders: Vec<PathBuf> = stages
            .iter()
            .map(|stage| Path::new("stages").join(stage))
            .collect();
        if let Some(manifest) = self.files.get_mut(Path::new("Cargo.toml")) {
            let old = text(Path::new("Cargo.toml"), manifest.clone())?;
            *manifest = manifest::with_default_members(&old, &folders).into_bytes();
        }
        Ok(())
    }

    /// Adds the list of the files that students do not write.
    fn list_given(&mut self, selection: &FileSelection, course: &Course) {
        let mut given = GivenFiles::default();
        for (path, contents) in &self.files {
            if !selection.is_written(path, &course.stages()) {
                given.add(path, contents, selection.decides_points(path));
            }
        }
        let list = given.to_text().into_bytes();
        self.files.insert(given::LIST.into(), list);
    }

    /// Replaces the snapshots of each task by its pack: as text they would take most of the handout.
    fn pack_goldens(&mut self) {
        let mut packs: BTreeMap<String, Vec<(PathBuf, Vec<u8>)>> = BTreeMap::new();
        self.files.retain(|path, contents| {
            let Ok(below) = path.strip_prefix("golden") else {
                return true;
            };
            let task = packed::task_of(below);
            if let Some(task) = &task {
                let files = packs.entry(task.clone()).or_default();
                files.push((below.to_path_buf(), std::mem::take(contents)));
            }
            task.is_none()
        });
        let packs = packs.into_iter();
        self.files
            .extend(packs.map(|(task, files)| (packed::path_of(&task), packed::pack(&files))));
    }
}

fn text(path: &Path, contents: Vec<u8>) -> Result<String, GraderError> {
    String::from_utf8(contents)
        .map_err(|_| GraderError::new(format!("{} is not UTF-8 text", path.display())))
}

/// Formats a carved file with rustfmt: a stub may need other line breaks than its solution.
fn formatted(root: &Path, path: &Path, text: &str) -> Result<String, GraderError> {
    let failed = |e: &dyn std::fmt::Display| {
        GraderError::new(format!(
            "cannot format {} after removing its solutions: {e}. (To install rustfmt, run `rustup component add rustfmt`.)",
            path.display()
        ))
    };
    let mut child = Command::new("rustfmt")
        .current_dir(root)
        .args(["--edition", "2024", "--emit", "stdout"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(|e| failed(&e))?;
    if let Some(mut stdin) = child.stdin.take() {
        stdin.write_all(text.as_bytes()).map_err(|e| failed(&e))?;
    }
    let output = child.wait_with_output().map_err(|e| failed(&e))?;
    if !output.status.success() {
        return Err(failed(&String::from_utf8_lossy(&output.stderr).trim()));
    }
    String::from_utf8(output.stdout).map_err(|e| failed(&e))
}
