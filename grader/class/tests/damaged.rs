//! Fuzzing: whatever archives, clones, results, plans and rosters have become on their way, their
//! readers return something or a sentence, and the tables of a class are written.
//!
//! `cargo test` tries some thousand; the ignored tests go on for `FIRSTLIGHT_FUZZ_SECONDS` each.

use crate::fake_class::{Behaviour, FakeClass};
use crate::git;
use class::by_hand::ByHand;
use class::collect::Options;
use class::out::Out;
use class::plan::Plan;
use class::pool;
use class::progress::Progress;
use class::reading::Unreadable;
use class::reading::intake::{self, Revision};
use class::roster::Roster;
use damage::{Naming, Random, damage, damage_json, seeds, seeds_for_a_while};
use std::io::{Cursor, Write};
use std::path::Path;

const STAGES: [&str; 2] = ["raygen", "intersect"];

const FILES: [(&str, &[u8]); 4] = [
    ("stages/intersect/src/lib.rs", b"mod a;\r\n"),
    ("stages/intersect/src/a/b.rs", &[b'x'; 3000]),
    ("stages/raygen/src/lib.rs", b"pub fn f() {}"),
    ("README.md", "é".as_bytes()),
];

fn zip(method: zip::CompressionMethod) -> Vec<u8> {
    let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
    let options = zip::write::SimpleFileOptions::default().compression_method(method);
    for (name, contents) in FILES {
        zip.start_file(name, options).expect("an entry");
        zip.write_all(contents).expect("its contents");
    }
    zip.add_symlink("link", "stages", options).expect("a link");
    zip.finish().expect("a zip").into_inner()
}

/// A tar file, which also has a name too long for its header, written in two ways, and a link.
fn tar() -> Vec<u8> {
    let mut tar = tar::Builder::new(Vec::new());
    let long = format!("stages/intersect/src/{}.rs", "x".repeat(200));
    for (name, contents) in FILES.into_iter().chain([(long.as_str(), &b"x"[..])]) {
        let mut header = tar::Header::new_gnu();
        header.set_size(contents.len() as u64);
        header.set_mode(0o644);
        tar.append_data(&mut header, name, contents)
            .expect("an entry");
    }
    let pax = [("path", "stages/intersect/src/pax.rs".as_bytes())];
    tar.append_pax_extensions(pax).expect("an extension");
    let mut header = tar::Header::new_ustar();
    header.set_size(0);
    tar.append_data(&mut header, "short", &b""[..])
        .expect("an entry");
    let mut header = tar::Header::new_gnu();
    header.set_entry_type(tar::EntryType::Symlink);
    header.set_size(0);
    tar.append_link(&mut header, "link", "stages")
        .expect("a link");
    tar.into_inner().expect("a tar")
}

fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut gzip = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    gzip.write_all(bytes).expect("compressed");
    gzip.finish().expect("compressed")
}

/// Opens what is in `folder`, and checks that a reason is a sentence.
fn open(path: &Path, revision: Option<&Revision>) {
    match intake::open(path, &STAGES, revision) {
        Ok(opened) => assert!(opened.root.is_dir()),
        Err(Unreadable::TooLarge(why) | Unreadable::Damaged(why) | Unreadable::NoClone(why)) => {
            let of_libraries = ["EOCD", "os error", "buffer", "deflate", "Invalid"];
            let is_told = !of_libraries.iter().any(|words| why.contains(words));
            assert!(why.contains(' ') && is_told, "{why}");
        }
        // The machine did not fail.
        Err(Unreadable::Machine(why)) => panic!("{why}"),
    }
}

fn damaged_archives(seeds: impl Iterator<Item = u64>) {
    use zip::CompressionMethod::{Deflated, Stored};
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("anna");
    let tar = tar();
    let whole = [zip(Stored), zip(Deflated), gzip(&tar), tar.clone()];
    for bytes in &whole {
        std::fs::write(&path, bytes).expect("a file");
        let opened = intake::open(&path, &STAGES, None).expect("it is whole");
        assert!(opened.root.join("stages/intersect/src/a/b.rs").is_file());
    }
    for seed in seeds {
        let _naming = Naming(seed);
        let mut random = Random::new(seed);
        let mut bytes = random.pick(&whole).clone();
        damage(&mut bytes, &mut random);
        // What is compressed is rarely valid after damage, so it is also damaged before.
        if random.below(3) == 0 {
            let mut inside = tar.clone();
            damage(&mut inside, &mut random);
            bytes = gzip(&inside);
        }
        std::fs::write(&path, &bytes).expect("a file");
        open(&path, None);
        let files = std::fs::read_dir(folder.path()).expect("a folder").count();
        assert_eq!(files, 1, "seed {seed} wrote beside the archive");
    }
}

#[test]
fn damaged_archives_are_read_or_refused() {
    damaged_archives(seeds(1500));
}

#[test]
#[ignore = "runs for FIRSTLIGHT_FUZZ_SECONDS seconds"]
fn damaged_archives_for_a_while() {
    damaged_archives(seeds_for_a_while());
}

fn git(folder: &Path, arguments: &[&str]) {
    let status = git::command(folder).args(arguments).status();
    assert!(status.expect("git runs").success(), "{arguments:?}");
}

/// The files of a clone whose names and objects are read.
fn files_below(folder: &Path, found: &mut Vec<std::path::PathBuf>) {
    for entry in std::fs::read_dir(folder).expect("a folder").flatten() {
        match entry.file_type().is_ok_and(|kind| kind.is_dir()) {
            true => files_below(&entry.path(), found),
            false => found.push(entry.path()),
        }
    }
    found.sort();
}

fn damaged_clones(seeds: impl Iterator<Item = u64>) {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, contents) in FILES {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        std::fs::write(path, contents).expect("a file");
    }
    git(folder.path(), &["init", "--quiet"]);
    git(folder.path(), &["add", "--all"]);
    git(folder.path(), &["commit", "--quiet", "--message", "all"]);
    git(folder.path(), &["tag", "v1"]);
    git(folder.path(), &["repack", "-a", "-d", "--quiet"]);
    git(folder.path(), &["pack-refs", "--all"]);
    // One object that is no part of the pack.
    std::fs::write(folder.path().join("README.md"), "new").expect("a file");
    git(
        folder.path(),
        &["commit", "--quiet", "--all", "--message", "more"],
    );
    let revisions = [
        Revision::Commit("v1".into()),
        Revision::before("2099-01-01").expect("a date"),
    ];
    for revision in &revisions {
        intake::open(folder.path(), &STAGES, Some(revision)).expect("it is whole");
    }
    let mut files = Vec::new();
    files_below(&folder.path().join(".git"), &mut files);
    files.retain(|path| !path.to_string_lossy().contains("/hooks/"));
    for seed in seeds {
        let _naming = Naming(seed);
        let mut random = Random::new(seed);
        let path = random.pick(&files);
        let whole = std::fs::read(path).expect("a file");
        let mut bytes = whole.clone();
        damage(&mut bytes, &mut random);
        // Objects are read-only.
        std::fs::remove_file(path).expect("it is ours");
        std::fs::write(path, &bytes).expect("a file");
        open(folder.path(), Some(random.pick(&revisions)));
        std::fs::write(path, &whole).expect("a file");
    }
}

#[test]
fn damaged_clones_are_read_or_refused() {
    damaged_clones(seeds(40));
}

#[test]
#[ignore = "runs for FIRSTLIGHT_FUZZ_SECONDS seconds"]
fn damaged_clones_for_a_while() {
    damaged_clones(seeds_for_a_while());
}

/// The result of a unit of a class of three, damaged: its student has a row, and so have the others.
fn damaged_units(seeds: impl Iterator<Item = u64>) {
    let folder = tempfile::tempdir().expect("a folder");
    let class = FakeClass::new(folder.path(), 3);
    let out = class.out("out");
    let jobs: Vec<_> = class.plan.units().into_iter().collect();
    pool::run(&jobs, 2, &out, &Progress::start(jobs.len()), |key| {
        class.command(&out, key, Behaviour::Fine)
    })
    .expect("graded");
    let path = out.unit(class.plan.submissions[0].key().expect("a unit"));
    let whole = std::fs::read(&path).expect("a unit");
    let value: serde_json::Value = serde_json::from_slice(&whole).expect("JSON");
    for seed in seeds {
        let _naming = Naming(seed);
        std::fs::write(&path, damaged_bytes_or_json(&whole, &value, seed)).expect("a file");
        let tables = class.tables(&out);
        let gradebook = String::from_utf8_lossy(&tables[Path::new("gradebook.csv")]);
        let rows: Vec<_> = csv::Reader::from_reader(gradebook.as_bytes())
            .into_records()
            .map(|row| row.expect("a row"))
            .collect();
        assert_eq!(rows.len(), 4, "{gradebook}");
        // Nobody has more points than there are, whatever a report says.
        for row in rows {
            let points: f64 = row[3].parse().unwrap_or_default();
            assert!((0.0..=10.0).contains(&points), "{gradebook}");
        }
    }
}

/// Damage of one of both kinds.
fn damaged_bytes_or_json(whole: &[u8], value: &serde_json::Value, seed: u64) -> Vec<u8> {
    let mut random = Random::new(seed);
    if random.below(2) == 0 {
        let mut bytes = whole.to_vec();
        damage(&mut bytes, &mut random);
        return bytes;
    }
    let mut value = value.clone();
    damage_json(&mut value, &mut random);
    value.to_string().into_bytes()
}

#[test]
fn damaged_results_stop_no_table() {
    damaged_units(seeds(600));
}

#[test]
#[ignore = "runs for FIRSTLIGHT_FUZZ_SECONDS seconds"]
fn damaged_results_for_a_while() {
    damaged_units(seeds_for_a_while());
}

/// A damaged plan is refused, or tables of it are written.
fn damaged_plans(seeds: impl Iterator<Item = u64>) {
    let folder = tempfile::tempdir().expect("a folder");
    let class = FakeClass::new(folder.path(), 3);
    let out: Out = class.out("out");
    let whole = std::fs::read(out.plan()).expect("a plan");
    let value: serde_json::Value = serde_json::from_slice(&whole).expect("JSON");
    let mut read = 0;
    for seed in seeds {
        let _naming = Naming(seed);
        std::fs::write(out.plan(), damaged_bytes_or_json(&whole, &value, seed)).expect("a file");
        if let Ok(Some(plan)) = Plan::load(&out.plan()) {
            read += 1;
            let hint = grader::report::HintLevel::Remedy;
            let _ = class::tables::write(&out, plan, hint, &Options::default());
        }
    }
    assert!(read > 0, "every plan is refused");
    let outside = std::fs::read_dir(folder.path()).expect("a folder").count();
    assert_eq!(outside, 2, "a name led out of OUT");
}

#[test]
fn damaged_plans_are_read_or_refused() {
    damaged_plans(seeds(400));
}

#[test]
#[ignore = "runs for FIRSTLIGHT_FUZZ_SECONDS seconds"]
fn damaged_plans_for_a_while() {
    damaged_plans(seeds_for_a_while());
}

const ROSTERS: [&str; 2] = [
    "Student,ID,SIS User ID,SIS Login ID,Section\r\n    Points Possible,,,,\r\n\"Lovelace, Ada\",17,a1,ada,S1\r\n",
    "Identifier;Full name;Email address;Status;Group\nParticipant 7;Zoë É;z@example.org;No submission;Réd\n",
];

#[test]
fn damaged_marks_by_hand_are_read_or_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let class = FakeClass::new(folder.path(), 3);
    let out = class.out("out");
    let whole = "id;task;points;words;held_back\r\nstudent00;part1.task1;-2,5;\"sch\u{f6}n; \"\"x\"\"\r\ny\";\r\nzz;;4;;x\r\n";
    for seed in seeds(1000) {
        let _naming = Naming(seed);
        let mut random = Random::new(seed);
        let mut bytes = whole.as_bytes().to_vec();
        damage(&mut bytes, &mut random);
        std::fs::write(out.join("by_hand.csv"), &bytes).expect("a file");
        if let Err(why) = ByHand::read(&out, &class.plan, None) {
            assert!(why.to_string().contains("by_hand.csv: "), "{why}");
        }
    }
}

#[test]
fn damaged_rosters_are_read_or_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("roster.csv");
    for seed in seeds(3000) {
        let _naming = Naming(seed);
        let mut random = Random::new(seed);
        let mut bytes = random.pick(&ROSTERS).as_bytes().to_vec();
        damage(&mut bytes, &mut random);
        std::fs::write(&path, &bytes).expect("a file");
        if let Err(why) = Roster::read(&path) {
            assert!(why.to_string().contains(' '), "{why}");
        }
    }
}
