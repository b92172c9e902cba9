//! The colours of the window.
//!
//! The hues are those of Okabe and Ito ("Color Universal Design", 2008), as on the pages: people
//! without one kind of cones tell them apart. No difference is shown by colour alone: what is exact
//! has a ring, what is yours a cross, and the lines of the kinds of rays have patterns. A test
//! computes the contrasts, also as such people see them (Machado, Oliveira and Fernandes, "A
//! Physiologically-based Model for Simulation of Color Vision Deficiency", 2009).

use egui::{Color32, Context, Ui, Visuals};
use kit::Spectrum;
use pathtracer::RayRole;

/// The colours of a theme.
#[derive(Debug)]
pub(super) struct Palette {
    /// What is right, the exact answer.
    pub(super) right: Color32,
    /// What is wrong, the answer of the student's code.
    pub(super) wrong: Color32,
    /// What is not judged but worth a look, and what is under the mouse.
    pub(super) attention: Color32,
    /// The selected element or node. In the dark it is the assignment's program's (1, 0.25, 0),
    /// lighter.
    pub(super) selected: Color32,
    camera: Color32,
    bounce: Color32,
    shadow: Color32,
    light: Color32,
    /// The background of views and pictures.
    pub(super) backdrop: Color32,
    /// Lines on the background.
    pub(super) line: Color32,
    /// Text that is less important.
    weak: Color32,
    /// Text.
    text: Color32,
}

const fn rgb(hex: u32) -> Color32 {
    Color32::from_rgb((hex >> 16) as u8, (hex >> 8) as u8, hex as u8)
}

const DARK: Palette = Palette {
    right: rgb(0x2bc79a),
    wrong: rgb(0xff8c42),
    attention: rgb(0xf0e442),
    selected: rgb(0xff7040),
    camera: rgb(0x56b4e9),
    bounce: rgb(0xf0e442),
    shadow: rgb(0xe093c3),
    light: rgb(0xffffff),
    backdrop: rgb(0x202020),
    line: rgb(0x8a8a8a),
    weak: rgb(0xa8a8a8),
    text: rgb(0xc8c8c8),
};

const LIGHT: Palette = Palette {
    right: rgb(0x00694a),
    wrong: rgb(0xb54500),
    attention: rgb(0x5c4400),
    selected: rgb(0xc83200),
    camera: rgb(0x0069a8),
    bounce: rgb(0x5c4400),
    shadow: rgb(0xa3457f),
    light: rgb(0x222222),
    backdrop: rgb(0xf0f0f0),
    line: rgb(0x6a6a6a),
    weak: rgb(0x5a5a5a),
    text: rgb(0x303030),
};

impl Palette {
    /// The palette of a theme.
    pub(super) const fn of(is_dark: bool) -> &'static Palette {
        if is_dark { &DARK } else { &LIGHT }
    }

    /// The colour of a ray.
    pub(super) fn ray(&self, role: RayRole) -> Color32 {
        match role {
            RayRole::Camera => self.camera,
            RayRole::Bounce => self.bounce,
            RayRole::Shadow => self.shadow,
            RayRole::Light => self.light,
        }
    }
}

/// The pattern of a line: what colours say, for those who cannot tell them apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pattern {
    /// Without gaps.
    Solid,
    /// Long dashes.
    Dashed,
    /// Dots.
    Dotted,
}

impl Pattern {
    /// The lengths of a dash and of the gap after it, in points; `None` without gaps.
    pub(super) fn dash(self, width: f32) -> Option<[f32; 2]> {
        match self {
            Pattern::Solid => None,
            Pattern::Dashed => Some([9.0, 5.0]),
            Pattern::Dotted => Some([width.max(1.5), 3.5]),
        }
    }
}

/// The pattern of a ray's line.
pub(super) fn pattern(role: RayRole) -> Pattern {
    match role {
        RayRole::Camera | RayRole::Light => Pattern::Solid,
        RayRole::Bounce => Pattern::Dashed,
        RayRole::Shadow => Pattern::Dotted,
    }
}

/// The palette of the window's theme.
pub(super) fn palette(ui: &Ui) -> &'static Palette {
    Palette::of(ui.visuals().dark_mode)
}

/// Sets colours, spacing and text sizes.
pub(super) fn set_style(ctx: &Context) {
    for theme in [egui::Theme::Dark, egui::Theme::Light] {
        ctx.style_mut_of(theme, |style| {
            style.spacing.item_spacing = egui::vec2(6.0, 4.0);
            // Lists that scroll do not fade at their ends: text would lose its contrast.
            style.spacing.scroll.fade.strength = 0.0;
            let palette = Palette::of(theme == egui::Theme::Dark);
            set_text_colors(&mut style.visuals, palette);
        });
    }
}

fn set_text_colors(visuals: &mut Visuals, palette: &Palette) {
    visuals.widgets.noninteractive.fg_stroke.color = palette.text;
    visuals.weak_text_color = Some(palette.weak);
    // Disabled widgets are explained by the sentence that is shown over them.
    visuals.disabled_alpha = 0.75;
}

/// The background of views and pictures.
pub(super) fn backdrop(ui: &Ui) -> Color32 {
    palette(ui).backdrop
}

/// Lines on the background.
pub(super) fn line(ui: &Ui) -> Color32 {
    palette(ui).line
}

/// The colour of a spectrum whose channels are bytes over 255.
pub(super) fn of(color: Spectrum) -> Color32 {
    let [r, g, b] = color.to_array().map(|c| (255.0 * c) as u8);
    Color32::from_rgb(r, g, b)
}

/// A coloured dot in a line of text.
pub(super) fn dot(ui: &mut Ui, color: Color32) {
    let (rect, _) = ui.allocate_exact_size(egui::Vec2::splat(10.0), egui::Sense::hover());
    ui.painter().circle_filled(rect.center(), 4.0, color);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// How people with all cones, and without red, green and blue ones, see linear colours
    /// (Machado and others, severity 1).
    const EYES: [[[f64; 3]; 3]; 4] = [
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [
            [0.152286, 1.052583, -0.204868],
            [0.114503, 0.786281, 0.099216],
            [-0.003882, -0.048116, 1.051998],
        ],
        [
            [0.367322, 0.860646, -0.227968],
            [0.280085, 0.672501, 0.047413],
            [-0.011820, 0.042940, 0.968881],
        ],
        [
            [1.255528, -0.076749, -0.178779],
            [-0.078411, 0.930809, 0.147602],
            [0.004733, 0.691367, 0.303900],
        ],
    ];

    fn linear(color: Color32) -> [f64; 3] {
        let [r, g, b, _] = color.to_array();
        [r, g, b].map(|c| {
            let c = f64::from(c) / 255.0;
            match c <= 0.04045 {
                true => c / 12.92,
                false => ((c + 0.055) / 1.055).powf(2.4),
            }
        })
    }

    fn dot_product(a: [f64; 3], b: [f64; 3]) -> f64 {
        a.iter().zip(b).map(|(a, b)| a * b).sum()
    }

    fn luminance(color: Color32) -> f64 {
        dot_product([0.2126, 0.7152, 0.0722], linear(color))
    }

    /// The contrast of two colours, from 1 to 21 (WCAG 2.2).
    fn contrast(a: Color32, b: Color32) -> f64 {
        let (a, b) = (luminance(a), luminance(b));
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    /// CIE L*a*b* of a linear colour.
    fn lab(rgb: [f64; 3]) -> [f64; 3] {
        let f = |t: f64| match t > 0.008856 {
            true => t.cbrt(),
            false => 7.787 * t + 16.0 / 116.0,
        };
        let x = f(dot_product([0.4124, 0.3576, 0.1805], rgb) / 0.9505);
        let y = f(dot_product([0.2126, 0.7152, 0.0722], rgb));
        let z = f(dot_product([0.0193, 0.1192, 0.9505], rgb) / 1.089);
        [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
    }

    /// The smallest distance of two colours in L*a*b* (CIE 1976) to any of the eyes.
    fn smallest_distance(a: Color32, b: Color32) -> f64 {
        let seen = |eye: &[[f64; 3]; 3], color| {
            lab(eye.map(|row| dot_product(row, linear(color)).clamp(0.0, 1.0)))
        };
        let distances = EYES.iter().map(|eye| {
            let difference = [0, 1, 2].map(|i| seen(eye, a)[i] - seen(eye, b)[i]);
            dot_product(difference, difference).sqrt()
        });
        distances.fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn text_has_contrast_on_views_and_panels() {
        for is_dark in [true, false] {
            let palette = Palette::of(is_dark);
            let visuals = match is_dark {
                true => Visuals::dark(),
                false => Visuals::light(),
            };
            let Palette {
                right,
                wrong,
                attention,
                weak,
                text,
                ..
            } = *palette;
            for background in [palette.backdrop, visuals.panel_fill] {
                for color in [right, wrong, attention, weak, text] {
                    let contrast = contrast(color, background);
                    assert!(contrast >= 4.5, "{color:?} on {background:?}: {contrast}");
                }
                for color in [palette.selected, palette.line] {
                    let contrast = contrast(color, background);
                    assert!(contrast >= 3.0, "{color:?} on {background:?}: {contrast}");
                }
            }
            let selection = visuals.selection;
            let contrast = contrast(selection.stroke.color, selection.bg_fill);
            assert!(contrast >= 4.5, "selected text: {contrast}");
        }
    }

    /// A distance of 2 is just visible; at 20 nobody hesitates.
    #[test]
    fn compared_colors_differ_for_people_without_one_kind_of_cones() {
        for is_dark in [true, false] {
            let palette = Palette::of(is_dark);
            for (a, b) in [
                (palette.right, palette.wrong),
                (palette.camera, palette.bounce),
                (palette.bounce, palette.shadow),
                (palette.bounce, palette.light),
                (palette.attention, palette.right),
            ] {
                let distance = smallest_distance(a, b);
                assert!(distance >= 20.0, "{a:?} and {b:?}: {distance}");
            }
        }
        // The colours that the window had: the measure sees that they are alike.
        let distance = smallest_distance(rgb(0xe63c46), rgb(0x3cb45a));
        assert!(distance < 15.0, "{distance}");
    }
}
