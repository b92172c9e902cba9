//! The tree: the selected node, its statistics, and a slider of depths.

use super::colors;
use super::side_panel::{facts, short};
use crate::command::Command;
use crate::session::Session;
use crate::tree_walk::{NodeStatistics, Side};
use crate::view_picture::LEFT_COLOR;
use crate::view_picture::RIGHT_COLOR;
use egui::{RichText, Slider, Ui};
use kit::{Bvh, NodeKind};
use pathtracer::Accel;
use std::sync::Arc;

pub(super) fn show(ui: &mut Ui, session: &mut Session, commands: &mut Vec<Command>) {
    ui.heading("Tree");
    let Some(scene) = session.scene().map(Arc::clone) else {
        ui.weak("There is no scene.");
        return;
    };
    let Some(tree) = scene.bvh() else {
        ui.colored_label(
            colors::palette(ui).attention,
            "construct_bvh built no tree.",
        );
        return;
    };
    ui.horizontal(|ui| {
        for (label, command) in [
            ("Left child", Command::Descend(Side::Left)),
            ("Right child", Command::Descend(Side::Right)),
            ("Parent", Command::Ascend),
        ] {
            if ui.button(label).clicked() {
                commands.push(command);
            }
        }
    });
    let mut depth = session.walk().depth();
    let deepest = depth + session.node_statistics().map_or(0, |node| node.depth);
    let slider = Slider::new(&mut depth, 0..=deepest.max(1)).text("depth");
    if ui.add(slider).changed() {
        commands.push(Command::GoToDepth(depth));
    }
    if !session.wide_boxes().is_empty() {
        let wide = session.shows_wide_tree();
        if ui
            .selectable_label(wide, "Boxes of the wide tree (8)")
            .clicked()
        {
            commands.push(Command::ToggleWideTree);
        }
    }
    if let Some(node) = session.node_statistics() {
        statistics(ui, "node", &node, tree);
    }
    ui.horizontal(|ui| {
        for (color, name) in [
            (colors::of(LEFT_COLOR), "left"),
            (colors::of(RIGHT_COLOR), "right"),
            (colors::palette(ui).selected, "node"),
        ] {
            colors::dot(ui, color);
            ui.label(name);
        }
    });
    ui.separator();
    egui::CollapsingHeader::new("Whole tree")
        .default_open(true)
        .show(ui, |ui| {
            if let Some(root) = session.root_statistics() {
                statistics(ui, "root", &root, tree);
            }
            if let Accel::Simd(wide) = &scene.prepared.accel {
                ui.label(RichText::new("Wide tree, which pictures use").strong());
                facts(
                    ui,
                    "wide",
                    &[
                        ("nodes of 8", wide.node_count().to_string()),
                        ("blocks of 8", wide.block_count().to_string()),
                    ],
                );
            }
        });
}

fn statistics(ui: &mut Ui, id: &str, node: &NodeStatistics, tree: &Bvh) {
    let kind = match tree.nodes.get(node.node as usize).map(|node| node.kind) {
        Some(NodeKind::Leaf { count, .. }) => format!("leaf of {count}"),
        _ => "interior".to_owned(),
    };
    facts(
        ui,
        id,
        &[
            ("node", format!("{}, {kind}", node.node)),
            ("primitives", node.primitives.to_string()),
            ("nodes", format!("{}, {} leaves", node.nodes, node.leaves)),
            ("deepest", format!("{} below", node.depth)),
            ("largest leaf", node.largest_leaf.to_string()),
            ("SAH cost", format!("{:.2} tests", node.sah)),
            (
                "overlap",
                format!("{:.1} % of the area", 100.0 * node.overlap),
            ),
            ("from", short(node.bounds.min)),
            ("to", short(node.bounds.max)),
        ],
    );
}
