//! A number type that counts its operations.

use lanes::{Precision, Real, Scalar};
use std::cell::Cell;
use std::cmp::Ordering;
use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub};

/// Numbers of operations. Subtractions count as additions; what only sets a sign is not counted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct OperationCounts {
    /// Additions and subtractions.
    pub add: u64,
    /// Multiplications.
    pub mul: u64,
    /// Divisions.
    pub div: u64,
    /// Square roots.
    pub sqrt: u64,
    /// Fused multiply-adds.
    pub fma: u64,
    /// Comparisons.
    pub compare: u64,
}

impl AddAssign for OperationCounts {
    fn add_assign(&mut self, other: OperationCounts) {
        self.add += other.add;
        self.mul += other.mul;
        self.div += other.div;
        self.sqrt += other.sqrt;
        self.fma += other.fma;
        self.compare += other.compare;
    }
}

thread_local! {
    static COUNT: Cell<OperationCounts> = const { Cell::new(OperationCounts {
        add: 0,
        mul: 0,
        div: 0,
        sqrt: 0,
        fma: 0,
        compare: 0,
    }) };
}

/// An `f64` that counts its operations, per thread.
#[derive(Clone, Copy, Debug)]
pub struct CountingF64(f64);

impl CountingF64 {
    /// Returns the operations that `work` executes on this thread.
    pub fn count(work: impl FnOnce()) -> OperationCounts {
        let before = COUNT.take();
        work();
        COUNT.replace(before)
    }

    fn record(what: impl FnOnce(&mut OperationCounts) -> &mut u64) {
        let mut count = COUNT.get();
        *what(&mut count) += 1;
        COUNT.set(count);
    }
}

impl Add for CountingF64 {
    type Output = CountingF64;
    fn add(self, other: CountingF64) -> CountingF64 {
        CountingF64::record(|count| &mut count.add);
        CountingF64(self.0 + other.0)
    }
}

impl Sub for CountingF64 {
    type Output = CountingF64;
    fn sub(self, other: CountingF64) -> CountingF64 {
        CountingF64::record(|count| &mut count.add);
        CountingF64(self.0 - other.0)
    }
}

impl Mul for CountingF64 {
    type Output = CountingF64;
    fn mul(self, other: CountingF64) -> CountingF64 {
        CountingF64::record(|count| &mut count.mul);
        CountingF64(self.0 * other.0)
    }
}

impl Div for CountingF64 {
    type Output = CountingF64;
    fn div(self, other: CountingF64) -> CountingF64 {
        CountingF64::record(|count| &mut count.div);
        CountingF64(self.0 / other.0)
    }
}

impl Neg for CountingF64 {
    type Output = CountingF64;
    fn neg(self) -> CountingF64 {
        CountingF64(-self.0)
    }
}

impl PartialEq for CountingF64 {
    fn eq(&self, other: &CountingF64) -> bool {
        CountingF64::record(|count| &mut count.compare);
        self.0 == other.0
    }
}

impl PartialOrd for CountingF64 {
    fn partial_cmp(&self, other: &CountingF64) -> Option<Ordering> {
        CountingF64::record(|count| &mut count.compare);
        self.0.partial_cmp(&other.0)
    }
}

impl Real for CountingF64 {
    type Mask = bool;

    fn constant(self, x: f64) -> CountingF64 {
        CountingF64(x)
    }

    fn sqrt(self) -> CountingF64 {
        CountingF64::record(|count| &mut count.sqrt);
        CountingF64(self.0.sqrt())
    }

    fn abs(self) -> CountingF64 {
        CountingF64(self.0.abs())
    }

    fn copysign(self, sign: CountingF64) -> CountingF64 {
        CountingF64(self.0.copysign(sign.0))
    }

    fn max(self, other: CountingF64) -> CountingF64 {
        CountingF64::record(|count| &mut count.compare);
        CountingF64(self.0.max(other.0))
    }

    fn min(self, other: CountingF64) -> CountingF64 {
        CountingF64::record(|count| &mut count.compare);
        CountingF64(self.0.min(other.0))
    }

    fn larger(self, other: CountingF64) -> CountingF64 {
        if self > other { self } else { other }
    }

    fn smaller(self, other: CountingF64) -> CountingF64 {
        if self < other { self } else { other }
    }

    fn less(self, other: CountingF64) -> bool {
        self < other
    }

    fn at_most(self, other: CountingF64) -> bool {
        self <= other
    }

    fn equals(self, other: CountingF64) -> bool {
        self == other
    }
}

impl Scalar for CountingF64 {
    const PRECISION: Precision = Precision::F64;

    fn from_f64(x: f64) -> CountingF64 {
        CountingF64(x)
    }

    fn to_f64(self) -> f64 {
        self.0
    }

    fn mul_add(self, factor: CountingF64, term: CountingF64) -> CountingF64 {
        CountingF64::record(|count| &mut count.fma);
        CountingF64(self.0.mul_add(factor.0, term.0))
    }
}
