//! Images on one sheet: instants of one scenario below each other, or one instant of several scenarios side by side.

use image::imageops::{self, FilterType};
use image::{DynamicImage, GrayImage, Rgb, RgbImage};
use noto_sans_mono_bitmap::{FontWeight, RasterHeight, get_raster, get_raster_width};
use sunblind_estimator::image::Image;

use crate::false_colour;

/// Size of an image on the sheet, pixels.
const CELL: (u32, u32) = (320, 240);
/// Between images, and around them, pixels.
const GAP: u32 = 8;
/// Height of a line of writing with its leading, pixels.
const LINE: u32 = 20;
const PAPER: Rgb<u8> = Rgb([250; 3]);
const INK: f32 = 30.0;
/// What a depth pixel without a value is drawn in; no colour of depth is as dark.
const HOLE: Rgb<u8> = Rgb([0; 3]);
/// The depths at the ends of the colours, metres: nearer than the first a Kinect is blind, and past the other its depth
/// is off by more than 10 cm.
const DEPTHS: [f32; 2] = [0.5, 8.0];

/// One instant.
pub(super) struct Seen {
    /// The scenario and its light: a line of ASCII.
    pub light: String,
    /// When and where: a line of ASCII.
    pub place: String,
    pub colour: RgbImage,
    pub infrared: GrayImage,
    /// Metres, 0 for none.
    pub depth: Image<f32>,
    /// Likewise.
    pub true_depth: Image<f32>,
}

/// A picture and the line below it.
type Cell = (RgbImage, String);

/// Instants of one scenario, a row each: colour, infrared, depth, true depth. All depths have the same colours, on every
/// sheet.
pub(super) fn below_each_other(instants: &[Seen]) -> RgbImage {
    let row = |seen: &Seen| {
        let [nearest, farthest] = DEPTHS;
        vec![
            (small(seen.colour.clone().into()), seen.place.clone()),
            (small(seen.infrared.clone().into()), "infrared".to_owned()),
            depth_cell(seen),
            (coloured(&seen.true_depth), format!("true depth: {nearest} m bright, {farthest} m dark")),
        ]
    };
    draw(&instants.iter().map(row).collect::<Vec<_>>())
}

/// One instant of several scenarios, a column each: colour, infrared, depth.
pub(super) fn side_by_side(scenarios: &[Seen]) -> RgbImage {
    let row = |cell: &dyn Fn(&Seen) -> Cell| scenarios.iter().map(cell).collect::<Vec<_>>();
    draw(&[
        row(&|seen| (small(seen.colour.clone().into()), seen.light.clone())),
        row(&|seen| (small(seen.infrared.clone().into()), "infrared".to_owned())),
        row(&|seen| depth_cell(seen)),
    ])
}

fn depth_cell(seen: &Seen) -> Cell {
    (coloured(&seen.depth), format!("depth: {:.1} % of the pixels have one", 100.0 * valid_share(&seen.depth)))
}

/// Sheets of one width below each other.
pub(super) fn stacked(sheets: &[RgbImage]) -> RgbImage {
    let width = sheets.iter().map(RgbImage::width).max().unwrap_or(0);
    let mut whole = RgbImage::from_pixel(width, sheets.iter().map(RgbImage::height).sum(), PAPER);
    let mut y = 0;
    for sheet in sheets {
        imageops::replace(&mut whole, sheet, 0, y);
        y += i64::from(sheet.height());
    }
    whole
}

fn draw(rows: &[Vec<Cell>]) -> RgbImage {
    let (cell_width, cell_height) = CELL;
    let row_height = cell_height + LINE + GAP;
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0) as u32;
    let mut sheet =
        RgbImage::from_pixel(GAP + columns * (cell_width + GAP), GAP + rows.len() as u32 * row_height, PAPER);
    for (index, row) in rows.iter().enumerate() {
        for (column, (picture, caption)) in row.iter().enumerate() {
            let (x, y) = (GAP + column as u32 * (cell_width + GAP), GAP + index as u32 * row_height);
            imageops::replace(&mut sheet, picture, x.into(), y.into());
            write(&mut sheet, [x, y + cell_height + 2], caption);
        }
    }
    sheet
}

/// Share of the pixels that have a depth.
fn valid_share(depth: &Image<f32>) -> f64 {
    let valid = depth.pixels().iter().filter(|&&z| z > 0.0).count();
    valid as f64 / depth.pixels().len() as f64
}

fn small(picture: DynamicImage) -> RgbImage {
    picture.resize_exact(CELL.0, CELL.1, FilterType::Triangle).into_rgb8()
}

/// By nearest neighbour: a mean over an edge or a hole would show a depth that is not there.
fn coloured(depth: &Image<f32>) -> RgbImage {
    let (width, height) = depth.size();
    let [nearest, farthest] = DEPTHS;
    RgbImage::from_fn(CELL.0, CELL.1, |x, y| {
        let z = depth.at(x as usize * width / CELL.0 as usize, y as usize * height / CELL.1 as usize);
        if z > 0.0 { Rgb(false_colour::of_depth((z - nearest) / (farthest - nearest))) } else { HOLE }
    })
}

/// Writes a line of ASCII, its upper left corner at `corner`, and cuts it off where the cell ends.
fn write(sheet: &mut RgbImage, corner: [u32; 2], text: &str) {
    const LETTER: u32 = get_raster_width(FontWeight::Bold, RasterHeight::Size16) as u32;
    for (index, letter) in text.chars().enumerate().take((CELL.0 / LETTER) as usize) {
        let Some(glyph) = get_raster(letter, FontWeight::Bold, RasterHeight::Size16) else { continue };
        for (y, x) in (0..glyph.height()).flat_map(|y| (0..glyph.width()).map(move |x| (y, x))) {
            let share = f32::from(glyph.pixel(x, y).unwrap_or(0)) / 255.0;
            let at = sheet.get_pixel_mut(corner[0] + index as u32 * LETTER + x as u32, corner[1] + y as u32);
            *at = Rgb(at.0.map(|paper| ((1.0 - share) * f32::from(paper) + share * INK) as u8));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seen(depth: f32) -> Seen {
        let grey = |level| Image::filled(640, 480, level);
        Seen {
            light: "noon".into(),
            place: "0 s".into(),
            colour: RgbImage::from_pixel(640, 480, Rgb([10, 200, 30])),
            infrared: GrayImage::from_pixel(640, 480, image::Luma([90])),
            depth: grey(depth),
            true_depth: grey(0.5),
        }
    }

    fn middle(sheet: &RgbImage, column: u32, row: u32) -> [u8; 3] {
        sheet.get_pixel(8 + 328 * column + 160, 8 + 268 * row + 120).0
    }

    fn is_captioned(sheet: &RgbImage, column: u32, row: u32) -> bool {
        let inked = |x: u32, y: u32| sheet.get_pixel(8 + 328 * column + x, 268 * row + y).0 != PAPER.0;
        (0..320).any(|x| (250..268).any(|y| inked(x, y)))
    }

    #[test]
    fn each_instant_has_a_row_of_four_and_holes_are_black() {
        let sheet = below_each_other(&[seen(0.5), seen(0.0)]);
        assert_eq!(sheet.dimensions(), (1320, 544));
        assert_eq!((middle(&sheet, 0, 0), middle(&sheet, 1, 1)), ([10, 200, 30], [90; 3]));
        assert_eq!((middle(&sheet, 2, 0), middle(&sheet, 2, 1)), (false_colour::of_depth(0.0), [0; 3]));
        assert_eq!(middle(&sheet, 3, 1), middle(&sheet, 2, 0), "one scale for both depths");
        assert!((0..4).all(|column| is_captioned(&sheet, column, 0)));
    }

    #[test]
    fn scenarios_stand_side_by_side_with_three_images_each() {
        let sheet = side_by_side(&[seen(0.5), seen(0.0)]);
        assert_eq!(sheet.dimensions(), (664, 812));
        assert_eq!((middle(&sheet, 1, 0), middle(&sheet, 0, 1)), ([10, 200, 30], [90; 3]));
        assert_eq!((middle(&sheet, 0, 2), middle(&sheet, 1, 2)), (false_colour::of_depth(0.0), [0; 3]));
        assert!((0..2).all(|column| is_captioned(&sheet, column, 2)));
        assert_eq!(stacked(&[sheet.clone(), sheet]).dimensions(), (664, 1624));
    }

    #[test]
    fn the_share_of_depth_counts_pixels() {
        let mut half = seen(1.0);
        half.depth = Image::from_pixels(2, 1, vec![0.0, 1.0]).unwrap();
        assert_eq!(depth_cell(&half).1, "depth: 50.0 % of the pixels have one");
    }
}
