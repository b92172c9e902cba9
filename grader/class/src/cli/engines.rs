//! Divides a class among machines: shards, and one command for each unit.

use crate::out::Out;
use crate::plan::Plan;
use crate::pool::Job;
use crate::unit;
use base::{GraderError, shell_word};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Part `index` of `of`, counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Shard {
    index: usize,
    of: usize,
}

impl Shard {
    /// Reads `2/17`.
    pub(super) fn parse(text: &str) -> Result<Shard, String> {
        let numbers = text
            .split_once('/')
            .and_then(|(index, of)| Some((index.parse().ok()?, of.parse().ok()?)));
        match numbers {
            Some((index, of)) if 1 <= index && index <= of => Ok(Shard { index, of }),
            _ => Err(format!(
                "`{text}` is no shard: expected I/N with I from 1 to N, such as 2/17"
            )),
        }
    }

    /// Its units: every `of`-th of all. Keys are hashes, so shards are of about the same size, and
    /// which unit belongs to which shard does not depend on what is graded already.
    pub(super) fn of(self, units: Vec<Job>) -> Vec<Job> {
        let of_shard = units.into_iter().skip(self.index - 1).step_by(self.of);
        of_shard.collect()
    }
}

/// The units of a plan that are not graded yet, sorted by key, and of these the ones of `shard`.
pub(super) fn missing<'a>(plan: &'a Plan, shard: Option<Shard>, out: &Out) -> Vec<Job<'a>> {
    let units: Vec<Job> = plan.units().into_iter().collect();
    let mut units = match shard {
        Some(shard) => shard.of(units),
        None => units,
    };
    units.retain(|(key, _)| !unit::is_stored(out, key));
    units
}

/// How a process that grades one unit is started.
#[derive(Clone, Debug)]
pub(super) struct UnitCommand {
    program: PathBuf,
    course: PathBuf,
    class: PathBuf,
    out: PathBuf,
    unsandboxed: bool,
}

impl UnitCommand {
    pub(super) fn new(
        course: &Path,
        class: &Path,
        out: &Out,
        unsandboxed: bool,
    ) -> Result<UnitCommand, GraderError> {
        let program = std::env::current_exe();
        let program = program
            .map_err(|e| GraderError::new(format!("cannot find out which program this is: {e}")))?;
        let class = class
            .canonicalize()
            .map_err(|e| GraderError::file("open", class, e))?;
        Ok(UnitCommand {
            program,
            course: course.to_path_buf(),
            class,
            out: out.path().to_path_buf(),
            unsandboxed,
        })
    }

    /// The command for this unit.
    pub(super) fn of(&self, key: &str) -> Command {
        let mut command = Command::new(&self.program);
        command.arg("class").arg(&self.class);
        command.arg("--out").arg(&self.out);
        command.arg("--course").arg(&self.course);
        command.args(["--unit", key]);
        command.args(self.unsandboxed.then_some("--unsandboxed"));
        command
    }

    /// The command for this unit as a line of a shell.
    pub(super) fn line(&self, key: &str) -> Result<String, GraderError> {
        let command = self.of(key);
        let words: Result<Vec<String>, GraderError> = std::iter::once(command.get_program())
            .chain(command.get_args())
            .map(quoted)
            .collect();
        Ok(words?.join(" "))
    }
}

/// A word as a POSIX shell reads it.
fn quoted(word: &OsStr) -> Result<String, GraderError> {
    let word = word
        .to_str()
        .filter(|word| !word.contains('\n'))
        .ok_or_else(|| {
            GraderError::new(
                "a path of the class is not UTF-8 or has a line end: rename the folder",
            )
        })?;
    Ok(shell_word(word))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_are_counted_from_one() {
        assert_eq!(Shard::parse("2/17"), Ok(Shard { index: 2, of: 17 }));
        for wrong in ["0/3", "4/3", "1", "1/0", "a/b", "-1/3"] {
            assert!(Shard::parse(wrong).is_err(), "{wrong}");
        }
    }
}
