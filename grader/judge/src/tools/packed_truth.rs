//! Right results that a handout has as a table, because the formula behind them is a solution.
//!
//! The oracle decides on hits in integers, which is no code to copy. Other truth is a formula: the
//! direction of a camera ray, a reflectance, a stopping rule. It stands in `truth.rs` of its task,
//! between the markers of a solution. In the course's checkout it is computed, and passes through
//! [`record`]; in a handout of the task's part the stub calls [`find`], which looks the result up.
//!
//! The table has the results for all questions of seed 0: those of the cases, the simple ones,
//! those of the pictures. Its keys are hashes of a formula's name and of the bits of its input, so
//! what it holds can be looked up, but not listed as inputs with their results. `grader handout`
//! writes it.

use super::compressed::{MAX_UNPACKED, compress, decompress};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::cell::RefCell;
use std::collections::{BTreeMap, HashMap};
use std::io::Write;
use std::sync::OnceLock;

/// The file of the table, below the workspace's root folder. Only handouts have it.
pub const FILE: &str = "grader/judge/src/tools/packed_truth.bin";

/// The table of this handout; `None` in the course's checkout, which computes everything. Every
/// handout lacks the solutions of the last part.
// BEGIN SOLUTION(part5.task2)
const PACKED: Option<&[u8]> = None;
// STUB: const PACKED: Option<&[u8]> = Some(include_bytes!("packed_truth.bin"));
// END SOLUTION(part5.task2)

/// The results of the formulas of each task, by the hash of formula and input.
pub type Tables = BTreeMap<&'static str, BTreeMap<u64, Vec<u8>>>;

/// Says why cases with this seed cannot be judged; `None` if they can. Handouts have the right
/// results for seed 0 alone.
pub fn refusal(seed: u64) -> Option<String> {
    (PACKED.is_some() && seed != 0).then(|| {
        format!(
            "this handout can judge seed 0 only, found seed {seed}: it has the right results for seed 0, and \
             not the formulas that compute others. Use `--seed 0`"
        )
    })
}

thread_local! {
    /// What [`record`] collects in this thread, while [`recorded`] runs.
    static RECORDED: RefCell<Option<Tables>> = const { RefCell::new(None) };
}

/// Runs `ask`, and collects the results of all formulas that it computes.
pub(crate) fn recorded(ask: impl FnOnce()) -> Tables {
    RECORDED.set(Some(Tables::new()));
    ask();
    RECORDED.take().unwrap_or_default()
}

/// Returns the result of a `formula` of `task` for an input, and collects it if a table is being
/// made.
pub fn record<I: Serialize + ?Sized, O: Serialize>(
    task: &'static str,
    formula: &str,
    input: &I,
    result: O,
) -> O {
    RECORDED.with_borrow_mut(|tables| {
        let Some(tables) = tables else { return };
        let bytes = postcard::to_stdvec(&result).expect("results are plain numbers");
        let of_task = tables.entry(task).or_default();
        let before = of_task.insert(key(task, formula, input), bytes.clone());
        let is_same = before.is_none_or(|before| before == bytes);
        assert!(is_same, "{task}: two inputs of {formula} have one hash");
    });
    result
}

/// Looks up the result of a `formula` of `task` for an input. A question that the table does not
/// have cannot be judged at all, so the program ends: students' code is in another process, and the
/// seed was refused before ([`refusal`]).
pub fn find<I: Serialize + ?Sized, O: DeserializeOwned>(task: &str, formula: &str, input: &I) -> O {
    static TABLE: OnceLock<Result<Table, String>> = OnceLock::new();
    let table = TABLE.get_or_init(|| Table::unpack(PACKED.unwrap_or_default()));
    let found = table.as_ref().map_err(Clone::clone).and_then(|table| {
        let result = table.find(key(task, formula, input))?;
        result.ok_or_else(|| format!("it has no {formula} of {task} for this question"))
    });
    found.unwrap_or_else(|why| {
        // Whoever has closed the pipe does not read it.
        let _ = writeln!(
            std::io::stderr(),
            "error: this handout can judge seed 0 only, by {FILE}: {why}. Restore the given files from the \
             handout, and use `--seed 0`"
        );
        std::process::exit(2)
    })
}

/// The hash of a formula and its input: FNV-1a with 64 bits, folded to 48 as its authors advise
/// (draft-eastlake-fnv). With 48 bits the table is shorter, and one of 10^9 inputs that it does not
/// have would be found in it.
fn key<I: Serialize + ?Sized>(task: &str, formula: &str, input: &I) -> u64 {
    const OFFSET_BASIS: u64 = 0xcbf2_9ce4_8422_2325;
    const PRIME: u64 = 0x0000_0100_0000_01b3;
    let input = postcard::to_stdvec(input).expect("inputs are plain numbers");
    let bytes = [task.as_bytes(), &[0], formula.as_bytes(), &[0], &input];
    let add = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(PRIME);
    let hash = bytes.into_iter().flatten().fold(OFFSET_BASIS, add);
    (hash >> 48) ^ (hash & 0xffff_ffff_ffff)
}

/// Packs the tables of some tasks into one.
pub fn pack<'a>(tables: impl IntoIterator<Item = &'a BTreeMap<u64, Vec<u8>>>) -> Vec<u8> {
    let all: BTreeMap<u64, &[u8]> = tables
        .into_iter()
        .flatten()
        .map(|(key, result)| (*key, result.as_slice()))
        .collect();
    let mut stored = Stored::default();
    let mut numbers: HashMap<&[u8], u32> = HashMap::new();
    let mut last = 0;
    for (key, result) in all {
        stored.key_steps.push(key - last);
        last = key;
        let next = stored.lengths.len() as u32;
        let number = *numbers.entry(result).or_insert(next);
        let is_new = number == next;
        if is_new {
            stored.lengths.push(result.len() as u32);
            stored.results.extend(result);
        }
        stored.result_of.push(if is_new { 0 } else { number + 1 });
    }
    let plain = postcard::to_stdvec(&stored).expect("a table is plain numbers");
    compress(&plain)
}

/// A packed table: each different result once.
#[derive(Debug, Default, Serialize, Deserialize)]
struct Stored {
    /// The keys in order, each less the one before.
    key_steps: Vec<u64>,
    /// The result of each key: 0 for the next one that no key before had, so that most of these
    /// numbers are 0, or one more than the number of an earlier result.
    result_of: Vec<u32>,
    /// The length of each result in bytes.
    lengths: Vec<u32>,
    /// The results, one after the other.
    results: Vec<u8>,
}

/// An unpacked table.
#[derive(Debug)]
struct Table {
    /// Where in `results` the result of each key is.
    places: HashMap<u64, std::ops::Range<usize>>,
    results: Vec<u8>,
}

impl Table {
    fn unpack(packed: &[u8]) -> Result<Table, String> {
        let plain = decompress(packed, MAX_UNPACKED).map_err(|e| format!("it is damaged: {e}"))?;
        let stored: Stored =
            postcard::from_bytes(&plain).map_err(|e| format!("it is damaged: {e}"))?;
        let mut end = 0_usize;
        let ranges: Vec<_> = stored
            .lengths
            .iter()
            .map(|length| {
                let start = end;
                end = start.saturating_add(*length as usize);
                start..end
            })
            .collect();
        if end != stored.results.len() || stored.key_steps.len() != stored.result_of.len() {
            return Err("it is damaged: its parts differ in length".into());
        }
        let (mut key, mut seen) = (0_u64, 0);
        let mut places = HashMap::with_capacity(stored.key_steps.len());
        for (step, number) in stored.key_steps.iter().zip(&stored.result_of) {
            key = key.wrapping_add(*step);
            let number = match number {
                0 => {
                    seen += 1;
                    seen - 1
                }
                number => *number as usize - 1,
            };
            let range = ranges.get(number);
            places.insert(
                key,
                range.ok_or("it is damaged: a key has no result")?.clone(),
            );
        }
        Ok(Table {
            places,
            results: stored.results,
        })
    }

    fn find<O: DeserializeOwned>(&self, key: u64) -> Result<Option<O>, String> {
        let Some(range) = self.places.get(&key) else {
            return Ok(None);
        };
        let result = postcard::from_bytes(&self.results[range.clone()]);
        result.map(Some).map_err(|e| format!("it is damaged: {e}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn halves() -> Tables {
        recorded(|| {
            for x in [1.0, 2.0, -0.0, f64::NAN] {
                record("part1.task1", "half", &(x, 1_u8), 0.5 * x);
            }
            record("part1.task2", "half", &(1.0, 1_u8), 7.0);
        })
    }

    fn found(table: &Table, task: &str, formula: &str, x: f64) -> Option<f64> {
        let result = table.find(key(task, formula, &(x, 1_u8)));
        result.expect("the table is complete")
    }

    #[test]
    fn recorded_results_are_found_by_task_formula_and_the_bits_of_the_input() {
        let tables = halves();
        let table = Table::unpack(&pack(tables.values())).unwrap();
        assert_eq!(found(&table, "part1.task1", "half", 1.0), Some(0.5));
        assert_eq!(found(&table, "part1.task2", "half", 1.0), Some(7.0));
        assert!(found(&table, "part1.task1", "half", f64::NAN).is_some_and(f64::is_nan));
        let negative = found(&table, "part1.task1", "half", -0.0);
        assert!(negative.is_some_and(f64::is_sign_negative));
        for (task, formula, x) in [
            ("part1.task1", "half", 0.0),
            ("part1.task1", "third", 1.0),
            ("part1.task3", "half", 1.0),
        ] {
            assert_eq!(
                found(&table, task, formula, x),
                None,
                "{task} {formula} {x}"
            );
        }
    }

    #[test]
    fn a_table_has_the_tasks_that_it_is_packed_from() {
        let tables = halves();
        let table = Table::unpack(&pack([&tables["part1.task2"]])).unwrap();
        assert_eq!(found(&table, "part1.task1", "half", 1.0), None);
        assert_eq!(found(&table, "part1.task2", "half", 1.0), Some(7.0));
        assert_eq!(pack(tables.values()), pack(halves().values()));
    }

    #[test]
    fn nothing_is_collected_when_no_table_is_made() {
        assert_eq!(record("part1.task1", "half", &3.0, 1.5), 1.5);
        assert!(recorded(|| ()).is_empty());
    }

    #[test]
    fn a_damaged_table_is_an_error() {
        let tables = halves();
        let packed = pack(tables.values());
        for damaged in [&packed[..packed.len() - 3], b"text", b""] {
            let error = Table::unpack(damaged).unwrap_err();
            assert!(error.contains("damaged"), "{error}");
        }
    }
}
