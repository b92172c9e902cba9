//! Part 2, tasks 1 and 3: the tree contains all primitives, and a ray has the same hits as without
//! it.

mod hard_cases;
mod rectangles;
mod same_as_brute_force;
mod triangles;
