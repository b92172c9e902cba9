//! Lines that several files of a pack have are stored once.

use std::collections::HashMap;

/// What a line begins with that names an earlier one by its number. A line of a file that begins
/// with this byte is written with a second one.
const MARK: u8 = 1;

/// The shortest line that is worth a number.
const SHORTEST: usize = 16;

/// The largest size of a restored file: a damaged pack could name one line again and again.
const LARGEST: usize = 16 << 20;

/// The lines that were written.
#[derive(Default)]
pub(super) struct Known(HashMap<Vec<u8>, usize>);

impl Known {
    /// `contents` with numbers in the place of known lines. The other lines are known from now on.
    pub(super) fn shortened(&mut self, contents: &[u8]) -> Vec<u8> {
        let mut short = Vec::with_capacity(contents.len());
        for (i, line) in contents.split(|byte| *byte == b'\n').enumerate() {
            if i > 0 {
                short.push(b'\n');
            }
            if let Some(number) = self.0.get(line) {
                short.push(MARK);
                short.extend(number.to_string().bytes());
                continue;
            }
            if line.first() == Some(&MARK) {
                short.push(MARK);
            }
            short.extend(line);
            if line.len() >= SHORTEST {
                let number = self.0.len();
                self.0.insert(line.to_vec(), number);
            }
        }
        short
    }
}

/// The lines that were read, by their numbers.
#[derive(Default)]
pub(super) struct Read(Vec<Vec<u8>>);

impl Read {
    /// What [`Known::shortened`] was called with; `None` if `short` is not its result.
    pub(super) fn restored(&mut self, short: &[u8]) -> Option<Vec<u8>> {
        let mut contents = Vec::with_capacity(short.len());
        for (i, line) in short.split(|byte| *byte == b'\n').enumerate() {
            if i > 0 {
                contents.push(b'\n');
            }
            match line.strip_prefix(&[MARK]) {
                Some(digits) if digits.first().is_some_and(u8::is_ascii_digit) => {
                    let number: usize = str::from_utf8(digits).ok()?.parse().ok()?;
                    contents.extend(self.0.get(number)?);
                }
                escaped => {
                    let line = escaped.unwrap_or(line);
                    contents.extend(line);
                    if line.len() >= SHORTEST {
                        self.0.push(line.to_vec());
                    }
                }
            }
            if contents.len() > LARGEST {
                return None;
            }
        }
        Some(contents)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_restored_and_common_lines_are_short() {
        let files: [&[u8]; 5] = [
            b"a line of both of the files\nshort\n",
            b"short\na line of both of the files\n\x01\x01begins with the mark, and again\nlast, without an end",
            b"",
            b"\x017\n\x01\n\x01\x01begins with the mark, and again\nlast, without an end\n\n",
            b"\xff\x00\x01binary, and longer than that\n\xff\x00\x01binary, and longer than that",
        ];
        let (mut known, mut read) = (Known::default(), Read::default());
        for file in files {
            let short = known.shortened(file);
            assert_eq!(read.restored(&short).as_deref(), Some(file));
        }
        let again = known.shortened(files[0]);
        assert_eq!(again, b"\x010\nshort\n");
    }

    #[test]
    fn a_number_of_no_line_is_damage() {
        for damaged in [
            b"\x013".as_slice(),
            b"\x011x",
            b"\x0199999999999999999999999",
        ] {
            assert_eq!(Read::default().restored(damaged), None);
        }
    }
}
