//! What the page is made of, without a browser.

use crate::{BOXES, FALSE_HIT, FALSE_MISS, LATER, MESH};
use review::case::{ROWS, State};
use review::cause::Cause;
use review::picture::Pixels;
use review::{Author, Review, page};
use wire::answer::Hit;

fn pixels(review: &Review) -> &Pixels {
    let picture = review.cases[0].picture.as_ref();
    let pixels = picture.and_then(|picture| picture.pixels.as_ref());
    pixels.expect("the sizes are equal")
}

#[test]
fn each_pixel_has_the_cause_of_its_difference() {
    let review = BOXES.review(&BOXES.spoilt_boxes());
    let pixels = pixels(&review);
    let counts = [(Cause::FalseHit, 1), (Cause::FalseMiss, 1), (Cause::T, 1)];
    assert_eq!(pixels.counts(), counts);
    for (pixel, cause) in [
        (FALSE_HIT, Cause::FalseHit),
        (FALSE_MISS, Cause::FalseMiss),
        (LATER, Cause::T),
    ] {
        assert_eq!(pixels.causes[BOXES.call(pixel)], cause);
        let [_, h] = BOXES.spec.picture.expect("it makes a picture");
        let colour = pixels.difference.get_pixel(pixel[0], h - 1 - pixel[1]);
        assert_eq!(*colour, cause.colour(), "{cause:?}");
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
    let words = "of the 181 rows for 3072 calls: 1 call now hit";
    assert_eq!(changes.to_string(), words);
    assert_eq!(*calls, 3);
    assert_eq!(*pixels, 2, "a later exit has no colour");
}

#[test]
fn rows_stand_side_by_side_with_what_the_oracle_says() {
    let review = BOXES.review(&BOXES.spoilt_boxes());
    let case = &review.cases[0];
    let calls: Vec<usize> = case.rows.iter().map(|row| row.call as usize).collect();
    assert_eq!(
        calls,
        [FALSE_HIT, FALSE_MISS, LATER].map(|pixel| BOXES.call(pixel))
    );
    let golden = case.rows[0].golden.as_ref();
    assert!(golden.is_some_and(|golden| golden.is_miss()));
    let row = &case.rows[1];
    assert!(row.golden.is_none(), "the golden has no row for this pixel");
    let [exact, actual] = [&row.exact, &row.actual].map(|line| line.as_ref().expect("a line"));
    assert!(!exact.is_miss() && actual.is_miss());
    assert!(
        row.question.starts_with("shape=1568 o=(3.1,4.3,5.2) d=("),
        "{}",
        row.question
    );
    assert_eq!(case.wrong[&row.call], ["hit or miss"]);
    let page = page::write(&review, &Author::Reference).expect("it is written");
    for said in [
        "1 of 1 case changed; the exact oracle refutes 1 of them",
        "<mark>miss</mark>",
        "no row; exact:</span> inside=[",
        "wrong: hit or miss</span>",
        "false miss: 1</button>",
    ] {
        assert!(page.contains(said), "no {said:?}");
    }
}

#[test]
fn primitives_distances_and_normals_are_told_apart() {
    let golden = MESH.snapshot();
    let Some(with_row) = golden.lines.iter().find(|line| !line.is_miss()) else {
        panic!("no row of {} is a hit", MESH.spec.name)
    };
    let with_row = with_row.call as usize;
    let cause = |at: usize, spoil: &dyn Fn(&mut Hit)| {
        let review = MESH.review(&MESH.hits(|hits| hits[at].iter_mut().for_each(spoil)));
        let pixels = pixels(&review);
        let exact = pixels.exact.as_ref().expect("the oracle knows meshes");
        assert!(exact.calls.contains(&(at as u32)));
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
fn a_bit_of_a_call_without_a_row_is_seen() {
    let review = BOXES.review(&BOXES.boxes(|answers| {
        let [_, leaves] = answers[BOXES.call(LATER)]
            .as_mut()
            .expect("it is in the middle");
        *leaves = leaves.next_up();
    }));
    assert!(!review.is_same());
    let page = page::write(&review, &Author::Reference).expect("it is written");
    for said in [
        "calls without a row changed; 0 of 3072 pixels",
        "No row shows the difference: only the hash of all answers does.",
        "The exact oracle confirms the new answers.",
    ] {
        assert!(page.contains(said), "no {said:?}");
    }
}

#[test]
fn many_rows_are_cut_and_counted() {
    let all = BOXES.boxes(|answers| answers.fill(Some([0.0, 1.0])));
    let review = BOXES.review(&all);
    assert_eq!(review.cases[0].rows.len(), ROWS);
    let page = page::write(&review, &Author::Reference).expect("it is written");
    assert!(page.contains("The first 100 of 3072 calls that differ."));
}

#[test]
fn where_nothing_differs_the_page_says_so_and_shows_the_picture() {
    let review = BOXES.review(&BOXES.answer);
    assert!(review.is_same());
    assert_eq!(pixels(&review).golden.calls, None, "all answers are known");
    let page = page::write(&review, &Author::Reference).expect("it is written");
    for said in [
        "<h1>Nothing changed in 1 case</h1>",
        "Difference: none.",
        "data:image/png;base64,",
        "1 case answers as the goldens say",
    ] {
        assert!(page.contains(said), "no {said:?}");
    }
}

#[test]
fn the_page_needs_nothing_but_itself() {
    let review = BOXES.review(&BOXES.spoilt_boxes());
    let page = page::write(&review, &Author::Student("<b>".into()));
    let page = page.expect("it is written");
    for outside in [
        "http://", "https://", "src=\"/", "href=\"/", "@import", "url(/",
    ] {
        let found = page
            .find(outside)
            .map(|at| &page[at..(at + 60).min(page.len())]);
        // The name of a drawing's language is no address.
        assert!(
            found.is_none_or(|at| at.starts_with("http://www.w3.org/2000/svg")),
            "{found:?}"
        );
    }
    assert!(page.contains("the stages in &lt;b&gt; answer"));
    assert!(!page.contains("<!-- "), "a placeholder is left");
}
