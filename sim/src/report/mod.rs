//! What a run leaves behind on disk: numbers for programs, trajectories for other tools, one page for people.

mod animation;
mod chart;
mod expectations;
mod figures;
mod format;
mod headline;
mod imagery;
mod judged;
mod metrics;
mod page;
mod pictures;
mod scale;
mod summary;
mod switching;
#[cfg(test)]
mod tests;
mod timeline;
mod timing;
mod trajectory;
mod uncertainty;

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use self::judged::Judged;
use crate::runner::log::RunLog;

/// Writes `summary.json`, `timeline.csv`, `modes.csv` (of an estimator that has a mode switch), `truth.tum` (where there
/// is truth), one `<track>.tum` each and `report.html` into the folder `out`; the path of the last. Equal logs give equal bytes.
///
/// # Errors
/// What the file system says; `InvalidInput` for a log without tracks, or with a track name that is no plain file stem
/// or is taken twice.
pub fn write(log: &RunLog, out: &Path) -> io::Result<PathBuf> {
    let judged = Judged::new(log)?;
    fs::write(out.join("summary.json"), summary::to_json(&judged)?)?;
    fs::write(out.join("timeline.csv"), timeline::to_csv(log)?)?;
    if !log.modes.is_empty() {
        fs::write(out.join("modes.csv"), switching::to_csv(log)?)?;
    }
    if !log.truth.is_empty() {
        fs::write(out.join("truth.tum"), trajectory::to_tum(log.truth.iter().map(|p| (p.time, p.world_from_body))))?;
    }
    for track in &log.tracks {
        let poses = track.frames.iter().map(|frame| (frame.time, frame.world_from_body));
        fs::write(out.join(format!("{}.tum", track.name)), trajectory::to_tum(poses))?;
    }
    let page = out.join("report.html");
    fs::write(&page, page::to_html(&judged)?)?;
    Ok(page)
}
