//! Paths and anchors of the book.

use std::path::{Component, Path, PathBuf};

/// The anchor of a heading, as forges and mdBook make it.
pub fn anchor(title: &str) -> String {
    let kept = title.chars().filter_map(|c| match c {
        ' ' | '-' => Some('-'),
        c if c.is_alphanumeric() || c == '_' => Some(c.to_ascii_lowercase()),
        _ => None,
    });
    kept.collect()
}

/// The folder of the chapter `at` in the sources. `at` is a path below `src`.
pub fn folder_of(at: &Path) -> PathBuf {
    let file = crate::folder().join("src").join(at);
    file.parent().map(Path::to_path_buf).unwrap_or_default()
}

/// The folder of the project.
pub fn project() -> PathBuf {
    normal(&crate::folder().join("../.."))
}

/// The number of a task's chapter, such as `1.3` for `part1/task3.md`; `None` for another chapter.
pub fn task_number(chapter: &Path) -> Option<String> {
    let name = chapter.with_extension("").display().to_string();
    let (part, task) = name.strip_prefix("part")?.split_once("/task")?;
    Some(format!("{part}.{task}"))
}

/// `path` without `.` and `..`.
pub fn normal(path: &Path) -> PathBuf {
    let mut normal = PathBuf::new();
    for part in path.components() {
        match part {
            Component::CurDir => {}
            Component::ParentDir => {
                normal.pop();
            }
            other => normal.push(other),
        }
    }
    normal
}

/// The relative path from the folder `from` to `to`, with slashes. Both are absolute.
pub fn relative(from: &Path, to: &Path) -> String {
    let from: Vec<Component> = from.components().collect();
    let to: Vec<Component> = to.components().collect();
    let common = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
    let up = std::iter::repeat_n("..".to_string(), from.len() - common);
    let down = to[common..]
        .iter()
        .map(|part| part.as_os_str().to_string_lossy().into_owned());
    up.chain(down).collect::<Vec<_>>().join("/")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chapters_of_tasks_have_numbers() {
        let number = |path: &str| task_number(Path::new(path));
        assert_eq!(number("part1/task3.md").as_deref(), Some("1.3"));
        assert_eq!(number("part1/README.md"), None);
        assert_eq!(number("light.md"), None);
    }

    #[test]
    fn relative_paths_go_up_and_down() {
        let at = |a: &str, b: &str| relative(Path::new(a), Path::new(b));
        assert_eq!(at("/a/b", "/a/c/d.html"), "../c/d.html");
        assert_eq!(at("/a", "/a/d.html"), "d.html");
        assert_eq!(normal(Path::new("/a/./b/../c")), Path::new("/a/c"));
    }

    #[test]
    fn anchors_are_those_of_forges() {
        assert_eq!(anchor("What you will see"), "what-you-will-see");
        assert_eq!(anchor("Part 1, Task 3: A"), "part-1-task-3-a");
    }
}
