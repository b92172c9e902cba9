//! The command `grader bless`: stores the reference's current answers as goldens.

use base::program::Exit;
use base::{GraderError, Workspace, out, outln};
use clap::{Arg, ArgAction, ArgMatches, Command};
use judge::plural;
use review::bless::{self, Change, ChangeKind, Proposal};
use std::io::IsTerminal;
use std::path::Path;

pub(crate) fn command() -> Command {
    Command::new("bless")
        .about("For instructors: shows how the reference's results differ from the goldens, then stores them as new goldens")
        .arg(
            Arg::new("what")
                .value_name("KEY")
                .num_args(1..)
                .default_value("all")
                .help("The goldens to update: `all`, parts such as `part1`, tasks such as `part1.task3`, cases such as `part1.task3/back_face`"),
        )
        .arg(
            Arg::new("yes")
                .long("yes")
                .action(ArgAction::SetTrue)
                .help("Write the goldens without asking for confirmation"),
        )
}

/// The lines of refusals that are printed: the page of `review` has all of them.
const REFUSALS: usize = 12;

pub(crate) fn run(matches: &ArgMatches) -> Result<Exit, GraderError> {
    let keys: Vec<&str> = matches
        .get_many::<String>("what")
        .unwrap_or_default()
        .map(String::as_str)
        .collect();
    let workspace = Workspace::above(Path::new("."))?;
    let proposal = bless::propose(&workspace, &keys)?;
    if !proposal.refused.is_empty() {
        return Err(GraderError::new(refusal(&proposal, &keys)));
    }
    let proposed = proposal.changes;
    if proposed.is_empty() {
        outln!("The goldens are up to date.");
        return Ok(Exit::Passed);
    }
    for change in &proposed {
        let golden = change
            .golden
            .strip_prefix(workspace.root())
            .unwrap_or(&change.golden);
        outln!("{}: {}", golden.display(), change.meaning);
        for aspect in &change.not_judged {
            outln!("  not judged: {aspect}");
        }
    }
    outln!("{}", verdict(&proposed));
    if matches.get_flag("yes") || confirmed(proposed.len())? {
        bless::accept(&workspace, &proposed)?;
        outln!("{} written.", plural(proposed.len(), "golden", "goldens"));
        return Ok(Exit::Passed);
    }
    outln!("No golden was written, and no file was changed.");
    Ok(Exit::Failed)
}

/// The message if answers are wrong or missing.
fn refusal(proposal: &Proposal, keys: &[&str]) -> String {
    let refused = &proposal.refused;
    let mut text = format!(
        "nothing is blessed, because {} wrong or missing:",
        match proposal.refused_cases() {
            1 => "the answers to a case are".to_string(),
            n => format!("the answers to {n} cases are"),
        }
    );
    for line in refused.iter().take(REFUSALS) {
        text.push_str(&format!("\n  {line}"));
    }
    if refused.len() > REFUSALS {
        text.push_str(&format!("\n  and {} more", refused.len() - REFUSALS));
    }
    let mut tasks: Vec<&str> = Vec::new();
    for key in keys {
        let task = key.split('/').next().unwrap_or(key);
        if !tasks.contains(&task) {
            tasks.push(task);
        }
    }
    text.push_str(&format!(
        "\nMend them first. `cargo grader review {}` shows each, and writes the command that blesses \
         only what you accept",
        tasks.join(" ")
    ));
    text
}

/// What was looked at, and by what: the oracle's verdict about new answers, and what nothing but the
/// reader judges.
fn verdict(proposed: &[Change]) -> String {
    let of_kind = |kind: ChangeKind| proposed.iter().filter(move |change| change.kind == kind);
    let answers = of_kind(ChangeKind::Answers).count();
    let open = of_kind(ChangeKind::Answers).filter(|change| !change.not_judged.is_empty());
    let mut sentences = vec![match (answers, open.count()) {
        (0, _) => "No answer of a case changed.".into(),
        (_, 0) => "The exact oracle confirms every answer of these cases.".into(),
        (_, open) => format!(
            "The exact oracle finds no answer wrong, but it does not judge all aspects of {}: look at \
             what is listed as not judged yourself, with `grader review`.",
            plural(open, "golden", "goldens")
        ),
    }];
    for picture in of_kind(ChangeKind::Picture) {
        sentences.push(format!(
            "The picture of {task} changed, which the oracle does not judge: look at it, with \
             `grader picture {task}`.",
            task = picture.task
        ));
    }
    sentences.join(" ")
}

/// Asks for confirmation on the terminal. Without a terminal the answer is no.
fn confirmed(goldens: usize) -> Result<bool, GraderError> {
    if !std::io::stdin().is_terminal() {
        outln!("Add `--yes` to write them without confirmation.");
        return Ok(false);
    }
    out!(
        "Write {}? [y/N] ",
        match goldens {
            1 => "this golden".into(),
            n => format!("these {n} goldens"),
        }
    );
    let mut answer = String::new();
    let read = std::io::stdin().read_line(&mut answer);
    read.map_err(|e| GraderError::new(format!("cannot ask for confirmation: {e}")))?;
    Ok(answer.trim().eq_ignore_ascii_case("y"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn change(kind: ChangeKind, not_judged: &[&str]) -> Change {
        Change {
            task: "part5.task1".into(),
            golden: "a.snap".into(),
            content: Vec::new(),
            meaning: "is new".into(),
            not_judged: not_judged.iter().map(ToString::to_string).collect(),
            kind,
        }
    }

    #[test]
    fn a_changed_picture_is_not_confirmed_by_the_oracle() {
        let picture = change(ChangeKind::Picture, &[]);
        let text = verdict(std::slice::from_ref(&picture));
        assert!(text.starts_with("No answer of a case changed."), "{text}");
        assert!(!text.contains("confirms"), "{text}");
        assert!(text.contains("`grader picture part5.task1`"), "{text}");
        let text = verdict(&[change(ChangeKind::Answers, &[]), picture]);
        assert!(text.starts_with("The exact oracle confirms"), "{text}");
        assert!(text.contains("picture of part5.task1 changed"), "{text}");
        let text = verdict(&[change(ChangeKind::Answers, &["mean"])]);
        assert!(text.contains("does not judge all aspects"), "{text}");
    }

    #[test]
    fn a_refusal_names_each_task_to_review_once() {
        let keys = ["part1.task4/head_on", "part1.task4/range", "part1.task2"];
        let mut proposal = Proposal::default();
        proposal.refuse("part1.task2", "range", "t is wrong");
        proposal.refuse("part1.task2", "range", "normal is wrong");
        let text = refusal(&proposal, &keys);
        assert!(
            text.contains("because the answers to a case are wrong"),
            "{text}"
        );
        assert!(
            text.contains("`cargo grader review part1.task4 part1.task2` shows"),
            "{text}"
        );
    }
}
