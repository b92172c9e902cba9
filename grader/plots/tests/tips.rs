//! Tests in a browser that the points of a plot show their texts: under the pointer, after a tap,
//! and by keyboard.
//!
//! Needs Chromium. `FIRSTLIGHT_CHROMIUM` names the browser; without it the test searches the path.
//! If none is found, the test prints that it is skipped.

use plots::canvas::svg;
use plots::document::Document;
use std::path::PathBuf;
use std::process::Command;

/// Acts on the page as a reader does, and writes after each action what is shown.
const READER: &str = r#"
const [a, b, c] = document.querySelectorAll(".tip");
const log = (what) => {
  const box = document.querySelector(".tooltip");
  const line = document.createElement("p");
  line.textContent = `${what}: ${box.hidden ? "nothing" : box.textContent}`;
  document.body.append(line);
};
const pointer = (type, point, pointerType, away) => {
  const at = point.getBoundingClientRect();
  point.ownerSVGElement.dispatchEvent(new PointerEvent(type, {
    clientX: at.right + away, clientY: (at.top + at.bottom) / 2, pointerType, bubbles: true,
  }));
};
const key = (key) => document.activeElement.dispatchEvent(
  new KeyboardEvent("keydown", { key, bubbles: true, cancelable: true }),
);
log("at first");
pointer("pointermove", b, "mouse", 3);
log("near b");
pointer("pointermove", b, "mouse", 15);
log("beside b");
pointer("click", b, "touch", 15);
log("tap beside b");
key("Escape");
log("Escape");
key("ArrowRight");
log("right");
key("ArrowUp");
log("up");
key("Home");
log("Home");
log(`focus in the order of Tab ${document.querySelectorAll(".tip[tabindex='0']").length}`);
log(`titles ${document.querySelectorAll(".tip title").length}`);
"#;

#[test]
fn points_show_their_texts() {
    let Some(chromium) = chromium() else {
        println!("skipped: found no Chromium");
        return;
    };
    let plot = svg(400.0, 200.0, "a plot", |canvas| {
        canvas.tip((50.0, 50.0), 6.0, "text of a");
        canvas.tip((200.0, 50.0), 6.0, "text of <b>");
        canvas.tip((300.0, 150.0), 6.0, "text of c");
    });
    let document = Document {
        title: "A page".into(),
        sections: vec![("Section".into(), plot)],
        ..Document::default()
    };
    let page = document.html();
    assert_eq!(page.matches("<title>text of").count(), 3, "{page}");
    let page = page.replace("</body>", &format!("<script>{READER}</script></body>"));
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("page.html");
    std::fs::write(&file, page).expect("the file is written");
    let output = Command::new(chromium)
        .args(["--headless", "--no-sandbox", "--disable-gpu"])
        .args(["--disable-dev-shm-usage", "--disable-background-networking"])
        .args(["--window-size=1000,800", "--dump-dom"])
        .arg(format!("--user-data-dir={}", folder.path().display()))
        .arg(format!("file://{}", file.display()))
        .output()
        .expect("the browser runs");
    let shown = String::from_utf8_lossy(&output.stdout);
    for line in [
        "at first: nothing",
        "near b: text of &lt;b&gt;",
        "beside b: nothing",
        "tap beside b: text of &lt;b&gt;",
        "Escape: nothing",
        "right: text of c",
        "up: text of &lt;b&gt;",
        "Home: text of a",
        "focus in the order of Tab 1: text of a",
        "titles 0: text of a",
    ] {
        assert!(
            shown.contains(&format!("<p>{line}</p>")),
            "no {line:?} in\n{shown}"
        );
    }
}

fn chromium() -> Option<PathBuf> {
    if let Some(named) = std::env::var_os("FIRSTLIGHT_CHROMIUM") {
        return Some(named.into());
    }
    let folders = std::env::var_os("PATH")?;
    let names = ["chromium", "chromium-browser", "google-chrome"];
    std::env::split_paths(&folders)
        .flat_map(|folder| names.map(|name| folder.join(name)))
        .find(|program| program.is_file())
}
