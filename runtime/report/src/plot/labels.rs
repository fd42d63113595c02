//! Placement of the names of curves next to their ends, without overlaps.

/// A rectangle in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Area {
    pub left: f64,
    pub top: f64,
    pub right: f64,
    pub bottom: f64,
}

impl Area {
    fn overlaps(&self, other: &Self) -> bool {
        self.left < other.right
            && other.left < self.right
            && self.top < other.bottom
            && other.top < self.bottom
    }

    fn holds(&self, (x, y): (f64, f64)) -> bool {
        (self.left..=self.right).contains(&x) && (self.top..=self.bottom).contains(&y)
    }

    fn is_within(&self, other: &Self) -> bool {
        self.left >= other.left
            && self.right <= other.right
            && self.top >= other.top
            && self.bottom <= other.bottom
    }
}

/// The height of a line of text.
pub const HEIGHT: f64 = 13.0;

/// An upper estimate of the width of a text of height [`HEIGHT`]; font metrics are not available.
pub fn width(text: &str) -> f64 {
    6.6 * text.chars().count() as f64
}

/// Largest distance to the left of the column of curve ends that are labelled in the column.
const REACH: f64 = 104.0;

/// Places texts near their points, inside `frame`. Texts of points within [`REACH`] of `column` are placed in a column
/// that begins there, ordered like the points. All other texts are placed near their points; overlaps with other texts,
/// with `taken` areas and with `curves` are avoided by penalties.
pub fn place(
    labels: &[(&str, (f64, f64))],
    curves: &[Vec<(f64, f64)>],
    taken: &[Area],
    frame: &Area,
    column: f64,
) -> Vec<Area> {
    let obstacles: Vec<(f64, f64)> = curves.iter().flat_map(|curve| samples(curve)).collect();
    let mut placed: Vec<Option<Area>> = vec![None; labels.len()];
    let in_column = |index: &usize| labels[*index].1.0 > column - REACH;
    let mut indices: Vec<usize> = (0..labels.len()).filter(in_column).collect();
    indices.sort_by(|&a, &b| labels[a].1.1.total_cmp(&labels[b].1.1));
    let wanted: Vec<f64> = indices.iter().map(|&index| labels[index].1.1).collect();
    let middles = spread(&wanted, HEIGHT + 1.0, (frame.top, frame.bottom));
    for (index, middle) in indices.into_iter().zip(middles) {
        placed[index] = Some(Area {
            left: column,
            top: middle - HEIGHT / 2.0,
            right: column + width(labels[index].0),
            bottom: middle + HEIGHT / 2.0,
        });
    }
    // From top to bottom, so that labels keep the order of their points.
    let mut order: Vec<usize> = (0..labels.len())
        .filter(|index| !in_column(index))
        .collect();
    order.sort_by(|&a, &b| labels[a].1.1.total_cmp(&labels[b].1.1));
    for index in order {
        let (text, point) = labels[index];
        let cost = |candidate: &Area| {
            let texts = placed
                .iter()
                .flatten()
                .chain(taken)
                .filter(|other| candidate.overlaps(other))
                .count();
            let outside = u32::from(!candidate.is_within(frame));
            let covered = obstacles.iter().filter(|at| candidate.holds(**at)).count();
            1e4 * texts as f64
                + 1e5 * f64::from(outside)
                + 4.0 * covered as f64
                + distance(candidate, point)
        };
        let best = candidates(width(text), point)
            .map(|candidate| (cost(&candidate), candidate))
            .min_by(|a, b| a.0.total_cmp(&b.0));
        placed[index] = best.map(|(_, area)| area);
    }
    placed.into_iter().flatten().collect()
}

/// Ascending values at least `gap` apart, closest to the ascending `wanted` values in least squares, and inside the
/// range if there is room.
fn spread(wanted: &[f64], gap: f64, (low, high): (f64, f64)) -> Vec<f64> {
    // Groups of touching neighbours: their number, and the sum of the positions of the first member that each member
    // wants.
    let mut groups: Vec<(usize, f64)> = Vec::new();
    for &value in wanted {
        let mut group = (1, value);
        while let Some(&(count, sum)) = groups.last() {
            let end = sum / count as f64 + gap * count as f64;
            if end <= group.1 / group.0 as f64 {
                break;
            }
            groups.pop();
            group = (
                count + group.0,
                sum + group.1 - gap * (count * group.0) as f64,
            );
        }
        groups.push(group);
    }
    let mut values: Vec<f64> = groups
        .into_iter()
        .flat_map(|(count, sum)| (0..count).map(move |k| sum / count as f64 + gap * k as f64))
        .collect();
    // Values outside the range are pushed in, together with their neighbours.
    let mut limit = low + gap / 2.0;
    for value in &mut values {
        *value = value.max(limit);
        limit = *value + gap;
    }
    let mut limit = high - gap / 2.0;
    for value in values.iter_mut().rev() {
        *value = value.min(limit);
        limit = *value - gap;
    }
    values
}

/// Candidate areas around a point, those to its right first.
fn candidates(width: f64, (x, y): (f64, f64)) -> impl Iterator<Item = Area> {
    let lefts = [x + 8.0, x + 20.0, x - width / 2.0, x - 8.0 - width];
    lefts.into_iter().flat_map(move |left| {
        (0..=60).map(move |k| {
            // 0, −4, 4, −8, 8, …
            let shift = 4.0 * f64::from((k + 1) / 2) * if k % 2 == 0 { 1.0 } else { -1.0 };
            let middle = y + shift;
            Area {
                left,
                top: middle - HEIGHT / 2.0,
                right: left + width,
                bottom: middle + HEIGHT / 2.0,
            }
        })
    })
}

/// The distance of a text from its point, with a penalty unless it is to the right.
pub fn distance(area: &Area, (x, y): (f64, f64)) -> f64 {
    let dx = (area.left - x).max(x - area.right).max(0.0);
    let dy = ((area.top + area.bottom) / 2.0 - y).abs();
    let beside = if area.left > x { 0.0 } else { 12.0 };
    dx + dy + beside
}

/// Points on the polygon of a curve, at most about 3 pixels apart.
fn samples(curve: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let between = |pair: &[(f64, f64)]| {
        let ((x0, y0), (x1, y1)) = (pair[0], pair[1]);
        let count = ((x1 - x0).hypot(y1 - y0) / 3.0).ceil().clamp(1.0, 1e3) as usize;
        let part = move |k: usize| k as f64 / count as f64;
        (0..=count).map(move |k| (x0 + part(k) * (x1 - x0), y0 + part(k) * (y1 - y0)))
    };
    curve.windows(2).flat_map(between).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME: Area = Area {
        left: 0.0,
        top: 0.0,
        right: 400.0,
        bottom: 300.0,
    };

    #[test]
    fn a_single_label_is_to_the_right_of_its_point() {
        let found = place(&[("Verlet", (100.0, 100.0))], &[], &[], &FRAME, 1e3);
        assert_eq!(found[0].left, 108.0);
        assert_eq!(found[0].top, 100.0 - HEIGHT / 2.0);
    }

    #[test]
    fn labels_of_crowded_points_do_not_overlap_and_stay_inside() {
        let names: Vec<String> = (0..14).map(|k| format!("method number {k}")).collect();
        let labels: Vec<(&str, (f64, f64))> = names
            .iter()
            .enumerate()
            .map(|(k, name)| (name.as_str(), (250.0, 150.0 + k as f64)))
            .collect();
        let found = place(&labels, &[], &[], &FRAME, 1e3);
        assert_eq!(found.len(), 14);
        for (k, area) in found.iter().enumerate() {
            assert!(area.is_within(&FRAME), "{area:?}");
            assert!(
                found[..k].iter().all(|other| !other.overlaps(area)),
                "{found:?}"
            );
        }
    }

    #[test]
    fn labels_in_a_column_keep_their_order_and_distance() {
        let labels: Vec<(&str, (f64, f64))> = [150.0, 149.0, 148.0, 40.0, 299.0, 298.0]
            .map(|y| ("name", (280.0, y)))
            .into();
        let found = place(&labels, &[], &[], &FRAME, 300.0);
        assert!(
            found
                .iter()
                .all(|area| area.left == 300.0 && area.is_within(&FRAME))
        );
        let tops = |of: &[usize]| of.iter().map(|&k| found[k].top).collect::<Vec<_>>();
        assert!(
            tops(&[3, 2, 1, 0, 5, 4])
                .windows(2)
                .all(|pair| pair[1] - pair[0] >= HEIGHT)
        );
        // The middle label of three stays in place, and so does an isolated label.
        assert!((found[1].top - (149.0 - HEIGHT / 2.0)).abs() < 1e-9);
        assert!((found[3].top - (40.0 - HEIGHT / 2.0)).abs() < 1e-9);
    }

    #[test]
    fn labels_avoid_curves() {
        // A line to the right of the point.
        let curve = vec![(100.0, 100.0), (400.0, 100.0)];
        let found = place(&[("Verlet", (100.0, 100.0))], &[curve], &[], &FRAME, 1e3);
        assert!(!found[0].holds((120.0, 100.0)), "{found:?}");
        assert!((found[0].top - 100.0).abs() < 30.0);
    }

    #[test]
    fn a_label_at_the_right_border_moves_inside() {
        let found = place(&[("Verlet", (395.0, 100.0))], &[], &[], &FRAME, 1e3);
        assert!(found[0].is_within(&FRAME));
    }

    #[test]
    fn a_label_avoids_an_occupied_place() {
        let label = [("Verlet", (100.0, 100.0))];
        let first = place(&label, &[], &[], &FRAME, 1e3);
        let second = place(&label, &[], &first, &FRAME, 1e3);
        assert!(!first[0].overlaps(&second[0]), "{second:?}");
    }
}
