//! The items of source files, and what each of them needs of the others.

use std::collections::{BTreeMap, BTreeSet};
use submission::file_tree::Files;
use syn::spanned::Spanned;
use syn::{FnArg, ImplItem, Item, ReturnType, Signature, UseTree};

/// A function that may be pasted.
#[derive(Clone, Debug)]
pub(super) struct Function {
    /// The file that has it.
    pub(super) file: String,
    /// How it is called: `direction`, or `Boundary::new`.
    pub(super) path: String,
    /// The names and types of its parameters. A `self` has the name `self`.
    pub(super) parameters: Vec<(String, String)>,
    /// The type that it returns.
    pub(super) returns: String,
    /// The name of the item that has to be pasted: the function's, or that of its type.
    item: String,
}

/// A source file.
#[derive(Debug, Default)]
struct SourceFile {
    /// The text of the items of each name.
    items: BTreeMap<String, Vec<String>>,
    /// The crate that each imported name comes from.
    imports: BTreeMap<String, String>,
    /// The types without fields.
    unit_types: BTreeSet<String>,
}

/// The sources of a handout.
#[derive(Debug, Default)]
pub(super) struct Sources {
    files: BTreeMap<String, SourceFile>,
    pub(super) functions: Vec<Function>,
}

/// More items than a person would paste.
const MOST_ITEMS: usize = 40;

impl Sources {
    /// The Rust files for which `is_read`.
    pub(super) fn of(files: &Files, is_read: impl Fn(&std::path::Path) -> bool) -> Sources {
        let mut sources = Sources::default();
        for (path, contents) in files {
            if path.extension().is_none_or(|e| e != "rs") || !is_read(path) {
                continue;
            }
            let text = std::str::from_utf8(contents).expect("it is Rust");
            sources.add(&path.to_string_lossy(), text);
        }
        sources
    }

    fn add(&mut self, path: &str, text: &str) {
        let parsed = syn::parse_file(text).unwrap_or_else(|e| panic!("{path}: {e}"));
        let mut file = SourceFile::default();
        let lines: Vec<&str> = text.lines().collect();
        for item in &parsed.items {
            let name = match item {
                Item::Fn(f) => {
                    let name = f.sig.ident.to_string();
                    self.add_function(path, None, &f.sig, &lines);
                    name
                }
                Item::Const(c) => c.ident.to_string(),
                Item::Static(s) => s.ident.to_string(),
                Item::Struct(s) => {
                    if s.fields.is_empty() {
                        file.unit_types.insert(s.ident.to_string());
                    }
                    s.ident.to_string()
                }
                Item::Enum(e) => e.ident.to_string(),
                Item::Type(t) => t.ident.to_string(),
                Item::Trait(t) => t.ident.to_string(),
                Item::Impl(i) => {
                    let of = text_at(&lines, &*i.self_ty)
                        .split('<')
                        .next()
                        .unwrap_or_default()
                        .to_string();
                    for item in &i.items {
                        if let ImplItem::Fn(f) = item {
                            self.add_function(path, Some(&of), &f.sig, &lines);
                        }
                    }
                    of
                }
                Item::Use(u) => {
                    imports(&u.tree, &mut Vec::new(), &mut file.imports);
                    continue;
                }
                _ => continue,
            };
            let text = without_attributes(&text_at(&lines, item));
            file.items.entry(name).or_default().push(text);
        }
        self.files.insert(path.to_string(), file);
    }

    fn add_function(&mut self, path: &str, of: Option<&str>, sig: &Signature, lines: &[&str]) {
        let parameters = sig.inputs.iter().map(|input| match input {
            FnArg::Receiver(_) => ("self".to_string(), of.unwrap_or_default().to_string()),
            FnArg::Typed(typed) => (text_at(lines, &*typed.pat), text_at(lines, &*typed.ty)),
        });
        let name = sig.ident.to_string();
        self.functions.push(Function {
            file: path.to_string(),
            parameters: parameters.collect(),
            returns: match &sig.output {
                ReturnType::Default => String::new(),
                ReturnType::Type(_, of) => text_at(lines, &**of),
            },
            path: of.map_or(name.clone(), |of| format!("{of}::{name}")),
            item: of.map_or(name, str::to_string),
        });
    }

    /// Whether a function's `self` is a type without fields.
    pub(super) fn has_unit_self(&self, function: &Function) -> bool {
        self.files[&function.file]
            .unit_types
            .contains(&function.item)
    }

    /// The text of a function, and of all that it needs of the same crate and of `wire`; `None` if
    /// that is more than a person would paste.
    pub(super) fn pasted(&self, function: &Function) -> Option<String> {
        // A stage depends on `kit`: its functions are called as they are.
        if function.file.starts_with("stages/kit") {
            return Some(String::new());
        }
        let mut open = vec![(function.file.clone(), function.item.clone())];
        let mut done = BTreeSet::new();
        let mut text = String::new();
        while let Some((path, name)) = open.pop() {
            if !done.insert(name.clone()) || done.len() > MOST_ITEMS {
                if done.len() > MOST_ITEMS {
                    return None;
                }
                continue;
            }
            for item in &self.files[&path].items[&name] {
                for word in words(item) {
                    if let Some(place) = self.place(&path, word) {
                        open.push(place);
                    }
                }
                text.push_str(item);
                text.push('\n');
            }
        }
        Some(text)
    }

    /// The file and the name of the item that `name` means in the file `path`.
    fn place(&self, path: &str, name: &str) -> Option<(String, String)> {
        let file = &self.files[path];
        if file.items.contains_key(name) {
            return Some((path.to_string(), name.to_string()));
        }
        let from = file.imports.get(name)?;
        let own = path.split("/src/").next().unwrap_or_default();
        let folder = match from.as_str() {
            "crate" | "super" | "self" => own,
            "wire" => "grader/wire",
            _ => return None,
        };
        let has = |(other, file): &(&String, &SourceFile)| {
            other.starts_with(&format!("{folder}/src/")) && file.items.contains_key(name)
        };
        let (other, _) = self.files.iter().find(has)?;
        Some((other.clone(), name.to_string()))
    }
}

/// The names that a `use` brings in, each with the first part of its path.
fn imports<'a>(
    tree: &'a UseTree,
    at: &mut Vec<&'a syn::Ident>,
    found: &mut BTreeMap<String, String>,
) {
    let mut add = |name: &syn::Ident, at: &[&syn::Ident]| {
        let first = at.first().map_or(name, |first| *first);
        found.insert(name.to_string(), first.to_string());
    };
    match tree {
        UseTree::Path(path) => {
            at.push(&path.ident);
            imports(&path.tree, at, found);
            at.pop();
        }
        UseTree::Name(name) => add(&name.ident, at),
        UseTree::Rename(rename) => add(&rename.ident, at),
        UseTree::Group(group) => {
            for tree in &group.items {
                imports(tree, at, found);
            }
        }
        UseTree::Glob(_) => {}
    }
}

/// The text between the ends of a part of the syntax tree.
fn text_at(lines: &[&str], part: &impl Spanned) -> String {
    let (start, end) = (part.span().start(), part.span().end());
    let cut = |line: &str, from: usize, to: usize| -> String {
        line.chars()
            .skip(from)
            .take(to.saturating_sub(from))
            .collect()
    };
    let of_line = |number: usize| {
        let line = lines[number - 1];
        let from = if number == start.line {
            start.column
        } else {
            0
        };
        let to = if number == end.line {
            end.column
        } else {
            usize::MAX
        };
        cut(line, from, to)
    };
    let all: Vec<String> = (start.line..=end.line).map(of_line).collect();
    all.join("\n")
}

/// An item without its attributes and doc comments, public, and cheap to copy if it can be.
fn without_attributes(item: &str) -> String {
    let is_code = |line: &&str| {
        let line = line.trim_start();
        !line.starts_with("#[") && !line.starts_with("///")
    };
    let lines: Vec<&str> = item.lines().filter(is_code).collect();
    let text = lines.join("\n");
    let first = text.trim_start();
    let is_type = ["pub struct", "struct", "pub enum", "enum"];
    if !is_type.iter().any(|start| first.starts_with(start)) && !first.contains(") struct ") {
        return text;
    }
    match text.contains("Vec<") || text.contains("String") || text.contains('&') {
        true => format!("#[derive(Clone, Debug)]\n{text}"),
        false => format!("#[derive(Clone, Copy, Debug, PartialEq)]\n{text}"),
    }
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !c.is_alphanumeric() && c != '_')
        .filter(|word| !word.is_empty())
}
