//! Packed goldens: the snapshots of a task in one compressed file.
//!
//! In the course's checkout they are text, one file each, to be reviewed. A handout has
//! `golden/TASK.pack` instead: entries, each a line `BYTES NAME`, then the bytes, compressed
//! together by [`judge::compressed`]. What nobody reviews as text, such as the signatures of
//! mistakes, is [`binary`] everywhere.

pub mod binary;

use base::{GraderError, Workspace};
use judge::compressed::{MAX_UNPACKED, compress, decompress};
use std::path::{Path, PathBuf};

/// The task to whose pack a file of the folder `golden` belongs, for the path below that folder;
/// `None` for files that are not packed.
pub fn task_of(path: &Path) -> Option<String> {
    let mut parts = path.iter().map(|part| part.to_string_lossy());
    let (folder, file) = (parts.next()?, parts.next()?);
    let (_, extension) = file.rsplit_once('.')?;
    (extension == "snap" && parts.next().is_none()).then(|| folder.to_string())
}

/// Packs files: their paths below the folder `golden`, and their contents.
pub fn pack(files: &[(PathBuf, Vec<u8>)]) -> Vec<u8> {
    let mut bytes = Vec::new();
    for (path, contents) in files {
        bytes.extend(format!("{} {}\n", contents.len(), path.display()).bytes());
        bytes.extend(contents);
    }
    compress(&bytes)
}

/// The path of the pack of a task.
pub fn path_of(task: &str) -> PathBuf {
    Path::new("golden").join(format!("{task}.pack"))
}

/// Reads a text of the folder `golden`, whether it is a file or in a pack; `path` is below that
/// folder. `None` if there is no such text.
pub fn read(workspace: &Workspace, path: &Path) -> Result<Option<String>, GraderError> {
    let file = workspace.root().join("golden").join(path);
    if file.is_file() {
        let text = std::fs::read_to_string(&file);
        return text
            .map(Some)
            .map_err(|e| GraderError::file("read", &file, e));
    }
    let Some(task) = task_of(path) else {
        return Ok(None);
    };
    let pack = workspace.root().join(path_of(&task));
    if !pack.is_file() {
        return Ok(None);
    }
    let packed = std::fs::read(&pack).map_err(|e| GraderError::file("read", &pack, e))?;
    find(&packed, path).map_err(|why| GraderError::file("unpack", &pack, why))
}

/// The text of the golden snapshot of a case; `None` if there is none.
pub fn read_snapshot(
    workspace: &Workspace,
    task: &str,
    case: &str,
) -> Result<Option<String>, GraderError> {
    read(workspace, &Path::new(task).join(format!("{case}.snap")))
}

/// Finds the text `path` in a pack.
fn find(packed: &[u8], path: &Path) -> Result<Option<String>, String> {
    let files = unpack(packed)?;
    let found = files.into_iter().find(|(name, _)| name == path);
    let text = found.map(|(name, contents)| {
        String::from_utf8(contents).map_err(|_| format!("{} is not UTF-8 text", name.display()))
    });
    text.transpose()
}

/// The files of a pack: their paths in it, and their contents.
pub fn unpack(packed: &[u8]) -> Result<Vec<(PathBuf, Vec<u8>)>, String> {
    let all = decompress(packed, MAX_UNPACKED)
        .map_err(|e| format!("it is damaged: {e}. Restore it from the handout"))?;
    let damaged =
        || "it is damaged: expected `BYTES NAME`. Restore it from the handout".to_string();
    let mut files = Vec::new();
    let mut rest = all.as_slice();
    while !rest.is_empty() {
        let end = rest.iter().position(|byte| *byte == b'\n');
        let (line, after) = rest.split_at(end.ok_or_else(damaged)?);
        let line = str::from_utf8(line).map_err(|_| damaged())?;
        let (length, name) = line.split_once(' ').ok_or_else(damaged)?;
        let length: usize = length.parse().map_err(|_| damaged())?;
        let (contents, next) = after[1..].split_at_checked(length).ok_or_else(damaged)?;
        files.push((PathBuf::from(name), contents.to_vec()));
        rest = next;
    }
    Ok(files)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn snapshots_belong_to_their_task() {
        for (path, task) in [
            ("part1.task3/back_face.snap", Some("part1.task3")),
            ("signatures/part1.task3.bin", None),
            ("part1.task3/picture.png", None),
            ("part1.task3/not_judged.txt", None),
            ("provenance.toml", None),
            ("a/b/c.snap", None),
        ] {
            assert_eq!(task_of(Path::new(path)).as_deref(), task, "{path}");
        }
    }

    #[test]
    fn packed_files_are_read_from_the_pack_of_their_task() {
        let folder = tempfile::tempdir().unwrap();
        let root = folder.path();
        std::fs::create_dir_all(root.join("stages")).unwrap();
        std::fs::create_dir_all(root.join("golden")).unwrap();
        std::fs::write(root.join("stages/course.toml"), "").unwrap();
        let workspace = Workspace::above(root).unwrap();
        let [a, b] = ["part1.task3/a.snap", "part1.task3/b.snap"].map(PathBuf::from);
        let files = [
            (a.clone(), b"one\n2 x\n".to_vec()),
            (b.clone(), b"two\n1 x\n".to_vec()),
        ];
        let pack = root.join(path_of("part1.task3"));
        std::fs::write(&pack, super::pack(&files)).unwrap();
        let text = |path: &Path| read(&workspace, path).unwrap();
        assert_eq!(text(&a).as_deref(), Some("one\n2 x\n"));
        assert_eq!(text(&b).as_deref(), Some("two\n1 x\n"));
        assert_eq!(text(Path::new("part1.task3/c.snap")), None);
        assert_eq!(text(Path::new("part1.task4/a.snap")), None);
        std::fs::create_dir_all(root.join("golden/part1.task3")).unwrap();
        std::fs::write(root.join("golden").join(&a), "a file").unwrap();
        assert_eq!(text(&a).as_deref(), Some("a file"), "files come first");
        std::fs::write(&pack, "no pack").unwrap();
        let error = read(&workspace, &b).unwrap_err().to_string();
        assert!(error.contains("it is damaged"), "{error}");
    }
}
