//! What only a chart of rows shows: which of a few things is the case, over time.

use std::ops::Range;

use super::{AREA_WIDTH, Chart};
use crate::report::scale::Scale;

/// Height of a row and of what is drawn in it, user units.
const ROW: f64 = 30.0;
const DRAWN: f64 = 20.0;

impl Chart {
    /// A chart with one row for each name, the first on top; names are short.
    pub(in crate::report) fn with_rows(x: Range<f64>, rows: &'static [&'static str]) -> Self {
        let count = rows.len() as f64;
        Self {
            x: Scale { from: x.start, to: x.end, start: 0.0, end: AREA_WIDTH },
            y: Scale { from: count, to: 0.0, start: count * ROW, end: 0.0 },
            rows,
            body: String::new(),
        }
    }

    /// What is the case in a row from one value of the x axis to another.
    pub(in crate::report) fn stretch(&mut self, class: &str, row: usize, [from, to]: [f64; 2]) {
        let (left, right) = (self.x.at(from), self.x.at(to));
        let (width, top) = ((right - left).max(0.5), self.row_middle(row) - 0.5 * DRAWN);
        self.add(format_args!(
            r#"<rect class="stretch {class}" x="{left:.1}" y="{top:.1}" width="{width:.1}" height="{DRAWN}"/>"#
        ));
    }

    /// Where on the page a row has its middle.
    pub(super) fn row_middle(&self, row: usize) -> f64 {
        self.y.at(row as f64 + 0.5)
    }
}
