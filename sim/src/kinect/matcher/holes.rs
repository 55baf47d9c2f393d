//! Narrow holes closed: the device's own hole filter, on by default (`HoleFilter` in its driver's settings). Without it
//! every edge of a surface or of its paint, where a window sees two things, would be a gap; frames of real devices have
//! none there, only shadows. What is wider than a window with its dots stays open.

use rayon::prelude::*;
use sunblind_estimator::image::DepthImage;

use super::NO_DEPTH;

/// The widest gap that is closed, pixels. A guess: real frames keep shadows of 15 px, and have no gaps of 8.
const WIDEST: usize = 8;
/// Pixels with depth in a row that it takes on both sides: scattered matches in noise prove nothing. A guess.
const FIRM: usize = 4;
/// Raw steps between both sides up to which they are one surface.
const SAME_SURFACE: u16 = 16;

/// Closes gaps along rows, then along columns.
pub(super) fn close(depth: &mut DepthImage) {
    let (width, height) = depth.size();
    depth.pixels_mut().par_chunks_exact_mut(width).for_each(close_line);
    let mut columns = vec![NO_DEPTH; width * height];
    let pixels = depth.pixels();
    columns.par_chunks_exact_mut(height).enumerate().for_each(|(x, column)| {
        column.iter_mut().enumerate().for_each(|(y, value)| *value = pixels[y * width + x]);
        close_line(column);
    });
    depth.pixels_mut().par_chunks_exact_mut(width).enumerate().for_each(|(y, row)| {
        row.iter_mut().enumerate().for_each(|(x, value)| *value = columns[x * height + y]);
    });
}

fn close_line(line: &mut [u16]) {
    let (mut at, mut firm) = (0, 0);
    while at < line.len() {
        if line[at] != NO_DEPTH {
            (at, firm) = (at + 1, firm + 1);
            continue;
        }
        let end = line[at..].iter().position(|&raw| raw != NO_DEPTH).map_or(line.len(), |gap| at + gap);
        let beyond = line[end..].iter().take(FIRM).take_while(|&&raw| raw != NO_DEPTH).count();
        if firm >= FIRM && beyond == FIRM && end - at <= WIDEST {
            bridge(line, at, end);
        }
        (at, firm) = (end, 0);
    }
}

/// One surface goes on evenly; of two, each reaches half way.
fn bridge(line: &mut [u16], start: usize, end: usize) {
    let (before, after) = (line[start - 1], line[end]);
    let count = end - start;
    for (index, raw) in line[start..end].iter_mut().enumerate() {
        *raw = if before.abs_diff(after) <= SAME_SURFACE {
            let share = (index + 1) as f32 / (count + 1) as f32;
            (f32::from(before) + share * (f32::from(after) - f32::from(before))).round() as u16
        } else if 2 * index < count {
            before
        } else {
            after
        };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn closed(parts: &[(u16, usize)]) -> Vec<u16> {
        let mut line: Vec<u16> = parts.iter().flat_map(|&(raw, count)| std::iter::repeat_n(raw, count)).collect();
        close_line(&mut line);
        line
    }

    #[test]
    fn a_narrow_gap_is_closed_and_a_shadow_is_not() {
        assert_eq!(closed(&[(800, 5), (NO_DEPTH, 3), (808, 5)])[5..8], [802, 804, 806]);
        assert_eq!(closed(&[(800, 5), (NO_DEPTH, 4), (900, 5)])[5..9], [800, 800, 900, 900]);
        let shadow = closed(&[(800, 5), (NO_DEPTH, WIDEST + 1), (900, 5)]);
        assert_eq!(shadow.iter().filter(|&&raw| raw == NO_DEPTH).count(), WIDEST + 1);
    }

    #[test]
    fn scattered_matches_and_the_borders_close_nothing() {
        for parts in [
            &[(800, 3), (NO_DEPTH, 2), (800, 9)][..],
            &[(800, 9), (NO_DEPTH, 2), (800, 3), (NO_DEPTH, 9)],
            &[(NO_DEPTH, 4), (800, 9)],
            &[(800, 9), (NO_DEPTH, 4)],
        ] {
            let line: Vec<u16> = parts.iter().flat_map(|&(raw, count)| std::iter::repeat_n(raw, count)).collect();
            assert_eq!(closed(parts), line);
        }
    }

    #[test]
    fn columns_are_closed_as_rows_are() {
        let mut depth = DepthImage::filled(20, 30, 700);
        depth.pixels_mut()[10 * 20..15 * 20].fill(NO_DEPTH);
        close(&mut depth);
        assert!(depth.pixels().iter().all(|&raw| raw == 700));
    }
}
