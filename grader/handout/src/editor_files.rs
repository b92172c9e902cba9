//! The files of a handout that set up editors: rust-analyzer runs `cargo grader check` when a file is
//! saved, and tasks run the other commands.

use files::file_tree::Files;

/// Path in the handout, and contents.
const FILES: [(&str, &str); 7] = [
    (
        ".vscode/settings.json",
        include_str!("editors/vscode_settings.json"),
    ),
    (
        ".vscode/extensions.json",
        include_str!("editors/vscode_extensions.json"),
    ),
    (
        ".vscode/tasks.json",
        include_str!("editors/vscode_tasks.json"),
    ),
    (
        ".zed/settings.json",
        include_str!("editors/zed_settings.json"),
    ),
    (".zed/tasks.json", include_str!("editors/zed_tasks.json")),
    (
        ".helix/languages.toml",
        include_str!("editors/helix_languages.toml"),
    ),
    (
        ".devcontainer/devcontainer.json",
        include_str!("editors/devcontainer.json"),
    ),
];

/// Adds them to the files of a handout.
pub(super) fn add(files: &mut Files) {
    let added = FILES
        .iter()
        .map(|(path, text)| ((*path).into(), text.as_bytes().to_vec()));
    files.extend(added);
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::Value;

    /// The file at `path` without the lines that are comments.
    fn json(path: &str) -> Value {
        let (_, text) = FILES
            .iter()
            .find(|(other, _)| *other == path)
            .expect("it is there");
        let lines = text
            .lines()
            .filter(|line| !line.trim_start().starts_with("//"));
        let text = lines.collect::<Vec<_>>().join("\n");
        serde_json::from_str(&text).unwrap_or_else(|e| panic!("{path}: {e}"))
    }

    #[test]
    fn every_editor_runs_the_same_command() {
        let command = serde_json::json!(["cargo", "grader", "check", "--message-format=json"]);
        let vscode = json(".vscode/settings.json");
        assert_eq!(vscode["rust-analyzer.check.overrideCommand"], command);
        let zed = json(".zed/settings.json");
        let options = &zed["lsp"]["rust-analyzer"]["initialization_options"];
        assert_eq!(options["check"]["overrideCommand"], command);
        let (_, helix) = FILES[5];
        let helix: toml::Value = toml::from_str(helix).expect("it is TOML");
        let config = &helix["language-server"]["rust-analyzer"]["config"];
        let list = config["check"]["overrideCommand"]
            .as_array()
            .expect("a list");
        let list: Vec<&str> = list.iter().filter_map(|word| word.as_str()).collect();
        assert_eq!(serde_json::json!(list), command);
    }

    #[test]
    fn the_tasks_of_two_editors_are_the_same() {
        let names = |tasks: &Value| -> Vec<String> {
            let tasks = tasks.as_array().expect("a list").iter();
            tasks
                .map(|task| task["label"].to_string() + &task["command"].to_string())
                .collect()
        };
        let vscode = json(".vscode/tasks.json");
        assert_eq!(names(&vscode["tasks"]), names(&json(".zed/tasks.json")));
        assert!(json(".devcontainer/devcontainer.json")["image"].is_string());
        assert!(json(".vscode/extensions.json")["recommendations"].is_array());
    }
}
