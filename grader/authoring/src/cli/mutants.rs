//! The command `grader mutants`: checks that every typical mistake loses points and that no correct
//! code does, and that `grader bless` would not accept a mistake of the reference.

use authoring::mutants::blessing::{self, BlessVerdict, Blessing};
use authoring::mutants::corpus::Corpus;
use authoring::mutants::examples::{self, Caught};
use authoring::mutants::groups;
use authoring::mutants::mistake_pictures;
use authoring::mutants::pairs;
use authoring::mutants::proportion::{self, Proportion};
use authoring::mutants::run;
use authoring::mutants::seeds::{self, Seeded};
use authoring::mutants::simplest::{self, Simplest};
use authoring::mutants::table::{self, Table};
use base::program::{Exit, path_argument, whole_number};
use base::{GraderError, Workspace, out, outln};
use clap::{Arg, ArgAction, ArgMatches, Command};
use grader::course::Course;
use grader::diagnosis::{self, Diagnosis, Explanation, Known};
use grader::report::{claims, message};
use grader::signature::Signature;
use grader::sketch::Sketch;
use judge::{cases, plural};
use rayon::prelude::*;
use std::path::{Path, PathBuf};

pub(crate) fn command() -> Command {
    Command::new("mutants")
        .about("For instructors: grades typical mistakes, which must lose points, and correct variants, which must not")
        .arg(
            Arg::new("what")
                .value_name("WHAT")
                .default_value("all")
                .help("What to grade: `all`, a part such as `part1`, or a task such as `part1.task3`"),
        )
        .arg(
            Arg::new("seeds")
                .long("seeds")
                .value_name("N")
                .value_parser(|value: &str| whole_number(value, 1, u64::MAX))
                .allow_negative_numbers(true)
                .conflicts_with("bless")
                .help("Instead, grade only the correct versions, with seeds 0 to N - 1, in the cases that depend on the seed, and say where a move changed bits or points"),
        )
        .arg(
            Arg::new("mistakes")
                .long("mistakes")
                .action(ArgAction::SetTrue)
                .requires("seeds")
                .help("With --seeds, grade the typical mistakes, too: a move should change few of their points, and none may be told that it recognizes the questions"),
        )
        .arg(
            path_argument("with", "FOLDER")
                .conflicts_with_all(["seeds", "bless"])
                .help("Instead, test the diagnosis with the mutants in FOLDER/TASK.txt, in the format of `grader/mutants`. Their mistakes need not be listed there. Nothing is stored"),
        )
        .arg(
            Arg::new("pairs")
                .long("pairs")
                .action(ArgAction::SetTrue)
                .conflicts_with_all(["seeds", "with"])
                .help("Instead, grade only the pairs of mistakes that grader/mutants/pairs.toml lists, and count those that the diagnosis does not name by what it knows of each mistake alone; with --bless store their signatures beside the stored ones"),
        )
        .arg(
            Arg::new("families")
                .long("families")
                .action(ArgAction::SetTrue)
                .conflicts_with_all(["seeds", "bless", "with"])
                .help("Instead, grade every small slip in the variants, and in the reference if there are few of them (a comparison turned, operands swapped, a constant halved, an update forgotten …), and list groups of them that the diagnosis does not name"),
        )
        .arg(
            Arg::new("simplest")
                .long("simplest")
                .action(ArgAction::SetTrue)
                .conflicts_with_all(["seeds", "bless", "with", "families"])
                .help("Instead, print how simple the calls are that show the mistakes to students, and test that correct versions answer all simple questions rightly, and that what is said and drawn of a call is true"),
        )
        .arg(
            Arg::new("proportion")
                .long("proportion")
                .action(ArgAction::SetTrue)
                .conflicts_with_all(["seeds", "bless", "with", "families", "simplest", "examples"])
                .help("Instead, print the share of wrong pixels in the task's picture and the share of lost core points of each mistake, and fail if more than a third of the picture is wrong for less than a third of the points"),
        )
        .arg(
            path_argument("examples", "FILE")
                .conflicts_with_all(["seeds", "bless", "with", "families", "simplest"])
                .help("Instead, count the mistakes that the right examples of FILE, such as stages/STAGE/examples.toml, would catch, and name the simplest that slips through"),
        )
        .arg(
            Arg::new("against-bless")
                .long("against-bless")
                .action(ArgAction::SetTrue)
                .help("Also print, as a table in Markdown, what `grader bless` would do with each mistake if the reference made it, and the answers that it would confirm although they differ by more than rounding errors"),
        )
        .arg(
            Arg::new("pictures")
                .long("pictures")
                .action(ArgAction::SetTrue)
                .conflicts_with_all(["seeds", "bless", "with", "families"])
                .help("Instead, render the mistakes that the chapters of the book show, as grader/mutants/pictures.toml lists them, to stages/book/src/mistakes and mistakes-large"),
        )
        .arg(
            Arg::new("stored")
                .long("stored")
                .action(ArgAction::SetTrue)
                .conflicts_with_all(["seeds", "bless", "with", "families", "pictures"])
                .help("Instead, print as text what is stored: the tables, and the signatures that the diagnosis uses"),
        )
        .arg(
            Arg::new("bless")
                .long("bless")
                .action(ArgAction::SetTrue)
                .help("Store the tables, and the signatures that the diagnosis uses"),
        )
}

pub(crate) fn run(matches: &ArgMatches) -> Result<Exit, GraderError> {
    let what: &String = matches.get_one("what").expect("it has a default");
    let seeds: Option<&u64> = matches.get_one("seeds");
    let with: Option<&PathBuf> = matches.get_one("with");
    let bless = matches.get_flag("bless");
    let against_bless = matches.get_flag("against-bless");
    let workspace = Workspace::above(Path::new("."))?;
    let course = Course::read(&workspace)?;
    let mut exit = Exit::Passed;
    if matches.get_flag("pictures") {
        for (path, bytes) in mistake_pictures::write(&workspace, &course, &course.select(what)?)? {
            outln!("{}: {bytes} bytes", workspace.relative(&path).display());
        }
        return Ok(exit);
    }
    let tasks = course.select(what)?;
    let _progress = progress::start("mutants", tasks.len());
    let mut found_some = false;
    for task in tasks {
        if matches.get_flag("stored") {
            print_stored(&workspace, &task.key)?;
            continue;
        }
        if let Some(&seeds) = seeds {
            let mistakes = matches.get_flag("mistakes");
            let graded = seeds::grade(&workspace, &course, task, 0..seeds, mistakes)?;
            show_seeds(&task.key, seeds, &graded);
            let is_unfair = !mistakes && !graded.other_points.is_empty();
            if !graded.marked_down.is_empty() || !graded.accused.is_empty() || is_unfair {
                exit = Exit::Failed;
            }
            continue;
        }
        if matches.get_flag("simplest") {
            let found = simplest::of_task(&workspace, &course, task)?;
            show_simplest(&task.key, &found);
            let is_false = |shown: &simplest::Shown| !shown.false_claims.is_empty();
            if !found.accused.is_empty() || found.shown.iter().any(is_false) {
                exit = Exit::Failed;
            }
            continue;
        }
        if matches.get_flag("proportion") {
            let found = proportion::of_task(&workspace, &course, task)?;
            show_proportions(&task.key, &found);
            if found.iter().any(Proportion::loses_too_little) {
                exit = Exit::Failed;
            }
            continue;
        }
        if let Some(file) = matches.get_one::<PathBuf>("examples") {
            let text =
                std::fs::read_to_string(file).map_err(|e| GraderError::file("read", file, e))?;
            let written = grader::examples::parse(&text)?;
            show_caught(
                &task.key,
                &examples::of_task(&workspace, &course, task, &written)?,
            );
            continue;
        }
        if matches.get_flag("families") {
            let known = diagnosis::known(&workspace, &task.key)?;
            let graded = run::families(&workspace, &course, task)?;
            out!("{}", groups::of(graded, &known).to_text(&task.key));
            continue;
        }
        if let Some(folder) = with {
            let mutants = Corpus::read_unlisted(folder, task)?;
            if !mutants.is_empty() {
                found_some = true;
                let known = diagnosis::known(&workspace, &task.key)?;
                let graded = run::unlisted(&workspace, &course, task, mutants)?;
                show_unlisted(&task.key, &graded, &known);
                for claim in false_claims(&task.key, &graded, &known) {
                    outln!("  FALSE: {claim}");
                    exit = Exit::Failed;
                }
                if !show_blessings(&task.key, &graded, against_bless) {
                    exit = Exit::Failed;
                }
            }
            continue;
        }
        let corpus = Corpus::read(&workspace, task)?;
        if matches.get_flag("pairs") {
            let mut known = diagnosis::known(&workspace, &task.key)?;
            let pairs = pairs::graded(&workspace, &course, task, &corpus)?;
            outln!(
                "{}: {}",
                task.key,
                pairs::renew(&mut known, &corpus, &pairs)
            );
            for claim in false_claims(&task.key, &pairs.graded, &known) {
                outln!("  FALSE: {claim}");
                exit = Exit::Failed;
            }
            if bless {
                diagnosis::store(&workspace, &task.key, &known)?;
            }
            continue;
        }
        let graded = run::task(&workspace, &course, task)?;
        let (mut known, spare) = run::known(&corpus, &graded);
        let pairs = pairs::graded(&workspace, &course, task, &corpus)?;
        let counts = pairs::renew(&mut known, &corpus, &pairs);
        let table = Table::of(&graded, &known);
        let marked_down: Vec<&run::Graded> = graded
            .iter()
            .filter(|graded| graded.is_marked_down())
            .collect();
        show(&task.key, &table, &marked_down);
        outln!("  {counts}");
        for name in spare {
            outln!(
                "  SPARE: the diagnosis names {name} without its own signature: it may leave the list"
            );
        }
        for (name, _) in table.misnamed() {
            let graded = graded.iter().find(|graded| graded.name == name);
            show_diagnosis(name, graded, &known);
        }
        let none_is_blessed = show_blessings(&task.key, &graded, against_bless);
        let rewarded = table::rewarded(&graded);
        let crashing_pays = table::crashing_pays(task, &graded);
        let mut claims = false_claims(&task.key, &graded, &known);
        claims.extend(false_claims(&task.key, &pairs.graded, &known));
        for claim in &claims {
            outln!("  FALSE: {claim}");
        }
        for (name, cases) in &crashing_pays {
            outln!("  REWARDED: {name} would earn more points if it crashed in {cases}");
        }
        for (name, [earned, base]) in &rewarded {
            outln!(
                "  REWARDED: {name} earns {earned} points, and the correct code that it is made from {base}"
            );
        }
        if !marked_down.is_empty()
            || !table.survivors().is_empty()
            || !none_is_blessed
            || !rewarded.is_empty()
            || !crashing_pays.is_empty()
            || !claims.is_empty()
        {
            exit = Exit::Failed;
        }
        if bless {
            diagnosis::store(&workspace, &task.key, &known)?;
            table.store(&workspace, &task.key)?;
        } else if !same_as_stored(&workspace, &task.key, &table, &known)? {
            exit = Exit::Failed;
        }
    }
    match with {
        Some(folder) if !found_some => Err(GraderError::new(format!(
            "{} has no form of a mistake of {what}: expected a file of the task's name, such as part1.task3.txt",
            folder.display()
        ))),
        _ => Ok(exit),
    }
}

/// Prints the stored table and signatures.
fn print_stored(workspace: &Workspace, task: &str) -> Result<(), GraderError> {
    outln!("{task}: version | cases in which it loses points | mistakes that it is named as");
    out!("{}", Table::read(workspace, task)?);
    outln!("\n{task}: the signatures, a line for each side of a case with a fault");
    for known in diagnosis::known(workspace, task)? {
        let symptom = if known.is_symptom { " (symptom)" } else { "" };
        outln!("\n{}{symptom}", known.mistakes.join(" + "));
        out!("{}", known.signature.to_text());
    }
    Ok(())
}

/// What reports would say of these versions that is false of their answers.
fn false_claims(task: &str, graded: &[run::Graded], known: &[Known]) -> Vec<String> {
    let specs = cases::of(task, 0);
    let each = graded.par_iter().flat_map_iter(|graded| {
        let cases = &graded.result.cases;
        let Explanation {
            diagnosis,
            regularities,
        } = diagnosis::explain(&graded.result, cases, known, (&specs, 0), &[]);
        let claims = claims::false_ones(task, cases, &specs, &regularities, diagnosis.as_ref());
        let name = &graded.name;
        claims
            .into_iter()
            .map(move |claim| format!("{name}: {claim}"))
    });
    each.collect()
}

/// Compares with the stored table and signatures, and prints what differs.
fn same_as_stored(
    workspace: &Workspace,
    task: &str,
    table: &Table,
    known: &[Known],
) -> Result<bool, GraderError> {
    let stored = Table::read(workspace, task)?;
    let differences = stored.differences(table);
    for name in &differences {
        outln!("  DIFFERS from the stored table: {name}");
    }
    let same_signatures = diagnosis::known(workspace, task)? == known;
    if !same_signatures {
        outln!("  DIFFERS from the stored signatures");
    }
    let same = differences.is_empty() && same_signatures && stored == *table;
    if !same {
        outln!("  If this is intended, run `grader mutants {task} --bless` to store it.");
    }
    Ok(same)
}

/// So many of the nearest known mistakes are listed beside a diagnosis.
const NEAREST: usize = 3;

/// Prints what mutants lose that may make unlisted mistakes, and their diagnosis.
fn show_unlisted(task: &str, graded: &[run::Graded], known: &[Known]) {
    outln!("{task}: {}", plural(graded.len(), "mutant", "mutants"));
    let specs = cases::of(task, 0);
    for graded in graded {
        let result = &graded.result;
        let loses = |points: f64, most: f64| points < most;
        let lost = if loses(result.score, result.max_score) {
            let cases = result.cases.iter();
            let failed = cases.filter(|case| case.score < case.max_score).count();
            format!("lost points in {}", plural(failed, "case", "cases"))
        } else if loses(result.robust_score, result.robust_max_score) {
            "lost only extra credit".to_string()
        } else {
            "SURVIVES".to_string()
        };
        let Explanation {
            diagnosis,
            regularities,
        } = diagnosis::explain(result, &result.cases, known, (&specs, 0), &[]);
        let says = match &diagnosis {
            Some(diagnosis) => format!("{}: {}", diagnosis.certainty.label(), diagnosis.says),
            None => "no mistake is named".to_string(),
        };
        outln!("  {}: {lost}\n    {says}", graded.name);
        if !diagnosis.as_ref().is_some_and(Diagnosis::is_likely) {
            for sentence in regularities {
                outln!("    - {sentence}");
            }
        }
        let nearest = diagnosis::candidates(known, &Signature::of(&result.cases));
        for (mistakes, likeness, contradicted) in nearest.into_iter().take(NEAREST) {
            let but = if contradicted { ", contradicted" } else { "" };
            outln!("      {likeness:.2} {}{but}", mistakes.join(" + "));
        }
    }
}

/// Confirmed answers that differ from the reference's by more than this are listed.
const MORE_THAN_ROUNDING: f64 = 1e-9;

/// Prints the mutants that `grader bless` would accept if the reference made their mistakes;
/// `in_full`, what it would do with each. Returns whether it would accept none.
fn show_blessings(task: &str, graded: &[run::Graded], in_full: bool) -> bool {
    let mutants = graded
        .iter()
        .filter(|graded| matches!(graded.kind, run::Kind::Mutant(_)));
    let mutants: Vec<(&str, &[Blessing])> = mutants
        .map(|graded| (graded.name.as_str(), graded.blessings.as_slice()))
        .collect();
    let of = |wanted: BlessVerdict| {
        let of = mutants
            .iter()
            .filter(move |(_, blessings)| blessing::verdict(blessings) == Some(wanted));
        of.map(|(name, _)| *name).collect::<Vec<&str>>()
    };
    let accepted = of(BlessVerdict::Confirmed);
    outln!(
        "  if the reference made the mistake, `grader bless` would refuse {}, list what is not judged for {}, accept {}",
        of(BlessVerdict::Refused).len(),
        of(BlessVerdict::NotJudged).len(),
        accepted.len()
    );
    for name in &accepted {
        outln!("  BLESSED: the oracle confirms every answer that {name} changes");
    }
    if in_full {
        outln!("{}", blessing::markdown(task, &mutants));
        for (name, blessings) in &mutants {
            for Blessing {
                case, confirmed, ..
            } in *blessings
            {
                if let Some(change) = confirmed
                    && change.difference > MORE_THAN_ROUNDING
                {
                    let (call, golden, actual) = (change.call, &change.golden, &change.actual);
                    outln!("confirmed: {name}, {case} {call}: {golden} -> {actual}");
                }
            }
        }
    }
    accepted.is_empty()
}

/// Prints the diagnosis that a student with this mistake reads.
fn show_diagnosis(name: &str, graded: Option<&run::Graded>, known: &[Known]) {
    let signature = graded.map(|graded| Signature::of(&graded.result.cases));
    let diagnosis = signature.and_then(|signature| diagnosis::diagnose(known, &signature));
    if let Some(diagnosis) = diagnosis {
        outln!("  diagnosis of {name}: {}", diagnosis.says);
    }
}

fn show(task: &str, table: &Table, marked_down: &[&run::Graded]) {
    outln!(
        "{task}: {} mutants, {} correct versions",
        table.mutants.len(),
        table.correct.len()
    );
    for (name, failed) in &table.mutants {
        let named = table
            .diagnosed
            .get(name)
            .map(|named| named.join(", "))
            .unwrap_or_default();
        let named = if named.is_empty() {
            "no mistake".to_string()
        } else {
            named
        };
        outln!(
            "  {name}: lost points in {}, diagnosed as {named}",
            plural(failed.len(), "case", "cases")
        );
    }
    for name in table.survivors() {
        outln!("  SURVIVES: {name} loses no points");
    }
    for (name, named) in table.misnamed() {
        outln!("  WRONG DIAGNOSIS: {name} is diagnosed as {named:?}");
    }
    for graded in marked_down {
        show_marked_down(&graded.name, graded);
    }
    outln!(
        "  diagnosed correctly: {} of {}",
        table.mutants.len() - table.misnamed().len(),
        table.mutants.len()
    );
    let (recognised, held_out) = table.recognised;
    if held_out > 0 {
        outln!("  held-out mutants whose mistakes are all recognised: {recognised} of {held_out}");
    }
}

/// Prints how the versions fared with `seeds` seeds.
fn show_seeds(task: &str, seeds: u64, graded: &Seeded) {
    let versions = plural(graded.versions, "version", "versions");
    outln!(
        "{task}: {versions}, {seeds} seeds, {}: {} marked down, {} accused",
        plural(
            graded.cases.len(),
            "case that depends on the seed",
            "cases that depend on the seed"
        ),
        graded.marked_down.len(),
        graded.accused.len()
    );
    for (seed, version) in &graded.accused {
        outln!(
            "  ACCUSED: {version} with seed {seed} would be told that it recognizes the questions"
        );
    }
    for (seed, graded) in &graded.marked_down {
        show_marked_down(&format!("{} with seed {seed}", graded.name), graded);
    }
    for (counts, what) in [
        (&graded.other_bits, "bits"),
        (&graded.other_points, "points"),
    ] {
        for ((version, case), moves) in counts {
            outln!("  other {what} after {moves} of {seeds} moves: {version}, {case}");
        }
    }
}

/// Prints the mistakes, those that spoil most for the fewest points first.
fn show_proportions(task: &str, found: &[Proportion]) {
    outln!("{task}: mistake | wrong pixels | lost core points");
    let mut rows: Vec<&Proportion> = found.iter().collect();
    rows.sort_by(|a, b| (b.wrong - b.lost).total_cmp(&(a.wrong - a.lost)));
    for row in rows {
        let sign = if row.loses_too_little() { "!" } else { " " };
        let [wrong, lost] = [row.wrong, row.lost].map(|share| 100.0 * share);
        outln!("{sign} {} | {wrong:.0} % | {lost:.0} %", row.mutant);
    }
}

/// Prints how many mutants of a task a student's examples catch, and the simplest mutant that slips
/// through.
fn show_caught(task: &str, found: &Caught) {
    let all = found.caught.len() + found.missed.len();
    outln!(
        "{task}: the examples catch {} of {}",
        found.caught.len(),
        plural(all, "mistake", "mistakes")
    );
    if let Some(simplest) = found.simplest_missed()
        && let Some(call) = &simplest.call
    {
        let (input, result) = (message::input(call), message::found(call));
        outln!("  the simplest that slips through: {}", simplest.mutant);
        outln!("    {input} -> {result}");
    }
}

/// Prints the simplest calls of the mutants of a task, and their digits.
fn show_simplest(task: &str, found: &Simplest) {
    for shown in &found.shown {
        let call = match &shown.call {
            Some(call) => {
                let only: String = call.only.iter().map(|only| format!(" ({only})")).collect();
                format!("{} -> {}{only}", call.input, call.result)
            }
            None => "no simple call".into(),
        };
        outln!("  {}: {call}", shown.mutant);
        for claim in &shown.false_claims {
            outln!("  FALSE: {}: {claim}", shown.mutant);
        }
        let drawn = shown.call.as_ref().and_then(|call| call.shown.as_ref());
        let sketch = drawn.and_then(Sketch::of);
        for line in sketch.iter().flat_map(|sketch| sketch.text(80)) {
            outln!("{line}");
        }
    }
    for accused in &found.accused {
        outln!("  ACCUSED: {accused}");
    }
    let shown = &found.shown;
    let count = |is: &dyn Fn(&simplest::Shown) -> bool| shown.iter().filter(|of| is(of)).count();
    let percent = |count: usize| 100 * count / shown.len().max(1);
    let with_call = count(&|shown| shown.call.is_some());
    let of_small = count(&simplest::Shown::is_of_small_numbers);
    let median = |mut numbers: Vec<usize>| {
        numbers.sort_unstable();
        numbers.get(numbers.len() / 2).copied().unwrap_or(0)
    };
    let worst = shown.iter().map(|shown| shown.digits_of_worst).collect();
    let digits = shown.iter().filter_map(simplest::Shown::digits).collect();
    let took = shown.iter().map(|shown| shown.took.as_millis() as usize);
    outln!(
        "{task}: {} lose core points; a simple call shows {with_call} ({} %), {of_small} of them \
         ({} %) with integers and halves of two digits; digits shown (median): {} of the worst \
         answer, {} of the simple call; {} ms (median)",
        plural(shown.len(), "mutant", "mutants"),
        percent(with_call),
        percent(of_small),
        median(worst),
        median(digits),
        median(took.collect()),
    );
}

/// Prints where correct code lost core points.
fn show_marked_down(name: &str, graded: &run::Graded) {
    outln!(
        "  MARKED DOWN: {name} is correct, but lost {} core points",
        graded.result.max_score - graded.result.score
    );
    let cases = graded.result.cases.iter();
    for case in cases.filter(|case| case.score < case.max_score) {
        let why = case
            .worst()
            .map(|(_, worst)| worst.message.to_string())
            .unwrap_or_default();
        outln!("    {}: {why}", case.name);
    }
}
