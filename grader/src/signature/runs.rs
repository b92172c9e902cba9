//! Writes codes as text: with symbols from the alphabet of a file, run lengths, and repeats.
//!
//! `40(4a6.)` means forty times: four calls with the code whose symbol is `a`, then six right
//! calls. A count of 1 is left out. The 26 commonest codes of a file have one letter, the next 1612
//! an upper case letter and a digit or letter, all others `_` and three digits or letters.

use super::codes::Codes;
use std::collections::BTreeMap;

/// The codes of a file except 0, the most frequent first.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Alphabet(Vec<u16>);

const DIGITS: &[u8; 62] = b"0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";

/// The number of symbols of one letter.
const SHORT: usize = 26;

/// The number of symbols of one or two characters.
const MEDIUM: usize = SHORT + 26 * DIGITS.len();

/// The maximum length, in runs, of a sequence whose repeats are written as a count.
const LONGEST_REPEATED: usize = 40;

/// A run of equal codes: how many, and the code.
type Run = (usize, u16);

impl Alphabet {
    /// The alphabet with which `all` has the shortest text.
    pub(super) fn of<'a>(all: impl Iterator<Item = &'a Codes>) -> Alphabet {
        let mut uses: BTreeMap<u16, usize> = BTreeMap::new();
        for codes in all {
            for (_, code) in runs(codes) {
                *uses.entry(code).or_default() += 1;
            }
        }
        uses.remove(&0);
        let mut codes: Vec<(u16, usize)> = uses.into_iter().collect();
        codes.sort_by_key(|&(code, uses)| (std::cmp::Reverse(uses), code));
        Alphabet(codes.into_iter().map(|(code, _)| code).collect())
    }

    /// The alphabet as text: four hexadecimal digits per code.
    pub(super) fn to_text(&self) -> String {
        let codes: Vec<String> = self.0.iter().map(|code| format!("{code:04x}")).collect();
        codes.concat()
    }

    /// Reads what [`Alphabet::to_text`] wrote.
    pub(super) fn parse(text: &str) -> Option<Alphabet> {
        let (codes, rest) = text.as_bytes().as_chunks::<4>();
        let code = |digits: &[u8; 4]| {
            let digits = std::str::from_utf8(digits).ok()?;
            u16::from_str_radix(digits, 16).ok()
        };
        let codes: Option<Vec<u16>> = codes.iter().map(code).collect();
        codes.filter(|_| rest.is_empty()).map(Alphabet)
    }

    /// The symbol of each code.
    pub(super) fn symbols(&self) -> BTreeMap<u16, String> {
        let digit = |i: usize| char::from(DIGITS[i % DIGITS.len()]);
        let letter = |first: u8, i: usize| char::from(first + i as u8);
        let symbol = |i: usize| match i {
            0..SHORT => letter(b'a', i).to_string(),
            SHORT..MEDIUM => {
                let i = i - SHORT;
                format!("{}{}", letter(b'A', i / DIGITS.len()), digit(i))
            }
            _ => {
                let (i, n) = (i - MEDIUM, DIGITS.len());
                format!("_{}{}{}", digit(i / n / n), digit(i / n), digit(i))
            }
        };
        let all = self.0.iter().enumerate();
        let mut symbols: BTreeMap<u16, String> = all.map(|(i, code)| (*code, symbol(i))).collect();
        symbols.insert(0, ".".to_string());
        symbols
    }

    /// Reads codes that [`write`] wrote with this alphabet's symbols.
    pub(super) fn read(&self, text: &str) -> Option<Codes> {
        let mut codes = Vec::new();
        let mut rest = text.as_bytes();
        // The start of the repeated sequence, and how often it occurs.
        let mut repeated: Option<(usize, usize)> = None;
        let mut count = None;
        while let [first, after @ ..] = rest {
            rest = after;
            if let b'0'..=b'9' = first {
                count = Some(10 * count.unwrap_or(0) + usize::from(first - b'0'));
                continue;
            }
            let times = count.take().unwrap_or(1);
            match first {
                b'(' if repeated.is_none() => repeated = Some((codes.len(), times)),
                b')' => {
                    let (start, times) = repeated.take()?;
                    let end = codes.len();
                    (1..times).for_each(|_| codes.extend_from_within(start..end));
                }
                b'.' => codes.resize(codes.len() + times, 0),
                _ => {
                    let (i, after) = symbol_at(*first, rest)?;
                    rest = after;
                    codes.resize(codes.len() + times, *self.0.get(i)?);
                }
            }
        }
        (repeated.is_none() && count.is_none()).then_some(Codes(codes))
    }
}

/// The index in the alphabet of the symbol that begins with `first`, and the text after the symbol.
fn symbol_at(first: u8, rest: &[u8]) -> Option<(usize, &[u8])> {
    let n = DIGITS.len();
    match first {
        b'a'..=b'z' => Some((usize::from(first - b'a'), rest)),
        b'A'..=b'Z' => {
            let (second, rest) = rest.split_first()?;
            Some((
                SHORT + n * usize::from(first - b'A') + value(*second)?,
                rest,
            ))
        }
        b'_' => {
            let ([a, b, c], rest) = rest.split_first_chunk::<3>()?;
            let i = (value(*a)? * n + value(*b)?) * n + value(*c)?;
            Some((MEDIUM + i, rest))
        }
        _ => None,
    }
}

/// The value of one of [`DIGITS`].
fn value(digit: u8) -> Option<usize> {
    Some(usize::from(match digit {
        b'0'..=b'9' => digit - b'0',
        b'A'..=b'Z' => digit - b'A' + 10,
        b'a'..=b'z' => digit - b'a' + 36,
        _ => return None,
    }))
}

/// The text of `codes` in these symbols.
pub(super) fn write(codes: &Codes, symbols: &BTreeMap<u16, String>) -> String {
    let all = runs(codes);
    let mut text = String::new();
    let mut rest = all.as_slice();
    while !rest.is_empty() {
        match repeat_at(rest) {
            Some((length, times)) => {
                text.push_str(&format!("{times}("));
                write_runs(&mut text, &rest[..length], symbols);
                text.push(')');
                rest = &rest[length * times..];
            }
            None => {
                write_runs(&mut text, &rest[..1], symbols);
                rest = &rest[1..];
            }
        }
    }
    text
}

fn write_runs(text: &mut String, runs: &[Run], symbols: &BTreeMap<u16, String>) {
    for (count, code) in runs {
        if *count > 1 {
            text.push_str(&count.to_string());
        }
        text.push_str(&symbols[code]);
    }
}

fn runs(codes: &Codes) -> Vec<Run> {
    let runs = codes.0.chunk_by(|a, b| a == b);
    runs.map(|run| (run.len(), run[0])).collect()
}

/// The length of the repeated sequence that `runs` begins with, and how often it occurs. If there
/// are several, the one that saves the most runs. `None` if no sequence saves more than its
/// brackets take.
fn repeat_at(runs: &[Run]) -> Option<(usize, usize)> {
    let longest = LONGEST_REPEATED.min(runs.len() / 2);
    let repeats = (1..=longest).map(|length| {
        let sequences = runs.chunks_exact(length);
        let times = sequences.take_while(|other| *other == &runs[..length]);
        (length, times.count())
    });
    let saved = |(length, times): &(usize, usize)| length * (times - 1);
    let best = repeats.max_by_key(saved)?;
    (saved(&best) > 2).then_some(best)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn written_codes_are_read_back() {
        let repeated = [7, 7, 9, 0, 0].repeat(5);
        let codes = [
            Codes(vec![0, 0, 0xbeef, 0xbeef, 1, 0]),
            Codes(repeated.clone()),
            Codes([vec![9; 12], repeated, vec![0; 3]].concat()),
            Codes(vec![]),
        ];
        let alphabet = Alphabet::of(codes.iter());
        assert_eq!(alphabet.to_text(), "00090007".to_string() + "0001beef");
        let symbols = alphabet.symbols();
        let texts = codes.each_ref().map(|codes| write(codes, &symbols));
        assert_eq!(texts, ["2.2dc.", "5(2ba2.)", "12a4(2ba2.)2ba5.", ""]);
        let read = texts.map(|text| alphabet.read(&text));
        assert_eq!(read, codes.map(Some));
        assert_eq!(Alphabet::parse(&alphabet.to_text()), Some(alphabet));
    }

    #[test]
    fn rare_codes_have_longer_symbols() {
        let all = Codes((1..=5000).collect());
        let alphabet = Alphabet::of([&all].into_iter());
        let symbols = alphabet.symbols();
        let of = |code: u16| symbols[&code].as_str();
        assert_eq!(
            [of(26), of(27), of(1638), of(1639)],
            ["z", "A0", "Zz", "_000"]
        );
        assert_eq!(alphabet.read(&write(&all, &symbols)), Some(all));
    }

    #[test]
    fn malformed_texts_are_rejected() {
        let alphabet = Alphabet(vec![1, 2]);
        for text in ["c", "3", "2(a", "a)", "A", "_00", "a b", "2((a))"] {
            assert_eq!(alphabet.read(text), None, "{text}");
        }
        assert_eq!(Alphabet::parse("00010"), None);
        assert_eq!(Alphabet::parse("000x"), None);
    }
}
