//! Tests the data and the text of the page, without a browser.

use crate::{
    FALSE_HIT, FALSE_MISS, LATER_EXIT, call, changed_boxes, changed_mesh, golden, review, spec,
};
use review::case::{ROWS, State};
use review::cause::Cause;
use review::{Author, page};
use wire::Answer;

#[test]
fn each_pixel_has_the_cause_of_its_difference() {
    let (spec, answer) = changed_boxes();
    let review = review(&spec, &answer);
    let case = &review.cases[0];
    let pixels = case.picture.as_ref().and_then(|p| p.pixels.as_ref());
    let pixels = pixels.expect("the sizes are equal");
    let counts = [(Cause::FalseHit, 1), (Cause::FalseMiss, 1), (Cause::T, 1)];
    assert_eq!(pixels.counts(), counts);
    for (pixel, cause) in [
        (FALSE_HIT, Cause::FalseHit),
        (FALSE_MISS, Cause::FalseMiss),
        (LATER_EXIT, Cause::T),
    ] {
        assert_eq!(pixels.causes[call(&spec, pixel)], cause);
        let [_, h] = spec.picture.expect("the case has a picture");
        let colour = pixels.difference.get_pixel(pixel[0], h - 1 - pixel[1]);
        assert_eq!(*colour, cause.colour(), "{cause:?}");
    }
    let State::Differs {
        changes, pixels, ..
    } = &case.state
    else {
        panic!("{:?}", case.state)
    };
    let text = "1 call now hit, 1 call now miss, 1 call changed otherwise";
    assert_eq!(changes.to_string(), text);
    assert_eq!(*pixels, 2, "the exit distance does not change the colour");
}

#[test]
fn rows_show_both_answers_and_the_oracles_result() {
    let (spec, answer) = changed_boxes();
    let review = review(&spec, &answer);
    let case = &review.cases[0];
    let calls: Vec<usize> = case.rows.iter().map(|row| row.call as usize).collect();
    assert_eq!(
        calls,
        [FALSE_HIT, FALSE_MISS, LATER_EXIT].map(|pixel| call(&spec, pixel))
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
    let page = page::write(&review, &Author::Reference).expect("the page is written");
    for text in [
        "1 of 1 case changed; the exact oracle refutes 1 of them",
        "<mark>miss</mark>",
        "wrong: hit or miss</span>",
        "false miss: 1</button>",
    ] {
        assert!(page.contains(text), "no {text:?}");
    }
}

#[test]
fn differences_in_primitive_t_and_normal_have_their_own_causes() {
    let hit = golden(&spec("part2.task3", "mesh_in_cornell_box"));
    let at = hit.lines.iter().position(|line| !line.is_miss());
    let at = at.expect("a ray hits something");
    let cause = |change: &dyn Fn(&mut wire::answer::Hit)| {
        let (spec, answer) = changed_mesh(|hits| hits[at].iter_mut().for_each(change));
        let review = review(&spec, &answer);
        let pixels = review.cases[0]
            .picture
            .as_ref()
            .and_then(|p| p.pixels.as_ref());
        let pixels = pixels.expect("the sizes are equal");
        let exact = pixels.exact.as_ref().expect("the oracle checks meshes");
        assert!(exact.calls.contains(&(at as u32)));
        pixels.causes[at]
    };
    assert_eq!(cause(&|hit| hit.prim += 1), Cause::Primitive);
    assert_eq!(cause(&|hit| hit.t = hit.t.next_up()), Cause::T);
    assert_eq!(cause(&|hit| hit.n = [0.6, 0.0, 0.8]), Cause::Normal);
}

#[test]
fn only_the_first_rows_are_shown_and_all_are_counted() {
    let (spec, mut answer) = changed_boxes();
    if let Answer::Boxes(answers) = &mut answer {
        answers
            .iter_mut()
            .for_each(|inside| *inside = Some([0.0, 1.0]));
    }
    let review = review(&spec, &answer);
    assert_eq!(review.cases[0].rows.len(), ROWS);
    let page = page::write(&review, &Author::Reference).expect("the page is written");
    assert!(page.contains("The first 100 of 3072 calls that differ."));
}

#[test]
fn a_page_without_differences_still_shows_the_picture() {
    let (spec, mut answer) = changed_boxes();
    let changed = review(&spec, &answer);
    if let Answer::Boxes(answers) = &mut answer {
        let lines = golden(&spec).lines;
        for row in &changed.cases[0].rows {
            let value = lines[row.call as usize].get("inside");
            answers[row.call as usize] =
                value.map(|value| [value.numbers()[0], value.numbers()[1]]);
        }
    }
    let review = review(&spec, &answer);
    assert!(review.is_same());
    let page = page::write(&review, &Author::Reference).expect("the page is written");
    for text in [
        "<h1>Nothing changed in 1 case</h1>",
        "No differences.",
        "data:image/png;base64,",
        "1 case is unchanged",
    ] {
        assert!(page.contains(text), "no {text:?}");
    }
}

#[test]
fn the_page_loads_no_other_files() {
    let (spec, answer) = changed_boxes();
    let page = page::write(&review(&spec, &answer), &Author::Student("<b>".into()));
    let page = page.expect("the page is written");
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
