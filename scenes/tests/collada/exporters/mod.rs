//! Small documents in the form that known exporters write. Each loads, with the warnings that are
//! listed here.

mod assimp;
mod blender;
mod fbx;
mod sketchup;
mod version_1_5;

use scenes::Loaded;

/// Reads a document and checks its warnings: the title of each, and what is in its line.
fn load(name: &str, text: &str, warnings: &[(&str, &str)]) -> Loaded {
    let loaded = scenes::parse(name, text).unwrap_or_else(|e| panic!("{e}"));
    let found: Vec<&str> = loaded.warnings.iter().map(|w| w.0.title()).collect();
    let titles: Vec<&str> = warnings.iter().map(|(title, _)| *title).collect();
    assert_eq!(found, titles);
    for (warning, (_, content)) in loaded.warnings.iter().zip(warnings) {
        let (line, _) = warning.0.line_and_column().expect("a line");
        let line = text.lines().nth(line - 1).expect("a line of the text");
        assert!(line.contains(content), "{warning}");
    }
    loaded
}
