//! A chapter as HTML.
//!
//! - A formula becomes MathML. The punctuation that follows a formula stays on its line.
//! - A link to a file of the project leads to that file, or is only its text.
//! - A picture of the project from outside the book is copied into the book.
//! - A drawn figure gets its number, a caption, and the drawing's description in words, which a
//!   program that reads the page aloud reads in place of the picture. An explorable figure has a
//!   caption of its own, and gets its number.
//! - The questions of a chapter get their choices as a form (`predictions.rs`).
//! - A picture that readers make themselves, in a comment `<!-- picture: FILE | TEXT -->`, is shown
//!   where the book is read alone.
//! - A sheet of mistakes becomes its panels, which are below each other where the page is narrow.

use crate::highlight;
use crate::maths;
use crate::paths::{anchor, folder_of, normal, project, relative, task_number};
use crate::predictions;
use pulldown_cmark::{CodeBlockKind, Event, Parser, Tag, TagEnd, TextMergeStream, html};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// The width of a panel on a sheet of mistakes, the height, and the gap between panels, in pixels.
const PANEL: [u32; 3] = [160, 120, 4];

/// The same where the book is read alone, with the sheets of [`LARGE_SHEETS`].
const LARGE_PANEL: [u32; 3] = [320, 240, 4];

/// The folder of the large sheets below `src`. They are too large for handouts.
pub const LARGE_SHEETS: &str = "mistakes-large";

/// The folder of the pictures that readers make themselves, below `src`. Beside a reader's own
/// program nobody needs them.
pub const OWN_PICTURES: &str = "so-far";

/// What is around the file and the text of such a picture.
const OWN_PICTURE: [&str; 2] = ["<!-- picture: ", "-->"];

/// A flag of up to so many bytes is not broken at its hyphens. Longer ones are, on narrow pages.
const SHORT_FLAG: usize = 16;

/// The start of the caption of an explorable figure.
const CAPTION: &str = "<figcaption>";

/// Where a chapter is shown.
#[derive(Clone, Copy, Debug)]
pub struct Place<'a> {
    /// The path of the chapter below `src`.
    pub at: &'a Path,
    /// The relative path from the site to the project; `None` where the book is read alone, and
    /// links to files of the project are only their text.
    pub to_project: Option<&'a str>,
    /// Whether all chapters are on this page, which is in the top folder of the site.
    pub is_whole_book: bool,
}

/// A chapter as HTML.
#[derive(Debug, Default)]
pub struct Page {
    /// The HTML.
    pub html: String,
    /// Its headings, with the text below each.
    pub sections: Vec<Section>,
    /// The pictures from outside of the book: the path of each copy in the book, and its file.
    pub pictures: BTreeMap<PathBuf, PathBuf>,
}

/// A heading, and what is below it up to the next.
#[derive(Debug, PartialEq, Eq)]
pub struct Section {
    /// 2 for `##`.
    pub level: usize,
    /// The anchor of the heading.
    pub id: String,
    /// The heading without markup.
    pub title: String,
    /// The text without markup.
    pub text: String,
}

/// Renders `markdown`, the chapter at `place`.
pub fn render(markdown: &str, place: Place) -> Result<Page, String> {
    let parser = Parser::new_ext(markdown, maths::options());
    let mut events = TextMergeStream::new(parser).peekable();
    let mut writer = Writer::new(place);
    while let Some(event) = events.next() {
        match event {
            Event::InlineMath(latex) => {
                let signs = match events.peek_mut() {
                    Some(Event::Text(text)) => cut_signs(text),
                    _ => String::new(),
                };
                writer.formula(&latex, &signs)?;
            }
            Event::DisplayMath(latex) => writer.put(maths::mathml(&latex, true)?),
            Event::Start(Tag::Image { dest_url, .. }) => {
                let alt = text_until(&mut events, |end| matches!(end, TagEnd::Image));
                writer.image(&dest_url, &alt)?;
            }
            Event::Start(Tag::CodeBlock(kind)) => {
                let code = text_until(&mut events, |end| matches!(end, TagEnd::CodeBlock));
                writer.code_block(&kind, &code);
            }
            Event::Html(html) => writer.html(&html)?,
            other => writer.other(other),
        }
    }
    Ok(writer.finish())
}

/// Cuts off the punctuation at the start of `text` that belongs to the formula before it.
fn cut_signs(text: &mut pulldown_cmark::CowStr) -> String {
    let rest = text.trim_start_matches([',', '.', ';', ':', '?', '!', ')']);
    let signs = text[..text.len() - rest.len()].to_string();
    *text = rest.to_string().into();
    signs
}

/// The text up to the end of an element.
fn text_until<'a>(
    events: &mut impl Iterator<Item = Event<'a>>,
    is_end: impl Fn(&TagEnd) -> bool,
) -> String {
    events
        .take_while(|event| !matches!(event, Event::End(end) if is_end(end)))
        .filter_map(|event| match event {
            Event::Text(text) | Event::Code(text) => Some(text.to_string()),
            Event::SoftBreak => Some(" ".into()),
            _ => None,
        })
        .collect()
}

/// What is written of a chapter.
struct Writer<'a> {
    place: Place<'a>,
    page: Page,
    out: Vec<Event<'a>>,
    /// The text since the last heading began or ended.
    text: String,
    /// Where the heading that is open begins in `out`.
    heading: usize,
    ids: BTreeSet<String>,
    last_figure: u32,
    is_in_figure: bool,
    is_in_dropped_link: bool,
    /// Whether a figure took the place of the paragraph that contains nothing else.
    is_paragraph_dropped: bool,
    has_form: bool,
}

impl<'a> Writer<'a> {
    fn new(place: Place<'a>) -> Writer<'a> {
        Writer {
            place,
            page: Page::default(),
            out: Vec::new(),
            text: String::new(),
            heading: 0,
            ids: BTreeSet::new(),
            last_figure: 0,
            is_in_figure: false,
            is_in_dropped_link: false,
            is_paragraph_dropped: false,
            has_form: false,
        }
    }

    /// Writes HTML as it is.
    fn put(&mut self, html: String) {
        self.text.push_str(&text_of(&html));
        self.out.push(Event::InlineHtml(html.into()));
    }

    /// A formula, with the punctuation that follows it on the same line.
    fn formula(&mut self, latex: &str, signs: &str) -> Result<(), String> {
        let math = maths::mathml(latex, false)?;
        self.put(match signs {
            "" => math,
            signs => format!("<span class=\"joined\">{math}{signs}</span>"),
        });
        Ok(())
    }

    fn image(&mut self, link: &str, alt: &str) -> Result<(), String> {
        let at = self.place.at;
        if link.contains("figures/") {
            let number = (!self.is_in_figure).then(|| self.next_figure());
            let html = drawn(&folder_of(at).join(link), &self.url(link), alt, number)?;
            if !self.is_in_figure && matches!(self.out.last(), Some(Event::Start(Tag::Paragraph))) {
                self.out.pop();
                self.is_paragraph_dropped = true;
            }
            self.put(html);
        } else if link.contains("/mistakes/") || link.starts_with("mistakes/") {
            let is_large = self.place.to_project.is_none();
            let large = link.replace("mistakes/", &format!("{LARGE_SHEETS}/"));
            let link = if is_large { &large } else { link };
            let html = sheet(&folder_of(at).join(link), &self.url(link), alt, is_large)?;
            self.put(html);
        } else {
            let mut url = self.url(link);
            if let Some(file) = of_project(link, at) {
                let copy = copy_of(&file);
                url = self.url_in_book(&copy);
                self.page.pictures.insert(copy, file);
            }
            // A click shows the picture alone, in its own size.
            let img = format!("<img src=\"{url}\" alt=\"{}\">", escaped(alt));
            self.put(format!("<a href=\"{url}\">{img}</a>"));
        }
        Ok(())
    }

    /// `<b>Figure 1.3-1.</b>` for the first figure of Part 1, Task 3.
    fn next_figure(&mut self) -> String {
        self.last_figure += 1;
        let prefix = task_number(self.place.at).map_or(String::new(), |task| format!("{task}-"));
        format!("<b>Figure {prefix}{}.</b>", self.last_figure)
    }

    fn code_block(&mut self, kind: &CodeBlockKind, code: &str) {
        let language = match kind {
            CodeBlockKind::Fenced(words) => words.split(',').next().unwrap_or_default(),
            CodeBlockKind::Indented => "",
        };
        let code = highlight::html(code, language);
        self.put(format!(
            "<pre><code class=\"language-{language}\">{code}</code></pre>\n"
        ));
    }

    /// A line of a block that is HTML in the Markdown, too.
    fn html(&mut self, html: &str) -> Result<(), String> {
        if let Some(comment) = html.strip_prefix(OWN_PICTURE[0]) {
            return self.own_picture(comment);
        }
        // Each task's chapter has this section with folded answers: `tests/course.rs`.
        let is_in_predict = self
            .page
            .sections
            .last()
            .is_some_and(|s| s.title == "Predict");
        if html.starts_with("<details>") && is_in_predict && !self.has_form {
            self.has_form = true;
            let form = predictions::form(self.place.at)?.unwrap_or_default();
            self.out.push(Event::Html(form.into()));
        }
        self.is_in_figure =
            (self.is_in_figure || html.starts_with("<figure")) && !html.starts_with("</figure");
        let mut html = html.to_string();
        if html.contains(CAPTION) {
            html = html.replace(CAPTION, &format!("{CAPTION}{} ", self.next_figure()));
        }
        self.put(html);
        Ok(())
    }

    /// A picture that readers make themselves, if the book is read alone.
    fn own_picture(&mut self, comment: &str) -> Result<(), String> {
        let inside = comment.trim_end().trim_end_matches(OWN_PICTURE[1]).trim();
        if let (None, Some((file, text))) = (self.place.to_project, inside.split_once(" | ")) {
            self.put("<p>".into());
            self.image(file, text)?;
            self.put("</p>\n".into());
        }
        Ok(())
    }

    fn other(&mut self, event: Event<'a>) {
        match event {
            Event::Code(code) if code.starts_with('-') && code.len() <= SHORT_FLAG => {
                self.put(format!("<code class=\"joined\">{}</code>", escaped(&code)));
            }
            Event::Text(ref text) | Event::Code(ref text) => {
                self.text.push_str(text);
                self.out.push(event);
            }
            Event::Start(Tag::Link { dest_url, .. }) => {
                self.is_in_dropped_link = self.place.to_project.is_none()
                    && of_project(&dest_url, self.place.at).is_some();
                if !self.is_in_dropped_link {
                    let url = escaped(&self.url(&dest_url));
                    self.out
                        .push(Event::InlineHtml(format!("<a href=\"{url}\">").into()));
                }
            }
            Event::End(TagEnd::Link) => {
                if !std::mem::take(&mut self.is_in_dropped_link) {
                    self.out.push(Event::InlineHtml("</a>".into()));
                }
            }
            // Notes of two chapters have different anchors on the page with all chapters.
            Event::FootnoteReference(name) => {
                let name = self.place.id(&name).into();
                self.out.push(Event::FootnoteReference(name));
            }
            Event::Start(Tag::FootnoteDefinition(name)) => {
                let name = self.place.id(&name).into();
                self.out.push(Event::Start(Tag::FootnoteDefinition(name)));
            }
            Event::Start(Tag::Heading { .. }) => {
                self.end_section();
                self.heading = self.out.len();
            }
            Event::End(TagEnd::Heading(level)) => self.end_heading(level as usize),
            Event::Start(Tag::Table(_)) => {
                self.out
                    .push(Event::Html("<div class=\"table-wrapper\">".into()));
                self.out.push(event);
            }
            Event::End(TagEnd::Table) => {
                self.out.extend([event, Event::Html("</div>\n".into())]);
            }
            Event::End(TagEnd::Paragraph) if std::mem::take(&mut self.is_paragraph_dropped) => {}
            other => {
                let is_blank = matches!(
                    other,
                    Event::SoftBreak
                        | Event::HardBreak
                        | Event::End(TagEnd::Paragraph | TagEnd::Item | TagEnd::TableCell)
                );
                self.text.push_str(if is_blank { " " } else { "" });
                self.out.push(other);
            }
        }
    }

    /// The text before the next heading belongs to the last one.
    fn end_section(&mut self) {
        let text = std::mem::take(&mut self.text);
        if let Some(section) = self.page.sections.last_mut() {
            section.text = text;
        }
    }

    fn end_heading(&mut self, level: usize) {
        let title = std::mem::take(&mut self.text);
        let first = anchor(&title);
        let others = (1..).map(|number| format!("{first}-{number}"));
        let mut ids = std::iter::once(first.clone()).chain(others);
        let id = ids.find(|id| !self.ids.contains(id)).unwrap_or_default();
        self.ids.insert(id.clone());
        let id = self.place.id(&id);
        let start = format!("<h{level} id=\"{id}\"><a class=\"header\" href=\"#{id}\">");
        self.out.insert(self.heading, Event::Html(start.into()));
        self.out
            .push(Event::Html(format!("</a></h{level}>\n").into()));
        let text = String::new();
        self.page.sections.push(Section {
            level,
            id,
            title,
            text,
        });
    }

    /// The address of what `link` of the chapter leads to.
    fn url(&self, link: &str) -> String {
        let (path, fragment) = match link.find('#') {
            Some(at) => link.split_at(at),
            None => (link, ""),
        };
        if link.contains("://") {
            return link.to_string();
        }
        if let (Some(file), Some(to_project)) =
            (of_project(link, self.place.at), self.place.to_project)
        {
            let file = relative(&project(), &file);
            return format!("{}{to_project}/{file}{fragment}", self.place.to_book());
        }
        if path.is_empty() {
            return format!("#{}", self.place.id(fragment.trim_start_matches('#')));
        }
        let file = normal(&folder_of(self.place.at).join(path));
        let file = file
            .strip_prefix(crate::folder().join("src"))
            .unwrap_or(&file);
        if self.place.is_whole_book && file.extension().is_some_and(|ending| ending == "md") {
            let chapter = Place {
                at: file,
                ..self.place
            };
            return format!("#{}", chapter.id(fragment.trim_start_matches('#')));
        }
        let url = self.url_in_book(file);
        format!(
            "{}{fragment}",
            url.strip_suffix(".md")
                .map_or(url.clone(), |url| format!("{url}.html"))
        )
    }

    /// The address of a file of the site.
    fn url_in_book(&self, file: &Path) -> String {
        let top = Path::new("/");
        let folder = self.place.at.parent().filter(|_| !self.place.is_whole_book);
        relative(&top.join(folder.unwrap_or(Path::new(""))), &top.join(file))
    }

    fn finish(mut self) -> Page {
        self.end_section();
        html::push_html(&mut self.page.html, self.out.into_iter());
        self.page
    }
}

impl Place<'_> {
    /// The path from the page to the folder of the site, with a slash at its end, or empty.
    pub fn to_book(&self) -> String {
        let depth = self.at.components().count().saturating_sub(1);
        "../".repeat(if self.is_whole_book { 0 } else { depth })
    }

    /// The anchor on this page of the heading with the anchor `id`, or of the chapter if `id` is
    /// empty.
    pub fn id(&self, id: &str) -> String {
        if !self.is_whole_book {
            return id.to_string();
        }
        let chapter = self.at.with_extension("").display().to_string();
        let chapter = chapter.replace(['/', '\\'], "-");
        format!("{chapter}{}{id}", if id.is_empty() { "" } else { "-" })
    }
}

/// The text of HTML without its tags, in which characters are not escaped.
fn text_of(html: &str) -> String {
    let mut parts = html.split('<');
    let mut text = parts.next().unwrap_or_default().to_string();
    for part in parts {
        text.push_str(part.split_once('>').map_or("", |(_, text)| text));
    }
    text.replace("&nbsp;", " ")
        .replace("&lt;", "<")
        .replace("&gt;", ">")
        .replace("&quot;", "\"")
        .replace("&amp;", "&")
}

/// A drawn figure: `caption` stands in the chapter, the description in the drawing. Without a
/// number it is only the picture.
fn drawn(file: &Path, url: &str, caption: &str, number: Option<String>) -> Result<String, String> {
    let svg = std::fs::read_to_string(file)
        .map_err(|error| format!("cannot read {}: {error}", file.display()))?;
    let title = svg
        .split("<title>")
        .nth(1)
        .and_then(|rest| rest.split("</title>").next());
    let title = title.ok_or_else(|| format!("{}: expected a <title>", file.display()))?;
    let description = title.replace('"', "&quot;");
    let img = format!("<img src=\"{url}\" alt=\"{description}\">");
    Ok(match number {
        Some(number) => format!(
            "<figure class=\"drawn\">{img}{CAPTION}{number} {}.</figcaption></figure>\n",
            escaped(caption)
        ),
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
fn sheet(file: &Path, url: &str, alt: &str, is_large: bool) -> Result<String, String> {
    let (class, size) = match is_large {
        true => ("sheet large", LARGE_PANEL),
        false => ("sheet", PANEL),
    };
    let [width, height] = size_of_png(file)?;
    let [panel, panel_height, gap] = size;
    let panels = (width + gap) / (panel + gap);
    if height != panel_height || panels < 2 || panels * (panel + gap) != width + gap {
        return Err(format!(
            "{}: expected panels of {panel} by {panel_height} pixels side by side with gaps of {gap}, found {width} by {height} pixels",
            file.display()
        ));
    }
    let alt = escaped(alt);
    let mut html = format!("<span class=\"{class}\" role=\"img\" aria-label=\"{alt}\">");
    for number in 0..panels {
        let position = f64::from(100 * number) / f64::from(panels - 1);
        let _ = write!(
            html,
            "<img src=\"{url}\" alt=\"\" width=\"{panel}\" height=\"{panel_height}\" style=\"object-position:{position:.3}% 0\">"
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

    /// The page of `markdown` as the chapter `part1/task3.md`, beside the project or read alone.
    fn page(markdown: &str, to_project: Option<&str>) -> Page {
        render(markdown, place(to_project)).expect("a chapter")
    }

    fn place(to_project: Option<&str>) -> Place<'_> {
        let at = Path::new("part1/task3.md");
        Place {
            at,
            to_project,
            is_whole_book: false,
        }
    }

    const BESIDE: Option<&str> = Some("../..");

    #[test]
    fn formulas_become_mathml_with_the_signs_after_them_and_code_stays() {
        let html = page("Let $x_1 = 2$, or $|y|$ wide; `$z$` is code.", None).html;
        let start = "<p>Let <span class=\"joined\"><math display=\"inline\"><msub>";
        assert!(html.starts_with(start), "{html}");
        assert!(html.contains("</math>,</span> or <math"), "{html}");
        assert!(
            html.contains("</math> wide; <code>$z$</code> is code."),
            "{html}"
        );
        let error = render(r"$$\nonsense x$$", place(None)).unwrap_err();
        assert!(error.contains(r"\nonsense"), "{error}");
    }

    #[test]
    fn code_and_text_are_escaped() {
        let html = page(
            "a \\< b `<i>`\n\n```rust,ignore\nlet a = b < c && \"<d>\";\n```\n",
            None,
        )
        .html;
        assert!(
            html.starts_with("<p>a &lt; b <code>&lt;i&gt;</code></p>"),
            "{html}"
        );
        let code = "<pre><code class=\"language-rust\"><span class=\"keyword\">let</span> a = b &lt; c &amp;&amp; ";
        assert!(html.contains(code), "{html}");
        assert!(!html.contains("<d>") && !html.contains("<i>"), "{html}");
    }

    #[test]
    fn short_flags_stay_whole() {
        let html = page("`-l` and `x -l`, `--rate-scale assignment`", None).html;
        let expected = "<p><code class=\"joined\">-l</code> and <code>x -l</code>, <code>--rate-scale assignment</code></p>\n";
        assert_eq!(html, expected);
    }

    #[test]
    fn headings_have_anchors_and_each_another_one() {
        let text = "# A\n\nOne.\n\n## What is *not* `b`\n\nTwo $x$,\nthree.\n\n## A\n\n- four\n- five\n\n## A\n";
        let page = page(text, None);
        let ids: Vec<_> = page.sections.iter().map(|s| s.id.as_str()).collect();
        assert_eq!(ids, ["a", "what-is-not-b", "a-1", "a-2"]);
        let heading = "<h2 id=\"what-is-not-b\"><a class=\"header\" href=\"#what-is-not-b\">What is <em>not</em> <code>b</code></a></h2>";
        assert!(page.html.contains(heading), "{}", page.html);
        let second = &page.sections[1];
        assert_eq!((second.level, second.title.as_str()), (2, "What is not b"));
        assert_eq!(second.text.trim(), "Two x, three.");
        assert_eq!(page.sections[2].text.trim(), "four five");
    }

    #[test]
    fn tables_scroll_and_footnotes_are_numbered() {
        let html = page("| a |\n|--:|\n| b |\n\nText.[^1]\n\n[^1]: More.\n", None).html;
        assert!(
            html.starts_with("<div class=\"table-wrapper\"><table>"),
            "{html}"
        );
        assert!(html.contains("</table>\n</div>"), "{html}");
        assert!(
            html.contains("class=\"footnote-reference\"><a href=\"#1\">1</a>"),
            "{html}"
        );
        assert!(
            html.contains("<div class=\"footnote-definition\" id=\"1\">"),
            "{html}"
        );
    }

    #[test]
    fn links_to_the_project_lead_to_its_files_or_nowhere() {
        let markdown = "See [`ray.rs`](../../../kit/src/ray.rs#x), [2](../part2/README.md#a), [b](#b), [c](https://a.org/).";
        let html = page(markdown, BESIDE).html;
        let chapters = "<a href=\"../part2/README.html#a\">2</a>, <a href=\"#b\">b</a>, <a href=\"https://a.org/\">c</a>.</p>\n";
        let file = "<a href=\"../../../stages/kit/src/ray.rs#x\"><code>ray.rs</code></a>";
        assert_eq!(html, format!("<p>See {file}, {chapters}"));
        let html = page(markdown, None).html;
        assert_eq!(html, format!("<p>See <code>ray.rs</code>, {chapters}"));
    }

    #[test]
    fn on_the_page_with_all_chapters_links_lead_to_its_sections() {
        let markdown = "## B\n\n[2](../part2/README.md#a), [b](#b), ![c](../figures/part4-path.svg) [d]() e[^1]\n\n[^1]: f";
        let place = Place {
            is_whole_book: true,
            ..place(None)
        };
        let html = render(markdown, place).expect("a chapter").html;
        assert!(html.contains("<h2 id=\"part1-task3-b\">"), "{html}");
        assert!(html.contains("href=\"#part2-README-a\""), "{html}");
        assert!(html.contains("href=\"#part1-task3-b\">b"), "{html}");
        assert!(html.contains("src=\"figures/part4-path.svg\""), "{html}");
        assert!(html.contains("id=\"part1-task3-1\""), "{html}");
    }

    #[test]
    fn questions_get_their_choices_before_the_answers() {
        let markdown = "# A\n\n## Predict\n\n1. What?\n\n<details>\n\n<details>\n";
        let html = page(markdown, None).html;
        let (before, after) = html.split_once("<form class=\"predict\"").expect("a form");
        assert!(before.ends_with("What?</li>\n</ol>\n"), "{html}");
        assert!(after.contains("</form>\n<details>\n<details>\n"), "{html}");
        assert!(!after.contains("<form"), "{html}");
    }

    #[test]
    fn pictures_from_outside_are_copied() {
        let page = page("![A box](../../../../golden/part1.task3/task.png)", None);
        let url = "../pictures/part1.task3/task.png";
        let expected = format!("<p><a href=\"{url}\"><img src=\"{url}\" alt=\"A box\"></a></p>\n");
        assert_eq!(page.html, expected);
        let copies: Vec<_> = page.pictures.keys().collect();
        assert_eq!(copies, [Path::new("pictures/part1.task3/task.png")]);
    }

    #[test]
    fn figures_are_numbered_and_described() {
        let markdown = "![A path](../figures/part4-path.svg)\n\n<figure class=\"explore\" data-explore=\"a\">\n\n\
                        ![B](../figures/part1-film.svg)\n\n<figcaption>To try</figcaption>\n</figure>\n\n\
                        ![C](../figures/part4-path.svg)\n";
        let html = page(markdown, None).html;
        let first = "<figure class=\"drawn\"><img src=\"../figures/part4-path.svg\" alt=\"";
        assert!(html.starts_with(first), "{html}");
        // A paragraph cannot contain a figure.
        let caption = "\"><figcaption><b>Figure 1.3-1.</b> A path.</figcaption></figure>\n<figure ";
        assert!(html.contains(caption), "{html}");
        let second = "<p><img src=\"../figures/part1-film.svg\" alt=\"A film of 4 by 2 pixels";
        assert!(html.contains(second), "{html}");
        assert!(
            html.contains("<figcaption><b>Figure 1.3-2.</b> To try"),
            "{html}"
        );
        assert!(
            html.contains("<figcaption><b>Figure 1.3-3.</b> C."),
            "{html}"
        );
        let error = render("![?](figures/none.svg)", place(None)).unwrap_err();
        assert!(error.contains("cannot read"), "{error}");
    }

    #[test]
    fn pictures_that_readers_make_are_on_the_site_alone() {
        let markdown = "A.\n\n<!-- picture: ../so-far/part1.png | \"Gems\" -->\n\nB.\n";
        assert_eq!(page(markdown, BESIDE).html, "<p>A.</p>\n<p>B.</p>\n");
        let html = page(markdown, None).html;
        let image = "<img src=\"../so-far/part1.png\" alt=\"&quot;Gems&quot;\">";
        assert!(html.contains(image), "{html}");
    }

    #[test]
    fn a_sheet_of_mistakes_becomes_panels() {
        let html = page(
            "![Right and \"wrong\"](../mistakes/part1-task3.png)",
            BESIDE,
        )
        .html;
        let panel = "<img src=\"../mistakes/part1-task3.png\"";
        assert_eq!(html.matches(panel).count(), 5, "{html}");
        assert!(
            html.contains("aria-label=\"Right and &quot;wrong&quot;\""),
            "{html}"
        );
        assert!(html.contains("object-position:25.000% 0"), "{html}");
        let html = page("![R](../mistakes/part1-task3.png)", None).html;
        let large = "<img src=\"../mistakes-large/part1-task3.png\" alt=\"\" width=\"320\"";
        assert_eq!(html.matches(large).count(), 5, "{html}");
        let error = render("![?](mistakes/none.png)", place(BESIDE)).unwrap_err();
        assert!(error.contains("cannot read"), "{error}");
    }
}
