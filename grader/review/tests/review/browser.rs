//! The page in a browser: a real click on a pixel shows its records.
//!
//! Runs where a Chromium and its `chromedriver` are found: `FIRSTLIGHT_CHROMIUM` names the browser, else it is
//! looked for on the path. Otherwise it says that it is skipped.

use crate::webdriver::Browser;
use crate::{BOXES, FALSE_MISS, LATER};
use review::{Author, page};

const PICTURE: &str = "[id='part2.task2/picture']";

#[test]
fn a_click_on_a_pixel_shows_its_ray_both_records_and_its_boxes() {
    let Some(mut browser) = Browser::start() else {
        println!("skipped: no Chromium with its chromedriver");
        return;
    };
    let review = BOXES.review(&BOXES.spoilt_boxes());
    let text = page::write(&review, &Author::Reference);
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("review.html");
    std::fs::write(&file, text.expect("it is written")).expect("it can be written");
    let address = format!("file://{}", file.display());

    browser.open(&address);
    let size = BOXES.spec.picture.expect("it makes a picture");
    browser.click_pixel(&format!("{PICTURE} .screen"), size, FALSE_MISS);
    let shown = browser.text(&format!("{PICTURE} .inspector"));
    for said in [
        "Pixel 32, 24: false miss",
        "(3.1, 4.3, 5.2)",
        "The exact oracle finds the actual answer wrong: hit or miss.",
        "The golden has rows for a sample of the pixels, and none for this one",
        "Boxes visited: asked for 1, the ray meets 0",
    ] {
        assert!(shown.contains(said), "no {said:?} in\n{shown}");
    }
    let field = |browser: &mut Browser, field: &str| {
        browser.text(&format!("{PICTURE} [data-field='{field}']"))
    };
    assert_eq!(field(&mut browser, "golden.answer"), "hit");
    assert_eq!(field(&mut browser, "actual.answer"), "miss");
    assert!(browser.address().ends_with("#part2.task2/picture/32,24"));

    // The address and the keys lead to the same place.
    browser.open("about:blank");
    browser.open(&format!("{address}#part2.task2/picture/32,24"));
    assert_eq!(browser.text(&format!("{PICTURE} .inspector")), shown);
    browser.press(&format!("{PICTURE} .screen"), "\u{e014}");
    let shown = browser.text(&format!("{PICTURE} .inspector h4"));
    assert_eq!(shown, format!("Pixel {}, {}: t", LATER[0], LATER[1]));
    assert_eq!(field(&mut browser, "golden.inside"), "–");
    let [exact, actual] = ["exact.inside", "actual.inside"].map(|name| field(&mut browser, name));
    assert!(
        exact != actual && exact.starts_with('['),
        "{exact} {actual}"
    );
}
