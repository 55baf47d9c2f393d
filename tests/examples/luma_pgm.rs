//! Writes the luma of every frame that the SURF oracle looks at as PGM, and the pairs as `pairs.txt`:
//! `cargo run --release -p sunblind-tests --example luma_pgm -- FOLDER`.
//!
//! The oracle must see the very bytes that our detector sees, and JPEG decoders differ.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::{env, fs, io};

use sunblind_tests::oracle::frame_pairs;
use sunblind_tests::pgm;
use sunblind_tests::recorded;

fn main() -> io::Result<()> {
    let folder = PathBuf::from(env::args_os().nth(1).expect("usage: luma_pgm FOLDER"));
    fs::create_dir_all(&folder)?;
    let pairs = frame_pairs();
    let names: Vec<_> = pairs.iter().map(|(from, to)| format!("{} {}\n", from.name(), to.name())).collect();
    fs::write(folder.join("pairs.txt"), names.concat())?;

    for frame in pairs.into_iter().flat_map(|(from, to)| [from, to]).collect::<BTreeSet<_>>() {
        let recording = recorded::open(frame.recording);
        pgm::write(&folder.join(frame.name() + ".pgm"), &recorded::frame(&recording, frame.index).rgb.to_luma())?;
    }
    Ok(())
}
