//! Portable grey maps: how images reach programs in other languages byte for byte.

use std::fs::File;
use std::io::{self, Write};
use std::path::Path;

use sunblind_estimator::image::GrayImage;

/// Writes an 8-bit binary PGM.
///
/// # Errors
/// When the file cannot be written.
pub fn write(path: &Path, image: &GrayImage) -> io::Result<()> {
    let mut file = File::create(path)?;
    write!(file, "P5\n{} {}\n255\n", image.width(), image.height())?;
    file.write_all(image.pixels())
}
