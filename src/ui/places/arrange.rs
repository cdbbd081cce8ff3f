//! Where the pictures of pins stand: beside their points, apart from each other.

use egui::{Pos2, Rect, Vec2, vec2};

/// Width and height of a pin's picture, in points.
pub const SIZE: Vec2 = vec2(84.0, 56.0);
/// Lengths of stems that are tried, in points.
const STEMS: [f32; 4] = [18.0, 40.0, 72.0, 110.0];
/// Directions that are tried.
const DIRECTIONS: u32 = 16;
/// Least distance from the picture's edges, in points.
const MARGIN: f32 = 6.0;
/// Least distance between pictures, in points.
const GAP: f32 = 6.0;
/// Distance from a point within which no picture should stand, in points.
const POINT_ROOM: f32 = 8.0;
/// Cost of a fully covered picture.
const COVERED: f32 = 8.0;
/// Cost of a covered point.
const COVERED_POINT: f32 = 1.0;
/// Cost of a point of stem.
const PER_STEM: f32 = 0.004;
/// Cost of standing straight below the point rather than straight above it.
const BELOW: f32 = 0.3;

/// The picture of a pin at `at`, moved into `within` where it would stick out.
pub fn placed(at: Pos2, offset: Vec2, within: Rect) -> Rect {
    moved_into(Rect::from_center_size(at + offset, SIZE), within)
}

/// A picture enlarged away from the pin's point `at`, which it still does not cover.
pub fn enlarged(rect: Rect, at: Pos2, factor: f32, within: Rect) -> Rect {
    let edge = rect.clamp(at);
    let grown = |corner: Pos2| edge + (corner - edge) * factor;
    moved_into(Rect::from_min_max(grown(rect.min), grown(rect.max)), within)
}

fn moved_into(rect: Rect, within: Rect) -> Rect {
    let room = within.shrink(MARGIN);
    let into = |low: f32, high: f32, from: f32, to: f32| (to - high).min(0.0).max(from - low);
    rect.translate(vec2(
        into(rect.left(), rect.right(), room.left(), room.right()),
        into(rect.top(), rect.bottom(), room.top(), room.bottom()),
    ))
}

/// From a pin's point `at` to where its picture covers least.
///
/// `others` are pictures and buttons, `points` the points of the other pins.
pub fn best_offset(at: Pos2, within: Rect, others: &[Rect], points: &[Pos2]) -> Vec2 {
    let covered = |a: Rect, b: &Rect| {
        let both = a.intersect(*b);
        if both.is_positive() { both.area() / a.area() } else { 0.0 }
    };
    let candidates = STEMS.iter().flat_map(|&stem| {
        (0..DIRECTIONS).map(move |k| {
            let toward = Vec2::angled(k as f32 * std::f32::consts::TAU / DIRECTIONS as f32);
            (stem, toward * (0.5 * SIZE + Vec2::splat(stem)))
        })
    });
    let cost = |&(stem, offset): &(f32, Vec2)| {
        let rect = placed(at, offset, within);
        let by_others: f32 = others.iter().map(|other| covered(rect.expand(GAP), other)).sum();
        let room = rect.expand(POINT_ROOM);
        let by_points = points.iter().chain([&at]).filter(|point| room.contains(**point)).count();
        let below = 0.5 + 0.5 * offset.y / (0.5 * SIZE.y + stem);
        COVERED * by_others + COVERED_POINT * by_points as f32 + PER_STEM * stem + BELOW * below
    };
    candidates
        .map(|candidate| (cost(&candidate), candidate.1))
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map_or(Vec2::ZERO, |(_, offset)| offset)
}

#[cfg(test)]
mod tests {
    use egui::pos2;

    use super::*;

    const WITHIN: Rect = Rect { min: pos2(0.0, 0.0), max: pos2(800.0, 500.0) };

    #[test]
    fn pictures_stand_within_and_apart() {
        // A golden spiral of twelve points.
        let points: Vec<_> = (0..12)
            .map(|k| {
                let radius = 230.0 * ((k as f32 + 0.5) / 12.0).sqrt();
                WITHIN.center() + Vec2::angled(2.4 * k as f32) * radius
            })
            .collect();
        let buttons = Rect::from_min_max(pos2(0.0, 440.0), pos2(160.0, 500.0));
        let mut taken = vec![buttons];
        for (index, &at) in points.iter().enumerate() {
            let mut others = points.clone();
            others.remove(index);
            let rect = placed(at, best_offset(at, WITHIN, &taken, &others), WITHIN);
            assert!(WITHIN.contains_rect(rect), "{index}: {rect:?}");
            assert!(!rect.contains(at), "{index}: {rect:?} covers its point {at:?}");
            for other in &taken {
                assert!(!rect.intersects(*other), "{index}: {rect:?} covers {other:?}");
            }
            taken.push(rect);
        }
    }

    #[test]
    fn an_enlarged_picture_still_shows_its_point() {
        let rect = Rect::from_center_size(pos2(400.0, 250.0), SIZE);
        for k in 0..16 {
            let at = rect.center() + Vec2::angled(0.4 * k as f32) * 90.0;
            let grown = enlarged(rect, at, 1.5, WITHIN);
            assert!((grown.size() - 1.5 * SIZE).length() < 1e-3);
            assert!((grown.distance_to_pos(at) - rect.distance_to_pos(at)).abs() < 1e-3);
        }
    }

    #[test]
    fn a_picture_in_a_corner_is_moved_into_the_view() {
        for at in [WITHIN.left_top(), WITHIN.right_bottom(), pos2(799.0, 3.0)] {
            let rect = placed(at, vec2(60.0, -46.0), WITHIN);
            assert_eq!(rect.size(), SIZE);
            assert!(WITHIN.contains_rect(rect), "{rect:?}");
        }
    }
}
