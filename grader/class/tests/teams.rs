//! Submissions of teams, and what a teacher gives by hand, from the files in `OUT` to the tables.

use crate::fake_class::{Behaviour, FakeClass};
use class::out::Out;
use class::pool;
use class::progress::Progress;
use serde_json::json;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use tempfile::TempDir;

/// Canvas's numbers, so that all systems can have the marks.
const ROSTER: &str = "name,participant number,id,login,team,extension\n\
    Ada <i>L</i>,1,s1,ada,red,\nBo,2,s2,bo,Red,1\nCy,3,s3,cy,blue,\nDi,4,s4,di,blue,\nEd,5,s5,ed,alone,\nFay,6,s6,fay,away,\n";

/// The submissions: that of the team red, twice that of blue, and Ed's, who is a team alone.
const NAMES: [&str; 4] = ["red", "cy", "di", "part1-ed"];

/// A class in a temporary folder.
struct Teams {
    _folder: TempDir,
    class: FakeClass,
    out: Out,
}

impl Teams {
    /// Grades the class. `red` was handed in a day and a half late; late work loses 10 % a day.
    fn new() -> Teams {
        let folder = tempfile::tempdir().expect("a folder");
        let mut class = FakeClass::new(folder.path(), 10);
        let due = 1_802_732_340;
        // Units 6 and 8 earn so many points.
        let keys =
            [6, 8, 8, 5].map(|i| class.plan.submissions[i].key().expect("a unit").to_string());
        let submissions = NAMES.iter().zip(keys).map(|(name, key)| {
            let at = due + if *name == "red" { 130_000 } else { -5 };
            let commit = json!({ "author": at, "committer": at, "doubt": null });
            json!({ "name": name, "file": name,
                    "unit": { "submission": key, "key": key, "notes": [], "commit": commit } })
        });
        let submissions: Vec<_> = submissions.collect();
        class.plan.submissions = serde_json::from_value(json!(submissions)).expect("submissions");
        let term = json!({ "title": "T", "due": due,
            "late": { "grace_minutes": 5, "percent_per_day": 10.0, "most_days": null } });
        class.plan.term = Some(serde_json::from_value(term).expect("a term"));
        std::fs::write(folder.path().join("roster.csv"), ROSTER).expect("a file");
        let out = class.out("out");
        let jobs: Vec<_> = class.plan.units().into_iter().collect();
        assert_eq!(jobs.len(), 3, "equal submissions are one unit");
        let progress = Progress::start(jobs.len());
        let command = |key: &str| class.command(&out, key, Behaviour::Fine);
        pool::run(&jobs, 3, &out, &progress, command).expect("graded");
        Teams {
            _folder: folder,
            class,
            out,
        }
    }

    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_class"));
        command
            .args(["class", "--collect", "--roster"])
            .arg(self.class.folder.join("roster.csv"))
            .arg("--out")
            .arg(self.out.path())
            .args(arguments);
        command
    }

    /// Writes the tables for a course system. Returns the exit code and what was printed.
    fn run(&self, arguments: &[&str]) -> (Option<i32>, String) {
        let Output {
            status,
            stdout,
            stderr,
        } = self.command(arguments).output().expect("it runs");
        let printed = String::from_utf8([stdout, stderr].concat()).expect("UTF-8");
        (status.code(), printed)
    }

    fn by_hand(&self, text: &str) {
        std::fs::write(self.out.join("by_hand.csv"), text).expect("a file");
    }

    fn read(&self, path: &str) -> String {
        std::fs::read_to_string(self.out.join(path)).unwrap_or_else(|e| panic!("{path}: {e}"))
    }

    /// All files that a run writes.
    fn files(&self) -> BTreeMap<PathBuf, Vec<u8>> {
        let folders = [self.out.path().to_path_buf(), self.out.join("students")];
        let entries = folders
            .iter()
            .flat_map(|folder| std::fs::read_dir(folder).expect("files"));
        let paths = entries.map(|entry| entry.expect("a file").path());
        let files = paths.filter(|path| path.is_file());
        files
            .map(|path| (path.clone(), std::fs::read(&path).expect("a file")))
            .collect()
    }

    /// The page whose title starts with a name.
    fn page_of(&self, name: &str) -> String {
        let is_page = |path: &Path| path.parent() == Some(&self.out.join("students"));
        let files = self.files().into_iter();
        let of_students = files.filter(|(path, _)| is_page(path));
        let mut pages = of_students.map(|(_, bytes)| String::from_utf8(bytes).expect("UTF-8"));
        let title = format!("<h1>{name}");
        pages
            .find(|page| page.contains(&title))
            .unwrap_or_else(|| panic!("no page of {name}"))
    }
}

#[test]
fn a_team_has_one_submission_and_each_member_a_mark() {
    let teams = Teams::new();
    let blue = teams.class.plan.submissions[1].key().expect("a unit");
    let unit = std::fs::read_to_string(teams.out.unit(blue)).expect("a unit");
    let equal = unit.replace("\"sources\":{}", "\"sources\":{\"raygen\":\"equal\"}");
    std::fs::write(teams.out.unit(blue), equal).expect("a unit");
    let (code, printed) = teams.run(&["--for", "csv"]);
    assert_eq!(code, Some(0), "{printed}");
    let table = teams.read("roster.csv");
    let marks: Vec<&str> = table.lines().skip(1).collect();
    // Ada is two days late, Bo, whose extension is a day, one.
    for (line, start, note) in [
        (
            0,
            "s1,Ada <i>L</i>,graded,4.8,10,0,2,6,0,",
            "2 days late, keeps 80 %: 6 points before",
        ),
        (
            1,
            "s2,Bo,graded,5.4,10,",
            "1 day late, keeps 90 %: 6 points before",
        ),
        (2, "s3,Cy,graded,8,10,", "team blue"),
        (3, "s4,Di,graded,8,10,", "team blue"),
        (4, "s5,Ed,graded,5,10,", "team alone"),
        (5, "s6,Fay,not handed in,,10,", ""),
    ] {
        assert!(
            marks[line].starts_with(start) && marks[line].contains(note),
            "{marks:?}"
        );
    }
    assert!(
        printed.contains("no submission: Fay (s6) of team away\n"),
        "{printed}"
    );
    assert!(
        printed.contains("6 students, 1 without a mark"),
        "{printed}"
    );
    let page = teams.read("class.html");
    assert!(
        page.contains("red: Ada &lt;i&gt;L&lt;/i&gt;, Bo</a>"),
        "{page}"
    );
    assert!(
        page.contains("No two submissions share"),
        "a team is no pair: {page}"
    );
    assert!(teams.page_of("red: Ada").contains("6 of 10 points"));
}

#[test]
fn what_is_given_by_hand_is_shown_everywhere_and_never_written() {
    let teams = Teams::new();
    let by_hand = "submission,student,team,task,points,words,held_back\r\n\
        ,,red,part1.task1,2,\"<b>=1+1</b>; =2, the case\r\nasks\",\r\n\
        ,bo,,,-1,did not come,\r\npart1-ed,,,,,see me,yes\r\n,,away,,1,,\r\n";
    teams.by_hand(by_hand);
    let (code, printed) = teams.run(&["--for", "canvas"]);
    assert_eq!(code, Some(1), "{printed}");
    for line in [
        "your decision: part1-ed: held back\n",
        "your decision: line 6 of by_hand.csv counts for nothing: away has no submission",
        "by hand: Bo (s2): nothing -> -1 point: did not come\n",
        "by hand: part1-ed: nothing -> held back: see me\n",
    ] {
        assert!(printed.contains(line), "{line}: {printed}");
    }
    // Late work loses nothing of what is given by hand: 0.8 * 6 + 2 and 0.9 * 6 + 2 - 1.
    let canvas = teams.read("canvas.csv");
    let marks: Vec<&str> = canvas.lines().skip(2).collect();
    assert_eq!(
        marks,
        [
            "Ada <i>L</i>,1,s1,ada,,6.8",
            "Bo,2,s2,bo,,6.4",
            "Cy,3,s3,cy,,8",
            "Di,4,s4,di,,8"
        ]
    );
    let words = "by hand: +2 points for part1.task1: &lt;b&gt;=1+1&lt;/b&gt;; =2, the case asks";
    let page = teams.page_of("red: Ada");
    for part in [
        words,
        "8 of 10 points",
        "The code earned 6.",
        "6 of 10, by hand +2",
    ] {
        assert!(page.contains(part), "{part}: {page}");
    }
    assert!(!page.contains("did not come"), "it is for Bo alone: {page}");
    let page = teams.page_of("Bo");
    assert!(
        page.contains("7 of 10 points") && page.contains("did not come"),
        "{page}"
    );
    let class = teams.read("class.html");
    let (before, _) = class.split_once(">Bo alone</a>").expect("a link");
    let (_, link) = before.rsplit_once("href=\"").expect("a link");
    assert_eq!(teams.read(link.trim_end_matches('"')), page);
    let page = teams.page_of("alone: Ed");
    assert!(
        page.contains("No score yet.") && page.contains("see me"),
        "{page}"
    );
    assert!(!page.contains(" of 10"), "no mark is released: {page}");
    let gradebook = teams.read("gradebook.csv");
    assert!(
        gradebook.contains("part1-ed,,held back,,10,,2,,,by hand: held back: see me"),
        "{gradebook}"
    );
    assert!(
        gradebook.contains("red,,graded,8,10,0,2,8,0,"),
        "{gradebook}"
    );
    assert!(
        gradebook.contains("</b>;' =2, the case asks"),
        "a formula: {gradebook}"
    );
    let (_, printed) = teams.run(&["--for", "moodle"]);
    assert!(!printed.contains("\nby hand"), "nothing changed: {printed}");
    let moodle = teams.read("moodle.csv");
    assert!(
        moodle.contains("Participant 2,Bo,,6.4,10,,\"graded; by hand: +2"),
        "{moodle}"
    );
    assert!(
        moodle.contains("by hand: -1 point: did not come"),
        "{moodle}"
    );

    // Both files change.
    teams.by_hand("student,points,words\r\nbo,-1,came late\r\ned,3,\r\n");
    let roster = ROSTER.replace("cy,blue", "cy,away");
    std::fs::write(teams.class.folder.join("roster.csv"), roster).expect("a file");
    let (_, printed) = teams.run(&[]);
    let listed: Vec<&str> = printed
        .lines()
        .filter(|line| line.starts_with("by hand") || line.starts_with("team "))
        .collect();
    assert_eq!(
        listed,
        [
            "by hand: Bo (s2): -1 point: did not come -> -1 point: came late",
            "by hand: part1-ed: held back: see me -> +3 points",
            "by hand: red: +2 points for part1.task1: <b>=1+1</b>; =2, the case asks -> nothing",
            "team away: Fay -> Cy, Fay",
            "team blue: Cy, Di -> Di",
        ]
    );
    // Two different archives of one team are a question, and no absence.
    let roster = ROSTER
        .replace("cy,blue", "cy,alone")
        .replace("di,blue", "di,away");
    std::fs::write(teams.class.folder.join("roster.csv"), roster).expect("a file");
    let (code, printed) = teams.run(&["--for", "csv"]);
    assert_eq!(code, Some(1), "{printed}");
    for name in ["cy", "part1-ed"] {
        let asked = format!("no mark: {name}: the team alone handed in more than one");
        assert!(printed.contains(&asked), "{printed}");
    }
    assert!(!printed.contains("no submission: "), "{printed}");
    assert_eq!(
        teams.read("by_hand.csv"),
        "student,points,words\r\nbo,-1,came late\r\ned,3,\r\n"
    );
}

#[test]
fn a_mistake_in_by_hand_stops_before_anything_is_written() {
    let teams = Teams::new();
    teams.by_hand("id,points\nred,1\n");
    let (code, printed) = teams.run(&[]);
    assert_eq!(code, Some(0), "{printed}");
    let before = teams.files();
    teams.by_hand("login,points\nada,1\nzoe,1\n");
    let (code, printed) = teams.run(&[]);
    assert_eq!(code, Some(2), "{printed}");
    assert!(
        printed.contains("by_hand.csv: line 3: no student of the roster"),
        "{printed}"
    );
    teams.by_hand("id,points\nred,1\n");
    assert!(teams.files() == before);
}

/// Points are added, so a regrade changes what is under them, and says on top of what they are.
#[test]
fn what_is_given_by_hand_survives_a_regrade() {
    let teams = Teams::new();
    teams.by_hand("team,task,points,words\nred,part1.task1,1.5,the case asks too much\n");
    teams.run(&["--for", "csv"]);
    assert!(teams.read("gradebook.csv").contains("red,,graded,7.5,10,"));
    let mut new = teams.class.plan.clone();
    new.tasks[0].cases[0].points = 20.0;
    new.store(&teams.out.proposed_plan()).expect("a plan");
    let before = teams.files();
    let (code, printed) = teams.run(&["--regrade"]);
    assert_eq!(code, Some(1), "{printed}");
    let listed = "red: 6 of 10 + 0 of 2, graded -> 12 of 20 + 0 of 2, graded\n    part1.task1: 6 + 0 -> 12 + 0\n    \
        by hand, and stays: +1.5 points for part1.task1: the case asks too much\n";
    assert!(printed.contains(listed), "{printed}");
    let regrade = teams.read("regrade.csv");
    assert!(
        regrade.contains("'+1.5 points for part1.task1"),
        "{regrade}"
    );
    std::fs::remove_file(teams.out.join("regrade.csv")).expect("a file");
    assert!(teams.files() == before, "nothing is replaced yet");
    let (code, printed) = teams.run(&["--regrade", "--yes", "--for", "csv"]);
    assert_eq!(code, Some(0), "{printed}");
    assert!(teams.read("gradebook.csv").contains("red,,graded,13.5,20,"));
    assert!(
        teams
            .read("roster.csv")
            .contains("s1,Ada <i>L</i>,graded,11.1,20,")
    );
    assert!(
        teams
            .read("by_hand.csv")
            .ends_with("red,part1.task1,1.5,the case asks too much\n")
    );
}

/// A run that was killed leaves some tables of the last run and some new ones; the next one writes
/// all. Two at once write the same.
#[test]
fn after_a_kill_and_beside_another_run_the_bytes_are_the_same() {
    let teams = Teams::new();
    teams.by_hand("id,points\nred,1\n");
    teams.run(&["--for", "csv"]);
    let old = teams.files();
    teams.by_hand("id,points,held_back\nred,2,\npart1-ed,,x\n");
    let (_, printed) = teams.run(&["--for", "csv"]);
    let whole = teams.files();
    let listed = "by hand: red: +1 point -> +2 points\n";
    assert!(printed.contains(listed) && whole != old, "{printed}");
    // A kill after each of the files, from the first to the last.
    for kept in 0..whole.len() {
        for (i, path) in whole
            .keys()
            .enumerate()
            .filter(|(_, path)| !path.ends_with("by_hand.csv"))
        {
            match old.get(path).filter(|_| i >= kept) {
                Some(bytes) => std::fs::write(path, bytes).expect("a file"),
                None if i >= kept => std::fs::remove_file(path).expect("a file"),
                None => {}
            }
        }
        let runs = [0, 1].map(|_| {
            let mut run = teams.command(&["--for", "csv"]);
            run.stdout(std::process::Stdio::null())
                .spawn()
                .expect("it starts")
        });
        for mut run in runs {
            assert_eq!(run.wait().expect("it ends").code(), Some(1));
        }
        assert!(teams.files() == whole, "{kept} files were new");
    }
}
