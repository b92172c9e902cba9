//! The kernels of the explorable figures, each with its inputs and the bits of its results.
//!
//! `bits.js` computes the same records: first the inputs, then the results, as floats. The kernels
//! are those of [`shapes`] (a ray and a triangle, a sphere, a box), [`trees`], [`cameras`] (camera
//! rays, angles, random numbers) and [`light`].

mod cameras;
mod light;
mod shapes;
mod trees;

use super::inputs::Inputs;
use std::fs;
use std::path::Path;

/// The number of records of a kernel.
const RECORDS: usize = 100_000;

/// The number of records of what is no kernel but decided in fractions, which takes longer.
const EXACT_RECORDS: usize = 20_000;

/// Makes the numbers of a record.
type Record = dyn FnMut(&mut Inputs) -> Vec<f64>;

/// A kernel: its name in `bits.js`, and a function that makes the inputs and results of a record.
struct Records {
    name: &'static str,
    inputs: usize,
    record: Box<Record>,
}

/// Writes the records of each kernel to `NAME.bin`, after the number of inputs and of all numbers
/// of a record.
pub(super) fn write_all(folder: &Path) {
    let all = [shapes::all(), trees::all(), cameras::all(), light::all()];
    for (seed, mut kernel) in (1..).zip(all.into_iter().flatten()) {
        let mut inputs = Inputs::new(seed);
        let is_exact = kernel.name.starts_with("exact_");
        let count = if is_exact { EXACT_RECORDS } else { RECORDS };
        let records: Vec<Vec<f64>> = (0..count).map(|_| (kernel.record)(&mut inputs)).collect();
        let head = [kernel.inputs as f64, records[0].len() as f64];
        let numbers = head.iter().chain(records.iter().flatten());
        let bytes: Vec<u8> = numbers.flat_map(|x| x.to_le_bytes()).collect();
        let file = folder.join(format!("{}.bin", kernel.name));
        fs::write(&file, bytes).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    }
}

fn records(
    name: &'static str,
    inputs: usize,
    record: impl FnMut(&mut Inputs) -> Vec<f64> + 'static,
) -> Records {
    Records {
        name,
        inputs,
        record: Box::new(record),
    }
}
