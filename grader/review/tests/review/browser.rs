//! Tests the page in a browser: a click on a pixel shows its records.
//!
//! Needs Chromium and `chromedriver`. `FIRSTLIGHT_CHROMIUM` names the browser; without it the test
//! searches the path. If none is found, the test prints that it is skipped.

use crate::webdriver::Browser;
use crate::{BOXES, FALSE_MISS, LATER_EXIT};
use review::{Author, page};

const PICTURE: &str = "[id='part2.task2/picture']";

#[test]
fn a_click_on_a_pixel_shows_its_ray_records_and_box_tests() {
    let Some(mut browser) = Browser::start() else {
        println!("skipped: found no Chromium with chromedriver");
        return;
    };
    let review = BOXES.review(&BOXES.changed_boxes());
    let text = page::write(&review, &Author::Reference);
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("review.html");
    std::fs::write(&file, text).expect("the file is written");
    let address = format!("file://{}", file.display());

    browser.open(&address);
    let size = BOXES.spec.picture.expect("the case has a picture");
    browser.click_pixel(&format!("{PICTURE} .screen"), size, FALSE_MISS);
    let shown = browser.text(&format!("{PICTURE} .inspector"));
    for text in [
        "Pixel 32, 24: false miss",
        "(3.1,4.3,5.2)",
        "The exact oracle refutes the actual answer: hit or miss.",
        "The golden stores rows for a sample of the pixels, and none for this one",
        "Box tests: golden needs 1, actual makes 1.",
        "step 1 of 1",
    ] {
        assert!(shown.contains(text), "no {text:?} in\n{shown}");
    }
    let field = |browser: &mut Browser, field: &str| {
        browser.text(&format!("{PICTURE} [data-field='{field}']"))
    };
    assert_eq!(field(&mut browser, "golden.answer"), "hit");
    assert_eq!(field(&mut browser, "actual.answer"), "miss");
    assert!(browser.address().ends_with("#part2.task2/picture/32,24"));

    // The address and the arrow keys also select pixels.
    browser.open("about:blank");
    browser.open(&format!("{address}#part2.task2/picture/32,24"));
    browser.wait_for_text(&format!("{PICTURE} .inspector"), &shown);
    browser.press(&format!("{PICTURE} .screen"), "\u{e014}");
    let shown = browser.text(&format!("{PICTURE} .inspector h4"));
    assert_eq!(
        shown,
        format!("Pixel {}, {}: t", LATER_EXIT[0], LATER_EXIT[1])
    );
    let [exact, actual] = ["exact.inside", "actual.inside"].map(|name| field(&mut browser, name));
    assert!(
        exact != actual && exact.starts_with('['),
        "{exact} {actual}"
    );
}

#[test]
fn accepted_changes_become_a_command_and_a_line_for_the_changelog() {
    let Some(mut browser) = Browser::start() else {
        println!("skipped: found no Chromium with chromedriver");
        return;
    };
    // No answer is refuted, so the change can be accepted.
    let review = BOXES.review(&BOXES.boxes(|answers| {
        let [_, leaves] = answers[BOXES.call(LATER_EXIT)]
            .as_mut()
            .expect("this pixel is inside the box");
        *leaves = leaves.next_up();
    }));
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("review.html");
    std::fs::write(&file, page::write(&review, &Author::Reference)).expect("the file is written");
    browser.open(&format!("file://{}", file.display()));
    browser.press("body", "n");
    assert!(
        browser
            .text(".topbar output")
            .starts_with("1 of 1 · 0 accepted")
    );
    browser.press("body", "y");
    let out = |browser: &mut Browser, name: &str| browser.text(&format!("[data-out='{name}']"));
    assert_eq!(
        out(&mut browser, "command"),
        "cargo grader bless part2.task2"
    );
    let line = out(&mut browser, "changelog");
    assert!(
        line.starts_with("- Goldens of `part2.task2` changed (picture: "),
        "{line}"
    );
    browser.press("body", "x");
    assert_eq!(out(&mut browser, "command"), "# nothing is accepted yet");
    assert!(out(&mut browser, "refused").starts_with("part2.task2/picture: "));
    browser.press("body", "b");
    let shown = browser.text(&format!("{PICTURE} [data-mode][aria-pressed='true']"));
    assert!(shown.starts_with("actual"), "{shown}");
}
