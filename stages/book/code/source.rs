//! The Markdown that mdBook renders: a chapter without what mdBook cannot render.
//!
//! - A formula becomes an empty element with a number, which [`crate::page`] fills with MathML. In
//!   Markdown, the signs of MathML would be read as emphasis or as the columns of a table. The
//!   punctuation that follows a formula stays on its line.
//! - A link to a file of the project leads to that file ([`Links::Project`]), or is only its text.
//! - A picture of the project from outside the book is copied into the book.
//! - A drawn figure gets its number, a caption, and the drawing's description in words, which a
//!   program that reads the page aloud reads in place of the picture. An explorable figure has a
//!   caption of its own, and gets its number.
//! - The questions of a chapter get their choices as a form (`predictions.rs`).
//! - A picture that readers make themselves, in a comment `<!-- picture: FILE | TEXT -->`, is shown
//!   where the book is read alone ([`Links::Nowhere`]).
//! - A sheet of mistakes becomes its panels, which are below each other where the page is narrow.

use crate::maths;
use crate::paths::{folder_of, normal, project, relative, task_number};
use crate::predictions;
use pulldown_cmark::{Event, Parser, Tag, TagEnd};
use std::collections::BTreeSet;
use std::fmt::Write;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Where links to files of the project lead.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Links {
    /// To the files: the book is read beside them.
    Project,
    /// Nowhere: the book is read alone. Only their text is shown.
    Nowhere,
}

/// The scheme of links to files of the project. [`crate::page`] replaces it.
pub(crate) const PROJECT: &str = "project:";

/// What is before the number of a formula, and what is after it.
pub(crate) const FORMULA: [&str; 2] = ["<span data-formula=\"", "\"></span>"];

/// The width of a panel on a sheet of mistakes, the height, and the gap between panels, in pixels.
const PANEL: [u32; 3] = [160, 120, 4];

/// The same where the book is read alone, with the sheets of [`LARGE_SHEETS`].
const LARGE_PANEL: [u32; 3] = [320, 240, 4];

/// The folder of the large sheets below `src`. They are too large for handouts.
pub const LARGE_SHEETS: &str = "mistakes-large";

/// The sources of the whole book.
#[derive(Debug)]
pub struct Sources {
    links: Links,
    formulas: Vec<String>,
    pictures: BTreeSet<PathBuf>,
}

impl Sources {
    /// No chapter yet.
    pub fn new(links: Links) -> Sources {
        Sources {
            links,
            formulas: Vec::new(),
            pictures: BTreeSet::new(),
        }
    }

    /// The MathML of all formulas, by their numbers.
    pub fn formulas(&self) -> &[String] {
        &self.formulas
    }

    /// The pictures from outside of the book: each file, and the path of its copy in the book.
    pub fn pictures(&self) -> impl Iterator<Item = (&Path, PathBuf)> {
        let files = self.pictures.iter();
        files.map(|file| (file.as_path(), copy_of(file)))
    }

    /// The Markdown for mdBook of the chapter `at`, a path below `src`.
    pub fn chapter(&mut self, markdown: &str, at: &Path) -> Result<String, String> {
        let mut changes: Vec<(Range<usize>, String)> = Vec::new();
        let mut figures = FigureNumbers::of(at);
        let events = Parser::new_ext(markdown, maths::options()).into_offset_iter();
        let mut link: Option<Range<usize>> = None;
        for (event, range) in events {
            if let Some(inside) = &mut link {
                match &event {
                    Event::End(TagEnd::Link) => {
                        // Of `[text](target)` the text stays. What is changed in it is changed.
                        let text = link.take().unwrap_or_default();
                        changes.push((range.start..text.start, String::new()));
                        changes.push((text.end..range.end, String::new()));
                        continue;
                    }
                    _ if inside.start == inside.end => *inside = range.clone(),
                    _ => inside.end = inside.end.max(range.end),
                }
            }
            match event {
                Event::InlineMath(latex) => {
                    changes.push(self.formula(markdown, range, &latex, false)?);
                }
                Event::DisplayMath(latex) => {
                    changes.push(self.formula(markdown, range, &latex, true)?);
                }
                Event::Code(code) if code.starts_with('-') && code.len() <= SHORT_FLAG => {
                    let whole = format!("<code class=\"joined\">{}</code>", escaped(&code));
                    changes.push((range, whole));
                }
                Event::Start(Tag::Link { dest_url, .. }) => {
                    if let Some(file) = of_project(&dest_url, at) {
                        match self.links {
                            Links::Nowhere => link = Some(range.end..range.end),
                            Links::Project => {
                                let fragment = dest_url.find('#').map_or("", |i| &dest_url[i..]);
                                let target = relative(&project(), &file);
                                let old = format!("]({dest_url})");
                                let start = range.start
                                    + markdown[range.clone()].rfind(&old).ok_or_else(|| {
                                        format!(
                                            "{}: write the link to {dest_url} as [text](target)",
                                            at.display()
                                        )
                                    })?;
                                let new = format!("]({PROJECT}{target}{fragment})");
                                changes.push((start..start + old.len(), new));
                            }
                        }
                    }
                }
                Event::Html(html) if html.contains(CAPTION) => {
                    let start = range.start + html.find(CAPTION).unwrap_or_default();
                    let end = start + CAPTION.len();
                    changes.push((start..end, format!("{CAPTION}{} ", figures.next())));
                }
                Event::Html(html) if html.starts_with(OWN_PICTURE[0]) => {
                    changes.push((range, own_picture(&html, self.links)));
                }
                Event::Start(Tag::Image { dest_url, .. }) => {
                    let image = &markdown[range.clone()];
                    if dest_url.contains("figures/") {
                        let is_explorable = markdown[..range.start].trim_end().ends_with("\">");
                        let number = (!is_explorable).then(|| figures.next());
                        let html = drawn(image, &dest_url, at, number.as_deref())?;
                        changes.push((range, html));
                    } else if dest_url.contains("/mistakes/") || dest_url.starts_with("mistakes/") {
                        changes.push((range, sheet(image, &dest_url, at, self.links)?));
                    } else if let Some(file) = of_project(&dest_url, at) {
                        let copy = crate::folder().join("src").join(copy_of(&file));
                        let copy = relative(&folder_of(at), &copy);
                        changes.push((range, image.replace(&*dest_url, &copy)));
                        self.pictures.insert(file);
                    }
                }
                _ => {}
            }
        }
        // Each task's chapter has this section with folded answers: `tests/course.rs`.
        let predict = markdown.find("\n## Predict\n");
        let answers = predict.and_then(|start| Some(start + markdown[start..].find("<details>")?));
        if let Some(place) = answers
            && let Some(form) = predictions::form(at)?
        {
            changes.push((place..place, format!("{form}\n")));
        }
        changes.sort_by_key(|(range, _)| range.start);
        let mut text = String::with_capacity(2 * markdown.len());
        let mut done = 0;
        for (range, new) in changes {
            text.push_str(&markdown[done..range.start]);
            text.push_str(&new);
            done = range.end;
        }
        text.push_str(&markdown[done..]);
        Ok(text)
    }

    /// The element of a formula, with the punctuation that follows it on the same line.
    fn formula(
        &mut self,
        markdown: &str,
        range: Range<usize>,
        latex: &str,
        display: bool,
    ) -> Result<(Range<usize>, String), String> {
        let number = self.formulas.len();
        self.formulas.push(maths::mathml(latex, display)?);
        let element = format!("{}{number}{}", FORMULA[0], FORMULA[1]);
        let after = &markdown[range.end..];
        let signs = after.len()
            - after
                .trim_start_matches([',', '.', ';', ':', '?', '!', ')'])
                .len();
        if display || signs == 0 {
            return Ok((range, element));
        }
        let with_signs = format!("<span class=\"joined\">{element}{}</span>", &after[..signs]);
        Ok((range.start..range.end + signs, with_signs))
    }
}

/// A flag of up to so many bytes is not broken at its hyphens. Longer ones are, on narrow pages.
const SHORT_FLAG: usize = 16;

/// The start of the caption of an explorable figure.
const CAPTION: &str = "<figcaption>";

/// What is around the file and the text of a picture that readers make themselves.
const OWN_PICTURE: [&str; 2] = ["<!-- picture: ", "-->"];

/// The folder of these pictures below `src`. Beside a reader's own program nobody needs them.
pub const OWN_PICTURES: &str = "so-far";

/// The element of a picture that readers make themselves, if the book is read alone.
fn own_picture(comment: &str, links: Links) -> String {
    let inside = comment
        .trim_end()
        .trim_end_matches(OWN_PICTURE[1])
        .trim_start_matches(OWN_PICTURE[0])
        .trim();
    match (links, inside.split_once(" | ")) {
        (Links::Nowhere, Some((file, text))) => {
            format!("<img src=\"{file}\" alt=\"{}\">\n", escaped(text))
        }
        _ => String::new(),
    }
}

/// Counts the figures of a chapter.
struct FigureNumbers {
    prefix: String,
    last: u32,
}

impl FigureNumbers {
    /// Those of the chapter `at`: `1.3-1` is the first of Part 1, Task 3.
    fn of(at: &Path) -> FigureNumbers {
        let prefix = task_number(at).map_or(String::new(), |task| format!("{task}-"));
        FigureNumbers { prefix, last: 0 }
    }

    fn next(&mut self) -> String {
        self.last += 1;
        format!("<b>Figure {}{}.</b>", self.prefix, self.last)
    }
}

/// A drawn figure: its text in the chapter is the caption, its title the description.
fn drawn(image: &str, link: &str, at: &Path, number: Option<&str>) -> Result<String, String> {
    let file = folder_of(at).join(link);
    let svg = std::fs::read_to_string(&file)
        .map_err(|error| format!("cannot read {}: {error}", file.display()))?;
    let title = svg
        .split("<title>")
        .nth(1)
        .and_then(|rest| rest.split("</title>").next());
    let title = title.ok_or_else(|| format!("{}: expected a <title>", file.display()))?;
    let description = title.replace('"', "&quot;");
    let img = format!("<img src=\"{link}\" alt=\"{description}\">");
    let caption = image.split("](").next().unwrap_or_default();
    let caption = escaped(caption.trim_start_matches("!["));
    Ok(match number {
        Some(number) => {
            format!(
                "<figure class=\"drawn\">{img}{CAPTION}{number} {caption}.</figcaption></figure>"
            )
        }
        None => img,
    })
}

/// The file of the project outside of the book to which `link` of the chapter `at` leads.
fn of_project(link: &str, at: &Path) -> Option<PathBuf> {
    if link.contains("://") || link.starts_with('#') {
        return None;
    }
    let target = link.split('#').next().unwrap_or_default();
    let file = normal(&folder_of(at).join(target));
    (!file.starts_with(crate::folder().join("src"))).then_some(file)
}

/// The place of a picture's copy in the book: its folder's name keeps copies apart.
fn copy_of(picture: &Path) -> PathBuf {
    let folder = picture.parent().and_then(Path::file_name);
    let name = picture.file_name();
    Path::new("pictures")
        .join(folder.unwrap_or_default())
        .join(name.unwrap_or_default())
}

/// The panels of a sheet of mistakes: the same file, of which each panel shows another piece.
fn sheet(image: &str, link: &str, at: &Path, links: Links) -> Result<String, String> {
    let (link, class, size) = match links {
        Links::Project => (link.to_string(), "sheet", PANEL),
        Links::Nowhere => {
            let large = link.replace("mistakes/", &format!("{LARGE_SHEETS}/"));
            (large, "sheet large", LARGE_PANEL)
        }
    };
    let file = folder_of(at).join(&link);
    let [width, height] = size_of_png(&file)?;
    let [panel, panel_height, gap] = size;
    let panels = (width + gap) / (panel + gap);
    if height != panel_height || panels < 2 || panels * (panel + gap) != width + gap {
        return Err(format!(
            "{}: expected panels of {panel} by {panel_height} pixels side by side with gaps of {gap}, found {width} by {height} pixels",
            file.display()
        ));
    }
    let alt = image.split("](").next().unwrap_or_default();
    let alt = escaped(alt.trim_start_matches("!["));
    let mut html = format!("<span class=\"{class}\" role=\"img\" aria-label=\"{alt}\">");
    for number in 0..panels {
        let position = f64::from(100 * number) / f64::from(panels - 1);
        let _ = write!(
            html,
            "<img src=\"{link}\" alt=\"\" width=\"{panel}\" height=\"{panel_height}\" style=\"object-position:{position:.3}% 0\">"
        );
    }
    html.push_str("</span>");
    Ok(html)
}

/// The width and height in the header of a PNG file.
fn size_of_png(file: &Path) -> Result<[u32; 2], String> {
    let failed = |why: &dyn std::fmt::Display| format!("cannot read {}: {why}", file.display());
    let bytes = std::fs::read(file).map_err(|error| failed(&error))?;
    let number = |at: usize| {
        let bytes = bytes.get(at..at + 4)?;
        Some(u32::from_be_bytes(bytes.try_into().ok()?))
    };
    match (bytes.get(12..16), number(16), number(20)) {
        (Some(b"IHDR"), Some(width), Some(height)) => Ok([width, height]),
        _ => Err(failed(&"expected a PNG file")),
    }
}

/// `text` in HTML, also as the value of an attribute.
pub(crate) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chapter(markdown: &str, links: Links) -> (String, Sources) {
        let mut sources = Sources::new(links);
        let text = sources.chapter(markdown, Path::new("part1/task3.md"));
        (text.expect("a chapter"), sources)
    }

    #[test]
    fn formulas_become_numbers_and_code_stays() {
        let (text, sources) = chapter(
            "Let $x_1 = 2$, or $|y|$ wide; `$z$` is code.",
            Links::Project,
        );
        let expected = "Let <span class=\"joined\"><span data-formula=\"0\"></span>,</span> or \
                        <span data-formula=\"1\"></span> wide; `$z$` is code.";
        assert_eq!(text, expected);
        assert_eq!(sources.formulas().len(), 2);
        let error = Sources::new(Links::Project)
            .chapter(r"$$\nonsense x$$", Path::new("a.md"))
            .unwrap_err();
        assert!(error.contains(r"\nonsense"), "{error}");
    }

    #[test]
    fn short_flags_stay_whole() {
        let (text, _) = chapter("`-l` and `x -l`, `--rate-scale assignment`", Links::Nowhere);
        assert_eq!(
            text,
            "<code class=\"joined\">-l</code> and `x -l`, `--rate-scale assignment`"
        );
    }

    #[test]
    fn links_to_the_project_lead_to_its_files_or_nowhere() {
        let markdown = "See [`ray.rs` and $t$](../../../kit/src/ray.rs), [Part 2](../part2/README.md), [a](https://a.org/).";
        let (text, _) = chapter(markdown, Links::Project);
        assert!(text.contains("](project:stages/kit/src/ray.rs),"), "{text}");
        let (text, _) = chapter(markdown, Links::Nowhere);
        assert_eq!(
            text,
            "See `ray.rs` and <span data-formula=\"0\"></span>, [Part 2](../part2/README.md), [a](https://a.org/)."
        );
    }

    #[test]
    fn questions_get_their_choices_before_the_answers() {
        let markdown = "# A\n\n## Predict\n\n1. What?\n\n<details>\n";
        let (text, _) = chapter(markdown, Links::Nowhere);
        let (before, after) = text.split_once("<form class=\"predict\"").expect("a form");
        assert!(before.ends_with("1. What?\n\n"), "{text}");
        assert!(after.ends_with("</form>\n\n<details>\n"), "{text}");
    }

    #[test]
    fn pictures_from_outside_are_copied() {
        let (text, sources) = chapter(
            "![A box](../../../../golden/part1.task3/task.png)",
            Links::Nowhere,
        );
        assert_eq!(text, "![A box](../pictures/part1.task3/task.png)");
        let pictures: Vec<_> = sources.pictures().map(|(_, copy)| copy).collect();
        assert_eq!(pictures, [Path::new("pictures/part1.task3/task.png")]);
    }

    #[test]
    fn figures_are_numbered_and_described() {
        let markdown = "![A path](../figures/part4-path.svg)\n\n<figure class=\"explore\" data-explore=\"a\">\n\n\
                        ![B](../figures/part1-film.svg)\n\n<figcaption>To try</figcaption>\n</figure>\n";
        let (text, _) = chapter(markdown, Links::Nowhere);
        let first = "<figure class=\"drawn\"><img src=\"../figures/part4-path.svg\" alt=\"";
        assert!(text.starts_with(first), "{text}");
        let caption = "\"><figcaption><b>Figure 1.3-1.</b> A path.</figcaption></figure>\n";
        assert!(text.contains(caption), "{text}");
        let second = "<img src=\"../figures/part1-film.svg\" alt=\"A film of 4 by 2 pixels";
        assert!(text.contains(second), "{text}");
        assert!(
            text.contains("<figcaption><b>Figure 1.3-2.</b> To try"),
            "{text}"
        );
        let error = Sources::new(Links::Nowhere)
            .chapter("![?](figures/none.svg)", Path::new("a.md"))
            .unwrap_err();
        assert!(error.contains("cannot read"), "{error}");
    }

    #[test]
    fn pictures_that_readers_make_are_on_the_site_alone() {
        let markdown = "A.\n\n<!-- picture: ../so-far/part1.png | \"Gems\" -->\n\nB.\n";
        let (text, _) = chapter(markdown, Links::Project);
        assert_eq!(text, "A.\n\n\nB.\n");
        let (text, _) = chapter(markdown, Links::Nowhere);
        let image = "<img src=\"../so-far/part1.png\" alt=\"&quot;Gems&quot;\">";
        assert_eq!(text, format!("A.\n\n{image}\n\nB.\n"));
    }

    #[test]
    fn a_sheet_of_mistakes_becomes_panels() {
        let (text, _) = chapter(
            "![Right and \"wrong\"](../mistakes/part1-task3.png)",
            Links::Project,
        );
        assert_eq!(
            text.matches("<img src=\"../mistakes/part1-task3.png\"")
                .count(),
            5
        );
        assert!(
            text.contains("aria-label=\"Right and &quot;wrong&quot;\""),
            "{text}"
        );
        assert!(text.contains("object-position:25.000% 0"), "{text}");
        let (text, _) = chapter("![R](../mistakes/part1-task3.png)", Links::Nowhere);
        let large = "<img src=\"../mistakes-large/part1-task3.png\" alt=\"\" width=\"320\"";
        assert_eq!(text.matches(large).count(), 5, "{text}");
        let error = Sources::new(Links::Project)
            .chapter("![?](mistakes/none.png)", Path::new("a.md"))
            .unwrap_err();
        assert!(error.contains("cannot read"), "{error}");
    }
}
