//! Selects the files of a handout, and the tasks whose solutions are removed.

use super::carve::Carver;
use base::GraderError;
use files::manifest;
use files::members::{self, Member};
use grader::course::Course;
use std::collections::BTreeSet;
use std::path::Path;

/// The programs of a handout. It contains their crates and what these depend on, and no other
/// crates.
const PROGRAMS: &[&str] = &[
    "grader",
    "worker",
    "pathtracer",
    "viewer",
    "cost",
    "speedup",
    "look",
    "preview",
    "formats",
];

/// The folder of the book, whose chapters of all parts are in every handout.
const BOOK: &str = "stages/book";

/// Chapters for those who teach or maintain the course. A handout has their rendered pages only.
const ONLY_RENDERED: [&str; 2] = ["src/hosting.md", "src/hard-cases.md"];

/// Pictures that the published book alone shows: those that readers make with their own program,
/// and large ones of mistakes.
const ONLY_PUBLISHED: [&str; 2] = ["src/so-far", "src/mistakes-large"];

/// Plots of `grader cost` that the book shows.
const PLOTS_IN_BOOK: [&str; 2] = ["grader/pictures/triangles.svg", "grader/pictures/world.svg"];

/// Files in the root folder that a handout contains.
const ROOT_FILES: [&str; 4] = ["Cargo.lock", ".gitignore", "clippy.toml", "rustfmt.toml"];

/// The list of what no seed changes.
const NOT_MOVED: &str = "golden/not_moved.txt";

/// The list, in the folder of each task, of what the oracle does not judge: for `grader bless`.
const NOT_JUDGED: &str = "not_judged.txt";

/// What students do not need: the README's pictures and their scenes, tests of given code,
/// scripts for large pictures, and what has other libraries answer.
const LEFT_OUT: [&str; 10] = [
    "scenes/pictures",
    "scenes/tests",
    "scenes/dae/dusk.dae",
    "scenes/dae/gallery.dae",
    "scenes/dae/materials.dae",
    "scenes/dae/sphereflake.dae",
    "scenes/dae/stones_sun.dae",
    "scenes/dae/window_room.dae",
    "grader/world",
    "stages/pathtracer/cluster",
];

/// Selects the files and crates of a handout.
#[derive(Clone, Debug)]
pub(super) struct FileSelection<'a> {
    members: &'a [Member],
    needed: BTreeSet<&'a str>,
    /// The crates that a student's points are computed with.
    grading: BTreeSet<&'a str>,
}

impl<'a> FileSelection<'a> {
    pub(super) fn new(members: &'a [Member]) -> FileSelection<'a> {
        // No handout has the tests of the grader's crates.
        let has_tests = |member: &Member| !is_grader_crate(member);
        let needed = members::with_tests_of(members, PROGRAMS, has_tests);
        let grading = members::with_dependencies(members, &["grader", "worker"]);
        FileSelection {
            members,
            needed,
            grading,
        }
    }

    /// Whether a handout contains the file `path`, apart from files that consist of solutions only.
    pub(super) fn includes(&self, path: &Path) -> bool {
        let top = path
            .iter()
            .next()
            .map(|top| top.to_string_lossy())
            .unwrap_or_default();
        let is_rust = path.extension().is_some_and(|extension| extension == "rs");
        let is_manifest = path.file_name().is_some_and(|name| name == "Cargo.toml");
        // Students need the goldens as data. The test of the goldens, the tables of mutants and the
        // list of what seeds do not change are for those who maintain the course.
        if top == "golden" {
            let is_for_authors = path.starts_with("golden/mutants")
                || path == Path::new(NOT_MOVED)
                || path.ends_with(NOT_JUDGED);
            return !is_rust && !is_manifest && !is_for_authors;
        }
        if LEFT_OUT.iter().any(|folder| path.starts_with(folder)) {
            return false;
        }
        // Students need the text of the book. The scripts of its pages are in the packed site. The
        // crate that draws its figures and tests its text computes what students have to write.
        if let Ok(inside) = path.strip_prefix(BOOK) {
            let is_only_rendered = ONLY_RENDERED.iter().any(|page| inside == Path::new(page));
            let is_script = path
                .extension()
                .is_some_and(|end| end == "js" || end == "css");
            let is_published = ONLY_PUBLISHED
                .iter()
                .any(|folder| inside.starts_with(folder));
            return inside.starts_with("src") && !is_script && !is_only_rendered && !is_published;
        }
        if PLOTS_IN_BOOK.iter().any(|plot| path == Path::new(plot)) {
            return true;
        }
        let Some(owner) = members::containing_member(self.members, path) else {
            let at_the_top = path.components().count() == 1;
            let is_known = is_manifest || top.starts_with("LICENSE") || ROOT_FILES.contains(&&*top);
            return path == Path::new("stages/course.toml")
                || top == ".cargo"
                || at_the_top && is_known;
        };
        let inside = path.strip_prefix(&owner.folder).unwrap_or(path);
        self.needed.contains(owner.name.as_str())
            && (!is_grader_crate(owner) || is_manifest || inside.starts_with("src"))
    }

    /// Whether no handout has the tests of the crate with the manifest `path`.
    pub(super) fn leaves_out_tests(&self, path: &Path) -> bool {
        let tests = path.with_file_name("tests");
        LEFT_OUT.iter().any(|folder| tests == Path::new(folder))
    }

    /// Whether students write the file `path`, of one of the `stages`: its sources and its tests.
    pub(super) fn is_written(&self, path: &Path, stages: &[&str]) -> bool {
        self.owner(path).is_some_and(|owner| {
            let folders = ["src", "tests"].map(|name| owner.folder.join(name));
            let is_inside = folders.iter().any(|folder| path.starts_with(folder));
            stages.contains(&owner.name.as_str()) && is_inside
        })
    }

    /// Whether the points of a student's run depend on the given file `path`.
    pub(super) fn decides_points(&self, path: &Path) -> bool {
        if path.extension().is_some_and(|extension| extension == "md") {
            return false;
        }
        match self.owner(path) {
            Some(owner) => owner.name == "golden" || self.grading.contains(owner.name.as_str()),
            None => {
                let others = ["Cargo.toml", "stages/course.toml", ".cargo/config.toml"];
                others.iter().any(|other| path == Path::new(other))
            }
        }
    }

    /// The crate that contains the file `path`.
    pub(super) fn owner(&self, path: &Path) -> Option<&'a Member> {
        members::containing_member(self.members, path)
    }

    /// Whether the file `path` is a test of its crate, or something else that runs the crate's
    /// code.
    pub(super) fn is_test(&self, path: &Path) -> bool {
        let inside = self
            .owner(path)
            .and_then(|owner| path.strip_prefix(&owner.folder).ok());
        let folder = inside.and_then(|inside| inside.iter().next());
        folder.is_some_and(|folder| members::TEST_FOLDERS.iter().any(|test| folder == *test))
    }

    /// Whether the crate's tests run code of the crates `carved`: the crate or one of its
    /// dependencies is among them. The grader's tests always run the reference.
    pub(super) fn tests_carved_code(&self, member: &Member, carved: &BTreeSet<&str>) -> bool {
        is_grader_crate(member)
            || !members::with_dependencies(self.members, &[&member.name]).is_disjoint(carved)
    }

    /// The workspace's manifest `text` with the crates of a handout.
    pub(super) fn with_members(&self, text: &str) -> String {
        manifest::with_members(text, self.members, &self.needed)
    }
}

/// Whether the crate belongs to the grader.
pub(super) fn is_grader_crate(member: &Member) -> bool {
    member.folder.starts_with("grader")
}

/// The crates outside the grader that students only use.
const GIVEN: [&str; 4] = ["kit", "pathtracer", "scenes", "viewer"];

/// Whether students only use the crate: the grader's, and what the stages and programs stand on.
pub(super) fn is_given(member: &Member) -> bool {
    is_grader_crate(member) || GIVEN.contains(&member.name.as_str())
}

/// The carver for the handout of `part`: it removes the solutions of this part and later ones.
pub(super) fn carver(course: &Course, part: u32) -> Result<Carver, GraderError> {
    if !course.parts.iter().any(|p| p.number == part) {
        let parts: Vec<String> = course.parts.iter().map(|p| p.number.to_string()).collect();
        if course.holes().any(|(number, _)| number == part) {
            return Err(GraderError::new(format!(
                "part {part} is extra work without points, and has no handout of its own: the handout of each part ({}) has its \
                 gaps, too",
                parts.join(", ")
            )));
        }
        return Err(GraderError::new(format!(
            "the course has no part {part}. Its parts are {}",
            parts.join(", ")
        )));
    }
    let keys = |chosen: &dyn Fn(u32) -> bool| {
        let chosen = course.holes().filter(|(number, _)| chosen(*number));
        chosen.map(|(_, key)| key.to_string()).collect()
    };
    let mut all_keys: BTreeSet<String> = keys(&|_| true);
    all_keys.extend(course.tasks_left_out().map(str::to_string));
    Ok(Carver {
        all_keys,
        carved_keys: keys(&|number| number >= part),
    })
}
