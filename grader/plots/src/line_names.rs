//! Names at the right ends of lines, so that none covers another one.

use crate::canvas::{Canvas, Label, Position};

/// Distance of a name from the end of its line, in points.
const GAP: f64 = 8.0;

/// Height of a line of text, as a multiple of the font size.
const LINE: f64 = 1.25;

/// The name of a line.
#[derive(Clone)]
pub struct LineName {
    /// The right end of the line.
    pub end: Position,
    /// The lines of the text.
    pub text: Vec<String>,
    /// The text's size and colour; the lines below the first one are not bold.
    pub label: Label,
}

impl LineName {
    fn height(&self) -> f64 {
        self.text.len() as f64 * self.label.size * LINE + 2.0
    }
}

/// Draws the names, each as near to the end of its line as the others allow.
pub fn draw(canvas: &Canvas, mut names: Vec<LineName>) {
    names.sort_by(|a, b| a.end.1.total_cmp(&b.end.1));
    let middles = middles(&names);
    for (name, middle) in names.iter().zip(middles) {
        let step = name.label.size * LINE;
        let first = middle - 0.5 * step * (name.text.len() as f64 - 1.0);
        for (i, text) in name.text.iter().enumerate() {
            let bold = name.label.bold && i == 0;
            let label = Label { bold, ..name.label };
            canvas.text(text, (name.end.0 + GAP, first + step * i as f64), label);
        }
    }
}

/// The middles of names that are sorted by their ends. Groups of names that would overlap are
/// placed around the mean of their ends.
fn middles(names: &[LineName]) -> Vec<f64> {
    // Groups: sum of the distances that the top should have, and the names.
    let mut groups: Vec<(f64, Vec<usize>)> = Vec::new();
    let height = |group: &[usize]| group.iter().map(|&i| names[i].height()).sum::<f64>();
    let top = |(wanted, group): &(f64, Vec<usize>)| wanted / group.len() as f64;
    for (i, name) in names.iter().enumerate() {
        let mut group = (name.end.1 - 0.5 * name.height(), vec![i]);
        while let Some(above) = groups.last() {
            if top(above) + height(&above.1) <= top(&group) {
                break;
            }
            let (wanted, mut members) = groups.pop().expect("the last group");
            // The tops that the lower group wants for itself are those of the union, moved up.
            let moved = height(&members) * group.1.len() as f64;
            members.append(&mut group.1);
            group = (wanted + group.0 - moved, members);
        }
        groups.push(group);
    }
    let mut middles = Vec::new();
    for group in &groups {
        let mut y = top(group);
        for &i in &group.1 {
            middles.push(y + 0.5 * names[i].height());
            y += names[i].height();
        }
    }
    middles
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(ends: &[f64]) -> Vec<LineName> {
        let name = |&y: &f64| LineName {
            end: (0.0, y),
            text: vec!["a".into(), "b".into()],
            label: Label::left(8.0),
        };
        ends.iter().map(name).collect()
    }

    #[test]
    fn names_with_room_are_at_the_ends_of_their_lines() {
        assert_eq!(middles(&names(&[10.0, 60.0])), [10.0, 60.0]);
    }

    #[test]
    fn crowded_names_are_spread_around_their_ends_in_order() {
        // Each name is 22 points high.
        assert_eq!(middles(&names(&[50.0, 50.0])), [39.0, 61.0]);
        let crowd = middles(&names(&[40.0, 50.0, 51.0, 200.0]));
        assert!(
            crowd
                .windows(2)
                .all(|pair| pair[1] - pair[0] >= 22.0 - 1e-9)
        );
        assert!((crowd[..3].iter().sum::<f64>() - 141.0).abs() < 1e-9);
        assert_eq!(crowd[3], 200.0);
    }
}
