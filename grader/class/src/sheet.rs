//! Tables that people keep in a spreadsheet and store as CSV: the roster and the marks by hand.

use submission::Untrusted;

/// A table with its names of columns. Columns are divided by commas, semicolons or tabs, as the
/// first line says; a byte order mark and the line ends of Windows do not matter.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sheet {
    /// The names of the columns.
    pub columns: Vec<String>,
    /// The lines that have a cell with text: the number in the file, and the cells without blanks
    /// around them. A line may have fewer or more cells than there are columns.
    pub lines: Vec<(usize, Vec<String>)>,
    /// Whether a comma divides no columns, so that `2,5` is a number.
    pub has_decimal_commas: bool,
}

impl Sheet {
    /// Reads the contents of a file.
    pub fn parse(bytes: &[u8]) -> Result<Sheet, String> {
        let text = std::str::from_utf8(bytes).map_err(|e| {
            let line = 1 + newlines(&bytes[..e.valid_up_to()]);
            format!("line {line} is not UTF-8: store the table as \"CSV UTF-8\"")
        })?;
        let unmarked = text.trim_start_matches('\u{feff}');
        let text = unmarked.replace("\r\n", "\n").replace('\r', "\n");
        let named = named_separator(&text);
        let (separator, text) = named.unwrap_or_else(|| (separator(&text), &text));
        ensure_closed_marks(text, separator)?;
        let mut reader = csv::ReaderBuilder::new()
            .flexible(true)
            .has_headers(false)
            .delimiter(separator)
            .trim(csv::Trim::All)
            .from_reader(text.as_bytes());
        let mut lines = Vec::new();
        let (mut line, mut counted) = (1, 0);
        for record in reader.records() {
            let record = record.map_err(|e| e.to_string())?;
            let at = record.position().map_or(0, |at| at.byte() as usize);
            // A record that follows empty lines is said to start at the first of them.
            let rest = &text[at..];
            let start = at + rest.len() - rest.trim_start_matches('\n').len();
            line += newlines(&text.as_bytes()[counted..start]);
            counted = start;
            let cells: Vec<String> = record.iter().map(str::to_string).collect();
            if cells.iter().any(|cell| !cell.is_empty()) {
                lines.push((line, cells));
            }
        }
        let columns = match lines.is_empty() {
            true => Vec::new(),
            false => lines.remove(0).1,
        };
        Ok(Sheet {
            columns,
            lines,
            has_decimal_commas: separator != b',',
        })
    }
}

/// Returns an error if a cell that begins with a quotation mark does not end with one: its end is
/// missing, and the next lines, somebody else's, would be part of the cell.
fn ensure_closed_marks(text: &str, separator: u8) -> Result<(), String> {
    let ends_cell = |c: char| c == '\n' || c == char::from(separator);
    let mut rest = text;
    let mut line = 1;
    while !rest.is_empty() {
        let Some(marked) = rest.strip_prefix('"') else {
            let end = rest.find(ends_cell).map_or(rest.len(), |end| end + 1);
            line += newlines(&rest.as_bytes()[..end]);
            rest = &rest[end..];
            continue;
        };
        let mut end = 0;
        let mut is_closed = false;
        while let Some(mark) = marked[end..].find('"').filter(|_| !is_closed) {
            end += mark + 1;
            // Two of them stand for one.
            is_closed = !marked[end..].starts_with('"');
            end += usize::from(!is_closed);
        }
        let after = marked[end..].trim_start_matches(' ');
        if !is_closed || !(after.is_empty() || after.starts_with(ends_cell)) {
            return Err(format!(
                "line {line}: a quotation mark is not closed, before `{}`: close it, or write it twice in a cell between marks",
                Untrusted::from(marked.lines().next().unwrap_or_default()).line()
            ));
        }
        line += newlines(&marked.as_bytes()[..end]);
        rest = after;
    }
    Ok(())
}

/// The separator of a first line `sep=;`, which spreadsheets write and read, and what follows: it
/// begins with the end of that line, so that lines are counted as in the file.
fn named_separator(text: &str) -> Option<(u8, &str)> {
    let (first, _) = text.split_once('\n')?;
    let named = first.trim_matches('"').strip_prefix("sep=")?;
    let separator = [",", ";", "\t"].into_iter().find(|it| *it == named)?;
    Some((separator.as_bytes()[0], &text[first.len()..]))
}

fn newlines(bytes: &[u8]) -> usize {
    bytes.iter().filter(|byte| **byte == b'\n').count()
}

/// What divides the columns: of the three, the one that the first line has most often outside
/// quotes.
fn separator(text: &str) -> u8 {
    let first = text.lines().find(|line| !line.trim().is_empty());
    // Every second part is between quotes.
    let parts = first.unwrap_or_default().split('"').step_by(2);
    let outside: String = parts.collect();
    let count = |separator: &u8| outside.bytes().filter(|byte| byte == separator).count();
    // Of equals the last one.
    let most = [b'\t', b';', b','].into_iter().max_by_key(count);
    most.unwrap_or(b',')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_spreadsheets_store_is_one_table() {
        let plain = "id,words\nanna,\"a, \"\"b\"\"\nc\"\n\nbo,\n";
        let expected = Sheet::parse(plain.as_bytes()).expect("a table");
        assert_eq!(expected.columns, ["id", "words"]);
        let cells = [(2, ["anna", "a, \"b\"\nc"]), (5, ["bo", ""])];
        let lines = cells.map(|(line, cells)| (line, cells.map(str::to_string).to_vec()));
        assert_eq!(expected.lines, lines);
        for (text, commas) in [
            (format!("\u{feff}{}", plain.replace('\n', "\r\n")), false),
            (plain.replace("id,words", "\"id\" , words"), false),
            (plain.replace("\n\n", "\n , \n"), false),
            (
                plain
                    .replace("d,w", "d;w")
                    .replace("anna,", "anna;")
                    .replace("bo,", "bo;"),
                true,
            ),
            (
                plain
                    .replace("d,w", "d\tw")
                    .replace("anna,", "anna\t")
                    .replace("bo,", "bo\t"),
                true,
            ),
        ] {
            let sheet = Sheet::parse(text.as_bytes()).expect("a table");
            assert_eq!(
                (&sheet.columns, &sheet.lines),
                (&expected.columns, &expected.lines),
                "{text}"
            );
            assert_eq!(sheet.has_decimal_commas, commas, "{text}");
        }
        let named = Sheet::parse(b"sep=;\r\nid;words\r\nanna;a, b, c\r\n").expect("a table");
        assert_eq!(named.columns, ["id", "words"]);
        let anna = ["anna", "a, b, c"].map(str::to_string).to_vec();
        assert_eq!(named.lines, [(3, anna)]);
        let quoted = Sheet::parse(b"\"a;b;c\",d\n").expect("a table");
        assert_eq!(quoted.columns, ["a;b;c", "d"]);
    }

    #[test]
    fn a_quotation_mark_that_is_not_closed_hides_no_lines() {
        let error = Sheet::parse(b"id,words\nanna,\"good\nbo,\ncy,\n").expect_err("a mark");
        assert!(
            error.starts_with("line 2: a quotation mark is not closed, before `good`"),
            "{error}"
        );
        // A second mark, before or after it, changes nothing.
        for text in [
            "id,words\nanna,a 5\" screen\nbo,\"good\ncy,\n",
            "id,words\nanna,\nbo,\"good\ncy,\"\"\"fine\"\"\"\n",
            "id,words\nanna,\nbo,\"good\ncy,\"fine\"\ndi,\n",
            "id,words\nanna,\nbo,\"good: \"\"x\"\"\ncy,\n",
        ] {
            let error = Sheet::parse(text.as_bytes()).expect_err(text);
            assert!(
                error.starts_with("line 3: a quotation mark is not closed"),
                "{error}"
            );
        }
        let inch = Sheet::parse(b"id,words\nanna,a 5\" screen\nbo,\n").expect("a table");
        assert_eq!(inch.lines.len(), 2);
    }

    #[test]
    fn other_encodings_are_named_with_the_line() {
        let error = Sheet::parse(b"id,words\nanna,\nbo,sch\xf6n\n").expect_err("Latin-1");
        assert!(error.starts_with("line 3 is not UTF-8"), "{error}");
        let error = Sheet::parse(b"\xff\xfei\0d\0").expect_err("UTF-16");
        assert!(error.starts_with("line 1 is not UTF-8"), "{error}");
    }
}
