//! The scattering of pictures that are not about it: that is what `part3.task1` and `part4.task1`
//! are about, so a handout has it as numbers.

use crate::tools::packed_truth;
use wire::picture::GivenScattering;

/// The scattering of the pictures of worlds with rectangles.
pub(crate) fn given() -> GivenScattering {
    GivenScattering {
        // BEGIN SOLUTION(part3.task1)
        white: packed_truth::record("part3.task1", "white", &(), std::f64::consts::FRAC_1_PI),
        // STUB: white: packed_truth::find("part3.task1", "white", &()),
        // END SOLUTION(part3.task1)
        // BEGIN SOLUTION(part4.task1)
        mirror: packed_truth::record("part4.task1", "mirror", &(), [-1.0, -1.0, 1.0]),
        // STUB: mirror: packed_truth::find("part4.task1", "mirror", &()),
        // END SOLUTION(part4.task1)
    }
}
