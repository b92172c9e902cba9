//! The real rust-analyzer, as an editor talks to it: what is wrong is shown when a file is saved.

use crate::student_loop::{FILE, copy_course, root};
use serde_json::{Value, json};
use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::mpsc::{self, Receiver};
use std::time::Duration;

/// Longer than any build takes.
const PATIENCE: Duration = Duration::from_secs(5000);

/// A connection to rust-analyzer in a folder.
struct Editor {
    server: Child,
    input: ChildStdin,
    messages: Receiver<Value>,
}

impl Drop for Editor {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

impl Editor {
    /// Opens `folder`; `None` if there is no rust-analyzer on this machine.
    fn open(folder: &Path) -> Option<Editor> {
        let version = Command::new("rust-analyzer").arg("--version").output();
        version.ok().filter(|output| output.status.success())?;
        let mut server = Command::new("rust-analyzer")
            .current_dir(folder)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("it runs");
        let output = BufReader::new(server.stdout.take().expect("a pipe"));
        let (sender, messages) = mpsc::channel();
        std::thread::spawn(move || {
            let mut output = output;
            while let Some(message) = read(&mut output) {
                if sender.send(message).is_err() {
                    return;
                }
            }
        });
        let input = server.stdin.take().expect("a pipe");
        let mut editor = Editor {
            server,
            input,
            messages,
        };
        let grader = env!("CARGO_BIN_EXE_grader");
        let check = [grader, "check", "part1.task1", "--message-format=json"];
        editor.send(&json!({"id": 1, "method": "initialize", "params": {
            "processId": std::process::id(),
            "rootUri": uri(folder),
            "workspaceFolders": [{"uri": uri(folder), "name": "course"}],
            "capabilities": {"textDocument": {"publishDiagnostics": {"relatedInformation": true}}},
            // The handouts' settings, without what takes long and does not matter here.
            "initializationOptions": {
                "checkOnSave": true,
                "check": {"overrideCommand": check},
                "cargo": {"buildScripts": {"enable": false}},
                "procMacro": {"enable": false},
                "cachePriming": {"enable": false},
            },
        }}));
        editor.wait(|message| message["id"] == 1 && message["result"].is_object());
        editor.send(&json!({"method": "initialized", "params": {}}));
        Some(editor)
    }

    fn send(&mut self, message: &Value) {
        let mut message = message.clone();
        message["jsonrpc"] = "2.0".into();
        let text = message.to_string();
        write!(self.input, "Content-Length: {}\r\n\r\n{text}", text.len()).expect("it reads");
        self.input.flush().expect("it reads");
    }

    /// Waits for a message; answers what the server asks meanwhile.
    fn wait(&mut self, is_it: impl Fn(&Value) -> bool) -> Value {
        loop {
            let message = self.messages.recv_timeout(PATIENCE).expect("it answers");
            if is_it(&message) {
                return message;
            }
            if message["method"].is_string() && !message["id"].is_null() {
                self.send(&json!({"id": message["id"], "result": null}));
            }
        }
    }

    /// Waits until a diagnostic about `file` is shown that fits, and returns it.
    fn wait_for(&mut self, file: &Path, fits: impl Fn(&Value) -> bool) -> Value {
        let shown = self.wait(|message| diagnostics(message, file).iter().any(&fits));
        let found = diagnostics(&shown, file).into_iter().find(fits);
        found.expect("it was found before")
    }
}

/// Reads a message; `None` at the end.
fn read(output: &mut impl BufRead) -> Option<Value> {
    let mut length = 0;
    loop {
        let mut line = String::new();
        output.read_line(&mut line).ok().filter(|read| *read > 0)?;
        match line.trim().strip_prefix("Content-Length: ") {
            Some(number) => length = number.parse().ok()?,
            None if line.trim().is_empty() => break,
            None => {}
        }
    }
    let mut text = vec![0; length];
    output.read_exact(&mut text).ok()?;
    serde_json::from_slice(&text).ok()
}

fn uri(path: &Path) -> String {
    grader::book::address(path)
}

/// The diagnostics of a message about `file`.
fn diagnostics(message: &Value, file: &Path) -> Vec<Value> {
    let params = &message["params"];
    let is_about =
        message["method"] == "textDocument/publishDiagnostics" && params["uri"] == uri(file);
    let list = params["diagnostics"].as_array().filter(|_| is_about);
    list.cloned().unwrap_or_default()
}

#[test]
#[ignore = "needs rust-analyzer, and builds a worker; .ci/nightly editor runs it"]
fn an_editor_shows_what_is_wrong() {
    let course = root().join("target/student-loop/editor");
    copy_course(&course);
    let file = course.join(FILE);
    let solution = fs::read_to_string(root().join(FILE)).expect("the reference");
    let start = ") -> PixelEstimate {\n";
    let with = |code: &str| solution.replacen(start, &format!("{start}    {code}\n"), 1);
    let wrong = with("if x == 1 { return PixelEstimate::default(); }");
    fs::write(&file, &wrong).expect("a file");
    let Some(mut editor) = Editor::open(&course) else {
        println!("skipped: there is no rust-analyzer on this machine");
        return;
    };
    let document = json!({"uri": uri(&file), "languageId": "rust", "version": 1, "text": wrong});
    editor.send(&json!({"method": "textDocument/didOpen", "params": {"textDocument": document}}));
    let is_ours = |shown: &Value| shown["code"] == "part1.task1";
    let warning = editor.wait_for(&file, is_ours);
    assert_eq!(warning["severity"], 2, "a warning: {warning:#}");
    let line = wrong
        .lines()
        .position(|line| line.starts_with("pub fn raytrace_pixel"));
    assert_eq!(
        warning["range"]["start"]["line"].as_u64(),
        line.map(|line| line as u64)
    );
    let text = warning["message"].as_str().unwrap_or_default();
    assert!(text.contains("simplest case: "), "{text}");
    println!("{text}");

    // A gap is a hint.
    fs::write(&file, with("kit::hole!(\"part1.task1\", x, y);")).expect("a file");
    let saved = json!({"textDocument": {"uri": uri(&file)}});
    editor.send(&json!({"method": "textDocument/didSave", "params": saved}));
    let gap = editor.wait_for(&file, |shown| is_ours(shown) && *shown != warning);
    assert_eq!(gap["severity"], 4, "a hint: {gap:#}");
    let text = gap["message"].as_str().unwrap_or_default();
    assert!(text.starts_with("not written yet: part1.task1"), "{text}");

    // The compiler's errors are shown as ever.
    fs::write(&file, with("let nothing: u8 = \"text\";")).expect("a file");
    editor.send(&json!({"method": "textDocument/didSave", "params": saved}));
    let error = editor.wait_for(&file, |shown| shown["code"] == "E0308");
    assert_eq!(error["severity"], 1, "an error: {error:#}");
}
