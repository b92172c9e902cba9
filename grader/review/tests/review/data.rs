//! What the page is made of, without a browser.

use crate::{FALSE_HIT, FALSE_MISS, LATER, call, golden, review, spec, spoilt_boxes, spoilt_mesh};
use review::case::{ROWS, State};
use review::cause::Cause;
use review::{Author, page};
use wire::Answer;

#[test]
fn each_pixel_has_the_cause_of_its_difference() {
    let (spec, answer) = spoilt_boxes();
    let review = review(&spec, &answer);
    let case = &review.cases[0];
    let pixels = case.picture.as_ref().and_then(|p| p.pixels.as_ref());
    let pixels = pixels.expect("the sizes are equal");
    let counts = [(Cause::FalseHit, 1), (Cause::FalseMiss, 1), (Cause::T, 1)];
    assert_eq!(pixels.counts(), counts);
    for (pixel, cause) in [
        (FALSE_HIT, Cause::FalseHit),
        (FALSE_MISS, Cause::FalseMiss),
        (LATER, Cause::T),
    ] {
        assert_eq!(pixels.causes[call(&spec, pixel)], cause);
        let [_, h] = spec.picture.expect("it makes a picture");
        let colour = pixels.difference.get_pixel(pixel[0], h - 1 - pixel[1]);
        assert_eq!(*colour, cause.colour(), "{cause:?}");
    }
    let State::Differs {
        changes, pixels, ..
    } = &case.state
    else {
        panic!("{:?}", case.state)
    };
    let words = "1 call now hit, 1 call now miss, 1 call changed otherwise";
    assert_eq!(changes.to_string(), words);
    assert_eq!(*pixels, 2, "a later exit has no colour");
}

#[test]
fn rows_stand_side_by_side_with_what_the_oracle_says() {
    let (spec, answer) = spoilt_boxes();
    let review = review(&spec, &answer);
    let case = &review.cases[0];
    let calls: Vec<usize> = case.rows.iter().map(|row| row.call as usize).collect();
    assert_eq!(
        calls,
        [FALSE_HIT, FALSE_MISS, LATER].map(|pixel| call(&spec, pixel))
    );
    let row = &case.rows[1];
    let [golden, actual] = [&row.golden, &row.actual].map(|line| line.as_ref().expect("a line"));
    assert!(!golden.is_miss() && actual.is_miss());
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
        "wrong: hit or miss</span>",
        "false miss: 1</button>",
    ] {
        assert!(page.contains(said), "no {said:?}");
    }
}

#[test]
fn primitives_distances_and_normals_are_told_apart() {
    let hit = golden(&spec("part2.task3", "mesh_in_cornell_box"));
    let at = hit.lines.iter().position(|line| !line.is_miss());
    let at = at.expect("something is hit");
    let cause = |spoil: &dyn Fn(&mut wire::answer::Hit)| {
        let (spec, answer) = spoilt_mesh(|hits| hits[at].iter_mut().for_each(spoil));
        let review = review(&spec, &answer);
        let pixels = review.cases[0]
            .picture
            .as_ref()
            .and_then(|p| p.pixels.as_ref());
        let pixels = pixels.expect("the sizes are equal");
        let exact = pixels.exact.as_ref().expect("the oracle knows meshes");
        assert!(exact.calls.contains(&(at as u32)));
        pixels.causes[at]
    };
    assert_eq!(cause(&|hit| hit.prim += 1), Cause::Primitive);
    assert_eq!(cause(&|hit| hit.t = hit.t.next_up()), Cause::T);
    assert_eq!(cause(&|hit| hit.n = [0.6, 0.0, 0.8]), Cause::Normal);
}

#[test]
fn many_rows_are_cut_and_counted() {
    let (spec, mut answer) = spoilt_boxes();
    if let Answer::Boxes(answers) = &mut answer {
        answers
            .iter_mut()
            .for_each(|inside| *inside = Some([0.0, 1.0]));
    }
    let review = review(&spec, &answer);
    assert_eq!(review.cases[0].rows.len(), ROWS);
    let page = page::write(&review, &Author::Reference).expect("it is written");
    assert!(page.contains("The first 100 of 3072 calls that differ."));
}

#[test]
fn where_nothing_differs_the_page_says_so_and_shows_the_picture() {
    let (spec, mut answer) = spoilt_boxes();
    let spoilt = review(&spec, &answer);
    if let Answer::Boxes(answers) = &mut answer {
        let lines = golden(&spec).lines;
        for row in &spoilt.cases[0].rows {
            let value = lines[row.call as usize].get("inside");
            answers[row.call as usize] =
                value.map(|value| [value.numbers()[0], value.numbers()[1]]);
        }
    }
    let review = review(&spec, &answer);
    assert!(review.is_same());
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
    let (spec, answer) = spoilt_boxes();
    let page = page::write(&review(&spec, &answer), &Author::Student("<b>".into()));
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
