//! Charts as inline SVG. Colours and text sizes come from the page's style sheet, so that one chart serves light and
//! dark, phone and desk; nothing in it but numbers and the labels given here, which must not come from outside.

mod map;
mod rows;

use std::fmt::Write;
use std::ops::Range;

use super::scale::Scale;

/// Width of every chart in user units: that of a phone, where they are pixels.
const WIDTH: f64 = 400.0;
const LEFT: f64 = 38.0;
const RIGHT: f64 = 10.0;
const TOP: f64 = 22.0;
const BOTTOM: f64 = 36.0;
const AREA_WIDTH: f64 = WIDTH - LEFT - RIGHT;
/// Height of the area of a chart over time.
const AREA_HEIGHT: f64 = 150.0;
/// Least and most height of an area with equal axes.
const EQUAL_HEIGHT: Range<f64> = 110.0..340.0;
/// A line of more points is thinned: more than twice what the widest screen can show.
const MOST_POINTS: usize = 4000;

/// A chart in the making: what is added first lies at the bottom.
pub(super) struct Chart {
    x: Scale,
    y: Scale,
    /// Names that stand for numbers on the y axis.
    rows: &'static [&'static str],
    body: String,
}

impl Chart {
    /// A chart whose axes have nothing to do with each other.
    pub(super) fn new(x: Range<f64>, y: Range<f64>) -> Self {
        Self {
            x: Scale { from: x.start, to: x.end, start: 0.0, end: AREA_WIDTH },
            y: Scale { from: y.start, to: y.end, start: AREA_HEIGHT, end: 0.0 },
            rows: &[],
            body: String::new(),
        }
    }

    /// A map: one unit is as long upwards as to the right. The ranges are widened to fill the area.
    pub(super) fn with_equal_axes([x, y]: [Range<f64>; 2]) -> Self {
        let (width, height) = (x.end - x.start, y.end - y.start);
        let area_height = (AREA_WIDTH * height / width).clamp(EQUAL_HEIGHT.start, EQUAL_HEIGHT.end);
        let per_unit = (AREA_WIDTH / width).min(area_height / height);
        let widened = |range: Range<f64>, length: f64| {
            let (middle, half) = (0.5 * (range.start + range.end), 0.5 * length / per_unit);
            (middle - half, middle + half)
        };
        let (left, right) = widened(x, AREA_WIDTH);
        let (bottom, top) = widened(y, area_height);
        Self {
            x: Scale { from: left, to: right, start: 0.0, end: AREA_WIDTH },
            y: Scale { from: bottom, to: top, start: area_height, end: 0.0 },
            rows: &[],
            body: String::new(),
        }
    }

    /// A line through `points`; a value that isn't finite leaves a gap.
    pub(super) fn line(&mut self, class: &str, points: &[(f64, f64)]) {
        let path: String = self.on_page(points).iter().map(|part| polyline('M', part)).collect();
        self.add(format_args!(r#"<path class="line {class}" d="{path}"/>"#));
    }

    /// The area between the x axis and `points`, with gaps like a line's.
    pub(super) fn band(&mut self, class: &str, points: &[(f64, f64)]) {
        let floor = self.y.start;
        let path: String = self
            .on_page(points)
            .iter()
            .filter_map(|part| {
                let (first, last) = (part.first()?.0, part.last()?.0);
                Some(format!("M{first:.1} {floor:.1}{}L{last:.1} {floor:.1}Z", polyline('L', part)))
            })
            .collect();
        self.add(format_args!(r#"<path class="band {class}" d="{path}"/>"#));
    }

    /// Stretches of the x axis over the whole height, widened to what the eye can find.
    pub(super) fn spans(&mut self, class: &str, spans: &[(f64, f64)]) {
        for &(from, to) in spans {
            let (left, right) = (self.x.at(from), self.x.at(to));
            let width = (right - left).max(1.5);
            let (x, height) = (0.5 * (left + right - width), self.y.start);
            self.add(format_args!(
                r#"<rect class="span {class}" x="{x:.1}" y="0" width="{width:.1}" height="{height:.1}"/>"#
            ));
        }
    }

    /// Short marks that stand on the x axis.
    pub(super) fn marks(&mut self, class: &str, values: &[f64]) {
        let floor = self.y.start;
        let path: String = values.iter().map(|&value| format!("M{:.1} {floor:.1}v-7", self.x.at(value))).collect();
        self.add(format_args!(r#"<path class="mark {class}" d="{path}"/>"#));
    }

    /// A dot, with words beside it where `words` isn't empty.
    pub(super) fn dot(&mut self, class: &str, (x, y): (f64, f64), words: &str) {
        let (x, y) = (self.x.at(x), self.y.at(y));
        self.add(format_args!(r#"<circle class="dot {class}" cx="{x:.1}" cy="{y:.1}" r="4"/>"#));
        if !words.is_empty() {
            // On the side where there is room.
            let (anchor, offset) = if x > 0.8 * AREA_WIDTH { ("end", -8.0) } else { ("start", 8.0) };
            let x = x + offset;
            self.add(format_args!(
                r#"<text class="halo" x="{x:.1}" y="{:.1}" text-anchor="{anchor}">{words}</text>"#,
                y + 4.0
            ));
        }
    }

    /// The finished chart; `description` is for those who hear it instead.
    pub(super) fn into_svg(self, x_label: &str, y_label: &str, description: &str) -> String {
        let (width, height) = (AREA_WIDTH, self.y.start);
        let total = TOP + height + BOTTOM;
        let mut grid = String::new();
        let mut labels = String::new();
        let wanted = if height > 200.0 { 6.0 } else { 4.0 };
        let ticks = if self.rows.is_empty() { self.y.ticks(wanted) } else { Vec::new() };
        let lines = ticks.into_iter().map(|(value, label)| (self.y.at(value), label)).inspect(|(y, _)| {
            push(&mut grid, format_args!("M0 {y:.1}h{width}"));
        });
        let names = self.rows.iter().enumerate().map(|(row, name)| (self.row_middle(row), (*name).to_owned()));
        for (y, label) in lines.chain(names) {
            push(&mut labels, format_args!(r#"<text x="-6" y="{:.1}" text-anchor="end">{label}</text>"#, y + 3.5));
        }
        for (value, label) in self.x.ticks(5.0) {
            let x = self.x.at(value);
            push(&mut grid, format_args!("M{x:.1} 0v{height:.1}"));
            push(
                &mut labels,
                format_args!(r#"<text x="{x:.1}" y="{:.1}" text-anchor="middle">{label}</text>"#, height + 15.0),
            );
        }
        let body = &self.body;
        let below = height + 31.0;
        format!(
            r#"<svg class="chart" viewBox="0 0 {WIDTH} {total:.1}" role="img" aria-label="{description}">
<g transform="translate({LEFT} {TOP})"><path class="grid" d="{grid}"/>
<svg width="{width}" height="{height:.1}" viewBox="0 0 {width} {height:.1}">{body}</svg>
<path class="axis" d="M0 0V{height:.1}H{width}"/>{labels}
<text class="name" x="-{LEFT}" y="-9">{y_label}</text>
<text class="name" x="{width}" y="{below:.1}" text-anchor="end">{x_label}</text></g></svg>"#
        )
    }

    /// The stretches between the gaps, in page coordinates.
    fn on_page(&self, points: &[(f64, f64)]) -> Vec<Vec<(f64, f64)>> {
        points
            .split(|(x, y)| !(x.is_finite() && y.is_finite()))
            .filter(|part| !part.is_empty())
            .map(|part| thinned(part).into_iter().map(|(x, y)| (self.x.at(x), self.y.at(y))).collect())
            .collect()
    }

    fn add(&mut self, element: std::fmt::Arguments) {
        push(&mut self.body, element);
    }
}

fn push(text: &mut String, what: std::fmt::Arguments) {
    text.write_fmt(what).expect("a string takes all that is written to it");
}

/// Path commands through `points`, the first reached by `start`.
fn polyline(start: char, points: &[(f64, f64)]) -> String {
    let mut path = String::new();
    for (index, (x, y)) in points.iter().enumerate() {
        let command = if index == 0 { start } else { 'L' };
        push(&mut path, format_args!("{command}{x:.1} {y:.1}"));
    }
    path
}

/// At most about [`MOST_POINTS`] of the points: of each run of them the first, the lowest and the highest, in their
/// order, so that no peak gets lost.
fn thinned(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    if points.len() <= MOST_POINTS {
        return points.to_vec();
    }
    let run = points.len().div_ceil(MOST_POINTS / 3);
    let by_height = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
    points
        .chunks(run)
        .flat_map(|chunk| {
            let lowest = chunk.iter().min_by(by_height).copied();
            let highest = chunk.iter().max_by(by_height).copied();
            let kept = move |point: &&(f64, f64)| Some(**point) == lowest || Some(**point) == highest;
            chunk.first().into_iter().chain(chunk[1..].iter().filter(kept))
        })
        .copied()
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thinning_keeps_the_peaks() {
        let mut points: Vec<(f64, f64)> = (0..100_000).map(|index| (f64::from(index), f64::from(index % 7))).collect();
        points[54_321].1 = 100.0;
        points[65_432].1 = -100.0;
        let kept = thinned(&points);
        assert!(kept.len() < 2 * MOST_POINTS, "{}", kept.len());
        assert!(kept.contains(&points[54_321]) && kept.contains(&points[65_432]));
    }

    #[test]
    fn equal_axes_are_equal() {
        for (width, height) in [(10.0, 1.0), (1.0, 10.0), (3.0, 2.0)] {
            let Chart { x, y, .. } = Chart::with_equal_axes([0.0..width, -height..0.0]);
            let (across, up) = (x.at(1.0) - x.at(0.0), y.at(0.0) - y.at(1.0));
            assert!((across - up).abs() < 1e-9);
            assert!(x.at(0.0) >= -1e-9 && x.at(width) <= AREA_WIDTH + 1e-9 && y.at(0.0) >= -1e-9);
        }
    }

    #[test]
    fn what_is_not_finite_leaves_a_gap() {
        let mut chart = Chart::new(0.0..3.0, 0.0..1.0);
        chart.line("t0", &[(0.0, 0.5), (1.0, f64::NAN), (2.0, 0.5), (3.0, 0.5)]);
        assert_eq!(chart.body.matches('M').count(), 2);
        assert!(!chart.body.contains("NaN"));
    }
}
