//! The English of the chapters: sentences and paragraphs are short, as the project's rules ask.

use book::chapter::{self, Chapter};
use pulldown_cmark::{Event, Parser, Tag, TagEnd};

/// The most words of a sentence.
const SENTENCE: usize = 35;

/// The most words of a paragraph.
const PARAGRAPH: usize = 80;

/// The paragraphs and the items of lists as text. A formula and a piece of code are a word each;
/// tables and blocks of code are left out.
fn paragraphs(markdown: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut text = String::new();
    let (mut tables, mut skipped) = (0, 0);
    for event in Parser::new_ext(markdown, book::maths::options()) {
        match event {
            Event::Start(Tag::Table(_)) => tables += 1,
            Event::End(TagEnd::Table) => tables -= 1,
            Event::Start(Tag::CodeBlock(_) | Tag::Image { .. } | Tag::Heading { .. }) => {
                skipped += 1
            }
            Event::End(TagEnd::CodeBlock | TagEnd::Image | TagEnd::Heading(_)) => skipped -= 1,
            Event::Start(Tag::Paragraph | Tag::Item)
            | Event::End(TagEnd::Paragraph | TagEnd::Item) => {
                found.push(std::mem::take(&mut text));
            }
            _ if tables + skipped > 0 => {}
            Event::Text(words) => text.push_str(&words),
            Event::Code(_) | Event::InlineMath(_) | Event::DisplayMath(_) => text.push('x'),
            Event::SoftBreak | Event::HardBreak => text.push(' '),
            _ => {}
        }
    }
    found.push(text);
    found.retain(|paragraph| !paragraph.trim().is_empty());
    found
}

/// The sentences of a paragraph: they end where a mark is followed by a space and a capital letter.
fn sentences(paragraph: &str) -> Vec<String> {
    let mut found = vec![String::new()];
    let words: Vec<&str> = paragraph.split_whitespace().collect();
    for (i, word) in words.iter().enumerate() {
        let last = found.last_mut().expect("never empty");
        last.push_str(word);
        last.push(' ');
        let ends = word.trim_end_matches(['"', ')']).ends_with(['.', '?', '!']);
        let next = words
            .get(i + 1)
            .and_then(|next| next.trim_start_matches(['"', '(']).chars().next());
        if ends && next.is_some_and(|c| c.is_uppercase() || c == 'x') {
            found.push(String::new());
        }
    }
    found
}

fn words(text: &str) -> usize {
    text.split_whitespace().count()
}

/// Lists of the mistakes that a sheet of pictures shows have the names that the grader gives them.
fn is_list_of_names(sentence: &str) -> bool {
    sentence.starts_with("From the left:")
}

fn too_long(chapter: &Chapter) -> Vec<String> {
    let at = chapter.path.display();
    let mut found = Vec::new();
    for paragraph in paragraphs(&chapter.text) {
        let count = words(&paragraph);
        if count > PARAGRAPH && !is_list_of_names(&paragraph) {
            found.push(format!(
                "{at}: a paragraph of {count} words: {paragraph:.60}..."
            ));
        }
        for sentence in sentences(&paragraph) {
            let count = words(&sentence);
            if count > SENTENCE && !is_list_of_names(&sentence) {
                found.push(format!("{at}: a sentence of {count} words: {sentence}"));
            }
        }
    }
    found
}

#[test]
fn sentences_and_paragraphs_are_short() {
    let chapters = chapter::all().expect("all chapters");
    let found: Vec<String> = chapters.iter().flat_map(too_long).collect();
    assert!(
        found.is_empty(),
        "at most {SENTENCE} words a sentence and {PARAGRAPH} a paragraph:\n{}",
        found.join("\n")
    );
}

#[test]
fn sentences_are_found() {
    let text = "One `a.b` is. Two (in $x_1$) are? \"Three.\" Four 1.5 ends here.\n\n| a | b |\n|---|---|\n| c. D | e |\n";
    let found = paragraphs(text);
    assert_eq!(found.len(), 1);
    assert_eq!(sentences(&found[0]).len(), 4);
    let long = "word ".repeat(SENTENCE + 1);
    let chapter = Chapter::parse("a.md".as_ref(), format!("# T\n\n{long}end. Short.\n"));
    assert_eq!(too_long(&chapter).len(), 1);
}
