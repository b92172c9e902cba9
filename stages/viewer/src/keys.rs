//! All keys. One list is the help sheet, the input of the window, and what the tests go through.

use crate::command::Command;
use crate::session::Mode;
use crate::settings::Change;
use crate::tree_walk::Side;
use egui::Key;

/// A key and what it does.
#[derive(Clone, Debug)]
pub struct Binding {
    /// The key.
    pub key: Key,
    /// Whether Shift has to be held; `None` if it does not matter.
    pub shift: Option<bool>,
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
    pub fn is_pressed(&self, key: Key, shift: bool) -> bool {
        self.key == key && self.shift.is_none_or(|wanted| wanted == shift)
    }
}

/// The command of a key in a mode.
pub fn command(mode: Mode, key: Key, shift: bool) -> Option<Command> {
    let of_key = |binding: &Binding| binding.works_in(mode) && binding.is_pressed(key, shift);
    bindings()
        .into_iter()
        .find(of_key)
        .map(|binding| binding.command)
}

const ALL: &[Mode] = &[];
const CAMERA: &[Mode] = &[Mode::Edit, Mode::Bvh];
const BVH: &[Mode] = &[Mode::Bvh];
const EDIT: &[Mode] = &[Mode::Edit];
const RENDER: &[Mode] = &[Mode::Render];

/// All bindings, in the order of the help sheet.
///
/// In the assignment's program S, D, C and H mean other things in edit mode than in render mode.
/// Here every key has one meaning, in all modes where it does something.
pub fn bindings() -> Vec<Binding> {
    let bind = |key, label, modes, command, help| Binding {
        key,
        shift: None,
        label,
        modes,
        command,
        help,
    };
    let shifted = |shift, binding: Binding| Binding {
        shift: Some(shift),
        ..binding
    };
    use Command as C;
    vec![
        bind(Key::E, "E", ALL, C::Mode(Mode::Edit), "edit mode"),
        bind(Key::V, "V", ALL, C::Mode(Mode::Bvh), "BVH visualiser"),
        bind(Key::R, "R", ALL, C::Render, "render; again: start over"),
        bind(Key::Space, "Space", CAMERA, C::ResetView, "reset the view"),
        bind(Key::W, "W", CAMERA, C::ToggleEdges, "edges of triangles"),
        bind(
            Key::Z,
            "Z",
            EDIT,
            C::UndoMove,
            "undo the last move of a vertex",
        ),
        bind(
            Key::ArrowLeft,
            "Left",
            BVH,
            C::Descend(Side::Left),
            "to the left child",
        ),
        bind(
            Key::ArrowRight,
            "Right",
            BVH,
            C::Descend(Side::Right),
            "to the right child",
        ),
        bind(Key::ArrowUp, "Up", BVH, C::Ascend, "to the parent"),
        bind(
            Key::OpenBracket,
            "[",
            ALL,
            C::Samples(Change::Less),
            "half the camera rays",
        ),
        bind(
            Key::CloseBracket,
            "]",
            ALL,
            C::Samples(Change::More),
            "twice the camera rays",
        ),
        bind(
            Key::Minus,
            "-",
            ALL,
            C::LightSamples(Change::Less),
            "half the light samples",
        ),
        bind(
            Key::Equals,
            "= +",
            ALL,
            C::LightSamples(Change::More),
            "twice the light samples",
        ),
        bind(
            Key::Comma,
            ", <",
            ALL,
            C::Depth(Change::Less),
            "ray depth - 1",
        ),
        bind(
            Key::Period,
            ". >",
            ALL,
            C::Depth(Change::More),
            "ray depth + 1",
        ),
        bind(
            Key::H,
            "H",
            ALL,
            C::ToggleHemisphere,
            "sample the hemisphere",
        ),
        bind(
            Key::M,
            "M",
            ALL,
            C::ToggleMis,
            "multiple importance sampling",
        ),
        bind(Key::A, "A", ALL, C::ToggleAdaptive, "adaptive sampling"),
        bind(
            Key::U,
            "U",
            ALL,
            C::NextSampler,
            "next distribution of samples",
        ),
        bind(
            Key::C,
            "C",
            RENDER,
            C::ToggleCell,
            "cell mode: drag a rectangle",
        ),
        bind(Key::P, "P", RENDER, C::StopOrResume, "stop or resume"),
        bind(
            Key::O,
            "O",
            RENDER,
            C::AddSamples,
            "add as many samples again",
        ),
        bind(Key::T, "T", RENDER, C::ToggleRate, "samples of each pixel"),
        bind(
            Key::X,
            "X",
            RENDER,
            C::NextHeat,
            "heat map: boxes, primitives, off",
        ),
        bind(
            Key::G,
            "G",
            RENDER,
            C::GoToDearest,
            "inspect the dearest pixel",
        ),
        bind(
            Key::K,
            "K",
            RENDER,
            C::KeepForComparison,
            "keep the picture to compare",
        ),
        bind(
            Key::F,
            "F",
            RENDER,
            C::Flicker,
            "flicker between both pictures",
        ),
        bind(
            Key::I,
            "I",
            ALL,
            C::InspectUnderPointer,
            "inspect the pixel under the mouse",
        ),
        shifted(
            false,
            bind(
                Key::N,
                "N",
                ALL,
                C::StepTest { forward: true },
                "next test of the ray",
            ),
        ),
        shifted(
            false,
            bind(
                Key::B,
                "B",
                ALL,
                C::StepTest { forward: false },
                "previous test (back)",
            ),
        ),
        shifted(
            true,
            bind(
                Key::N,
                "Shift N",
                ALL,
                C::StepRay { forward: true },
                "next ray",
            ),
        ),
        shifted(
            true,
            bind(
                Key::B,
                "Shift B",
                ALL,
                C::StepRay { forward: false },
                "previous ray",
            ),
        ),
        bind(Key::Q, "Q", ALL, C::CloseInspector, "close the inspector"),
        bind(Key::S, "S", ALL, C::Screenshot, "save a screenshot"),
        bind(
            Key::D,
            "D",
            ALL,
            C::DumpCamera,
            "write the camera to a file for -c",
        ),
        bind(
            Key::Backtick,
            "`",
            ALL,
            C::ToggleOverlay,
            "text in the view",
        ),
        bind(Key::L, "L", ALL, C::ToggleTheme, "light or dark"),
        bind(Key::F5, "F5", ALL, C::Reload, "read the scene file again"),
        bind(Key::Questionmark, "?", ALL, C::ToggleHelp, "this sheet"),
        bind(Key::F1, "F1", ALL, C::ToggleHelp, "this sheet"),
        bind(
            Key::Escape,
            "Esc",
            ALL,
            C::Escape,
            "close the sheet, then the window",
        ),
    ]
}

/// Other keys that mean the same as a key of the list.
pub fn canonical(key: Key) -> Key {
    match key {
        Key::Plus => Key::Equals,
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
                    let both = [false, true]
                        .iter()
                        .any(|&shift| a.is_pressed(a.key, shift) && b.is_pressed(a.key, shift));
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
                .filter(|b| b.key == a.key && b.shift == a.shift)
            {
                assert_eq!(a.command, b.command, "{}", a.label);
            }
        }
    }
}
