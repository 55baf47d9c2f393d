//! What only a map shows: walls, furniture, a robot.

use std::fmt::Write;
use std::ops::Range;

use super::Chart;
use crate::world::plan::Plan;

/// How wide a wall's face is drawn, metres: two faces of a partition become one wall.
const WALL_WIDTH: f64 = 0.16;
/// Length of the robot in user units: in a large world it is drawn larger than it is, on a short way smaller.
const DRAWN_ROBOT: Range<f64> = 15.0..50.0;
/// Length of a Pioneer P3-AT, metres; its parts below are drawn in this unit.
const ROBOT: f64 = 0.5;

impl Chart {
    /// Where on the page a point lies, user units.
    pub(in crate::report) fn on_map(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.x.at(x), self.y.at(y)]
    }

    /// Walls and furniture.
    pub(in crate::report) fn plan(&mut self, plan: &Plan) {
        let furniture: String = plan.furniture.iter().map(|outline| self.outline(outline) + "Z").collect();
        let walls: String = plan.walls.iter().map(|ends| self.outline(ends)).collect();
        let width = WALL_WIDTH * self.per_metre();
        self.add(format_args!(r#"<path class="furniture" d="{furniture}"/>"#));
        self.add(format_args!(r#"<path class="wall" stroke-width="{width:.1}" d="{walls}"/>"#));
    }

    /// The robot at a place, `heading` degrees anticlockwise from x; a dot for what has no heading.
    pub(in crate::report) fn robot(&mut self, place: [f64; 2], heading: Option<f64>) {
        let [x, y] = self.on_map(place);
        let Some(heading) = heading else {
            self.add(format_args!(
                r#"<g class="robot" transform="translate({x:.1} {y:.1})"><circle class="body" r="5"/></g>"#
            ));
            return;
        };
        let size = (ROBOT * self.per_metre()).clamp(DRAWN_ROBOT.start, DRAWN_ROBOT.end);
        // From above, nose to the right: what the camera sees, four wheels, the body, an arrow.
        self.add(format_args!(
            r#"<g class="robot" transform="translate({x:.1} {y:.1}) rotate({:.1})"><g transform="scale({size:.1})">
<path class="view" d="M.3 0L2.9 -1.41A2.95 2.95 0 0 1 2.9 1.41Z"/>
<path class="wheels" d="M-.45 -.48h.4v.96h-.4zM.05 -.48h.4v.96h-.4z"/>
<rect class="body" x="-.5" y="-.36" width="1" height=".72" rx=".18"/>
<path class="nose" d="M.02 -.2L.32 0L.02 .2Z"/></g></g>"#,
            -heading
        ));
    }

    /// User units that a metre takes; of equal axes.
    fn per_metre(&self) -> f64 {
        (self.x.end - self.x.start) / (self.x.to - self.x.from)
    }

    fn outline(&self, points: &[[f64; 2]]) -> String {
        let mut path = String::new();
        for (index, &point) in points.iter().enumerate() {
            let [x, y] = self.on_map(point);
            let command = if index == 0 { 'M' } else { 'L' };
            write!(path, "{command}{x:.1} {y:.1}").expect("a string takes all that is written to it");
        }
        path
    }
}
