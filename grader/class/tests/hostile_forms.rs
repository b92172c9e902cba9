//! Forms in which somebody hands in what is not meant to be read: each is read without harm or refused
//! with a sentence, and none is followed out of its folder.

use crate::forms::{LIB, gzip, tar, write, zip};
use crate::git;
use class::reading::Unreadable;
use class::reading::intake::{self, Revision};
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

/// What comes of a submission: the text of its file and the notes, or why it is refused.
fn said(path: &Path, revision: Option<&Revision>) -> String {
    match intake::open(path, &["raygen", "intersect"], revision) {
        Ok(opened) => {
            let text = std::fs::read_to_string(opened.root.join(LIB));
            format!("read {text:?}; {}", opened.notes.join("; "))
        }
        Err(Unreadable::TooLarge(why)) => format!("too large: {why}"),
        Err(Unreadable::Damaged(why)) => format!("damaged: {why}"),
        Err(Unreadable::NoClone(why)) => format!("no clone: {why}"),
        Err(Unreadable::Machine(why)) => format!("machine: {why}"),
    }
}

/// A tar file with one more entry of this kind.
fn tar_with(kind: tar::EntryType, name: &str, link: &str) -> Vec<u8> {
    let mut archive = tar::Builder::new(Vec::new());
    let mut header = tar::Header::new_gnu();
    header.set_entry_type(kind);
    header.set_size(0);
    archive
        .append_link(&mut header, name, link)
        .expect("an entry");
    let mut header = tar::Header::new_gnu();
    header.set_size(1);
    archive
        .append_data(&mut header, LIB, &b"x"[..])
        .expect("a file");
    archive.into_inner().expect("a tar")
}

#[test]
fn hostile_archives_are_read_without_harm_or_refused() {
    let nested = (0..6).fold(zip(&[(LIB, b"x")]), |inner, i| {
        zip(&[(&format!("{i}.zip"), &inner)])
    });
    let many: Vec<(String, &[u8])> = (0..6000)
        .map(|i| (format!("d{i}/x"), b"".as_slice()))
        .collect();
    let many: Vec<(&str, &[u8])> = many
        .iter()
        .map(|(name, text)| (name.as_str(), *text))
        .collect();
    let long = format!("stages/intersect/src/{}.rs", "x/".repeat(400));
    let hidden = format!("{LIB}\0.png");
    for (what, bytes, expected) in [
        (
            "a file where a folder is",
            zip(&[("stages/intersect/src", b"x"), (LIB, b"y")]),
            "damaged: contains stages/intersect/src/lib.rs, which cannot be written",
        ),
        (
            "a folder where a file is",
            zip(&[(LIB, b"y"), (&format!("{LIB}/a.rs"), b"x")]),
            "damaged: contains stages/intersect/src/lib.rs/a.rs, which cannot be written",
        ),
        (
            "a file twice",
            tar(&[(LIB, b"first"), (LIB, b"second")]),
            "read Ok(\"second\")",
        ),
        (
            "archives inside archives",
            nested,
            "damaged: contains archives inside archives",
        ),
        (
            "thousands of folders",
            zip(&many),
            "too large: contains more than 5000 folders",
        ),
        (
            "a path that is too long",
            zip(&[(LIB, b"x"), (&long, b"x")]),
            "damaged: contains the path",
        ),
        (
            "a zero byte in a name",
            zip(&[(&hidden, b"x")]),
            "damaged: contains the path stages/intersect/src/lib.rs\\0.png, which contains a zero byte",
        ),
        (
            "a name that clears the screen",
            zip(&[("/\u{1b}[2J\r\n.rs", b"x")]),
            "damaged: contains the path /\\u{1b}[2J\\r\\n.rs, which is absolute",
        ),
        (
            "a second name of a file outside",
            tar_with(
                tar::EntryType::Link,
                "stages/intersect/src/a.rs",
                "/etc/passwd",
            ),
            "read Ok(\"x\"); links were left out: stages/intersect/src/a.rs",
        ),
        (
            "a device",
            tar_with(tar::EntryType::Char, "stages/intersect/src/a.rs", "x"),
            "read Ok(\"x\"); links were left out",
        ),
        (
            "a pipe",
            tar_with(tar::EntryType::Fifo, "stages/intersect/src/a.rs", "x"),
            "read Ok(\"x\"); links were left out",
        ),
        (
            "a file of holes",
            tar_with(tar::EntryType::GNUSparse, "stages/intersect/src/a.rs", "x"),
            "damaged: is a damaged tar file",
        ),
        (
            "two streams one after the other",
            [gzip(&tar(&[(LIB, b"x")])), gzip(&[0; 4096])].concat(),
            "read Ok(\"x\")",
        ),
        (
            "the end of a zip and nothing else",
            b"PK\x05\x06\0\0\0\0\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\0\0".to_vec(),
            "damaged: is a damaged zip file",
        ),
    ] {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("anna.zip");
        std::fs::write(&path, bytes).expect("a file");
        let said = said(&path, None);
        assert!(said.starts_with(expected), "{what}: {said}");
        assert_eq!(
            std::fs::read_dir(folder.path()).expect("a folder").count(),
            1
        );
    }
}

/// Runs git, and returns what it prints.
fn git(folder: &Path, arguments: &[&str], input: &[u8]) -> String {
    let mut child = git::command(folder)
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("git runs");
    let mut stdin = child.stdin.take().expect("an input");
    stdin.write_all(input).expect("it reads");
    drop(stdin);
    let output = child.wait_with_output().expect("it ends");
    assert!(output.status.success(), "{arguments:?}");
    String::from_utf8_lossy(&output.stdout).trim().to_string()
}

/// A clone with a commit of a tree with these entries: mode, name, and the text of the file or the
/// target of the link.
fn clone_of(folder: &Path, entries: &[(&str, &str, &str)]) {
    git(folder, &["init", "--quiet"], b"");
    let mut tree = Vec::new();
    for (mode, name, text) in entries {
        let hash = git(folder, &["hash-object", "-w", "--stdin"], text.as_bytes());
        tree.extend(format!("{mode} {name}\0").bytes());
        let digit = |i: usize| u8::from_str_radix(&hash[i..i + 2], 16).expect("a hash");
        tree.extend((0..hash.len()).step_by(2).map(digit));
    }
    let literally = ["hash-object", "-w", "--literally", "--stdin", "-t", "tree"];
    let tree = git(folder, &literally, &tree);
    let commit = git(folder, &["commit-tree", &tree, "-m", "hostile"], b"");
    git(folder, &["update-ref", "refs/heads/main", &commit], b"");
    git(folder, &["symbolic-ref", "HEAD", "refs/heads/main"], b"");
}

#[test]
fn hostile_trees_are_read_without_harm_or_refused() {
    for (entries, expected) in [
        (&[("100644", "../../evil.rs", "x")][..], "damaged: "),
        (&[("100644", "/tmp/evil.rs", "x")], "damaged: "),
        (&[("100644", "..", "x")], "damaged: "),
        (
            &[("100644", ".git/config", "x")],
            "damaged: contains no stage",
        ),
        (
            &[("120000", "stages", "/etc")],
            "damaged: contains no stage",
        ),
        (&[("160000", "stages", "x")], "damaged: contains no stage"),
        (&[("100644", "a\nb.rs", "x")], "damaged: contains no stage"),
        (
            &[("100644", "a.rs", "x"), ("100644", "a.rs", "y")],
            "damaged: contains no stage",
        ),
        // A file that says that it is a folder.
        (
            &[("40000", "stages", "x")],
            "damaged: is a clone that git cannot read",
        ),
    ] {
        let folder = tempfile::tempdir().expect("a folder");
        clone_of(folder.path(), entries);
        let said = said(folder.path(), Some(&Revision::Commit("main".into())));
        assert!(said.starts_with(expected), "{entries:?}: {said}");
    }
}

/// What a folder `.git` says about where else to look is not followed.
#[test]
fn clones_that_lead_elsewhere_are_not_followed() {
    let secret = tempfile::tempdir().expect("a folder");
    let file = secret.path().join(LIB);
    write(secret.path(), &[(LIB, b"a secret")]);
    git(secret.path(), &["init", "--quiet"], b"");
    git(secret.path(), &["add", "--all"], b"");
    git(
        secret.path(),
        &["commit", "--quiet", "--message", "secret"],
        b"",
    );
    let dot_git = secret.path().join(".git");
    let hash = git(secret.path(), &["rev-parse", "HEAD"], b"");
    let elsewhere = dot_git.display();
    for (name, text) in [
        (".git", format!("gitdir: {elsewhere}\n")),
        (".git/commondir", format!("{elsewhere}\n")),
        (
            ".git/HEAD",
            format!("ref: ../../../../../{}\n", file.display()),
        ),
        (".git/HEAD", format!("{hash}\n")),
        (".git/packed-refs", format!("{hash} refs/heads/main\n")),
        (
            ".git/objects/info/http-alternates",
            format!("{elsewhere}/objects\n"),
        ),
        (".git/info/grafts", format!("{hash}\n")),
        (
            ".git/config",
            format!(
                "[core]\n\tworktree = {}\n[extensions]\n\tobjectFormat = sha256\n\tpartialClone = x\n[remote \"x\"]\n\tpromisor = true\n\turl = {elsewhere}\n",
                secret.path().display()
            ),
        ),
    ] {
        let folder = tempfile::tempdir().expect("a folder");
        if name != ".git" {
            git(folder.path(), &["init", "--quiet"], b"");
        }
        write(folder.path(), &[(name, text.as_bytes())]);
        for revision in [
            Revision::Commit("HEAD".into()),
            Revision::Commit(hash.clone()),
        ] {
            let said = said(folder.path(), Some(&revision));
            // A file `.git` names a folder elsewhere: no clone was handed in.
            let kind = if name == ".git" {
                "no clone: "
            } else {
                "damaged: "
            };
            assert!(said.starts_with(kind), "{name}: {said}");
            assert!(!said.contains("a secret"), "{name}: {said}");
        }
    }
}

/// A link in the place of a folder of a clone leads to the clone of somebody else.
#[cfg(unix)]
#[test]
fn links_to_the_clone_of_somebody_else_are_not_followed() {
    use std::os::unix::fs::symlink;
    let class = tempfile::tempdir().expect("a folder");
    let alice = class.path().join("alice");
    write(&alice, &[(LIB, b"a secret")]);
    git(&alice, &["init", "--quiet"], b"");
    git(&alice, &["add", "--all"], b"");
    git(&alice, &["commit", "--quiet", "--message", "all"], b"");
    for (name, target) in [
        (".git", "../alice/.git"),
        ("sub", "../alice"),
        ("sub/.git", "../../alice/.git"),
        (".git/objects", "../../alice/.git/objects"),
        (".git/refs", "../../alice/.git/refs"),
        (".git/HEAD", "../../alice/.git/HEAD"),
    ] {
        let bob = class.path().join("bob");
        std::fs::create_dir_all(&bob).expect("a folder");
        if name.starts_with(".git/") {
            git(&bob, &["init", "--quiet"], b"");
        }
        let link = bob.join(name);
        std::fs::create_dir_all(link.parent().expect("a folder")).expect("a folder");
        let _ = std::fs::remove_dir_all(&link).or_else(|_| std::fs::remove_file(&link)); // git's own
        symlink(target, &link).expect("a link");
        let said = said(&bob, Some(&Revision::Commit("HEAD".into())));
        let expected = "no clone: is no git clone: expected a folder .git in it, and no link";
        assert!(said.starts_with(expected), "{name}: {said}");
        std::fs::remove_dir_all(&bob).expect("it is removed");
    }
}

/// The names of a clone's commits are copied: neither large ones nor many fill the disk.
#[test]
fn names_of_commits_are_copied_within_limits() {
    let folder = tempfile::tempdir().expect("a folder");
    write(folder.path(), &[(LIB, b"mod a;")]);
    git(folder.path(), &["init", "--quiet"], b"");
    git(folder.path(), &["add", "--all"], b"");
    git(
        folder.path(),
        &["commit", "--quiet", "--message", "all"],
        b"",
    );
    let hash = git(folder.path(), &["rev-parse", "HEAD"], b"");
    let names = folder.path().join(".git/refs/heads");
    // A name of holes is no name: it is not copied, and what remains is read.
    let large = std::fs::File::create(names.join("large")).expect("a file");
    large.set_len(4 << 20).expect("it has holes");
    let of = |name: &str| said(folder.path(), Some(&Revision::Commit(name.into())));
    assert!(of("HEAD").starts_with("read Ok(\"mod a;\")"));
    let none = "damaged: has no commit, tag or branch large";
    assert!(of("large").starts_with(none));
    for i in 0..4100 {
        std::fs::write(names.join(i.to_string()), &hash).expect("a file");
    }
    let many = of("HEAD");
    let expected = "too large: has names of commits of more than 16 MB";
    assert!(many.starts_with(expected), "{many}");
}

/// Tables are the same for every run, so what is said has no name of a temporary folder.
#[test]
fn what_git_says_names_no_temporary_folder() {
    let folder = tempfile::tempdir().expect("a folder");
    git(folder.path(), &["init", "--quiet"], b"");
    write(folder.path(), &[(".git/HEAD", b"ref: HEAD\n")]);
    let said = said(folder.path(), Some(&Revision::Before("2030-01-01".into())));
    let expected = "damaged: is a clone that git cannot read: fatal: not a git repository: '.git'";
    assert!(said.starts_with(expected), "{said}");
}

/// Folders are removed again, by a process without limits if the one that reads was ended.
#[test]
fn an_archive_of_very_many_folders_is_refused_before_they_are_made() {
    let deep = |i: usize| format!("{i}/{}x", "d/".repeat(200));
    let files: Vec<String> = (0..60).map(deep).collect();
    let files: Vec<(&str, &[u8])> = files.iter().map(|name| (name.as_str(), &b""[..])).collect();
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("anna.zip");
    std::fs::write(&path, zip(&files)).expect("a file");
    let said = said(&path, None);
    let expected = "too large: contains more than 10000 folders: expected the folder stages";
    assert!(said.starts_with(expected), "{said}");
}

/// Somebody's name is as long as a name can be, or a pipe, or has a socket in it.
#[cfg(unix)]
#[test]
fn entries_that_are_no_submissions_are_said() {
    let folder = tempfile::tempdir().expect("a folder");
    let pipe = folder.path().join("pipe.zip");
    let made = Command::new("mkfifo").arg(&pipe).status();
    assert!(made.expect("mkfifo runs").success());
    let expected = "damaged: is neither a folder nor a zip, tar or tar.gz file";
    assert!(said(&pipe, None).starts_with(expected));
    let inside = folder.path().join("eve");
    write(&inside, &[(LIB, b"mod a;")]);
    let socket = std::os::unix::net::UnixListener::bind(inside.join("socket.zip"));
    assert!(socket.is_ok());
    assert!(said(&inside, None).starts_with("read Ok(\"mod a;\")"));
    std::os::unix::fs::symlink("/dev/zero", folder.path().join("zero.zip")).expect("a link");
    assert!(said(&folder.path().join("zero.zip"), None).starts_with("damaged: "));
}
