//! Images on disk, and the two of one frame.

use std::fs;
use std::io::Cursor;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use image::{ColorType, DynamicImage, ImageDecoder, ImageFormat, ImageReader};
use sunblind_estimator::image::{DepthImage, Image, InfraredImage, RgbImage};
use sunblind_estimator::{Rig, Timestamp};

use super::error::RecordError;

/// The largest of ten bits.
const INFRARED_MAX: u16 = 1023;

/// An image on disk.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ImageFile {
    /// When it was captured.
    pub time: Timestamp,
    /// Where it lies.
    pub path: PathBuf,
}

/// A frame on disk.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FrameFiles {
    /// Colour.
    pub rgb: ImageFile,
    /// Depth.
    pub depth: ImageFile,
}

/// A frame in memory.
#[derive(Clone, Debug)]
pub struct Frame {
    /// When the colour image was captured; this is the frame's time.
    pub rgb_time: Timestamp,
    /// When the depth image was captured.
    pub depth_time: Timestamp,
    /// Colour.
    pub rgb: Arc<RgbImage>,
    /// Depth, in the rig's encoding.
    pub depth: Arc<DepthImage>,
}

impl FrameFiles {
    /// Decodes both images.
    ///
    /// # Errors
    /// An image that is damaged, of another size than the rig's, or (depth) not 16-bit grey.
    pub fn decode(&self, rig: &Rig) -> Result<Frame, RecordError> {
        Ok(Frame {
            rgb_time: self.rgb.time,
            depth_time: self.depth.time,
            rgb: Arc::new(colour(&self.rgb.path, rig.colour.size())?),
            depth: Arc::new(depth(&self.depth.path, rig.depth.model.size())?),
        })
    }
}

pub(super) fn colour(file: &Path, expected: (usize, usize)) -> Result<RgbImage, RecordError> {
    let bytes = read(file)?;
    let decoder = decoder(file, &bytes, "colour", expected)?;
    let image = DynamicImage::from_decoder(decoder).map_err(|source| undecodable(file, source))?;
    Ok(of_size(expected, image.into_rgb8().into_raw().as_chunks().0.to_vec()))
}

pub(super) fn depth(file: &Path, expected: (usize, usize)) -> Result<DepthImage, RecordError> {
    grey16(file, "depth", expected)
}

/// The infrared camera is the depth camera: `expected` is its size.
pub(super) fn infrared(file: &Path, expected: (usize, usize)) -> Result<InfraredImage, RecordError> {
    let image = grey16(file, "infrared", expected)?;
    match image.pixels().iter().find(|&&value| value > INFRARED_MAX) {
        Some(&found) => Err(RecordError::InfraredRange { file: file.to_owned(), found }),
        None => Ok(image),
    }
}

fn grey16(file: &Path, kind: &'static str, expected: (usize, usize)) -> Result<Image<u16>, RecordError> {
    let bytes = read(file)?;
    let decoder = decoder(file, &bytes, "depth", expected)?;
    let found = decoder.color_type();
    if found != ColorType::L16 {
        return Err(RecordError::Not16Bit { file: file.to_owned(), kind, found: in_words(found) });
    }
    let image = DynamicImage::from_decoder(decoder).map_err(|source| undecodable(file, source))?;
    Ok(of_size(expected, image.into_luma16().into_raw()))
}

fn of_size<P>((width, height): (usize, usize), pixels: Vec<P>) -> Image<P> {
    Image::from_pixels(width, height, pixels).expect("the decoder gives as many pixels as its header says")
}

fn read(file: &Path) -> Result<Vec<u8>, RecordError> {
    fs::read(file).map_err(|error| undecodable(file, error.into()))
}

/// Reads the header only, so that an image of the wrong size costs nothing, however large it claims to be.
fn decoder<'a>(
    file: &Path,
    bytes: &'a [u8],
    camera: &'static str,
    expected: (usize, usize),
) -> Result<impl ImageDecoder + 'a, RecordError> {
    let format = image::guess_format(bytes).map_err(|source| undecodable(file, source))?;
    if format == ImageFormat::Jpeg && !jpeg_is_whole(bytes) {
        return Err(RecordError::Truncated { file: file.to_owned() });
    }
    let reader = ImageReader::with_format(Cursor::new(bytes), format);
    let decoder = reader.into_decoder().map_err(|source| undecodable(file, source))?;
    let (width, height) = decoder.dimensions();
    let found = (width as usize, height as usize);
    if found != expected {
        return Err(RecordError::Size { file: file.to_owned(), camera, found, expected });
    }
    Ok(decoder)
}

/// Whether the last scan (FF DA) is followed by the end of the image (FF D9); neither occurs within a scan
/// (ITU-T T.81, B.1.1.2 and B.1.1.5). The decoder itself fills what is missing with grey and says nothing.
fn jpeg_is_whole(bytes: &[u8]) -> bool {
    let last = |marker: [u8; 2]| bytes.windows(2).rposition(|pair| pair == marker);
    last([0xff, 0xd9]) > last([0xff, 0xda])
}

fn undecodable(file: &Path, source: image::ImageError) -> RecordError {
    RecordError::Undecodable { file: file.to_owned(), source }
}

fn in_words(colour: ColorType) -> String {
    let bits = colour.bits_per_pixel() / u16::from(colour.channel_count());
    let kind = if colour.has_color() { "colour" } else { "grey" };
    let alpha = if colour.has_alpha() { " with transparency" } else { "" };
    format!("{bits}-bit {kind}{alpha}")
}
