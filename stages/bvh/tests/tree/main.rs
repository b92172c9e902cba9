//! Part 2, tasks 1 and 3: the tree keeps everything, and a ray hits through it what it hits without.

mod hard_cases;
mod rectangles;
mod same_as_brute_force;
mod triangles;
