//! Families of mistakes: every small slip that can be made in a piece of code.
//!
//! Each comparison is turned, each operand swapped or dropped, each constant halved, doubled or
//! negated, each coordinate and vertex replaced by the next, each early return and each update
//! forgotten. `grader mutants TASK --families` grades them and lists those that the diagnosis
//! cannot name.

use super::corpus::{Edit, Mutant, REFERENCE, Sources, Variant};
use std::collections::BTreeSet;
use std::ops::Range;
use std::path::{Path, PathBuf};
use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{BinOp, Expr, Lit, Member, RangeLimits, Stmt};

/// One slip: the bytes of the text that it replaces, and the new text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Slip {
    /// Which bytes of the text.
    pub at: Range<usize>,
    /// What stands there instead.
    pub with: String,
}

/// Names of which students take one for another: each is replaced by the next in its row.
const MIXED_UP: &[&[&str]] = &[
    &["x", "y", "z"],
    &["p0", "p1", "p2"],
    &["n0", "n1", "n2"],
    &["e0", "e1", "e2"],
    &["b0", "b1", "b2"],
    &["t0", "t1"],
    &["u", "v"],
    &["near", "far"],
    &["left", "right"],
    &["first", "second"],
    &["enter", "exit"],
    &["entry", "exit"],
    &["lo", "hi"],
    &["min", "max"],
    &["min_t", "max_t"],
    &["o", "d"],
    &["n", "ng"],
    &["wo", "wi"],
    &["sin", "cos"],
    &["sum", "sum_sq"],
    &["sum", "squares"],
    &["width", "height"],
    &["w", "h"],
    &["cos_i", "cos_t"],
    &["floor", "ceil"],
    &["pdf", "f"],
    &["reflectance", "transmittance"],
];

/// Methods that students forget to call.
const FORGOTTEN: &[&str] = &[
    "abs",
    "normalize",
    "normalize_or_zero",
    "sqrt",
    "to_radians",
    "recip",
    "length",
    "clamp",
    "max",
    "min",
];

/// With this many variants, the reference is left out: students do not write its exact arithmetic.
const ENOUGH_VARIANTS: usize = 3;

/// A mutant for each slip in the variants of the solution of the task with this key; also in the
/// reference if there are few variants.
pub fn mutants(key: &str, reference: &Sources, variants: &[&Variant]) -> Vec<Mutant> {
    let mut mutants = Vec::new();
    let few = variants.len() < ENOUGH_VARIANTS;
    for text in reference.values().filter(|_| few) {
        mutants.extend(edited(REFERENCE, text, &solutions(key, text), reference));
    }
    for variant in variants {
        let only = Sources::from([(PathBuf::from("lib.rs"), variant.text.clone())]);
        let text = &only[Path::new("lib.rs")];
        let all = 0..text.len();
        mutants.extend(edited(
            &variant.name,
            text,
            std::slice::from_ref(&all),
            &only,
        ));
    }
    // Some slips come to the same text.
    let mut seen = BTreeSet::new();
    mutants.retain(|mutant| seen.insert(mutant.mistakes.clone()));
    mutants
}

/// The parts of a stage's source that a handout leaves out for the task with this key.
fn solutions(key: &str, text: &str) -> Vec<Range<usize>> {
    let [begin, end] = ["BEGIN", "END"].map(|word| format!("// {word} SOLUTION({key})"));
    let starts = text.match_indices(&begin);
    let range = |(start, _): (usize, &str)| Some(start..start + text[start..].find(&end)?);
    starts.filter_map(range).collect()
}

/// The mutants of one file of `sources` for its slips within these ranges. They are named by the
/// code before and after.
fn edited(on: &str, text: &str, within: &[Range<usize>], sources: &Sources) -> Vec<Mutant> {
    let slips = slips(text, within).into_iter();
    let of_slip = |slip: Slip| {
        let edit = edit(text, &slip, sources)?;
        let [before, after] = changed_lines(text, &slip);
        (before != after).then(|| Mutant {
            mistakes: vec![format!("{before} => {after}")],
            on: on.into(),
            edits: vec![edit],
            ..Mutant::default()
        })
    };
    slips.filter_map(of_slip).collect()
}

/// The lines that a slip changes, before and after, without indentation.
fn changed_lines(text: &str, slip: &Slip) -> [String; 2] {
    let lines = whole_lines(text, slip.at.clone());
    let (head, tail) = (
        &text[lines.start..slip.at.start],
        &text[slip.at.end..lines.end],
    );
    let before = text[lines.clone()].to_string();
    let after = [head, slip.with.as_str(), tail].concat();
    [before, after].map(|text| text.split_whitespace().collect::<Vec<_>>().join(" "))
}

/// The edit that makes a slip. Its text is extended to whole lines, and by lines before and after,
/// until it occurs once in `sources`. `None` if it never does.
fn edit(text: &str, slip: &Slip, sources: &Sources) -> Option<Edit> {
    let mut at = whole_lines(text, slip.at.clone());
    loop {
        let find = &text[at.clone()];
        let found = sources.values().map(|text| text.matches(find).count());
        if found.sum::<usize>() == 1 {
            let (head, tail) = (&text[at.start..slip.at.start], &text[slip.at.end..at.end]);
            return Some(Edit {
                find: find.into(),
                replace: [head, slip.with.as_str(), tail].concat(),
                ..Edit::default()
            });
        }
        let wider = whole_lines(
            text,
            at.start.saturating_sub(1)..(at.end + 1).min(text.len()),
        );
        if wider == at {
            return None;
        }
        at = wider;
    }
}

/// `at`, extended to whole lines, without the last line break.
fn whole_lines(text: &str, at: Range<usize>) -> Range<usize> {
    let start = text[..at.start].rfind('\n').map_or(0, |i| i + 1);
    let end = text[at.end..].find('\n').map_or(text.len(), |i| at.end + i);
    start..end
}

/// All slips in the Rust source `text` that lie within one of the byte ranges `within`. Empty if
/// the text is not Rust.
pub fn slips(text: &str, within: &[Range<usize>]) -> Vec<Slip> {
    let Ok(file) = syn::parse_file(text) else {
        return Vec::new();
    };
    let is_letter = |c: char| c.is_alphanumeric() || c == '_';
    let mut found = Found {
        text,
        identifiers: text.split(|c| !is_letter(c)).collect(),
        slips: Vec::new(),
    };
    found.visit_file(&file);
    let inside = |at: &Range<usize>| {
        let mut ranges = within.iter();
        ranges.any(|range| range.start <= at.start && at.end <= range.end)
    };
    found.slips.retain(|slip| inside(&slip.at));
    found.slips
}

struct Found<'a> {
    text: &'a str,
    identifiers: BTreeSet<&'a str>,
    slips: Vec<Slip>,
}

impl Found<'_> {
    fn add(&mut self, at: impl Spanned, with: impl Into<String>) {
        self.slips.push(Slip {
            at: at.span().byte_range(),
            with: with.into(),
        });
    }

    fn text(&self, of: impl Spanned) -> String {
        self.text[of.span().byte_range()].to_string()
    }

    fn swap(&mut self, whole: impl Spanned, a: impl Spanned, b: impl Spanned) {
        let [whole, a, b] = [whole.span(), a.span(), b.span()].map(|span| span.byte_range());
        let part = |range: Range<usize>| &self.text[range];
        let with = [
            part(whole.start..a.start),
            part(b.clone()),
            part(a.end..b.start),
            part(a.clone()),
            part(b.end..whole.end),
        ];
        let with = with.concat();
        self.slips.push(Slip { at: whole, with });
    }

    fn mix_up(&mut self, name: &syn::Ident) {
        let text = name.to_string();
        for row in MIXED_UP {
            if let Some(i) = row.iter().position(|other| *other == text) {
                let next = row[(i + 1) % row.len()];
                if self.identifiers.contains(next) {
                    self.add(name, next);
                }
            }
        }
    }
}

/// What students write instead of an operator.
fn instead_of(op: &BinOp) -> &'static [&'static str] {
    match op {
        BinOp::Add(_) => &["-"],
        BinOp::Sub(_) => &["+"],
        BinOp::Mul(_) => &["/"],
        BinOp::Div(_) => &["*"],
        BinOp::Lt(_) => &["<=", ">"],
        BinOp::Le(_) => &["<", ">="],
        BinOp::Gt(_) => &[">=", "<"],
        BinOp::Ge(_) => &[">", "<="],
        BinOp::Eq(_) => &["!="],
        BinOp::Ne(_) => &["=="],
        BinOp::And(_) => &["||"],
        BinOp::Or(_) => &["&&"],
        BinOp::AddAssign(_) => &["=", "-="],
        BinOp::SubAssign(_) => &["=", "+="],
        BinOp::MulAssign(_) => &["=", "/=", "+="],
        BinOp::DivAssign(_) => &["=", "*="],
        _ => &[],
    }
}

impl<'ast> Visit<'ast> for Found<'_> {
    fn visit_expr_binary(&mut self, expr: &'ast syn::ExprBinary) {
        for op in instead_of(&expr.op) {
            self.add(expr.op, *op);
        }
        match expr.op {
            BinOp::Sub(_) | BinOp::Div(_) => self.swap(expr, &expr.left, &expr.right),
            BinOp::And(_) | BinOp::Or(_) | BinOp::Mul(_) | BinOp::Add(_) => {}
            _ => return visit::visit_expr_binary(self, expr),
        }
        // Either operand is forgotten.
        let [left, right] = [self.text(&expr.left), self.text(&expr.right)];
        self.add(expr, left);
        self.add(expr, right);
        visit::visit_expr_binary(self, expr);
    }

    fn visit_expr_unary(&mut self, expr: &'ast syn::ExprUnary) {
        if !matches!(expr.op, syn::UnOp::Deref(_)) {
            let operand = self.text(&expr.expr);
            self.add(expr, operand);
        }
        visit::visit_expr_unary(self, expr);
    }

    fn visit_expr_lit(&mut self, expr: &'ast syn::ExprLit) {
        match &expr.lit {
            Lit::Float(number) => {
                let number = self.text(number);
                if number == "0.0" {
                    self.add(expr, "1.0");
                    self.add(expr, "1e-3");
                } else {
                    for with in ["2.0 *", "0.5 *", "-"] {
                        self.add(expr, format!("({with} {number})"));
                    }
                }
            }
            Lit::Int(number) => {
                let number = self.text(number);
                self.add(expr, format!("({number} + 1)"));
                if number != "0" {
                    self.add(expr, format!("({number} - 1)"));
                }
            }
            Lit::Bool(value) => self.add(expr, (!value.value).to_string()),
            _ => {}
        }
    }

    fn visit_expr_path(&mut self, expr: &'ast syn::ExprPath) {
        if let Some(name) = expr.path.get_ident() {
            self.mix_up(name);
            if name == "INFINITY" {
                self.add(expr, "1e3");
            }
        }
    }

    fn visit_expr_field(&mut self, expr: &'ast syn::ExprField) {
        if let Member::Named(name) = &expr.member {
            self.mix_up(name);
        }
        visit::visit_expr_field(self, expr);
    }

    fn visit_expr_method_call(&mut self, expr: &'ast syn::ExprMethodCall) {
        let name = expr.method.to_string();
        self.mix_up(&expr.method);
        if FORGOTTEN.contains(&name.as_str()) {
            let receiver = self.text(&expr.receiver);
            self.add(expr, receiver);
        }
        if name == "cross" && expr.args.len() == 1 {
            self.swap(expr, &expr.receiver, &expr.args[0]);
        }
        if ["max", "min"].contains(&name.as_str()) && expr.args.len() == 1 {
            let argument = self.text(&expr.args[0]);
            self.add(expr, argument);
        }
        for i in 1..expr.args.len() {
            self.swap(expr, &expr.args[i - 1], &expr.args[i]);
        }
        visit::visit_expr_method_call(self, expr);
    }

    fn visit_expr_call(&mut self, expr: &'ast syn::ExprCall) {
        for i in 1..expr.args.len() {
            self.swap(expr, &expr.args[i - 1], &expr.args[i]);
        }
        if self.text(&expr.func) == "Some" {
            self.add(expr, "None");
        }
        visit::visit_expr_call(self, expr);
    }

    fn visit_expr_array(&mut self, expr: &'ast syn::ExprArray) {
        for i in 1..expr.elems.len() {
            self.swap(expr, &expr.elems[i - 1], &expr.elems[i]);
        }
        visit::visit_expr_array(self, expr);
    }

    fn visit_expr_if(&mut self, expr: &'ast syn::ExprIf) {
        if !matches!(*expr.cond, Expr::Let(_)) {
            self.add(&expr.cond, "true");
            self.add(&expr.cond, "false");
        }
        visit::visit_expr_if(self, expr);
    }

    fn visit_expr_range(&mut self, expr: &'ast syn::ExprRange) {
        if expr.end.is_some() {
            let other = match expr.limits {
                RangeLimits::HalfOpen(_) => "..=",
                RangeLimits::Closed(_) => "..",
            };
            self.add(expr.limits, other);
        }
        visit::visit_expr_range(self, expr);
    }

    fn visit_expr_struct(&mut self, expr: &'ast syn::ExprStruct) {
        for field in &expr.fields {
            let value = self.text(&field.expr);
            if field.colon_token.is_some() && value != "0.0" {
                let name = self.text(&field.member);
                self.add(field, format!("{name}: Default::default()"));
            }
        }
        visit::visit_expr_struct(self, expr);
    }

    fn visit_stmt(&mut self, stmt: &'ast Stmt) {
        // An update is forgotten.
        if let Stmt::Expr(expr, Some(_)) = stmt {
            let is_update = match expr {
                Expr::Assign(_) | Expr::MethodCall(_) | Expr::Call(_) => true,
                Expr::Break(_) | Expr::Continue(_) => true,
                Expr::Binary(binary) => !instead_of(&binary.op).is_empty(),
                _ => false,
            };
            if is_update {
                self.add(stmt, "");
            }
        }
        visit::visit_stmt(self, stmt);
    }

    fn visit_item_mod(&mut self, item: &'ast syn::ItemMod) {
        // Tests make no mistakes.
        if item.ident != "tests" {
            visit::visit_item_mod(self, item);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every text that differs from `text` by one slip.
    fn mistaken(text: &str) -> Vec<String> {
        let all = 0..text.len();
        let slips = slips(text, std::slice::from_ref(&all)).into_iter();
        let replaced = slips.map(|Slip { at, with }| {
            let mut text = text.to_string();
            text.replace_range(at, &with);
            text
        });
        replaced.collect()
    }

    #[test]
    fn a_comparison_is_turned_and_a_bound_left_out() {
        let found = mistaken("fn f(a: f64, u: f64) -> bool { a <= 1.5 && u > a + v }");
        for body in [
            "a < 1.5 && u > a + v",
            "a >= 1.5 && u > a + v",
            "a <= 1.5 || u > a + v",
            "u > a + v",
            "a <= 1.5",
            "a <= (0.5 * 1.5) && u > a + v",
            "a <= 1.5 && v > a + v",
        ] {
            let text = format!("fn f(a: f64, u: f64) -> bool {{ {body} }}");
            assert!(found.contains(&text), "{body}: {found:#?}");
        }
    }

    #[test]
    fn operands_are_swapped_and_updates_forgotten() {
        let found = mistaken("fn f(a: V, b: V) { r.t = a.x - g(a.cross(b), c); }");
        for body in [
            "r.t = g(a.cross(b), c) - a.x;",
            "r.t = a.x - g(b.cross(a), c);",
            "r.t = a.x - g(c, a.cross(b));",
            "",
        ] {
            let text = format!("fn f(a: V, b: V) {{ {body} }}");
            assert!(found.contains(&text), "{body}: {found:#?}");
        }
    }

    #[test]
    fn only_the_given_places_are_changed() {
        let text = "fn f() { a + b; } fn g() { c + d; }";
        let second = 18..text.len();
        assert!(
            slips(text, std::slice::from_ref(&second))
                .iter()
                .all(|slip| slip.at.start >= 18)
        );
    }
}
