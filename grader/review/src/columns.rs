//! Stores the records of many calls as columns of numbers, compact enough for one page.

use judge::snapshot::Fields;
use pages::html::base64;
use serde::Serialize;

/// One field of many records.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Column {
    /// The field's name. If a record has several fields of one name, each has its own column.
    pub name: String,
    /// The number of `f64` per value: 1, or 3 for a vector.
    pub width: usize,
    /// One byte per record: 1 if it has the field. Base 64; `None` if all records have it.
    pub has: Option<String>,
    /// Whether all values are equal. Then the value is stored once.
    pub constant: bool,
    /// The values of the records that have the field, as little-endian `f64`. Base 64.
    pub values: String,
}

/// The columns of `records`, in the order in which their fields first occur.
pub fn columns(records: &[&Fields]) -> Vec<Column> {
    let mut builders: Vec<ColumnBuilder> = Vec::new();
    for (row, fields) in records.iter().enumerate() {
        for (i, (name, value)) in fields.iter().enumerate() {
            let nth = fields[..i]
                .iter()
                .filter(|(other, _)| other == name)
                .count();
            let known = builders
                .iter()
                .position(|c| c.name == *name && c.nth == nth);
            let column = known.unwrap_or_else(|| {
                builders.push(ColumnBuilder::new(name, nth));
                builders.len() - 1
            });
            builders[column].rows.push(row);
            builders[column].values.push(value.numbers());
        }
    }
    builders
        .into_iter()
        .map(|c| c.finish(records.len()))
        .collect()
}

/// A column that values are still added to.
struct ColumnBuilder {
    name: String,
    /// The number of fields of the same name before it in a record.
    nth: usize,
    rows: Vec<usize>,
    values: Vec<Vec<f64>>,
}

impl ColumnBuilder {
    fn new(name: &str, nth: usize) -> ColumnBuilder {
        ColumnBuilder {
            name: name.into(),
            nth,
            rows: Vec::new(),
            values: Vec::new(),
        }
    }

    fn finish(self, rows: usize) -> Column {
        let bits = |value: &[f64]| value.iter().copied().map(f64::to_bits).collect::<Vec<_>>();
        let first = self.values.first().cloned().unwrap_or_default();
        let constant = self.values.iter().all(|value| bits(value) == bits(&first));
        let kept = if constant { 1 } else { self.values.len() };
        let numbers = self.values[..kept].iter().flatten();
        let bytes: Vec<u8> = numbers.flat_map(|number| number.to_le_bytes()).collect();
        let has = (self.rows.len() < rows).then(|| {
            let mut has = vec![0; rows];
            self.rows.iter().for_each(|&row| has[row] = 1);
            base64(&has)
        });
        Column {
            name: self.name,
            width: first.len(),
            has,
            constant,
            values: base64(&bytes),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use judge::snapshot::parse;

    #[test]
    fn a_column_stores_existing_values_and_a_constant_once() {
        let text =
            "0: o=(1,2,3) -> t=1 at=(0,1) at=(2,3)\n1: o=(1,2,3) -> miss\n2: o=(1,2,3) -> t=2\n";
        let lines = parse(text).unwrap().lines;
        let answers: Vec<&Fields> = lines.iter().map(|line| &line.answer).collect();
        let questions: Vec<&Fields> = lines.iter().map(|line| &line.question).collect();
        let answers = columns(&answers);
        let names: Vec<&str> = answers.iter().map(|c| c.name.as_str()).collect();
        assert_eq!(names, ["t", "at", "at"]);
        let bytes = |numbers: &[f64]| -> Vec<u8> {
            numbers
                .iter()
                .flat_map(|number| number.to_le_bytes())
                .collect()
        };
        assert_eq!(answers[0].values, base64(&bytes(&[1.0, 2.0])));
        assert_eq!(answers[0].has, Some(base64(&[1, 0, 1])));
        assert_eq!(answers[2].values, base64(&bytes(&[2.0, 3.0])));
        let [origin] = columns(&questions).try_into().expect("one field");
        assert_eq!((origin.constant, origin.has, origin.width), (true, None, 3));
        assert_eq!(origin.values, base64(&bytes(&[1.0, 2.0, 3.0])));
    }
}
