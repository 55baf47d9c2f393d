//! What can be wrong with a recording: each message says what, where, and what to do.

use std::io;
use std::path::PathBuf;

use image::ImageError;
use thiserror::Error;

use super::place::Place;

/// A recording that can't be replayed.
#[derive(Debug, Error)]
#[allow(missing_docs, reason = "the messages say what each field is")]
pub enum RecordError {
    /// The recording's folder does not exist, or is a file.
    #[error("{}: no such folder; give the folder that holds rgb.txt and depth.txt", folder.display())]
    NoFolder { folder: PathBuf },
    /// A file that every recording needs is missing.
    #[error("{}: no such file; {wanted}", file.display())]
    NoFile { file: PathBuf, wanted: &'static str },
    /// The file is there but can't be read as text.
    #[error("{}: can't be read: {source}; it must be a readable text file in UTF-8", file.display())]
    Unreadable { file: PathBuf, source: io::Error },
    /// A list without entries.
    #[error("{}: lists nothing; write {wanted}, one a line", file.display())]
    Empty { file: PathBuf, wanted: &'static str },
    /// A line that does not begin with a time stamp.
    #[error("{place}: `{found}` is no time stamp; write seconds as a decimal number, such as 1305031102.175304")]
    Time { place: Place, found: String },
    /// Time goes backwards or stands still.
    #[error(
        "{place}: time stamp {found} s is not later than {previous} s of the line before; sort the lines by time and \
         keep one of those that repeat"
    )]
    NotLater { place: Place, found: f64, previous: f64 },
    /// A line without a file name.
    #[error("{place}: no file name after the time stamp; write `timestamp filename`")]
    NoFileName { place: Place },
    /// A line that names an image that is not there.
    #[error("{place}: the image {} does not exist; restore it or delete this line", image.display())]
    NoImage { place: Place, image: PathBuf },
    /// Numbers that are none, or not as many as wanted.
    #[error("{place}: {problem}; write {wanted}, or delete this line")]
    Values { place: Place, problem: String, wanted: &'static str },
    /// No colour image has a depth image close enough in time.
    #[error(
        "{}: no colour image has a depth image within {within_ms} ms; rgb.txt and depth.txt must be on the same clock",
        folder.display()
    )]
    NoPairs { folder: PathBuf, within_ms: i64 },
    /// An image that is damaged or of an unknown format.
    #[error("{}: can't be decoded: {source}; copy or record it again as PNG or JPEG", file.display())]
    Undecodable { file: PathBuf, source: ImageError },
    /// A file that ends before its image does.
    #[error("{}: the file ends before the image does; copy or record it again", file.display())]
    Truncated { file: PathBuf },
    /// An image of another size than the calibration's.
    #[error(
        "{}: the image is {}×{} px, the calibration says {}×{} px for [{camera}]; correct width_px and height_px in \
         calibration.toml (and the focal length and centre with them), or replace the image",
        file.display(), found.0, found.1, expected.0, expected.1
    )]
    Size { file: PathBuf, camera: &'static str, found: (usize, usize), expected: (usize, usize) },
    /// A depth or infrared image that is not 16-bit grey.
    #[error("{}: {kind} must be 16-bit grey PNG, this image is {found}; export {kind} again with 16 bits a pixel and \
         without colours", file.display())]
    Not16Bit { file: PathBuf, kind: &'static str, found: String },
    /// An infrared image that was scaled.
    #[error("{}: an infrared value is {found}, but a Kinect's have 10 bits, 0 to 1023; export infrared again without \
         scaling it", file.display())]
    InfraredRange { file: PathBuf, found: u16 },
    /// A calibration that describes no camera.
    #[error("{place}: {problem}")]
    Calibration { place: Place, problem: String },
}
