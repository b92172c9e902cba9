//! Tests the data and the text of the page, without a browser.

use crate::{BOXES, FACES, FALSE_HIT, FALSE_MISS, LATER_EXIT, MESH};
use grader::diagnosis::{Certainty, Diagnosis};
use judge::findings::Aspect;
use look::case::{Case, ROWS, State};
use look::picture::{Pixels, RECORDS};
use pictures::Image;
use pictures::cause::Cause;
use review::{Author, Review, page};
use wire::answer::Hit;

fn pixels(review: &Review) -> &Pixels {
    let picture = review.cases[0].picture.as_ref();
    let pixels = picture.and_then(|picture| picture.pixels.as_ref());
    pixels.expect("the sizes are equal")
}

#[test]
fn each_pixel_has_the_cause_of_its_difference() {
    let review = BOXES.review(&BOXES.changed_boxes());
    let pixels = pixels(&review);
    let counts = [(Cause::FalseHit, 1), (Cause::FalseMiss, 1), (Cause::T, 1)];
    assert_eq!(pixels.counts(), counts);
    for (pixel, cause) in [
        (FALSE_HIT, Cause::FalseHit),
        (FALSE_MISS, Cause::FalseMiss),
        (LATER_EXIT, Cause::T),
    ] {
        assert_eq!(pixels.causes[BOXES.call(pixel)], cause);
        let [_, h] = BOXES.spec.picture.expect("the case has a picture");
        let colour = pixels.difference.get(pixel[0], h - 1 - pixel[1]);
        assert_eq!(colour, cause.colour(), "{cause:?}");
    }
    let State::Differs {
        changes,
        calls,
        pixels,
        ..
    } = &review.cases[0].state
    else {
        panic!("{:?}", review.cases[0].state)
    };
    let text = "of the 181 rows for 3072 calls: 1 call now hit";
    assert_eq!(changes.to_string(), text);
    assert_eq!(*calls, 3);
    assert_eq!(*pixels, 2, "the exit distance does not change the colour");
}

#[test]
fn rows_show_all_answers_and_the_oracles_verdict() {
    let review = BOXES.review(&BOXES.changed_boxes());
    let case = &review.cases[0];
    let calls: Vec<usize> = case.rows.iter().map(|row| row.call as usize).collect();
    assert_eq!(
        calls,
        [FALSE_HIT, FALSE_MISS, LATER_EXIT].map(|pixel| BOXES.call(pixel))
    );
    let golden = case.rows[0].golden.as_ref();
    assert!(golden.is_some_and(|golden| golden.is_miss()));
    let row = &case.rows[1];
    assert!(row.golden.is_none(), "the golden has no row for this pixel");
    assert_eq!(row.golden_hits, Some(true), "its colour shows a hit");
    let [exact, actual] = [&row.exact, &row.actual].map(|line| line.as_ref().expect("a line"));
    assert!(!exact.is_miss() && actual.is_miss());
    assert!(
        row.question.starts_with("shape=1568 o=(3.1,4.3,5.2) d=("),
        "{}",
        row.question
    );
    let wrong = &case.whole.wrong_calls()[&row.call];
    assert_eq!(wrong, &[Aspect::HitOrMiss]);
    let page = page::write(&review, &Author::Reference);
    for text in [
        "1 of 1 golden changed; the exact oracle refutes 1 of them",
        "false miss: 1</button>",
        "Nearer to the truth: 0, farther: 1.",
        "data-decide=\"accept\" disabled",
    ] {
        assert!(page.contains(text), "no {text:?}");
    }
}

/// A case without a picture lists its calls.
#[test]
fn a_changed_call_is_listed_with_its_digits_and_its_distance_from_the_truth() {
    let review = FACES.review(&FACES.triangles(|answers| {
        let hit = answers[1].hit.as_mut().expect("the second ray hits");
        hit.t = hit.t.next_up().next_up();
        let t = hit.t;
        answers[1].ray_after.max_t = t;
        answers[1].test = answers[1].test.map(|[_, b1, b2]| [t, b1, b2]);
    }));
    let State::Differs { nearer, .. } = review.cases[0].state else {
        panic!("{:?}", review.cases[0].state)
    };
    assert_eq!((nearer.nearer, nearer.farther), (0, 1));
    let page = page::write(&review, &Author::Reference);
    for text in [
        "Call 1: t</h4>",
        "The exact oracle confirms the actual answer.",
        "<td class=\"delta\">Δ 2 ulp; 2 ulp from exact</td>",
        "<td class=\"delta\">0 ulp from exact</td>",
        "</mark>",
        "data-case=\"front_face\"",
        "cargo grader bless",
    ] {
        assert!(page.contains(text), "no {text:?}");
    }
    let students = page::write(&review, &Author::Student("x".into()));
    assert!(
        !students.contains("data-decide=\"accept\""),
        "only a reference is blessed"
    );
}

/// Hundreds of pixels differ: the page has the records of some of them.
#[test]
fn a_page_of_a_usual_change_has_less_than_a_megabyte() {
    let review = BOXES.review(&BOXES.boxes(|answers| {
        for [_, leaves] in answers.iter_mut().flatten() {
            *leaves += 1.0;
        }
    }));
    let records = pixels(&review).rows.len();
    assert!((RECORDS / 2..=RECORDS).contains(&records), "{records}");
    let page = page::write(&review, &Author::Reference);
    assert!(page.len() < 300_000, "{}", page.len());
}

#[test]
fn the_picture_of_a_task_is_reviewed_too() {
    let golden = Image::filled([4, 3], [9; 3]);
    let mut actual = golden.clone();
    let same = Case::of_task_picture("part1.task3", golden.clone(), actual.clone());
    assert_eq!(same.state, State::Same);
    actual.set(1, 1, [10; 3]);
    let case = Case::of_task_picture("part1.task3", golden, actual);
    let review = Review {
        cases: vec![case],
        ..Review::default()
    };
    let page = page::write(&review, &Author::Reference);
    for text in [
        "1 of 12 pixels",
        "data-case=\"task\"",
        "look at it yourself",
    ] {
        assert!(page.contains(text), "no {text:?}");
    }
    assert!(!page.contains("confirms every new answer"));
}

#[test]
fn the_mistake_that_the_answers_look_like_is_named() {
    let mut review = BOXES.review(&BOXES.changed_boxes());
    let diagnosis = Diagnosis {
        mistakes: vec!["swapped".into()],
        says: String::new(),
        description: "swaps <min> and max".into(),
        hint: String::new(),
        equal: 3,
        of: 4,
        certainty: Certainty::Perhaps,
        ..Diagnosis::default()
    };
    review.diagnoses.insert("part2.task2".into(), diagnosis);
    let page = page::write(&review, &Author::Reference);
    let text = "<strong>Looks like:</strong> swaps &lt;min&gt; and max, 3 of 4 calls.";
    assert!(page.contains(text), "{page}");
}

#[test]
fn differences_in_primitive_t_and_normal_have_their_own_causes() {
    let golden = MESH.snapshot();
    let Some(with_row) = golden.lines.iter().find(|line| !line.is_miss()) else {
        panic!("no row of {} is a hit", MESH.spec.name)
    };
    let with_row = with_row.call as usize;
    let cause = |at: usize, change: &dyn Fn(&mut Hit)| {
        let review = MESH.review(&MESH.hits(|hits| hits[at].iter_mut().for_each(change)));
        let pixels = pixels(&review);
        let row = pixels.rows.iter().find(|row| row.call as usize == at);
        assert!(
            row.is_some_and(|row| row.exact.is_some()),
            "the oracle checks meshes"
        );
        pixels.causes[at]
    };
    let without_row = with_row + 1;
    for at in [with_row, without_row] {
        assert_eq!(cause(at, &|hit| hit.prim += 1), Cause::Primitive);
        assert_eq!(cause(at, &|hit| hit.t *= 1.5), Cause::T);
        assert_eq!(cause(at, &|hit| hit.n = [0.6, 0.0, 0.8]), Cause::Normal);
    }
    assert_eq!(cause(with_row, &|hit| hit.t = hit.t.next_up()), Cause::T);
}

#[test]
fn a_changed_bit_of_a_call_without_a_row_is_found() {
    let review = BOXES.review(&BOXES.boxes(|answers| {
        let [_, leaves] = answers[BOXES.call(LATER_EXIT)]
            .as_mut()
            .expect("this pixel is inside the box");
        *leaves = leaves.next_up();
    }));
    assert!(!review.is_same());
    let page = page::write(&review, &Author::Reference);
    for text in [
        "calls without a row changed; 0 of 3072 pixels",
        "No row shows the difference: only the hash of all answers does.",
        "The exact oracle confirms the new answers.",
    ] {
        assert!(page.contains(text), "no {text:?}");
    }
}

/// The case has an aspect that the oracle does not judge: its totals, without a box test, are none
/// of a right traversal that the oracle knows.
#[test]
fn what_is_not_judged_is_not_confirmed() {
    let golden = MESH.snapshot();
    let mut hits = golden.lines.iter().filter(|line| !line.is_miss());
    let in_full = hits.find(|line| !line.question.is_empty());
    let at = in_full.expect("a row in full is a hit").call as usize;
    let change = |change: &dyn Fn(&mut Hit)| {
        let review = MESH.review(&MESH.hits(|hits| hits[at].iter_mut().for_each(change)));
        page::write(&review, &Author::Reference)
    };
    // Another rounding: nothing is wrong.
    let rounded = change(&|hit| hit.ng[0] = hit.ng[0].next_up());
    for text in [
        "1 of 1 golden changed; the exact oracle does not judge all aspects of 1",
        "it does not judge all their aspects",
        "Not judged: number of tests: there are fewer tests",
    ] {
        assert!(rounded.contains(text), "no {text:?}");
    }
    for text in ["confirms every new answer", "confirms the new answers"] {
        assert!(!rounded.contains(text), "{text:?}");
    }
    // The case grades no normals.
    let flipped = change(&|hit| hit.n = hit.n.map(|x| -x));
    assert!(flipped.contains("the exact oracle refutes 1 of them"));
}

#[test]
fn only_the_first_rows_are_kept_and_all_are_counted() {
    let all = BOXES.boxes(|answers| answers.fill(Some([0.0, 1.0])));
    let review = BOXES.review(&all);
    assert_eq!(review.cases[0].rows.len(), ROWS);
    let State::Differs { calls, .. } = review.cases[0].state else {
        panic!("{:?}", review.cases[0].state)
    };
    assert_eq!(calls, 3072);
}

#[test]
fn what_did_not_change_is_only_named() {
    let review = BOXES.review(&BOXES.answer);
    assert!(review.is_same());
    let page = page::write(&review, &Author::Reference);
    for text in [
        "<h1>Nothing changed in 1 golden</h1>",
        "1 golden is unchanged",
    ] {
        assert!(page.contains(text), "no {text:?}");
    }
    assert!(!page.contains("data:image/png"));
}

#[test]
fn the_page_loads_no_other_files() {
    let review = BOXES.review(&BOXES.changed_boxes());
    let page = page::write(&review, &Author::Student("<b>".into()));
    for outside in [
        "http://", "https://", "src=\"/", "href=\"/", "@import", "url(/",
    ] {
        let found = page
            .find(outside)
            .map(|at| &page[at..(at + 60).min(page.len())]);
        // The namespace of SVG is not loaded.
        assert!(
            found.is_none_or(|at| at.starts_with("http://www.w3.org/2000/svg")),
            "{found:?}"
        );
    }
    assert!(page.contains("the answers of the stages in &lt;b&gt;"));
    assert!(!page.contains("<!-- "), "a placeholder is left");
}
