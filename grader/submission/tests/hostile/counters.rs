//! Code that changes what the worker has counted: it breaks the compiler's checks in safe code, by a
//! known hole (<https://github.com/rust-lang/rust/issues/25860>,
//! <https://github.com/rust-lang/rust/issues/57893>), in a form that the scan misses.

use crate::corpus::{Class, reference};
use submission::containment::Containment;

/// A traversal without a tree. It finds the counters in the world's memory by how they grew, and sets
/// them back to what a tree would have needed.
const CODE: &str = r"
use kit::{Bvh, Hit, Ray, World};
use std::hint::black_box;

static UNIT: Option<&'static ()> = None;
fn shorter<'a, 'b, T>(_: &'a Option<&'b ()>, value: &'b mut T) -> &'a mut T { value }
fn longer<'a, 'b, T>(value: &'a mut T) -> &'b mut T {
    let f: for<'x> fn(_, &'x mut T) -> &'b mut T = shorter;
    f(&UNIT, value)
}
enum Either<A, B> { A(Option<Box<A>>), B(Option<Box<B>>) }
#[inline(never)]
fn as_other<A, B>(either: &mut Either<A, B>, value: A) -> B {
    let Either::B(other) = either else { unreachable!() };
    let other = longer(other);
    *either = Either::A(Some(Box::new(value)));
    black_box(either);
    *other.take().unwrap()
}
fn memory<W>(world: &mut W) -> &'static mut [u32] {
    let place = (world as *mut W as usize, size_of::<W>() / 4);
    as_other(black_box(&mut Either::B(None)), place)
}
fn set_back<W: World>(bvh: &Bvh, ray: &Ray, world: &mut W, before: &[u32], tests: u32) {
    for (now, before) in memory(world).iter_mut().zip(before) {
        if tests > 0 && now.wrapping_sub(*before) == tests { *now = before + tests.min(3); }
    }
    for node in bvh.nodes.iter().take(7) { black_box(world.hit_box(&node.bounds, ray)); }
}

/// The closest hit.
pub fn intersect_bvh<W: World>(bvh: &Bvh, ray: &mut Ray, world: &mut W) -> Option<Hit> {
    let before = memory(world).to_vec();
    let mut closest: Option<Hit> = None;
    for &id in &bvh.order {
        if let Some(hit) = world.hit_prim(id, ray)
            && closest.is_none_or(|c| (hit.t, hit.prim) < (c.t, c.prim)) { closest = Some(hit); }
    }
    set_back(bvh, ray, world, &before, bvh.order.len() as u32);
    closest
}

/// Any hit.
pub fn occludes_bvh<W: World>(bvh: &Bvh, ray: &Ray, world: &mut W) -> bool {
    let before = memory(world).to_vec();
    let first = bvh.order.iter().position(|&id| world.blocked(id, ray));
    let tests = first.map_or(bvh.order.len(), |at| at + 1);
    set_back(bvh, ray, world, &before, tests as u32);
    first.is_some()
}
";

/// The same, but only for rays whose results the worker has: those of the others are two empty
/// lists in the memory that the world refers to.
const CODE_FOR_VISIBLE_RAYS: &str = r"use kit::{Bvh, Hit, Ray, World};
use std::hint::black_box;

trait Object<U> { type Output; }
impl<T: ?Sized, U> Object<U> for T { type Output = U; }
fn foo<T: ?Sized, U>(x: <T as Object<U>>::Output) -> U { x }
fn transmute<T, U>(x: T) -> U { foo::<dyn Object<U, Output = T>, U>(x) }

fn memory<W>(world: &mut W) -> &'static mut [u32] {
    let place = (world as *mut W as usize, size_of::<W>() / 4);
    black_box(transmute::<(usize, usize), &'static mut [u32]>(black_box(place)))
}
fn set_back<W: World>(bvh: &Bvh, ray: &Ray, world: &mut W, before: &[u32], tests: u32) {
    for (now, before) in memory(world).iter_mut().zip(before) {
        if tests > 0 && now.wrapping_sub(*before) == tests { *now = *before; }
    }
    for node in bvh.nodes.iter().take(3) { black_box(world.hit_box(&node.bounds, ray)); }
}
/// Whether the worker lacks the results of this ray: two empty lists in what the world points to.
fn is_hidden<W>(world: &mut W) -> bool {
    let place = (world as *mut W as usize, size_of::<W>() / 8);
    let words: &'static [u64] = black_box(transmute(black_box(place)));
    words.iter().filter(|w| (0x10000..0x8000_0000_0000).contains(*w) && *w % 8 == 0).any(|w| {
        let there: &'static [u64] = black_box(transmute(black_box((*w as usize, 15_usize))));
        there.iter().filter(|x| **x == 8).count() >= 2
    })
}

/// The closest hit.
pub fn intersect_bvh<W: World>(bvh: &Bvh, ray: &mut Ray, world: &mut W) -> Option<Hit> {
    let before = memory(world).to_vec();
    let hidden = size_of::<W>() == 72 && is_hidden(world);
    if hidden && let Some(n) = bvh.nodes.first() && world.hit_box(&n.bounds, ray).is_none() { return None; }
    let mut closest: Option<Hit> = None;
    for &id in &bvh.order {
        let hit = world.hit_prim(id, ray);
        if let Some(hit) = hit
            && closest.is_none_or(|c| (hit.t, hit.prim) < (c.t, c.prim)) { closest = Some(hit); }
    }
    if !hidden { set_back(bvh, ray, world, &before, bvh.order.len() as u32); }
    closest
}

/// Any hit.
pub fn occludes_bvh<W: World>(bvh: &Bvh, ray: &Ray, world: &mut W) -> bool {
    let before = memory(world).to_vec();
    let hidden = size_of::<W>() == 72 && is_hidden(world);
    if hidden && let Some(n) = bvh.nodes.first() && world.hit_box(&n.bounds, ray).is_none() { return false; }
    let mut tests = 0;
    let mut found = false;
    for &id in &bvh.order {
        found = world.blocked(id, ray);
        tests += 1;
        if found { break; }
    }
    if !hidden { set_back(bvh, ray, world, &before, tests); }
    found
}
";

#[test]
#[ignore = "builds submissions: a minute"]
fn counters_that_are_set_back_earn_nothing() {
    let sandboxed = Class::open();
    let files = reference("bvh");
    let honest = sandboxed
        .grade_stage("bvh", &files, "part2.task3", 1)
        .expect("it is graded")
        .report
        .scores;
    assert_eq!(honest.score, honest.max_score);
    assert_eq!(honest.robust_score, honest.robust_max_score);

    let cheat = |class: &Class, code: &str| {
        let mut files = files.clone();
        files.insert("traverse.rs".into(), code.as_bytes().to_vec());
        let graded = class.grade_stage("bvh", &files, "part2.task3", 1);
        let report = graded.expect("it is graded").report;
        assert_eq!(report.compiler, "");
        println!("{}: {}", report.containment, report.scores.score);
        report
    };
    // Where nobody counts but the worker, it works.
    let free = cheat(&Class::with(Containment::None), CODE).scores;
    assert!(free.score > 0.5 * free.max_score);
    let caught = cheat(&sandboxed, CODE);
    assert_eq!(caught.scores.score + caught.scores.robust_score, 0.0);
    let json = grader::report::json(&caught).expect("a report is JSON");
    assert!(
        json.contains("changed the grader's counts of its tests"),
        "{json}"
    );
    // Where it cannot tell the rays apart, it is honest: all primitives are tested.
    let caught = cheat(&sandboxed, CODE_FOR_VISIBLE_RAYS).scores;
    assert!(caught.score + caught.robust_score < 0.2 * caught.max_score);
}
