//! Writes the marks of a class for a course system: `--roster ROSTER --for SYSTEM`.

use crate::collect::{Class, points};
use crate::late::Lateness;
use crate::out::Out;
use crate::roster::Roster;
use crate::roster::join::{Join, Problem};
use crate::roster::table::{self, Marks, System};
use base::{GraderError, outln, write_whole};
use clap::ArgMatches;
use std::path::PathBuf;
use submission::Untrusted;

/// Writes the marks, if the arguments ask for them, and prints what a person has to decide. Returns
/// whether there is nothing to decide.
pub(super) fn write(matches: &ArgMatches, out: &Out, class: &Class) -> Result<bool, GraderError> {
    let system = matches
        .get_one::<String>("for")
        .and_then(|name| System::named(name));
    let (Some(path), Some(system)) = (matches.get_one::<PathBuf>("roster"), system) else {
        return Ok(true);
    };
    let roster = Roster::read(path)?;
    let names: Vec<&str> = class.rows.iter().map(|row| row.name.raw()).collect();
    let join = Join::of(&roster, &names);
    let given = matches.get_one::<String>("assignment").cloned();
    let marks = Marks {
        system,
        assignment: given.unwrap_or_else(|| format!("First Light {}", class.plan.settings.what)),
        add_extra: matches.get_flag("add-extra"),
    };
    let lateness = Lateness::of(class, &roster, &join);
    let marked = lateness.as_ref().map(|lateness| lateness.apply(class));
    let marked = marked.as_ref().unwrap_or(class);
    let file = out.join(system.file());
    write_whole(
        &file,
        table::write(marked, &roster, &join, &marks)?.as_bytes(),
    )?;

    if let Some(why) = about_maximum(system, &roster, class) {
        outln!("{why}");
    }
    let name = |i: usize| class.rows[i].name.line();
    let mut is_decided = join.problems.is_empty();
    if let Some(lateness) = &lateness {
        for (i, (_, about)) in &lateness.late {
            outln!("late: {}: {about}", name(*i));
        }
        for (i, why) in &lateness.questions {
            outln!("no mark: {}: {why}", name(*i));
        }
        if lateness.untimed > 0 {
            outln!(
                "in time, as far as anybody knows: {} submissions without a commit time; of clones, `--before` or `--commit` takes it",
                lateness.untimed
            );
        }
        is_decided &= lateness.questions.is_empty();
    }
    for (submission, problem) in &join.problems {
        outln!(
            "no mark: {}: {}",
            name(*submission),
            about(&roster, problem)
        );
    }
    let late: Vec<String> = join.late.iter().map(|i| name(*i)).collect();
    if !late.is_empty() && lateness.is_none() {
        outln!("late, as the course system says: {}", late.join(", "));
    }
    let missing = join
        .submissions
        .iter()
        .filter(|submission| submission.is_none_or(|i| marked.rows[i].score.is_none()));
    outln!(
        "marks: {}: {} students, {} without a mark from this folder",
        file.display(),
        roster.students.len(),
        missing.count()
    );
    Ok(is_decided)
}

/// Moodle takes a mark as one of its own maximum, and leaves out what is larger without a word.
fn about_maximum(system: System, roster: &Roster, class: &Class) -> Option<String> {
    let [possible, _] = class.plan.max_score();
    let maximum = roster.maximum.filter(|_| system == System::Moodle)?;
    (maximum != possible).then(|| {
        format!(
            "the maximum grade in Moodle is {}, and {} points are possible: change it there before you import, or {} points are not all",
            points(maximum),
            points(possible),
            points(possible)
        )
    })
}

fn about(roster: &Roster, problem: &Problem) -> String {
    let student = |i: &usize| {
        let student = &roster.students[*i];
        let known = [&student.id, &student.login, &student.number].map(Untrusted::line);
        let known = known.into_iter().find(|known| !known.is_empty());
        match known {
            Some(known) => format!("{} ({known})", student.name.line()),
            None => student.name.line(),
        }
    };
    match problem {
        Problem::Nobody => {
            "no student of the roster has this name or number. Rename it to the student's identifier".into()
        }
        Problem::Several(students) => {
            let students: Vec<String> = students.iter().map(student).collect();
            format!(
                "it may belong to {}. Rename it to the student's identifier",
                students.join(" or ")
            )
        }
        Problem::Again(of) => {
            format!("{} handed in more than one. Remove those that do not count", student(of))
        }
    }
}
