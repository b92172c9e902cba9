//! All keys. One list is the help sheet, the input of the window, and what the tests go through.

use crate::command::Command;
use crate::element_walk::ElementKind;
use crate::session::Mode;
use crate::settings::Change;
use crate::tree_walk::Side;
use egui::{Key, Modifiers};
use kit::Vec2;

/// The keys that are held beside another one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Held {
    /// Shift or none: it does not matter.
    Any,
    /// None.
    Nothing,
    /// Shift.
    Shift,
    /// Alt.
    Alt,
    /// Shift and Alt.
    ShiftAlt,
    /// Ctrl.
    Ctrl,
}

impl Held {
    /// The held keys that this stands for.
    pub fn modifiers(self) -> Modifiers {
        match self {
            Held::Any | Held::Nothing => Modifiers::NONE,
            Held::Shift => Modifiers::SHIFT,
            Held::Alt => Modifiers::ALT,
            Held::ShiftAlt => Modifiers::SHIFT.plus(Modifiers::ALT),
            Held::Ctrl => Modifiers::CTRL,
        }
    }

    fn fits(self, modifiers: Modifiers) -> bool {
        let held = [modifiers.shift, modifiers.alt, modifiers.ctrl];
        match self {
            Held::Any => [false, false] == held[1..],
            Held::Nothing => held == [false, false, false],
            Held::Shift => held == [true, false, false],
            Held::Alt => held == [false, true, false],
            Held::ShiftAlt => held == [true, true, false],
            Held::Ctrl => held == [false, false, true],
        }
    }
}

/// A key and what it does.
#[derive(Clone, Debug)]
pub struct Binding {
    /// The key.
    pub key: Key,
    /// What is held beside it.
    pub held: Held,
    /// The key on the help sheet.
    pub label: &'static str,
    /// The modes in which it works; empty for all.
    pub modes: &'static [Mode],
    /// The command.
    pub command: Command,
    /// What it does, for the help sheet.
    pub help: &'static str,
}

impl Binding {
    /// Whether the key works in `mode`.
    pub fn works_in(&self, mode: Mode) -> bool {
        self.modes.is_empty() || self.modes.contains(&mode)
    }

    /// Whether a press of `key` is this one.
    pub fn is_pressed(&self, key: Key, modifiers: Modifiers) -> bool {
        self.key == key && self.held.fits(modifiers)
    }
}

/// The command of a key in a mode.
pub fn command(mode: Mode, key: Key, modifiers: Modifiers) -> Option<Command> {
    let of_key = |binding: &Binding| binding.works_in(mode) && binding.is_pressed(key, modifiers);
    bindings()
        .into_iter()
        .find(of_key)
        .map(|binding| binding.command)
}

const ALL: &[Mode] = &[];
const CAMERA: &[Mode] = &[Mode::Edit, Mode::Bvh];
const VIEWS: &[Mode] = &[Mode::Edit, Mode::Bvh, Mode::Render];
const BVH: &[Mode] = &[Mode::Bvh];
const TREE: &[Mode] = &[Mode::Bvh, Mode::Report];
const EDIT: &[Mode] = &[Mode::Edit];
const RENDER: &[Mode] = &[Mode::Render];
const REPORT: &[Mode] = &[Mode::Report];
const PAIRS: &[Mode] = &[Mode::Render, Mode::Report];

/// The share of the view that a key rotates, pans or moves a vertex by.
const KEY_STEP: f64 = 0.04;
/// The share of the view that a key moves a vertex by.
const VERTEX_STEP: f64 = 0.01;

/// One line for each key: what is held, the key, its name on the help sheet, the modes in which it
/// works, the command, and what it does.
macro_rules! keys {
    ($($held:ident $key:ident $label:literal $modes:ident $command:expr => $help:literal;)*) => {
        vec![$(Binding {
            key: Key::$key,
            held: Held::$held,
            label: $label,
            modes: $modes,
            command: $command,
            help: $help,
        },)*]
    };
}

/// All bindings, in the order of the help sheet.
///
/// In the assignment's program S, D, C and H mean other things in edit mode than in render mode.
/// Here every key has one meaning, in all modes where it does something.
pub fn bindings() -> Vec<Binding> {
    use Command as C;
    let mut bindings = keys![
        Any E "E" ALL C::Mode(Mode::Edit) => "edit mode";
        Any V "V" ALL C::Mode(Mode::Bvh) => "BVH visualiser";
        Any R "R" ALL C::Render => "render; again: start over";
        Any Y "Y" ALL C::ShowReport => "report; again: its pictures";
        Any Space "Space" CAMERA C::ResetView => "reset the view";
        Nothing Num1 "1" EDIT select(ElementKind::Vertex, true) => "next vertex; Shift: previous";
        Shift Num1 "" EDIT select(ElementKind::Vertex, false) => "";
        Nothing Num2 "2" EDIT select(ElementKind::Edge, true) => "next edge; Shift: previous";
        Shift Num2 "" EDIT select(ElementKind::Edge, false) => "";
        Nothing Num3 "3" EDIT select(ElementKind::Face, true) => "next face; Shift: previous";
        Shift Num3 "" EDIT select(ElementKind::Face, false) => "";
        Any PageUp "Page Up" ALL C::Zoom(1.0) => "nearer";
        Any PageDown "Page Down" ALL C::Zoom(-1.0) => "farther";
        Any W "W" CAMERA C::ToggleEdges => "edges of triangles";
        Nothing Num5 "5" VIEWS C::NextCut => "cut open at x, y, z; Shift: other side";
        Shift Num5 "" VIEWS C::FlipCut => "";
        Nothing Z "Z" EDIT C::UndoMove => "undo the last move; Shift: redo";
        Shift Z "" EDIT C::RedoMove => "";
        Ctrl Z "" EDIT C::UndoMove => "";
        Ctrl Y "" EDIT C::RedoMove => "";
        Nothing ArrowLeft "Left" TREE C::Descend(Side::Left) => "to the left child";
        Nothing ArrowRight "Right" TREE C::Descend(Side::Right) => "to the right child";
        Nothing ArrowUp "Up" TREE C::Ascend => "to the parent";
        Any OpenBracket "[" ALL C::Samples(Change::Less) => "half the camera rays";
        Any CloseBracket "]" ALL C::Samples(Change::More) => "twice the camera rays";
        Any Minus "-" ALL C::LightSamples(Change::Less) => "half the light samples";
        Any Equals "= +" ALL C::LightSamples(Change::More) => "twice the light samples";
        Any Comma ", <" ALL C::Depth(Change::Less) => "ray depth - 1";
        Any Period ". >" ALL C::Depth(Change::More) => "ray depth + 1";
        Any H "H" ALL C::ToggleHemisphere => "sample the hemisphere";
        Any M "M" ALL C::ToggleMis => "multiple importance sampling";
        Any A "A" ALL C::ToggleAdaptive => "adaptive sampling";
        Any U "U" ALL C::NextSampler => "next distribution of samples";
        Any C "C" RENDER C::ToggleCell => "cell mode: drag a rectangle";
        Any P "P" RENDER C::StopOrResume => "stop or resume";
        Any O "O" RENDER C::AddSamples => "add as many samples again";
        Any T "T" RENDER C::ToggleRate => "samples of each pixel";
        Any X "X" RENDER C::NextHeat => "heat map: boxes, primitives, off";
        Any Num6 "6" RENDER C::ToggleFalseColor => "false colours: the luminance";
        Any G "G" RENDER C::GoToCostliest => "inspect the costliest pixel";
        Any K "K" RENDER C::KeepForComparison => "keep the picture to compare";
        Any F "F" PAIRS C::Flicker => "flicker between both pictures";
        Any J "J" PAIRS C::NextPairView => "wipe, flicker, A, B, difference";
        Any Num8 "8" BVH C::ToggleWideTree => "boxes of the wide tree, of the binary one";
        Any Num9 "9" RENDER C::NextCompared => "compare with the next kept picture";
        Any Num0 "0" RENDER C::SwapCompared => "swap both pictures";
        Any Enter "Enter" REPORT C::NeighbourCase { forward: true } => "next case";
        Any Backspace "Backspace" REPORT C::NeighbourCase { forward: false } => "previous case";
        Any I "I" ALL C::InspectUnderPointer => "inspect the pixel under the mouse";
        Nothing N "N" ALL C::StepTest { forward: true } => "next test of the ray";
        Nothing B "B" ALL C::StepTest { forward: false } => "previous test (back)";
        Shift N "Shift N" ALL C::StepRay { forward: true } => "next ray";
        Shift B "Shift B" ALL C::StepRay { forward: false } => "previous ray";
        Any Q "Q" ALL C::CloseInspector => "close the inspector";
        Any S "S" ALL C::Screenshot => "save a screenshot";
        Nothing Num4 "4" ALL C::KeepCamera => "keep the camera; Shift: to the next kept";
        Shift Num4 "" ALL C::NextKeptCamera => "";
        Ctrl O "Ctrl O" ALL C::ChooseFile => "open a scene, a picture, a camera";
        Ctrl S "Ctrl S" ALL C::SaveScene => "save the scene as another file";
        Any D "D" ALL C::DumpCamera => "write the camera to a file for -c";
        Any Backtick "`" ALL C::ToggleOverlay => "text in the view";
        Any L "L" ALL C::ToggleTheme => "light or dark";
        Any F5 "F5" ALL C::Reload => "read the scene file again";
        Any Questionmark "?" ALL C::ToggleHelp => "this sheet";
        Any F1 "F1" ALL C::ToggleHelp => "this sheet";
        Any Escape "Esc" ALL C::Escape => "close the sheet, then the window";
    ];
    bindings.extend(arrows());
    bindings
}

fn select(kind: ElementKind, forward: bool) -> Command {
    Command::SelectNext { kind, forward }
}

/// The arrow keys with others held: one line of the help sheet for each of the four.
fn arrows() -> impl Iterator<Item = Binding> {
    type Step = fn(Vec2) -> Command;
    let kinds: [(Held, &str, &str, &'static [Mode], Step); 4] = [
        (Held::Shift, "Shift Arrows", "rotate the view", ALL, |by| {
            Command::Orbit(KEY_STEP * by)
        }),
        (Held::Alt, "Alt Arrows", "move the view", ALL, |by| {
            Command::Pan(KEY_STEP * by)
        }),
        (
            Held::ShiftAlt,
            "Shift Alt Arrows",
            "move the selected vertex",
            EDIT,
            |by| Command::NudgeVertex(VERTEX_STEP * by),
        ),
        (
            Held::Ctrl,
            "Ctrl Arrows",
            "replay the next pixel",
            RENDER,
            |by| Command::InspectNext(by.x as i32, by.y as i32),
        ),
    ];
    let directions = [
        (Key::ArrowLeft, Vec2::new(-1.0, 0.0)),
        (Key::ArrowRight, Vec2::new(1.0, 0.0)),
        (Key::ArrowUp, Vec2::new(0.0, 1.0)),
        (Key::ArrowDown, Vec2::new(0.0, -1.0)),
    ];
    kinds
        .into_iter()
        .flat_map(move |(held, label, help, modes, command)| {
            directions
                .into_iter()
                .enumerate()
                .map(move |(i, (key, by))| Binding {
                    key,
                    held,
                    label: if i == 0 { label } else { "" },
                    modes,
                    command: command(by),
                    help,
                })
        })
}

/// The key of the list that a pressed key stands for. With Shift the window gets some keys by the
/// sign that they write.
pub fn canonical(key: Key) -> Key {
    match key {
        Key::Plus => Key::Equals,
        Key::Exclamationmark => Key::Num1,
        Key::OpenCurlyBracket => Key::OpenBracket,
        Key::CloseCurlyBracket => Key::CloseBracket,
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HELD: [Held; 6] = [
        Held::Any,
        Held::Nothing,
        Held::Shift,
        Held::Alt,
        Held::ShiftAlt,
        Held::Ctrl,
    ];

    #[test]
    fn no_key_means_two_things_in_one_mode() {
        for mode in Mode::ALL {
            let bindings = bindings();
            for (i, a) in bindings
                .iter()
                .enumerate()
                .filter(|(_, b)| b.works_in(mode))
            {
                for b in bindings[i + 1..].iter().filter(|b| b.works_in(mode)) {
                    let both = HELD.iter().any(|held| {
                        let modifiers = held.modifiers();
                        a.is_pressed(a.key, modifiers) && b.is_pressed(a.key, modifiers)
                    });
                    assert!(!both, "{} and {} clash in {mode:?}", a.help, b.help);
                }
            }
        }
    }

    #[test]
    fn no_key_means_different_things_in_different_modes() {
        let bindings = bindings();
        for a in &bindings {
            for b in bindings
                .iter()
                .filter(|b| b.key == a.key && b.held == a.held)
            {
                assert_eq!(a.command, b.command, "{}", a.label);
            }
        }
    }
}
