//! Walls with openings, floors, ceilings, lamps, windows and doors.

use glam::{Vec2, Vec3, vec2, vec3};

use super::CEILING;
use crate::world::material::Surface;
use crate::world::scene::{Kind, Piece, Scene};
use crate::world::shape::{Place, cuts_no_longer_than};
use crate::world::{Lamp, Mesh, WINDOWS};

/// Exitance of a ceiling panel's cover, lux. A LED panel of 0.72 m² and some 5700 lm. 830 nm: none, it is a white LED.
const PANEL: [f32; 4] = [8200.0, 8000.0, 7650.0, 0.0];
/// Exitance of a window in daylight, lux: an overcast day, sky and park seen through double glazing. 830 nm: 0.007
/// W m⁻² nm⁻¹ per klx, overcast (estimate); a low-emissivity coating lets about half as much of it through as of
/// visible light (remembered: 0.3 to 0.6 against 0.8).
const DAYLIGHT: [f32; 4] = [2850.0, 3000.0, 3200.0, 0.0105];
/// The same on what stands outside, as seen through the glass: brighter than what of it comes through a window, as its
/// albedo is about 0.4.
const OUTDOORS: [f32; 4] = [8200.0, 8600.0, 9200.0, 0.03];
/// How far down roller blinds are drawn, as they are over screens: share of the window's height. A guess.
const DRAWN: f32 = 0.6;
/// Light that a blind lets through: a glare-control fabric, a twentieth of it holes. Data sheets: 0.04 to 0.08.
const FABRIC: f32 = 0.06;

/// How finely walls are cut, and ceilings, which no lamp shines on: metres. Shadows on them are soft.
const WALL_STEP: f32 = 0.4;
const CEILING_STEP: f32 = 0.6;

/// A hole in a wall: along it, and above the floor, metres.
#[derive(Clone, Copy)]
pub(super) struct Opening {
    pub along: [f32; 2],
    pub height: [f32; 2],
    /// How deep its cheeks go; none where the wall's other face builds them.
    pub cheeks: f32,
}

/// A wall's face between two corners of the plan, from left to right for who sees it.
pub(super) struct Wall {
    pub name: &'static str,
    pub from: [f32; 2],
    pub to: [f32; 2],
}

impl Wall {
    fn right(&self) -> Vec2 {
        (Vec2::from(self.to) - Vec2::from(self.from)).normalize()
    }

    /// Where the wall's own frame lies: x along it, y into it.
    pub fn place(&self) -> Place {
        let right = self.right();
        Place { at: Vec2::from(self.from).extend(0.0), yaw: right.y.atan2(right.x) }
    }

    fn length(&self) -> f32 {
        Vec2::from(self.from).distance(self.to.into())
    }

    /// Builds the face, the openings' cheeks and a skirting board.
    pub fn build(&self, scene: &mut Scene, openings: &[Opening]) {
        let cuts = |end: f32, inner: Vec<f32>| {
            let mut cuts = [vec![0.0, end], inner].concat();
            cuts.sort_by(f32::total_cmp);
            cuts.dedup();
            cuts_no_longer_than(WALL_STEP, &cuts)
        };
        let columns = cuts(self.length(), openings.iter().flat_map(|opening| opening.along).collect());
        let rows = cuts(CEILING, openings.iter().flat_map(|opening| opening.height.map(|z| CEILING - z)).collect());
        let hole = |column: usize, row: usize| {
            let (x, z) = (columns[column] + 1e-3, CEILING - rows[row] - 1e-3);
            let within = |[low, high]: [f32; 2], value: f32| low <= value && value <= high;
            openings.iter().any(|opening| within(opening.along, x) && within(opening.height, z))
        };
        scene.piece(self.name, Kind::Solid, self.place(), |piece| {
            let surface = Surface::WallPaint;
            let corner = vec3(0.0, 0.0, CEILING);
            let face = Mesh::grid(corner, Vec3::X, -Vec3::Z, [&columns, &rows], hole, piece.mapping(surface));
            piece.mesh(surface, &face);
            openings.iter().filter(|opening| opening.cheeks > 0.0).for_each(|opening| cheeks(piece, opening));
        });
        scene.piece(&format!("{}, skirting", self.name), Kind::Decor, self.place(), |piece| {
            let doorway = |left: f32| {
                let within = |[from, to]: [f32; 2]| from <= left && left < to;
                openings.iter().any(|opening| opening.height[0] == 0.0 && within(opening.along))
            };
            for pair in columns.windows(2).filter(|pair| !doorway(pair[0])) {
                let right = vec3(pair[1] - pair[0], 0.0, 0.0);
                piece.front(Surface::Skirting, [pair[0], pair[1]], [0.0, 0.08], -0.008);
                piece.face(Surface::Skirting, vec3(pair[0], 0.0, 0.08), right, vec3(0.0, -0.01, 0.0));
            }
        });
    }
}

fn cheeks(piece: &mut Piece, Opening { along: [left, right], height: [bottom, top], cheeks }: &Opening) {
    let (into, width, down) = (vec3(0.0, *cheeks, 0.0), vec3(right - left, 0.0, 0.0), vec3(0.0, 0.0, bottom - top));
    let surface = Surface::Enamel;
    piece.face(surface, vec3(*left, 0.0, *top), into, down);
    piece.face(surface, vec3(*right, *cheeks, *top), -into, down);
    piece.face(surface, vec3(*left, 0.0, *top), width, into);
    if *bottom > 0.0 {
        piece.face(surface, vec3(*left, *cheeks, *bottom), width, -into);
    }
}

/// A window in an opening: frame, bars, sill, and the daylight that comes through.
pub(super) fn window(scene: &mut Scene, wall: &Wall, opening: &Opening) {
    let Opening { along: [left, right], height: [bottom, top], cheeks } = *opening;
    scene.piece(&format!("{}, window at {left}", wall.name), Kind::Solid, wall.place(), |piece| {
        let (near, far, bar) = (cheeks - 0.06, cheeks, 0.05);
        let middle = 0.5 * (left + right);
        for x in [left, middle - 0.5 * bar, right - bar] {
            piece.cuboid(Surface::Enamel, [x, near, bottom], [x + bar, far, top]);
        }
        for z in [bottom, top - bar] {
            piece.cuboid(Surface::Enamel, [left + bar, near, z], [middle - 0.5 * bar, far, z + bar]);
            piece.cuboid(Surface::Enamel, [middle + 0.5 * bar, near, z], [right - bar, far, z + bar]);
        }
        piece.cuboid(Surface::Enamel, [left - 0.03, -0.1, bottom - 0.03], [right + 0.03, -0.0, bottom]);
        piece.bar(Surface::DarkCoat, [middle, near - 0.03, bottom + 0.45], [middle, near - 0.03, bottom + 0.57], 0.01);
    });
    let hem = top - DRAWN * (top - bottom);
    blind(scene, wall, [left, right], [hem, top]);
    // Before the bars: what they shade is little, and their own shadows would want more rays.
    daylight(scene, wall, "daylight", [left, right], [bottom, hem], cheeks - 0.07, DAYLIGHT);
    daylight(scene, wall, "blind", [left, right], [hem, top], BLIND - 0.006, DAYLIGHT.map(|light| FABRIC * light));
}

/// How deep in a window's cheeks its blind hangs, metres.
const BLIND: f32 = 0.05;

/// A roller blind, drawn down to a hem.
fn blind(scene: &mut Scene, wall: &Wall, [left, right]: [f32; 2], [hem, top]: [f32; 2]) {
    scene.piece(&format!("{}, blind at {left}", wall.name), Kind::Decor, wall.place(), |piece| {
        piece.front(Surface::Blind, [left + 0.02, right - 0.02], [hem, top - 0.07], BLIND);
        piece.cuboid(Surface::Enamel, [left, BLIND - 0.04, top - 0.08], [right, BLIND + 0.04, top]);
        piece.bar(Surface::Steel, [left + 0.02, BLIND, hem], [right - 0.02, BLIND, hem], 0.012);
        piece.bar(Surface::Enamel, [right - 0.04, BLIND - 0.03, hem - 0.3], [right - 0.04, BLIND - 0.03, top], 0.004);
    });
}

/// Light that comes through an upright rectangle in a wall.
fn daylight(
    scene: &mut Scene,
    wall: &Wall,
    name: &str,
    [left, right]: [f32; 2],
    [bottom, top]: [f32; 2],
    depth: f32,
    exitance: [f32; 4],
) {
    let place = wall.place();
    let along = place.point(vec3(0.5 * (right - left), 0.0, 0.0)) - place.at;
    let centre = place.point(vec3(0.5 * (left + right), depth, 0.5 * (bottom + top)));
    scene.lamp(Lamp {
        name: format!("{}, {name} at {left}", wall.name),
        centre: centre.to_array(),
        half_edges: [along.to_array(), [0.0, 0.0, 0.5 * (top - bottom)]],
        exitance,
        group: WINDOWS.to_owned(),
    });
}

/// A picture of the outdoors behind windows, with a light of its own that shines away from the house. `from`, `to`:
/// its lower corners, from left to right for who looks out.
pub(super) fn outlook(scene: &mut Scene, name: &'static str, from: [f32; 2], to: [f32; 2]) {
    let wall = Wall { name, from, to };
    let (length, [low, high]) = (wall.length(), [-2.0, 7.0]);
    // Coarse: nothing out there casts a shadow worth a vertex.
    let coarse = |end: f32| [0.0, 0.25, 0.5, 0.75, 1.0].map(|share| share * end);
    let (columns, rows) = (coarse(length), coarse(high - low));
    scene.piece(name, Kind::Decor, wall.place(), |piece| {
        let (corner, mapping) = (vec3(0.0, 0.0, high), piece.mapping(Surface::Outdoors));
        let mesh = Mesh::grid(corner, Vec3::X, -Vec3::Z, [&columns, &rows], |_, _| false, mapping);
        piece.mesh(Surface::Outdoors, &mesh);
    });
    let place = wall.place();
    let along = place.point(vec3(0.5 * length, 0.0, 0.0)) - place.at;
    scene.lamp(Lamp {
        name: format!("{name}, sky"),
        centre: place.point(vec3(0.5 * length, -2.0, 0.5 * (low + high))).to_array(),
        half_edges: [[0.0, 0.0, 0.5 * (high - low)], along.to_array()],
        exitance: OUTDOORS,
        group: WINDOWS.to_owned(),
    });
}

/// A floor or, seen from below, a ceiling, between two corners of the plan.
pub(super) fn slab(scene: &mut Scene, name: &str, surface: Surface, min: [f32; 2], max: [f32; 2], z: f32) {
    let kind = if z > 0.0 { Kind::Decor } else { Kind::Solid };
    let (right, depth) = (vec3(max[0] - min[0], 0.0, 0.0), vec3(0.0, max[1] - min[1], 0.0));
    // Tiles run on from slab to slab.
    let mesh = if z > 0.0 {
        let [columns, rows] = [right, depth].map(|edge| cuts_no_longer_than(CEILING_STEP, &[0.0, edge.length()]));
        let corner = vec3(min[0], min[1], z);
        Mesh::grid(corner, right, depth, [&columns, &rows], |_, _| false, surface.mapping_from(min))
    } else {
        Mesh::quad(vec3(min[0], max[1], z), right, -depth, surface.mapping_from([min[0], -max[1]]))
    };
    scene.piece(name, kind, Place::new(0.0, 0.0, 0.0, 0.0), |piece| piece.mesh(surface, &mesh));
}

/// A LED panel under the ceiling, `size` metres along x and y.
pub(super) fn panel(scene: &mut Scene, name: &str, [x, y]: [f32; 2], size: [f32; 2]) {
    let half = 0.5 * vec2(size[0], size[1]);
    scene.piece(name, Kind::Decor, Place::new(x, y, CEILING, 0.0), |piece| {
        piece.cuboid(Surface::Enamel, [-half.x - 0.02, -half.y - 0.02, -0.03], [half.x + 0.02, half.y + 0.02, -1e-3]);
        let corner = vec3(-half.x, -half.y, -0.032);
        piece.face(Surface::Opal, corner, vec3(size[0], 0.0, 0.0), vec3(0.0, size[1], 0.0));
    });
    scene.lamp(Lamp {
        name: name.to_owned(),
        centre: [x, y, CEILING - 0.036],
        half_edges: [[0.0, half.y, 0.0], [half.x, 0.0, 0.0]],
        exitance: PANEL,
        group: "ceiling".to_owned(),
    });
}

/// Trim around a doorway, on one wall face; `leaf` adds a closed door.
pub(super) fn door_frame(scene: &mut Scene, wall: &Wall, [left, right]: [f32; 2], top: f32, leaf: bool) {
    scene.piece(&format!("{}, door frame at {left}", wall.name), Kind::Decor, wall.place(), |piece| {
        let (wide, proud) = (0.07, -0.02);
        piece.cuboid(Surface::DarkCoat, [left - wide, proud, 0.0], [left, 0.0, top]);
        piece.cuboid(Surface::DarkCoat, [right, proud, 0.0], [right + wide, 0.0, top]);
        piece.cuboid(Surface::DarkCoat, [left - wide, proud, top], [right + wide, 0.0, top + wide]);
        if leaf {
            piece.front(Surface::DoorLeaf, [left, right], [0.0, top], -0.004);
            piece.bar(Surface::Steel, [left + 0.07, -0.06, 1.05], [left + 0.2, -0.06, 1.05], 0.012);
            piece.bar(Surface::Steel, [left + 0.07, 0.0, 1.05], [left + 0.07, -0.06, 1.05], 0.012);
        }
    });
}

/// A door that stands open against a wall.
pub(super) fn open_leaf(scene: &mut Scene, wall: &Wall, [left, right]: [f32; 2]) {
    scene.piece(&format!("{}, open door", wall.name), Kind::Solid, wall.place(), |piece| {
        piece.cuboid(Surface::Oak, [left, -0.12, 0.01], [right, -0.08, 2.08]);
        piece.front(Surface::DoorLeaf, [left, right], [0.01, 2.08], -0.12);
        piece.bar(Surface::Steel, [right - 0.2, -0.17, 1.05], [right - 0.07, -0.17, 1.05], 0.012);
    });
}

/// A picture on a wall, its lower left corner at `at` metres along and above the floor.
pub(super) fn picture(scene: &mut Scene, wall: &Wall, surface: Surface, at: [f32; 2], size: [f32; 2]) {
    let [left, bottom] = at;
    scene.piece(&format!("{}, picture at {left}", wall.name), Kind::Decor, wall.place(), |piece| {
        piece.front(surface, [left, left + size[0]], [bottom, bottom + size[1]], -0.006);
    });
}
