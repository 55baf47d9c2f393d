//! Letters on a grid of 3 × 5, for labels, titles and spines.

use super::canvas::{Canvas, Coat};
use super::noise::hash;

/// Five rows of three, top left first; drawn here.
const GLYPHS: [(char, &str); 37] = [
    ('A', "010101111101101"),
    ('B', "110101110101110"),
    ('C', "011100100100011"),
    ('D', "110101101101110"),
    ('E', "111100110100111"),
    ('F', "111100110100100"),
    ('G', "011100101101011"),
    ('H', "101101111101101"),
    ('I', "111010010010111"),
    ('J', "001001001101010"),
    ('K', "101101110101101"),
    ('L', "100100100100111"),
    ('M', "101111111101101"),
    ('N', "110101101101101"),
    ('O', "010101101101010"),
    ('P', "110101110100100"),
    ('Q', "010101101110011"),
    ('R', "110101110101101"),
    ('S', "011100010001110"),
    ('T', "111010010010010"),
    ('U', "101101101101111"),
    ('V', "101101101101010"),
    ('W', "101101111111101"),
    ('X', "101101010101101"),
    ('Y', "101101010010010"),
    ('Z', "111001010100111"),
    ('0', "111101101101111"),
    ('1', "010110010010111"),
    ('2', "110001010100111"),
    ('3', "110001010001110"),
    ('4', "101101111001001"),
    ('5', "111100110001110"),
    ('6', "011100110101010"),
    ('7', "111001010010010"),
    ('8', "010101010101010"),
    ('9', "010101011001110"),
    ('-', "000000111000000"),
];

/// Which way a line of writing runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Running {
    /// To the right.
    Across,
    /// Downwards, turned clockwise, as on a book's spine.
    Down,
}

/// Writes capitals, digits and hyphens; the rest stays blank. `corner`: where the first letter's top left goes;
/// `height` of a letter, metres.
pub fn write(canvas: &mut Canvas, corner: [f32; 2], height: f32, text: &str, running: Running, coat: Coat) {
    let cell = height / 5.0;
    for (place, letter) in text.chars().enumerate() {
        let Some((_, rows)) = GLYPHS.iter().find(|(known, _)| *known == letter) else { continue };
        for (index, _) in rows.chars().enumerate().filter(|&(_, dot)| dot == '1') {
            let (along, beside) = ((4 * place + index % 3) as f32 * cell, (index / 3) as f32 * cell);
            let (x, y) = match running {
                Running::Across => (corner[0] + along, corner[1] + beside),
                Running::Down => (corner[0] - beside - cell, corner[1] + along),
            };
            canvas.rectangle([x, y, x + cell, y + cell], coat);
        }
    }
}

/// Lines of small print that nobody reads: words of random length, ragged right, in `area`.
pub fn small_print(canvas: &mut Canvas, area: [f32; 4], line: f32, coat: Coat, seed: u32) {
    let [left, top, right, bottom] = area;
    let mut row = 0;
    loop {
        let y = top + row as f32 * line;
        if y + 0.5 * line > bottom {
            return;
        }
        let end = right - 0.25 * (right - left) * hash(row, 1, seed);
        let mut x = left;
        let mut word = 0;
        while x < end {
            let length = line * (0.8 + 2.6 * hash(row, 2 + word, seed));
            canvas.rectangle([x, y, (x + length).min(end), y + 0.5 * line], coat);
            x += length + 0.45 * line;
            word += 1;
        }
        row += 1;
    }
}
