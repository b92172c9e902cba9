//! Each operation of a kernel is counted.

use kernels::{CountingF64, OperationCounts, Scalar};
use lanes::Real;

#[test]
fn every_operation_is_counted_once() {
    let [a, b] = [2.0, 3.0].map(CountingF64::from_f64);
    let count = CountingF64::count(|| {
        let c = (a + b) * (a - b) / a.mul_add(b, -a).abs().sqrt();
        assert!(c < a && c != b);
    });
    let expected = OperationCounts {
        add: 2,
        mul: 1,
        div: 1,
        sqrt: 1,
        fma: 1,
        compare: 2,
    };
    assert_eq!(count, expected);
    assert_eq!(CountingF64::count(|| {}), OperationCounts::default());
}
