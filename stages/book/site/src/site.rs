//! Builds the site.

use crate::search_index;
use book::source::{LARGE_SHEETS, Links, OWN_PICTURES, Sources};
use book::{page, paths};
use mdbook_driver::MDBook;
use mdbook_driver::config::Config;
use std::fs;
use std::path::{Path, PathBuf};

/// Writes the site to the folder `out`. What is in the folder is removed first.
pub(crate) fn build(out: &Path, links: Links) -> Result<(), String> {
    let out = std::path::absolute(out).map_err(|error| failed("find", out, &error))?;
    let out = paths::normal(&out);
    let mut sources = Sources::new(links);
    render(&out, &mut sources)?;
    let to_project = paths::relative(&out, &paths::project());
    for file in files_below(&out)? {
        if file
            .extension()
            .is_some_and(|extension| extension == "html")
        {
            let html = fs::read_to_string(&file).map_err(|e| failed("read", &file, &e))?;
            let path = file.strip_prefix(&out).unwrap_or(&file);
            let html = page::complete(&html, path, sources.formulas(), &to_project)?;
            fs::write(&file, html).map_err(|e| failed("write", &file, &e))?;
        }
    }
    // The pages have the choices in their forms.
    let choices = out.join("predictions.toml");
    fs::remove_file(&choices).map_err(|e| failed("remove", &choices, &e))?;
    // What mdBook has copied and no page shows.
    let unused: &[&str] = match links {
        Links::Project => &[OWN_PICTURES, LARGE_SHEETS],
        Links::Nowhere => &["mistakes"],
    };
    for folder in unused.iter().map(|name| out.join(name)) {
        fs::remove_dir_all(&folder).map_err(|e| failed("remove", &folder, &e))?;
    }
    let script = out.join("highlight.js");
    let js = fs::read_to_string(&script).map_err(|e| failed("read", &script, &e))?;
    fs::write(&script, with_languages_of_the_book(&js))
        .map_err(|e| failed("write", &script, &e))?;
    let index = out.join("searchindex.js");
    let js = fs::read_to_string(&index).map_err(|e| failed("read", &index, &e))?;
    let js = search_index::shortened(&js).map_err(|why| format!("{}: {why}", index.display()))?;
    fs::write(&index, js).map_err(|e| failed("write", &index, &e))?;
    for (picture, copy) in sources.pictures() {
        let copy = out.join(copy);
        if let Some(folder) = copy.parent() {
            fs::create_dir_all(folder).map_err(|e| failed("create", folder, &e))?;
        }
        fs::copy(picture, &copy).map_err(|e| failed("copy", picture, &e))?;
    }
    Ok(())
}

/// The languages of the book's code, with the names that highlight.js has for them: `sh` is a
/// shell's, `toml` an ini file's, `text` plain text.
const LANGUAGES: [&str; 4] = ["bash", "ini", "plaintext", "rust"];

/// The script of highlight.js without the languages that the book has no code in: nine tenths of
/// it.
fn with_languages_of_the_book(js: &str) -> String {
    const START: &str = "hljs.registerLanguage(\"";
    let mut parts = js.split(START);
    let mut kept = parts.next().unwrap_or_default().to_string();
    for part in parts {
        let name = part.split('"').next().unwrap_or_default();
        if LANGUAGES.contains(&name) {
            kept += START;
            kept += part;
        }
    }
    kept
}

/// Lets mdBook render the chapters to `out`.
fn render(out: &Path, sources: &mut Sources) -> Result<(), String> {
    let root = book::folder();
    // `{:#}` prints the causes of mdBook's errors, too.
    let told = |error: mdbook_driver::errors::Error| format!("mdBook: {error:#}");
    let mut config = Config::from_disk(root.join("book.toml")).map_err(told)?;
    config.build.build_dir = out.to_path_buf();
    let mut book = MDBook::load_with_config(root, config).map_err(told)?;
    let mut result = Ok(());
    book.book.for_each_chapter_mut(|chapter| {
        let Some(path) = &chapter.path else { return };
        match sources.chapter(&chapter.content, path) {
            Ok(content) => chapter.content = content,
            Err(why) => result = Err(why),
        }
    });
    result?;
    book.build().map_err(told)
}

fn files_below(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let mut files = Vec::new();
    let entries = fs::read_dir(folder).map_err(|e| failed("read", folder, &e))?;
    for entry in entries {
        let path = entry.map_err(|e| failed("read", folder, &e))?.path();
        if path.is_dir() {
            files.extend(files_below(&path)?);
        } else {
            files.push(path);
        }
    }
    Ok(files)
}

fn failed(what: &str, path: &Path, error: &std::io::Error) -> String {
    format!("cannot {what} {}: {error}", path.display())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_languages_of_the_book_stay() {
        let js = "core;hljs.registerLanguage(\"ada\",f());hljs.registerLanguage(\"rust\",g());hljs.registerLanguage(\"sql\",h());";
        assert_eq!(
            with_languages_of_the_book(js),
            "core;hljs.registerLanguage(\"rust\",g());"
        );
    }
}
