//! The modules of a crate, and which file defines what a path names.

use super::tokens::{self, Token};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// A module: a file, or a block in one.
#[derive(Debug, Default)]
struct Module {
    file: PathBuf,
    parent: Option<usize>,
    children: BTreeMap<String, usize>,
    /// The names that `use` brings into the module, with the paths that they stand for.
    imports: BTreeMap<String, Vec<String>>,
    /// The paths of `use ...::*`.
    globs: Vec<Vec<String>>,
    /// All paths that the module names, in `use` and elsewhere.
    paths: BTreeSet<Vec<String>>,
}

/// The modules of a crate; the first is its root.
#[derive(Debug, Default)]
pub(crate) struct SourceTree {
    modules: Vec<Module>,
}

/// A path is not followed through more imports than this: imports may go round.
const MAX_IMPORTS: usize = 16;

impl SourceTree {
    /// The modules of the crate whose root is the file `root`. `read` returns the text of a file;
    /// `None` if there is no such file.
    pub(crate) fn new(root: &Path, read: &dyn Fn(&Path) -> Option<String>) -> SourceTree {
        let mut tree = SourceTree::default();
        let folder = root.parent().unwrap_or(Path::new("")).to_path_buf();
        tree.add_file(root.to_path_buf(), folder, None, read);
        tree
    }

    /// Which file imports from which.
    pub(crate) fn imports(&self) -> BTreeMap<PathBuf, BTreeSet<PathBuf>> {
        let mut imports: BTreeMap<PathBuf, BTreeSet<PathBuf>> = BTreeMap::new();
        for (at, module) in self.modules.iter().enumerate() {
            let from = imports.entry(module.file.clone()).or_default();
            let files = module.paths.iter().flat_map(|path| self.files(at, path));
            from.extend(files.filter(|file| *file != module.file));
        }
        imports
    }

    fn add_file(
        &mut self,
        file: PathBuf,
        folder: PathBuf,
        parent: Option<usize>,
        read: &dyn Fn(&Path) -> Option<String>,
    ) -> usize {
        let text = read(&file).unwrap_or_else(|| panic!("{} does not exist", file.display()));
        self.add_module(&tokens::of(&text), file, folder, parent, read)
    }

    /// Adds the module in `file` whose child modules are in `folder`.
    fn add_module(
        &mut self,
        tokens: &[Token],
        file: PathBuf,
        folder: PathBuf,
        parent: Option<usize>,
        read: &dyn Fn(&Path) -> Option<String>,
    ) -> usize {
        let this = self.modules.len();
        self.modules.push(Module {
            file: file.clone(),
            parent,
            ..Module::default()
        });
        let mut at = 0;
        while at < tokens.len() {
            match (
                &tokens[at..],
                at.checked_sub(1).map(|before| &tokens[before]),
            ) {
                ([Token::Name(word), Token::Name(name), Token::Mark(';'), ..], _)
                    if word == "mod" =>
                {
                    let inside = folder.join(name);
                    let candidates = [folder.join(format!("{name}.rs")), inside.join("mod.rs")];
                    let found = candidates.into_iter().find(|path| read(path).is_some());
                    let child = match found {
                        Some(path) => self.add_file(path, inside, Some(this), read),
                        None if has_path(&tokens[..at]) => {
                            self.add_module(&[], inside.clone(), inside, Some(this), read)
                        }
                        None => panic!("{}: no file for `mod {name};`", file.display()),
                    };
                    self.modules[this].children.insert(name.clone(), child);
                    at += 3;
                }
                ([Token::Name(word), Token::Name(name), Token::Mark('{'), ..], _)
                    if word == "mod" =>
                {
                    let end = tokens::item_end(tokens, at);
                    let inner = &tokens[at + 3..end - 1];
                    let child =
                        self.add_module(inner, file.clone(), folder.join(name), Some(this), read);
                    self.modules[this].children.insert(name.clone(), child);
                    at = end;
                }
                ([Token::Name(word), ..], _) if word == "use" => {
                    let end = tokens::use_end(tokens, at);
                    let module = &mut self.modules[this];
                    add_use(module, &mut tokens[at + 1..end].iter().peekable(), &[]);
                    at = end + 1;
                }
                ([Token::Name(_), Token::Path, ..], before) if before != Some(&Token::Path) => {
                    let path = path_at(&tokens[at..]);
                    at += 2 * path.len() - 1;
                    self.modules[this].paths.insert(path);
                }
                // A single name may be a function or a type that a `use` brings in: the `use` counts.
                _ => at += 1,
            }
        }
        this
    }

    /// The files that define what `path`, written in the module `from`, names: several for a glob;
    /// none if it is in another crate.
    fn files(&self, from: usize, path: &[String]) -> Vec<PathBuf> {
        let found = self.define(from, path, MAX_IMPORTS);
        found
            .map(|module| self.modules[module].file.clone())
            .into_iter()
            .collect()
    }

    /// The module that defines what `path` names.
    fn define(&self, from: usize, path: &[String], imports: usize) -> Option<usize> {
        let (first, rest) = path.split_first()?;
        let module = &self.modules[from];
        match first.as_str() {
            "crate" => self.descend(0, rest, imports),
            "self" => self.descend(from, rest, imports),
            "super" => self.define_super(module.parent?, rest, imports),
            _ if module.children.contains_key(first) || module.imports.contains_key(first) => {
                self.descend(from, path, imports)
            }
            _ => None,
        }
    }

    fn define_super(&self, from: usize, path: &[String], imports: usize) -> Option<usize> {
        match path.split_first() {
            Some((first, rest)) if first == "super" => {
                self.define_super(self.modules[from].parent?, rest, imports)
            }
            _ => self.descend(from, path, imports),
        }
    }

    /// The module that defines what `path` names, seen from inside the module `at`.
    fn descend(&self, at: usize, path: &[String], imports: usize) -> Option<usize> {
        let Some((first, rest)) = path.split_first() else {
            return Some(at);
        };
        let module = &self.modules[at];
        if let Some(child) = module.children.get(first) {
            return self.descend(*child, rest, imports);
        }
        let imports = imports.checked_sub(1)?;
        if let Some(import) = module.imports.get(first) {
            let whole: Vec<String> = import.iter().chain(rest).cloned().collect();
            return self.define(at, &whole, imports);
        }
        let through_glob = module.globs.iter().find_map(|glob| {
            let from = self.define(at, glob, imports)?;
            let is_there = |module: &Module| {
                module.children.contains_key(first) || module.imports.contains_key(first)
            };
            (from != at && is_there(&self.modules[from]))
                .then(|| self.descend(from, path, imports))
                .flatten()
        });
        Some(through_glob.unwrap_or(at))
    }
}

/// The path that starts at the first token.
fn path_at(tokens: &[Token]) -> Vec<String> {
    let mut path = Vec::new();
    let mut rest = tokens;
    while let [Token::Name(name), after @ ..] = rest {
        path.push(name.clone());
        match after {
            [Token::Path, next @ ..] if matches!(next.first(), Some(Token::Name(_))) => rest = next,
            _ => break,
        }
    }
    path
}

/// Whether the module that follows these tokens has `#[path = "..."]`: its file is another crate's,
/// and imports nothing of this one.
fn has_path(before: &[Token]) -> bool {
    let before = match before {
        [rest @ .., Token::Name(word)] if word == "pub" => rest,
        all => all,
    };
    matches!(
        before,
        [.., Token::Name(word), Token::Mark('='), Token::Literal, Token::Mark(']')] if word == "path"
    )
}

/// Adds the tree of a `use`, whose paths start with `prefix`.
fn add_use<'a>(
    module: &mut Module,
    tokens: &mut std::iter::Peekable<impl Iterator<Item = &'a Token>>,
    prefix: &[String],
) {
    let mut path = prefix.to_vec();
    while let Some(token) = tokens.next() {
        match token {
            Token::Name(name) if name == "as" => {
                if let Some(Token::Name(alias)) = tokens.next() {
                    add_import(module, path.clone(), alias);
                    path = prefix.to_vec();
                }
            }
            Token::Name(name) => path.push(name.clone()),
            Token::Path => {}
            Token::Mark('*') => {
                module.paths.insert(path.clone());
                module
                    .globs
                    .push(std::mem::replace(&mut path, prefix.to_vec()));
            }
            Token::Mark('{') => {
                add_use(module, tokens, &path);
                path = prefix.to_vec();
            }
            Token::Mark(mark @ (',' | '}')) => {
                if path.len() > prefix.len() {
                    let name = path[path.len() - 1].clone();
                    add_import(module, std::mem::replace(&mut path, prefix.to_vec()), &name);
                }
                if *mark == '}' {
                    return;
                }
            }
            Token::Mark(_) | Token::Literal => {}
        }
    }
    if path.len() > prefix.len() {
        let name = path[path.len() - 1].clone();
        add_import(module, path, &name);
    }
}

/// Adds the import of `path` under `name`; `self` is the module before it.
fn add_import(module: &mut Module, mut path: Vec<String>, name: &str) {
    if path.len() > 1 && path[path.len() - 1] == "self" {
        path.pop();
    }
    let name = match name {
        "self" => path[path.len() - 1].clone(),
        name => name.to_string(),
    };
    module.paths.insert(path.clone());
    // `use a;` of a child `a` or of a crate is no other name.
    if path != [name.clone()] {
        module.imports.insert(name, path);
    }
}
