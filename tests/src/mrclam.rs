//! The sixth course of the UTIAS multi-robot data set (Leung et al. 2011): robots among landmarks whose places are
//! known, followed by motion capture.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::Read;
use std::path::Path;

use flate2::read::GzDecoder;
use nalgebra::Point2;
use sunblind_estimator::fusion::PlanarPose;

/// One robot's run; times in seconds from the first odometry reading.
pub struct Run {
    /// (time, forward m/s, counter-clockwise rad/s), each holding until the next.
    pub odometry: Vec<(f64, f64, f64)>,
    /// (time, the landmark's place, range m, bearing rad). Some are of another landmark than they say.
    pub sightings: Vec<(f64, Point2<f64>, f64, f64)>,
    /// (time, pose), at about 100 Hz.
    truth: Vec<(f64, PlanarPose)>,
}

impl Run {
    /// Where the robot was, between two instants of the truth; `None` outside of it.
    pub fn truth_at(&self, time: f64) -> Option<PlanarPose> {
        let after = self.truth.partition_point(|(at, _)| *at <= time);
        let ((from, before), (to, after)) = (self.truth.get(after.checked_sub(1)?)?, self.truth.get(after)?);
        let share = (time - from) / (to - from);
        Some(before.plus(&(after.minus(before) * share)))
    }
}

/// The five runs.
///
/// # Panics
/// When a file is missing or is not what it should be.
pub fn runs(folder: &Path) -> Vec<Run> {
    let subjects: BTreeMap<u32, u32> =
        rows::<2>(folder, "Barcodes").into_iter().map(|[subject, barcode]| (barcode as u32, subject as u32)).collect();
    let landmarks: BTreeMap<u32, Point2<f64>> = rows::<5>(folder, "Landmark_Groundtruth")
        .into_iter()
        .map(|[subject, x, y, ..]| (subject as u32, Point2::new(x, y)))
        .collect();
    assert_eq!(landmarks.len(), 15);
    let run = |robot: u32| {
        let file = |name: &str| format!("Robot{robot}_{name}");
        let odometry = rows::<3>(folder, &file("Odometry"));
        let start = odometry[0][0];
        Run {
            odometry: odometry.into_iter().map(|[time, v, w]| (time - start, v, w)).collect(),
            sightings: rows::<4>(folder, &file("Measurement"))
                .into_iter()
                .filter_map(|[time, barcode, range, bearing]| {
                    // Other robots carry barcodes too; where they are nobody told this one.
                    let landmark = landmarks.get(subjects.get(&(barcode as u32))?)?;
                    Some((time - start, *landmark, range, bearing))
                })
                .collect(),
            truth: rows::<4>(folder, &file("Groundtruth"))
                .into_iter()
                .map(|[time, x, y, heading]| (time - start, PlanarPose::new(x, y, heading)))
                .collect(),
        }
    };
    (1..=5).map(run).collect()
}

/// The rows of one gzipped table, without its comments.
fn rows<const N: usize>(folder: &Path, name: &str) -> Vec<[f64; N]> {
    let path = folder.join(format!("{name}.dat.gz"));
    let file = File::open(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let mut text = String::new();
    GzDecoder::new(file).read_to_string(&mut text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    text.lines()
        .filter(|line| !line.starts_with('#'))
        .map(|line| {
            let numbers: Vec<f64> = line.split_whitespace().filter_map(|number| number.parse().ok()).collect();
            numbers.try_into().unwrap_or_else(|_| panic!("{}: {N} numbers expected in {line:?}", path.display()))
        })
        .collect()
}
