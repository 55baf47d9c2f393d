//! Search within a band, at every place.

use super::descriptor::Descriptor;
use super::edges::Edges;
use super::refine::peak_near;
use super::{Band, CrossMatch, is_distinct};

/// Between places that are looked at, pixels: less than half of the descriptor's blur, so that none falls between two.
const STEP: f32 = 2.0;
/// So near to where it came from a match must lead back, pixels.
const BACK: f32 = 2.5;

/// From one image to the other.
pub struct Search<'a> {
    pub from: &'a Edges,
    pub to: &'a Edges,
    pub band: Band,
    /// From here on it is elsewhere, pixels.
    pub apart: f32,
}

/// The best place and what is best elsewhere.
struct Best {
    column: f32,
    row: f32,
    similarity: f32,
    rival: f32,
}

impl Search<'_> {
    /// Where a place is found, if the best place is distinctly better than any elsewhere and leads back.
    pub fn find(&self, place: (f32, f32), max_ratio: f32) -> Option<CrossMatch> {
        let wanted = Descriptor::at(self.from, place.0, place.1);
        let best = self.best(&wanted, self.to, place, self.band)?;
        is_distinct(best.similarity, best.rival, max_ratio).then_some(())?;
        let peak = peak_near(&wanted, self.to, (place.0 + best.column, place.1 + best.row))?;
        let (column, row) = (peak.x - place.0, peak.y - place.1);
        let (least, most) = self.band.columns;
        let is_within = (least..=most).contains(&column) && row.abs() <= self.band.rows;
        is_within.then_some(())?;
        let mirrored = Band { rows: 0.0, columns: (-most, -least) };
        let back = self.best(&Descriptor::at(self.to, peak.x, peak.y), self.from, (peak.x, place.1), mirrored)?;
        ((back.column + column).abs() <= BACK).then(|| peak.matched_with(place))
    }

    fn best(&self, wanted: &Descriptor, edges: &Edges, place: (f32, f32), band: Band) -> Option<Best> {
        let steps = |least: f32, most: f32| {
            let count = ((most - least) / STEP).max(0.0).round() as usize;
            let spacing = (most - least) / count.max(1) as f32;
            (0..=count).map(move |index| least + spacing * index as f32)
        };
        let columns = || steps(band.columns.0, band.columns.1);
        // By columns, the best of the rows.
        let peaks: Vec<Best> = columns()
            .map(|column| {
                let of_row = |row: f32| {
                    let seen = Descriptor::at(edges, place.0 + column, place.1 + row);
                    Best { column, row, similarity: wanted.similarity(&seen), rival: f32::NEG_INFINITY }
                };
                let rows = steps(-band.rows, band.rows).map(of_row);
                rows.max_by(|a, b| a.similarity.total_cmp(&b.similarity))
            })
            .collect::<Option<_>>()?;
        let best = peaks.iter().max_by(|a, b| a.similarity.total_cmp(&b.similarity))?;
        let elsewhere = peaks.iter().filter(|peak| (peak.column - best.column).abs() > self.apart);
        let rival = elsewhere.map(|peak| peak.similarity).fold(f32::NEG_INFINITY, f32::max);
        Some(Best { rival, ..*best })
    }
}
