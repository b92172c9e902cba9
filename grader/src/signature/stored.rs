//! The form in which the known mistakes of a task are stored: one packed value.
//!
//! Most of it are codes. The codes of one key resemble each other, those of one mistake do not: so
//! they are ordered by their keys. The commonest codes have the smallest numbers, which take one
//! byte. Both make the packed value shorter. The counts of a distribution of directions are stored
//! like codes, with a key of their own.

use super::codes::Codes;
use super::key::SignatureKey;
use super::{Cases, Distributions};
use crate::course::packed::binary;
use crate::diagnosis::mistake::Known;
use judge::findings::{COUNTS, DirectionCounts};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

/// The known mistakes of a task.
#[derive(Debug, Default, Serialize, Deserialize)]
struct Stored {
    mistakes: Vec<Mistake>,
    /// In the order of the known mistakes.
    signatures: Vec<StoredSignature>,
    /// The texts of the keys.
    keys: Vec<String>,
    /// All codes but 0, the most frequent first. In `codes` the first of them has the number 1.
    alphabet: Vec<u16>,
    /// For each key, the codes of the signatures that use it, in the order of their first use.
    codes: Vec<Vec<CodesOfKey>>,
}

/// The texts of a mistake.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord, Clone, Serialize, Deserialize)]
struct Mistake {
    name: String,
    description: String,
    hint: String,
}

/// One way to make a mistake, or two at once.
#[derive(Debug, Serialize, Deserialize)]
struct StoredSignature {
    /// The numbers of its mistakes.
    mistakes: Vec<u32>,
    is_symptom: bool,
    /// The numbers of its keys.
    core: Vec<u32>,
    robust: Vec<u32>,
}

/// The codes of one signature for one key.
#[derive(Debug, Serialize, Deserialize)]
enum CodesOfKey {
    /// The number of each code in the alphabet.
    New(Vec<u16>),
    /// The codes of an earlier signature, by their place in the list of this key.
    Same(u32),
}

/// What a list of numbers describes.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Key {
    /// The codes of a side.
    Codes(SignatureKey),
    /// The counts of the distributions of a side.
    Distributions(SignatureKey),
}

/// The text of a key of distributions ends with this.
const DISTRIBUTIONS: &str = " (distributions)";

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Key::Codes(key) => key.fmt(f),
            Key::Distributions(key) => write!(f, "{key}{DISTRIBUTIONS}"),
        }
    }
}

impl Key {
    fn parse(text: &str) -> Option<Key> {
        match text.strip_suffix(DISTRIBUTIONS) {
            Some(side) => SignatureKey::parse(side).map(Key::Distributions),
            None => SignatureKey::parse(text).map(Key::Codes),
        }
    }
}

/// The lists of one signature: those of core cases with the distributions of all, then those of
/// robust cases.
fn lists_of(known: &Known) -> [BTreeMap<Key, Codes>; 2] {
    let signature = &known.signature;
    let [mut core, robust] = [&signature.core, &signature.robust].map(|cases| {
        let all = cases.iter();
        all.map(|(key, codes)| (Key::Codes(key.clone()), codes.clone()))
            .collect::<BTreeMap<_, _>>()
    });
    core.extend(signature.distributions.iter().map(|(key, all)| {
        let counts = all.iter().flat_map(|counts| *counts.counts());
        (Key::Distributions(key.clone()), Codes(counts.collect()))
    }));
    [core, robust]
}

/// Packs known mistakes.
pub(crate) fn write(known: &[Known]) -> Result<Vec<u8>, String> {
    let lists: Vec<_> = known.iter().map(lists_of).collect();
    let all = || lists.iter().flatten();
    let keys: BTreeSet<&Key> = all().flat_map(BTreeMap::keys).collect();
    let mut writer = Writer {
        number_of_code: BTreeMap::from([(0, 0)]),
        places: vec![BTreeMap::new(); keys.len()],
        stored: Stored {
            keys: keys.iter().map(|key| key.to_string()).collect(),
            codes: keys.iter().map(|_| Vec::new()).collect(),
            alphabet: by_frequency(all().flat_map(BTreeMap::values)),
            ..Stored::default()
        },
        number_of_key: (0..).zip(keys).map(|(n, key)| (key, n)).collect(),
    };
    let numbered = writer.stored.alphabet.iter().zip(1..);
    writer
        .number_of_code
        .extend(numbered.map(|(code, n)| (*code, n)));
    for (known, lists) in known.iter().zip(&lists) {
        writer.known(known, lists);
    }
    binary::to_bytes(&writer.stored)
}

/// The codes but 0 that occur, the most frequent first.
fn by_frequency<'a>(all: impl Iterator<Item = &'a Codes>) -> Vec<u16> {
    let mut uses: BTreeMap<u16, usize> = BTreeMap::new();
    for code in all.flat_map(|codes| &codes.0).filter(|code| **code != 0) {
        *uses.entry(*code).or_default() += 1;
    }
    let mut codes: Vec<(u16, usize)> = uses.into_iter().collect();
    codes.sort_by_key(|&(code, uses)| (std::cmp::Reverse(uses), code));
    codes.into_iter().map(|(code, _)| code).collect()
}

struct Writer<'a> {
    stored: Stored,
    number_of_key: BTreeMap<&'a Key, u32>,
    number_of_code: BTreeMap<u16, u16>,
    /// For each key, the place of all codes that its list already contains.
    places: Vec<BTreeMap<&'a Codes, u32>>,
}

impl<'a> Writer<'a> {
    fn known(&mut self, known: &Known, [core, robust]: &'a [BTreeMap<Key, Codes>; 2]) {
        let texts = known.descriptions.iter().zip(&known.hints);
        let mistakes = known.mistakes.iter().zip(texts);
        let signature = StoredSignature {
            mistakes: mistakes
                .map(|(name, (description, hint))| {
                    self.mistake(Mistake {
                        name: name.clone(),
                        description: description.clone(),
                        hint: hint.clone(),
                    })
                })
                .collect(),
            is_symptom: known.is_symptom,
            core: self.lists(core),
            robust: self.lists(robust),
        };
        self.stored.signatures.push(signature);
    }

    /// The number of a mistake.
    fn mistake(&mut self, mistake: Mistake) -> u32 {
        let all = &mut self.stored.mistakes;
        let place = all.iter().position(|other| *other == mistake);
        place.unwrap_or_else(|| {
            all.push(mistake);
            all.len() - 1
        }) as u32
    }

    /// Writes lists, and returns the numbers of their keys.
    fn lists(&mut self, lists: &'a BTreeMap<Key, Codes>) -> Vec<u32> {
        lists
            .iter()
            .map(|(key, codes)| self.codes(key, codes))
            .collect()
    }

    fn codes(&mut self, key: &Key, codes: &'a Codes) -> u32 {
        let number = self.number_of_key[key];
        let list = &mut self.stored.codes[number as usize];
        let places = &mut self.places[number as usize];
        list.push(match places.get(codes) {
            Some(place) => CodesOfKey::Same(*place),
            None => {
                places.insert(codes, list.len() as u32);
                let numbers = codes.0.iter().map(|code| self.number_of_code[code]);
                CodesOfKey::New(numbers.collect())
            }
        });
        number
    }
}

/// Unpacks what [`write`] packed. The error says what is wrong with the bytes.
pub(crate) fn read(bytes: &[u8]) -> Result<Vec<Known>, String> {
    let stored: Stored = binary::from_bytes(bytes)?;
    Reader::new(&stored)
        .and_then(|mut reader| {
            stored
                .signatures
                .iter()
                .map(|of| reader.known(of))
                .collect()
        })
        .ok_or_else(|| "a number in it refers to nothing".to_string())
}

struct Reader<'a> {
    mistakes: &'a [Mistake],
    keys: Vec<Key>,
    /// For each key, the codes of its list and how many of them are used.
    codes: Vec<(Vec<Codes>, usize)>,
}

impl Reader<'_> {
    fn new(stored: &Stored) -> Option<Reader<'_>> {
        let keys: Option<_> = stored.keys.iter().map(|key| Key::parse(key)).collect();
        let lists = stored.codes.iter();
        let codes: Option<Vec<_>> = lists
            .map(|list| Some((codes_of_key(list, &stored.alphabet)?, 0)))
            .collect();
        Some(Reader {
            mistakes: &stored.mistakes,
            keys: keys?,
            codes: codes?,
        })
    }

    fn known(&mut self, signature: &StoredSignature) -> Option<Known> {
        let mut known = Known {
            is_symptom: signature.is_symptom,
            ..Known::default()
        };
        for number in &signature.mistakes {
            let mistake = self.mistakes.get(*number as usize)?;
            known.mistakes.push(mistake.name.clone());
            known.descriptions.push(mistake.description.clone());
            known.hints.push(mistake.hint.clone());
        }
        let mut distributions = Distributions::new();
        known.signature.core = self.cases(&signature.core, &mut distributions)?;
        known.signature.robust = self.cases(&signature.robust, &mut distributions)?;
        known.signature.distributions = distributions;
        Some(known)
    }

    fn cases(&mut self, numbers: &[u32], distributions: &mut Distributions) -> Option<Cases> {
        let mut cases = Cases::new();
        for number in numbers {
            let (list, used) = self.codes.get_mut(*number as usize)?;
            let codes = list.get(*used)?;
            *used += 1;
            match self.keys.get(*number as usize)?.clone() {
                Key::Codes(key) => {
                    cases.insert(key, codes.clone());
                }
                Key::Distributions(key) => {
                    let each = codes.0.chunks(COUNTS).map(|counts| counts.try_into().ok());
                    let all: Option<Vec<[u16; COUNTS]>> = each.collect();
                    let all = all?.into_iter().map(DirectionCounts::from_counts);
                    distributions.insert(key, all.collect());
                }
            }
        }
        Some(cases)
    }
}

fn codes_of_key(list: &[CodesOfKey], alphabet: &[u16]) -> Option<Vec<Codes>> {
    let code = |number: &u16| match number {
        0 => Some(0),
        number => alphabet.get(usize::from(*number) - 1).copied(),
    };
    let mut all: Vec<Codes> = Vec::new();
    for codes in list {
        all.push(match codes {
            CodesOfKey::New(numbers) => Codes(numbers.iter().map(code).collect::<Option<_>>()?),
            CodesOfKey::Same(place) => all.get(*place as usize)?.clone(),
        });
    }
    Some(all)
}

#[cfg(test)]
mod tests {
    use super::super::Signature;
    use super::super::tests::signature;
    use super::*;

    fn known() -> Vec<Known> {
        let mistake = |names: &[&str], core: &[(&str, &str)], robust: &[(&str, &str)]| Known {
            mistakes: names.iter().map(|name| name.to_string()).collect(),
            descriptions: names.iter().map(|name| format!("does {name}")).collect(),
            hints: names.iter().map(|name| format!("Not {name}.")).collect(),
            signature: Signature {
                core: signature(core).core,
                robust: signature(robust).core,
                ..Signature::default()
            },
            is_symptom: names == ["other"],
        };
        let t = ("one t@refract", "2 3*a");
        let crash = ("two crashed", "1*ffff");
        vec![
            mistake(&["this"], &[t, ("one normal", "2 3*a")], &[crash]),
            mistake(&["this", "that"], &[], &[t, crash]),
            mistake(
                &["other"],
                &[("one leaf_size one too many", "1*c 2 1*c")],
                &[],
            ),
        ]
    }

    #[test]
    fn written_mistakes_are_read_back() {
        let mut with_distributions = known();
        let counts = std::array::from_fn(|i| 300 * i as u16);
        with_distributions[1].signature.distributions.insert(
            SignatureKey::parse("one spread@sample").unwrap(),
            vec![DirectionCounts::from_counts(counts); 2],
        );
        let bytes = write(&with_distributions).unwrap();
        assert_eq!(read(&bytes), Ok(with_distributions));
        let bytes = write(&known()).unwrap();
        assert_eq!(read(&bytes), Ok(known()));
        assert_eq!(read(&write(&[]).unwrap()), Ok(Vec::new()));
    }

    #[test]
    fn the_commonest_code_has_the_first_number_and_equal_codes_are_stored_once() {
        let stored: Stored = binary::from_bytes(&write(&known()).unwrap()).unwrap();
        assert_eq!(stored.alphabet, [0xa, 0xc, 0xffff]);
        assert_eq!(stored.mistakes.len(), 3);
        let of_t = stored.keys.iter().position(|key| key == "one t@refract");
        let [CodesOfKey::New(first), CodesOfKey::Same(0)] = &stored.codes[of_t.unwrap()][..] else {
            panic!("{:?}", stored.codes);
        };
        assert_eq!(first, &[0, 0, 1, 1, 1]);
    }

    #[test]
    fn damaged_bytes_are_an_error() {
        let damaged = |change: &dyn Fn(&mut Stored)| {
            let mut stored = binary::from_bytes(&write(&known()).unwrap()).unwrap();
            change(&mut stored);
            read(&binary::to_bytes(&stored).unwrap()).unwrap_err()
        };
        let dangling: [&dyn Fn(&mut Stored); 5] = [
            &|stored| stored.mistakes.clear(),
            &|stored| stored.alphabet.clear(),
            &|stored| stored.codes.clear(),
            &|stored| stored.keys[0] = "one".into(),
            &|stored| stored.codes[0].clear(),
        ];
        for change in dangling {
            assert_eq!(damaged(change), "a number in it refers to nothing");
        }
        assert!(read(b"text").unwrap_err().contains("it cannot be unpacked"));
    }
}
