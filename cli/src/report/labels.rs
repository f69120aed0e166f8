//! Names in a drawing, where they cover nothing.
//!
//! In: points with names, what is drawn already. Out: a place for each name that finds one; names never overlap.

/// A rectangle: its left upper corner and its size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Box2 {
    pub(super) at: [f64; 2],
    pub(super) size: [f64; 2],
}

/// What is to be named.
pub(super) struct Wanted {
    pub(super) at: [f64; 2],
    pub(super) size: [f64; 2],
}

/// What names should keep off: marks, and lines from point to point.
#[derive(Default)]
pub(super) struct Drawn {
    pub(super) marks: Vec<Box2>,
    pub(super) lines: Vec<[[f64; 2]; 2]>,
    /// Letters that stand already: no name covers them.
    pub(super) letters: Vec<Box2>,
}

/// Where no place is better than this, as one is that covers three marks, a name would be more noise than help.
const WORST: f64 = 80.0;

/// Distances from the point that are tried, in pixels.
const DISTANCES: [f64; 4] = [9.0, 15.0, 24.0, 36.0];

/// Directions that are tried: to the right first.
const DIRECTIONS: [[f64; 2]; 8] =
    [[1.0, -0.6], [1.0, 0.6], [-1.0, -0.6], [-1.0, 0.6], [0.0, -1.0], [0.0, 1.0], [1.0, 0.0], [-1.0, 0.0]];

/// Boxes of the names, inside the sheet; nothing for those that find no room.
pub(super) fn place(wanted: &[Wanted], drawn: &Drawn, sheet: Box2) -> Vec<Option<Box2>> {
    let mut taken: Vec<Box2> = drawn.letters.clone();
    let mut places = Vec::new();
    for name in wanted {
        let mut best: Option<(f64, Box2)> = None;
        for (number, distance) in DISTANCES.into_iter().enumerate() {
            for (turn, [x, y]) in DIRECTIONS.into_iter().enumerate() {
                let [w, h] = name.size;
                // The side that looks at the point stands off by the distance.
                let side = |way: f64, size: f64| {
                    if way == 0.0 {
                        -size / 2.0
                    } else if way > 0.0 {
                        0.0
                    } else {
                        -size
                    }
                };
                let at = [name.at[0] + x * distance + side(x, w), name.at[1] + y * distance + side(y, h)];
                let place = Box2 { at, size: name.size };
                if !inside(place, sheet) || taken.iter().any(|other| overlap(place, *other)) {
                    continue;
                }
                let covered = drawn.marks.iter().filter(|mark| overlap(place, **mark)).count();
                let crossed = drawn.lines.iter().filter(|line| crosses(place, **line)).count();
                let cost = 30.0 * covered as f64 + 12.0 * crossed as f64 + 6.0 * number as f64 + 0.1 * turn as f64;
                if best.is_none_or(|(least, _)| cost < least) {
                    best = Some((cost, place));
                }
            }
        }
        let place = best.filter(|(cost, _)| *cost < WORST).map(|(_, place)| place);
        taken.extend(place);
        places.push(place);
    }
    places
}

fn inside(place: Box2, sheet: Box2) -> bool {
    (0..2).all(|k| place.at[k] >= sheet.at[k] && place.at[k] + place.size[k] <= sheet.at[k] + sheet.size[k])
}

fn overlap(a: Box2, b: Box2) -> bool {
    (0..2).all(|k| a.at[k] < b.at[k] + b.size[k] && b.at[k] < a.at[k] + a.size[k])
}

/// Whether a line passes a box: what is left of it within all four sides (Liang and Barsky).
fn crosses(place: Box2, [a, b]: [[f64; 2]; 2]) -> bool {
    let (mut first, mut last) = (0.0, 1.0);
    for k in 0..2 {
        let way = b[k] - a[k];
        let bounds = [place.at[k] - a[k], place.at[k] + place.size[k] - a[k]];
        if way == 0.0 {
            if bounds[0] > 0.0 || bounds[1] < 0.0 {
                return false;
            }
            continue;
        }
        let [s, t] = bounds.map(|bound| bound / way);
        first = f64::max(first, s.min(t));
        last = f64::min(last, s.max(t));
    }
    first < last
}

#[cfg(test)]
mod tests {
    use super::{Box2, Drawn, Wanted, crosses, overlap, place};

    const SHEET: Box2 = Box2 { at: [0.0, 0.0], size: [200.0, 100.0] };

    #[test]
    fn names_of_one_point_do_not_overlap() {
        let wanted: Vec<Wanted> = (0..30).map(|_| Wanted { at: [100.0, 50.0], size: [40.0, 12.0] }).collect();
        let letter = Box2 { at: [110.0, 40.0], size: [8.0, 8.0] };
        let drawn = Drawn { letters: vec![letter], ..Drawn::default() };
        let places = place(&wanted, &drawn, SHEET);
        let found: Vec<Box2> = places.iter().flatten().copied().collect();
        assert!(found.iter().all(|name| !overlap(*name, letter)));
        assert!(found.len() >= 6 && found.len() < 30, "{}", found.len());
        for (k, a) in found.iter().enumerate() {
            assert!(found[k + 1..].iter().all(|b| !overlap(*a, *b)));
        }
    }

    #[test]
    fn lines_are_kept_off() {
        let line = [[100.0, 50.0], [180.0, 20.0]];
        let drawn = Drawn { lines: vec![line], ..Drawn::default() };
        let [Some(found)] = place(&[Wanted { at: [100.0, 50.0], size: [40.0, 12.0] }], &drawn, SHEET)[..] else {
            panic!()
        };
        assert!(!crosses(found, line));
        assert!(crosses(Box2 { at: [120.0, 30.0], size: [20.0, 20.0] }, line));
        assert!(!crosses(Box2 { at: [120.0, 60.0], size: [20.0, 20.0] }, line));
    }
}
