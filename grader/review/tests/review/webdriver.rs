//! A minimal WebDriver client (W3C, 2018): sends HTTP requests with JSON to `chromedriver`.

use serde_json::{Value, json};
use std::io::{self, BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

/// A browser without a window. It is closed when this is dropped.
pub(crate) struct Browser {
    driver: Child,
    port: u16,
    session: String,
}

/// Longer than any answer takes, even on a busy machine.
const TIMEOUT: Duration = Duration::from_secs(120);

/// The JSON key of element references in WebDriver.
const ELEMENT: &str = "element-6066-11e4-a52e-4f735466cecf";

impl Browser {
    /// Starts a browser; `None` if none is installed.
    pub(crate) fn start() -> Option<Browser> {
        let chromium = std::env::var_os("FIRSTLIGHT_CHROMIUM").map(PathBuf::from);
        let chromium = chromium.or_else(|| {
            ["chromium", "chromium-browser", "google-chrome"]
                .into_iter()
                .find_map(on_the_path)
        })?;
        let driver = Command::new("chromedriver")
            .arg("--port=0")
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn();
        let mut driver = driver.ok()?;
        let output = BufReader::new(driver.stdout.take().expect("stdout is piped"));
        let port = output.lines().map_while(Result::ok).find_map(|line| {
            let port = line.split("successfully on port ").nth(1)?;
            port.trim_end_matches('.').parse().ok()
        });
        let mut browser = Browser {
            driver,
            port: port.expect("chromedriver prints its port"),
            session: String::new(),
        };
        let options = json!({
            "binary": chromium,
            "args": ["--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--window-size=1200,2000"],
        });
        let capabilities =
            json!({ "capabilities": { "alwaysMatch": { "goog:chromeOptions": options } } });
        let session = browser.request("POST", "/session", &capabilities);
        browser.session = format!(
            "/session/{}",
            session["sessionId"].as_str().expect("a session")
        );
        Some(browser)
    }

    /// Opens a page and waits until it has loaded.
    pub(crate) fn open(&mut self, address: &str) {
        self.command("/url", &json!({ "url": address }));
    }

    /// The address of the current page.
    pub(crate) fn address(&mut self) -> String {
        self.read("/url")
    }

    /// The text that the first element of `selector` shows.
    pub(crate) fn text(&mut self, selector: &str) -> String {
        let element = self.element(selector);
        self.read(&format!("/element/{element}/text"))
    }

    /// Waits until the first element of `selector` shows `text`: the page's data is unpacked after it
    /// has loaded.
    pub(crate) fn wait_for_text(&mut self, selector: &str, text: &str) {
        let start = Instant::now();
        let mut shown = self.text(selector);
        while shown != text {
            assert!(start.elapsed() < TIMEOUT, "{selector} shows {shown:?}");
            std::thread::sleep(Duration::from_millis(50));
            shown = self.text(selector);
        }
    }

    /// Presses a key on an element.
    pub(crate) fn press(&mut self, selector: &str, key: &str) {
        let element = self.element(selector);
        self.command(
            &format!("/element/{element}/value"),
            &json!({ "text": key }),
        );
    }

    /// Clicks a pixel of a picture that fills an element. `size` is the picture's size in pixels;
    /// pixels count from the bottom left.
    pub(crate) fn click_pixel(&mut self, selector: &str, size: [u32; 2], pixel: [u32; 2]) {
        let element = self.element(selector);
        let rect = self.request(
            "GET",
            &format!("{}/element/{element}/rect", self.session),
            &Value::Null,
        );
        let side = |name: &str| rect[name].as_f64().expect("a number");
        // Relative to the centre of the element; y points down.
        let relative =
            [0, 1].map(|axis| (f64::from(pixel[axis]) + 0.5) / f64::from(size[axis]) - 0.5);
        let (x, y) = (relative[0] * side("width"), -relative[1] * side("height"));
        let origin = json!({ ELEMENT: element });
        let mouse = json!({
            "type": "pointer", "id": "mouse", "parameters": { "pointerType": "mouse" },
            "actions": [
                { "type": "pointerMove", "origin": origin, "x": x.round(), "y": y.round() },
                { "type": "pointerDown", "button": 0 },
                { "type": "pointerUp", "button": 0 },
            ],
        });
        self.command("/actions", &json!({ "actions": [mouse] }));
    }

    fn element(&mut self, selector: &str) -> String {
        let wanted = json!({ "using": "css selector", "value": selector });
        let found = self.command("/element", &wanted);
        let name = found[ELEMENT].as_str();
        name.unwrap_or_else(|| panic!("no {selector}: {found}"))
            .to_string()
    }

    fn command(&mut self, path: &str, body: &Value) -> Value {
        self.request("POST", &format!("{}{path}", self.session), body)
    }

    fn read(&mut self, path: &str) -> String {
        let value = self.request("GET", &format!("{}{path}", self.session), &Value::Null);
        value
            .as_str()
            .unwrap_or_else(|| panic!("{path}: {value}"))
            .to_string()
    }

    /// Sends one request and returns the `value` of the answer.
    fn request(&self, method: &str, path: &str, body: &Value) -> Value {
        let answer = self.try_request(method, path, body);
        answer.unwrap_or_else(|e| panic!("the request {path} to chromedriver failed: {e}"))
    }

    fn try_request(&self, method: &str, path: &str, body: &Value) -> io::Result<Value> {
        let body = if body.is_null() {
            String::new()
        } else {
            body.to_string()
        };
        let mut stream = TcpStream::connect(("127.0.0.1", self.port))?;
        stream.set_read_timeout(Some(TIMEOUT))?;
        let request = format!(
            "{method} {path} HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Type: application/json\r\nContent-Length: {}\r\n\r\n{body}",
            body.len()
        );
        stream.write_all(request.as_bytes())?;
        let mut answer = BufReader::new(stream);
        let mut length = 0;
        loop {
            let mut header = String::new();
            answer.read_line(&mut header)?;
            if header.trim().is_empty() {
                break;
            }
            if let Some((name, text)) = header.split_once(':')
                && name.eq_ignore_ascii_case("content-length")
            {
                length = text.trim().parse().expect("a length");
            }
        }
        let mut text = vec![0; length];
        answer.read_exact(&mut text)?;
        let answer: Value = serde_json::from_slice(&text)?;
        Ok(answer["value"].clone())
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        if !self.session.is_empty() {
            let _ = self.try_request("DELETE", &self.session, &Value::Null);
        }
        let _ = self.driver.kill();
        let _ = self.driver.wait();
    }
}

/// The path of the program `name`, if it is on the `PATH`.
fn on_the_path(name: &str) -> Option<PathBuf> {
    let folders = std::env::var_os("PATH")?;
    std::env::split_paths(&folders)
        .map(|folder| folder.join(name))
        .find(|program| program.is_file())
}
