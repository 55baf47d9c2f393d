//! Images of several instants on one sheet, a row each: colour, infrared, depth, true depth.

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
pub(super) struct Row {
    /// A line of ASCII.
    pub caption: String,
    pub colour: RgbImage,
    pub infrared: GrayImage,
    /// Metres, 0 for none.
    pub depth: Image<f32>,
    /// Likewise.
    pub true_depth: Image<f32>,
}

/// The sheet. All depths have the same colours, on every sheet.
pub(super) fn draw(rows: &[Row]) -> RgbImage {
    let (cell_width, cell_height) = CELL;
    let row_height = cell_height + LINE + GAP;
    let mut sheet = RgbImage::from_pixel(GAP + 4 * (cell_width + GAP), GAP + rows.len() as u32 * row_height, PAPER);
    for (index, row) in rows.iter().enumerate() {
        let valid = valid_share(&row.depth);
        let [nearest, farthest] = DEPTHS;
        let cells = [
            (small(row.colour.clone().into()), row.caption.clone()),
            (small(row.infrared.clone().into()), "infrared".to_owned()),
            (coloured(&row.depth), format!("depth: {:.1} % of the pixels have one", 100.0 * valid)),
            (coloured(&row.true_depth), format!("true depth: {nearest} m bright, {farthest} m dark")),
        ];
        for (column, (picture, caption)) in cells.into_iter().enumerate() {
            let (x, y) = (GAP + column as u32 * (cell_width + GAP), GAP + index as u32 * row_height);
            imageops::replace(&mut sheet, &picture, x.into(), y.into());
            write(&mut sheet, [x, y + cell_height + 2], &caption);
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

    fn row(depth: f32) -> Row {
        let grey = |level| Image::filled(640, 480, level);
        Row {
            caption: "0 s".into(),
            colour: RgbImage::from_pixel(640, 480, Rgb([10, 200, 30])),
            infrared: GrayImage::from_pixel(640, 480, image::Luma([90])),
            depth: grey(depth),
            true_depth: grey(0.5),
        }
    }

    #[test]
    fn each_instant_has_a_row_of_four_and_holes_are_black() {
        let sheet = draw(&[row(0.5), row(0.0)]);
        assert_eq!(sheet.dimensions(), (1320, 544));
        let middle = |column: u32, row: u32| sheet.get_pixel(8 + 328 * column + 160, 8 + 268 * row + 120).0;
        assert_eq!((middle(0, 0), middle(1, 1)), ([10, 200, 30], [90; 3]));
        assert_eq!((middle(2, 0), middle(2, 1)), (false_colour::of_depth(0.0), [0; 3]));
        assert_eq!(middle(3, 1), middle(2, 0), "one scale for both depths");
    }

    #[test]
    fn the_captions_say_how_much_depth_there_is() {
        let mut half = row(1.0);
        half.depth = Image::from_pixels(2, 1, vec![0.0, 1.0]).unwrap();
        assert_eq!(valid_share(&half.depth), 0.5);
        let sheet = draw(&[half]);
        let inked = |x: u32, y: u32| sheet.get_pixel(x, y).0 != PAPER.0;
        let caption = |column: u32| (0..320).any(|x| (250..268).any(|y| inked(8 + 328 * column + x, y)));
        assert!((0..4).all(caption));
    }
}
