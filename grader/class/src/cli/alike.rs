//! Runs `grader class --alike`.

use crate::alike::owners::Owners;
use crate::alike::page::{self, Contents};
use crate::alike::pairs::{self, Student};
use crate::alike::{common, jplag, table};
use crate::entries;
use crate::out::Out;
use crate::reading::Reader;
use crate::reading::intake::Revision;
use crate::roster::Roster;
use crate::roster::join::Join;
use base::program::Exit;
use base::{GraderError, Workspace, errln, outln, write_whole};
use grader::course::Course;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use submission::Untrusted;
use submission::code::passages::Known;
use submission::code::{self, source::Source};

/// The most bytes of a stage that are compared: a hundred times what a student writes. The tokens of
/// a text take some hundred times its memory.
const LARGEST_STAGE: usize = 1 << 20;

/// Compares the submissions in the folder `class`, and writes the page and the folder for JPlag to
/// `out`. With a `roster` those of a team are not compared with each other. `progress` is told
/// which submission is read, and of how many.
pub(super) fn run(
    workspace: &Workspace,
    class: &Path,
    out: &Out,
    reader: &Reader,
    revision: Option<&Revision>,
    roster: Option<&Path>,
    progress: fn(usize, usize),
) -> Result<Exit, GraderError> {
    let course = Course::read(workspace)?;
    let folder = out.join("jplag");
    if folder.exists() {
        std::fs::remove_dir_all(&folder).map_err(|e| GraderError::file("remove", &folder, e))?;
    }
    let mut known = BTreeMap::new();
    for stage in course.stages() {
        jplag::write(
            &folder.join("given"),
            stage,
            &code::given(workspace.root(), stage)?,
        )?;
        known.insert(stage, code::known(workspace.root(), stage)?);
    }
    let entries = entries::list(class)?;
    let names: Vec<&str> = entries.iter().map(|entry| entry.name.as_str()).collect();
    let folders = entries::page_names(&names);
    let (owners, labels) = match roster.map(Roster::read).transpose()? {
        Some(roster) => {
            let join = Join::of(&roster, &names);
            let labels = join.names(&roster, &names);
            (join.owners, labels)
        }
        None => (vec![None; names.len()], BTreeMap::new()),
    };
    let mut students = Vec::new();
    let mut unread = Vec::new();
    for (i, entry) in entries.iter().enumerate() {
        progress(i, entries.len());
        let label = labels.get(&entry.name).cloned();
        let name = label.unwrap_or_else(|| Untrusted::from(entry.name.as_str()));
        let read = match reader.read_entry(class, entry, revision) {
            Ok(read) => read,
            Err(unreadable) => {
                unread.push((name, Untrusted::from(unreadable.why())));
                continue;
            }
        };
        let mut stages = BTreeMap::new();
        for (stage, files) in &read.submission.stages {
            jplag::write(&folder.join("submissions").join(&folders[i]), stage, files)?;
            let Some(known) = known.get(stage.as_str()) else {
                continue;
            };
            let bytes: usize = files.values().map(Vec::len).sum();
            if bytes > LARGEST_STAGE {
                let why = format!("{stage} has more than 1 MB");
                unread.push((name.clone(), why.into()));
                continue;
            }
            stages.insert(stage.clone(), Source::new(files, known));
        }
        let owner = owners[i];
        students.push(Student {
            name,
            owner,
            stages,
        });
    }
    for (name, why) in &unread {
        errln!("not compared: {}: {}", name.line(), why.line());
    }
    let of_fingerprints = Owners::new(&students);
    let pairs = pairs::pairs(&students, &of_fingerprints, pairs::COMPARED);
    let strongest = pairs
        .listed
        .iter()
        .take(page::LISTED)
        .map(|found| pairs::pair(&students, &of_fingerprints, found));
    let (common, more_common) = common::common(&students, &of_fingerprints, page::LISTED);
    let grader = the_grader(workspace, &students, &known)?;
    let (pasted, with_pasted) = pairs::pasted(&grader, &students, page::LISTED);
    let contents = Contents {
        students: students.len(),
        unread,
        pairs: strongest.collect(),
        found: pairs.listed.len(),
        not_compared: pairs.not_compared,
        common,
        more_common,
        pasted,
        with_pasted,
    };
    let path = out.join("alike.html");
    write_whole(&path, page::page(&contents).as_bytes())?;
    let all = out.join("alike.csv");
    table::write(&all, &students, &pairs.listed)?;
    outln!(
        "{} submissions compared: {} pairs to ask about, {} passages that many have, {} with code of the grader: {}",
        contents.students,
        contents.found,
        contents.common.len(),
        contents.with_pasted,
        path.display()
    );
    if contents.found > contents.pairs.len() {
        outln!(
            "the page shows the strongest {}; all pairs: {}",
            contents.pairs.len(),
            all.display()
        );
    }
    outln!("the same with JPlag: {}", jplag::command(&folder));
    Ok(Exit::Passed)
}

/// The code of the grader, as if a student had handed it in as each of the stages.
fn the_grader(
    workspace: &Workspace,
    students: &[Student],
    known: &BTreeMap<&str, Known>,
) -> Result<Student, GraderError> {
    let files = code::of_the_grader(workspace.root())?;
    let stages = students.iter().flat_map(|student| student.stages.keys());
    let handed_in: BTreeSet<&String> = stages.collect();
    let as_stages = handed_in.into_iter().map(|stage| {
        let source = Source::new(&files, &known[stage.as_str()]);
        (stage.clone(), source)
    });
    Ok(Student {
        name: Untrusted::from("the grader"),
        owner: None,
        stages: as_stages.collect(),
    })
}
