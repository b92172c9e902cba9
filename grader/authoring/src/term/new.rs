//! Makes the folder of a term: `grader course new`.

use super::build::build;
use base::{GraderError, VERSION, Workspace};
use files::file_tree;
use grader::course::Course;
use judge::Tier;
use std::fmt::Write;
use std::path::Path;

/// The files that do not depend on the course, with their paths.
const FILES: [(&str, &str); 9] = [
    ("front.md", include_str!("new/front.md")),
    ("README.md", include_str!("new/README.md")),
    ("get-first-light", include_str!("new/get-first-light")),
    (".gitignore", include_str!("new/gitignore")),
    (".gitattributes", "* text=auto eol=lf\n"),
    (".cargo/config.toml", include_str!("new/cargo-config.toml")),
    (".github/workflows/check.yml", include_str!("new/check.yml")),
    (
        ".github/workflows/handouts.yml",
        include_str!("new/handouts.yml"),
    ),
    (".github/workflows/site.yml", include_str!("new/site.yml")),
];

/// Fills the new folder `folder` of a term called `name` and `when`. Others clone First Light from
/// `source`.
pub fn new(
    first_light: &Workspace,
    folder: &Path,
    name: &str,
    when: &str,
    source: &str,
) -> Result<(), GraderError> {
    first_light.ensure_full("a term needs the whole course")?;
    let course = Course::read(first_light)?;
    let settings = settings(&course, name, when, source);
    file_tree::write(&folder.join("course.toml"), settings.as_bytes())?;
    for (path, contents) in FILES {
        let contents = contents.replace("{name}", name).replace("{when}", when);
        file_tree::write(&folder.join(path), contents.as_bytes())?;
    }
    make_executable(&folder.join("get-first-light"))?;
    build(first_light, folder)
}

#[cfg(unix)]
fn make_executable(path: &Path) -> Result<(), GraderError> {
    use std::os::unix::fs::PermissionsExt;
    std::fs::set_permissions(path, PermissionsExt::from_mode(0o755))
        .map_err(|e| GraderError::file("make executable", path, e))
}

#[cfg(not(unix))]
fn make_executable(_: &Path) -> Result<(), GraderError> {
    Ok(())
}

/// The teacher's `course.toml`, with every setting in a comment.
fn settings(course: &Course, name: &str, when: &str, source: &str) -> String {
    let quoted = |text: &str| toml::Value::String(text.to_string()).to_string();
    let mut parts = String::new();
    for part in &course.parts {
        let core: f64 = part.tasks.iter().map(|task| task.points(Tier::Core)).sum();
        let _ = writeln!(
            parts,
            "#     {{ part = {}, opens = 2027-02-01, due = 2027-02-15T23:59:00+01:00 }}, # {}: {core} core points",
            part.number, part.title
        );
    }
    include_str!("new/course.toml")
        .replace("{name}", &quoted(name))
        .replace("{when}", &quoted(when))
        .replace("{version}", &quoted(VERSION))
        .replace("{source}", &quoted(source))
        .replace("{parts}\n", &parts)
}

/// Whether the tag that `get-first-light` clones is in this checkout.
pub fn has_tag_of_version(workspace: &Workspace) -> bool {
    let tag = format!("refs/tags/v{VERSION}");
    git(workspace, &["rev-parse", "--verify", "--quiet", &tag]).is_some()
}

/// Where a checkout was cloned from: its remote `origin`. A checkout without one names itself.
pub fn source_of(workspace: &Workspace) -> String {
    git(workspace, &["remote", "get-url", "origin"])
        .unwrap_or_else(|| workspace.root().display().to_string())
}

/// What git prints in a checkout, trimmed; `None` if it fails or prints nothing.
fn git(workspace: &Workspace, args: &[&str]) -> Option<String> {
    let output = std::process::Command::new("git")
        .arg("-C")
        .arg(workspace.root())
        .args(args)
        .output();
    let output = output.ok().filter(|output| output.status.success())?;
    let text = String::from_utf8(output.stdout).ok()?.trim().to_string();
    (!text.is_empty()).then_some(text)
}
