//! Numbers that count what is done with them.

use crate::real::{Precision, Real};
use std::cell::Cell;
use std::cmp::Ordering;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

/// How many operations there were. Differences count as sums, changes of sign as nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Count {
    /// Sums and differences.
    pub add: u64,
    /// Products.
    pub mul: u64,
    /// Quotients.
    pub div: u64,
    /// Square roots.
    pub sqrt: u64,
    /// Fused multiply-adds.
    pub fma: u64,
    /// Comparisons.
    pub compare: u64,
}

impl AddAssign for Count {
    fn add_assign(&mut self, other: Count) {
        self.add += other.add;
        self.mul += other.mul;
        self.div += other.div;
        self.sqrt += other.sqrt;
        self.fma += other.fma;
        self.compare += other.compare;
    }
}

thread_local! {
    static COUNT: Cell<Count> = const { Cell::new(Count {
        add: 0,
        mul: 0,
        div: 0,
        sqrt: 0,
        fma: 0,
        compare: 0,
    }) };
}

/// An `f64` that counts, thread by thread.
#[derive(Clone, Copy, Debug)]
pub struct Counted(f64);

impl Counted {
    /// What `work` does on this thread.
    pub fn count(work: impl FnOnce()) -> Count {
        let before = COUNT.take();
        work();
        COUNT.replace(before)
    }

    fn note(what: impl FnOnce(&mut Count) -> &mut u64) {
        let mut count = COUNT.get();
        *what(&mut count) += 1;
        COUNT.set(count);
    }
}

impl Add for Counted {
    type Output = Counted;
    fn add(self, other: Counted) -> Counted {
        Counted::note(|count| &mut count.add);
        Counted(self.0 + other.0)
    }
}

impl Sub for Counted {
    type Output = Counted;
    fn sub(self, other: Counted) -> Counted {
        Counted::note(|count| &mut count.add);
        Counted(self.0 - other.0)
    }
}

impl Mul for Counted {
    type Output = Counted;
    fn mul(self, other: Counted) -> Counted {
        Counted::note(|count| &mut count.mul);
        Counted(self.0 * other.0)
    }
}

impl Div for Counted {
    type Output = Counted;
    fn div(self, other: Counted) -> Counted {
        Counted::note(|count| &mut count.div);
        Counted(self.0 / other.0)
    }
}

impl Neg for Counted {
    type Output = Counted;
    fn neg(self) -> Counted {
        Counted(-self.0)
    }
}

impl PartialEq for Counted {
    fn eq(&self, other: &Counted) -> bool {
        Counted::note(|count| &mut count.compare);
        self.0 == other.0
    }
}

impl PartialOrd for Counted {
    fn partial_cmp(&self, other: &Counted) -> Option<Ordering> {
        Counted::note(|count| &mut count.compare);
        self.0.partial_cmp(&other.0)
    }
}

impl Real for Counted {
    const PRECISION: Precision = Precision::F64;

    fn of(x: f64) -> Counted {
        Counted(x)
    }

    fn wide(self) -> f64 {
        self.0
    }

    fn sqrt(self) -> Counted {
        Counted::note(|count| &mut count.sqrt);
        Counted(self.0.sqrt())
    }

    fn abs(self) -> Counted {
        Counted(self.0.abs())
    }

    fn mul_add(self, factor: Counted, term: Counted) -> Counted {
        Counted::note(|count| &mut count.fma);
        Counted(self.0.mul_add(factor.0, term.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_operation_is_counted_once() {
        let [a, b] = [2.0, 3.0].map(Counted);
        let count = Counted::count(|| {
            let c = (a + b) * (a - b) / a.mul_add(b, -a).abs().sqrt();
            assert!(c < a && c != b);
        });
        let expected = Count {
            add: 2,
            mul: 1,
            div: 1,
            sqrt: 1,
            fma: 1,
            compare: 2,
        };
        assert_eq!(count, expected);
        assert_eq!(Counted::count(|| {}), Count::default());
    }
}
