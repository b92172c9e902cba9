//! The whole book as HTML pages that ask nothing of any server.

use crate::chapter::{self, Chapter};
use crate::maths;
use pulldown_cmark::{CowStr, Event, Parser, Tag, TagEnd, html};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Component, Path, PathBuf};

/// Layout of a page. Rules that mdBook needs as well are in `theme/book.css`.
const STYLE: &str = "\
:root{color-scheme:light dark}body{margin:0;font:17px/1.55 system-ui,sans-serif;background:#fff;color:#222}\
main{max-width:46rem;margin:0 auto;padding:1rem 1.2rem 4rem;overflow-wrap:break-word}\
nav{padding:.6rem 1.2rem;border-bottom:1px solid #8886}nav ul{list-style:none;padding-left:1rem;margin:.2rem 0}\
h1,h2,h3{line-height:1.25}h2{margin-top:2.2rem}a{color:#0061a8}code{font-size:.88em;background:#8882;padding:.1em .25em}\
pre{background:#8882;padding:.8rem;overflow-x:auto;line-height:1.4}pre code{background:none;padding:0}\
table{border-collapse:collapse;display:block;overflow-x:auto}th,td{border:1px solid #8886;padding:.3rem .6rem;text-align:left}\
blockquote{margin:1em 0;padding:.1em 1em;border-left:4px solid #0072b2}img{display:block;margin:1em auto}\
.turn{display:flex;justify-content:space-between;gap:1rem;margin-top:3rem}\
@media (prefers-color-scheme:dark){body{background:#16181d;color:#e6e6e6}a{color:#79c0ff}}\
@media print{nav,.turn{display:none}body{background:#fff;color:#000}}";

/// Writes the book to the folder `out`, one HTML page for each chapter, and `index.html`.
pub fn build(out: &Path) -> Result<(), String> {
    let chapters = chapter::all()?;
    let shared = crate::folder().join("theme/book.css");
    let shared = fs::read_to_string(&shared).map_err(|e| failed("read", &shared, &e))?;
    let out = absolute(out)?;
    let mut pictures = BTreeSet::new();
    for (i, chapter) in chapters.iter().enumerate() {
        let page = Page { chapter, out: &out };
        let body = page.body(&mut pictures)?;
        let before = i.checked_sub(1).map(|i| &chapters[i]);
        let turn = page.turn(before, chapters.get(i + 1));
        let contents = page.contents()?;
        let title = escaped(&chapter.title);
        let text = format!(
            "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\
             <meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\
             <title>{title} - First Light</title><style>{STYLE}\n{shared}</style></head><body>\n\
             <nav><details><summary>Contents</summary>{contents}</details></nav>\n\
             <main>\n{body}{turn}</main></body></html>\n"
        );
        write(
            &out.join(chapter.path.with_extension("html")),
            text.as_bytes(),
        )?;
        if i == 0 {
            let target = page.link_to(&chapter.path);
            let text =
                format!("<!doctype html><meta http-equiv=\"refresh\" content=\"0;url={target}\">");
            write(&out.join("index.html"), text.as_bytes())?;
        }
    }
    for picture in pictures {
        let bytes = fs::read(&picture).map_err(|e| failed("read", &picture, &e))?;
        write(&out.join(copy_of(&picture)), &bytes)?;
    }
    Ok(())
}

/// One page of the book.
struct Page<'a> {
    chapter: &'a Chapter,
    out: &'a Path,
}

impl Page<'_> {
    /// The chapter as HTML. Adds the pictures that it shows to `pictures`.
    fn body(&self, pictures: &mut BTreeSet<PathBuf>) -> Result<String, String> {
        self.markdown(&self.chapter.text, &self.chapter.path, pictures)
    }

    /// The table of contents, with links from this page.
    fn contents(&self) -> Result<String, String> {
        let summary = Chapter::read(Path::new("SUMMARY.md"))?;
        self.markdown(&summary.text, &summary.path, &mut BTreeSet::new())
    }

    /// Converts Markdown whose links are relative to the chapter `at`.
    fn markdown(
        &self,
        text: &str,
        at: &Path,
        pictures: &mut BTreeSet<PathBuf>,
    ) -> Result<String, String> {
        let mut events = Vec::new();
        let mut heading: Option<(usize, String)> = None;
        for event in Parser::new_ext(text, maths::options()) {
            let event = match event {
                Event::InlineMath(latex) => Event::InlineHtml(maths::mathml(&latex, false)?.into()),
                Event::DisplayMath(latex) => Event::InlineHtml(maths::mathml(&latex, true)?.into()),
                Event::Start(Tag::Link {
                    link_type,
                    dest_url,
                    title,
                    id,
                }) => Event::Start(Tag::Link {
                    link_type,
                    dest_url: self.target(&dest_url, at),
                    title,
                    id,
                }),
                Event::Start(Tag::Image {
                    link_type,
                    dest_url,
                    title,
                    id,
                }) => {
                    let file = normal(&folder_of(at).join(&*dest_url));
                    let copy = self.link_to(&copy_of(&file));
                    pictures.insert(file);
                    Event::Start(Tag::Image {
                        link_type,
                        dest_url: copy.into(),
                        title,
                        id,
                    })
                }
                other => other,
            };
            match &event {
                Event::Start(Tag::Heading { .. }) => {
                    heading = Some((events.len(), String::new()));
                }
                Event::Text(words) | Event::Code(words) => {
                    if let Some((_, title)) = &mut heading {
                        title.push_str(words);
                    }
                }
                Event::End(TagEnd::Heading(_)) => {
                    if let Some((start, title)) = heading.take()
                        && let Event::Start(Tag::Heading { id, .. }) = &mut events[start]
                    {
                        *id = Some(anchor(&title).into());
                    }
                }
                _ => {}
            }
            events.push(event);
        }
        let mut page = String::new();
        html::push_html(&mut page, events.into_iter());
        Ok(page)
    }

    /// Links to the chapters before and after this one.
    fn turn(&self, before: Option<&Chapter>, after: Option<&Chapter>) -> String {
        let link = |chapter: Option<&Chapter>, left: &str, right: &str| {
            chapter.map_or(String::from("<span></span>"), |chapter| {
                let target = self.link_to(&chapter.path);
                format!(
                    "<a href=\"{target}\">{left}{}{right}</a>",
                    escaped(&chapter.title)
                )
            })
        };
        format!(
            "<div class=\"turn\">{}{}</div>\n",
            link(before, "← ", ""),
            link(after, "", " →")
        )
    }

    /// The target of a link of the chapter `at`: a chapter's page, or a file of the project.
    fn target<'a>(&self, link: &str, at: &Path) -> CowStr<'a> {
        if link.contains("://") || link.starts_with('#') {
            return link.to_string().into();
        }
        let (file, fragment) = link.split_once('#').unwrap_or((link, ""));
        let fragment = if fragment.is_empty() {
            String::new()
        } else {
            format!("#{fragment}")
        };
        let file = normal(&folder_of(at).join(file));
        let target = match file.strip_prefix(crate::folder().join("src")) {
            Ok(inside) => self.link_to(inside),
            Err(_) => relative(&self.page_folder(), &file),
        };
        format!("{target}{fragment}").into()
    }

    /// The link from this page to `path` in the folder of the book; chapters are pages there.
    fn link_to(&self, path: &Path) -> String {
        let path = if path.extension().is_some_and(|extension| extension == "md") {
            path.with_extension("html")
        } else {
            path.to_path_buf()
        };
        relative(&self.page_folder(), &self.out.join(path))
    }

    fn page_folder(&self) -> PathBuf {
        let page = self.out.join(&self.chapter.path);
        page.parent().map(Path::to_path_buf).unwrap_or_default()
    }
}

/// The id of a heading, as forges and mdBook make it.
pub fn anchor(title: &str) -> String {
    let kept = title.chars().filter_map(|c| match c {
        ' ' | '-' => Some('-'),
        c if c.is_alphanumeric() || c == '_' => Some(c.to_ascii_lowercase()),
        _ => None,
    });
    kept.collect()
}

/// The folder of the chapter `at` in the sources.
pub fn folder_of(at: &Path) -> PathBuf {
    let file = crate::folder().join("src").join(at);
    file.parent().map(Path::to_path_buf).unwrap_or_default()
}

/// The place of a picture's copy in the folder of the book: its folder's name keeps copies apart.
fn copy_of(picture: &Path) -> PathBuf {
    let folder = picture.parent().and_then(Path::file_name);
    let name = picture.file_name();
    Path::new("pictures")
        .join(folder.unwrap_or_default())
        .join(name.unwrap_or_default())
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
fn relative(from: &Path, to: &Path) -> String {
    let from: Vec<Component> = from.components().collect();
    let to: Vec<Component> = to.components().collect();
    let common = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
    let up = std::iter::repeat_n("..".to_string(), from.len() - common);
    let down = to[common..]
        .iter()
        .map(|part| part.as_os_str().to_string_lossy().into_owned());
    up.chain(down).collect::<Vec<_>>().join("/")
}

fn absolute(path: &Path) -> Result<PathBuf, String> {
    std::path::absolute(path)
        .map(|path| normal(&path))
        .map_err(|error| failed("find", path, &error))
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), String> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(|e| failed("create", folder, &e))?;
    }
    fs::write(path, bytes).map_err(|e| failed("write", path, &e))
}

fn failed(what: &str, path: &Path, error: &std::io::Error) -> String {
    format!("cannot {what} {}: {error}", path.display())
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;")
}

#[cfg(test)]
mod tests {
    use super::*;

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
