//! `timeline.csv`: all that is known of every frame, one row a frame and track.

use std::io;

use serde::Serialize;
use sunblind_estimator::{Health, Mode};

use super::uncertainty::{position_covariance, rotation_covariance, sigmas};
use crate::evaluation::{position_error, rotation_error, true_pose_at};
use crate::record::stamp::decimal_seconds;
use crate::runner::log::{FrameLog, RunLog, Track};

/// The columns. Sigmas are standard deviations along (of rotations: about) the world's axes.
#[derive(Serialize)]
struct Row<'a> {
    time_s: String,
    track: &'a str,
    x_m: f64,
    y_m: f64,
    z_m: f64,
    qx: f64,
    qy: f64,
    qz: f64,
    qw: f64,
    sigma_x_m: f64,
    sigma_y_m: f64,
    sigma_z_m: f64,
    sigma_about_x_deg: f64,
    sigma_about_y_deg: f64,
    sigma_about_z_deg: f64,
    mode: Mode,
    health: &'static str,
    lost_because: Option<String>,
    features: Option<usize>,
    matches: Option<usize>,
    inliers: Option<usize>,
    keyframe: Option<bool>,
    depth_valid_share: Option<f64>,
    registration_ms: f64,
    features_ms: f64,
    matching_ms: f64,
    motion_ms: f64,
    position_error_m: Option<f64>,
    rotation_error_deg: Option<f64>,
}

/// Errors are left empty where there is no truth, counts where nothing was counted.
pub(super) fn to_csv(log: &RunLog) -> io::Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for track in &log.tracks {
        for frame in &track.frames {
            writer.serialize(row(log, track, frame))?;
        }
    }
    writer.into_inner().map_err(|error| error.into_error())
}

fn row<'a>(log: &RunLog, track: &'a Track, frame: &FrameLog) -> Row<'a> {
    let (t, q) = (frame.world_from_body.translation, frame.world_from_body.rotation.coords);
    let position_sigmas = sigmas(&position_covariance(frame));
    let rotation_sigmas = sigmas(&rotation_covariance(frame)).map(f64::to_degrees);
    let (health, lost_because) = match frame.health {
        Health::Initialising => ("initialising", None),
        Health::Good => ("good", None),
        Health::Lost(failure) => ("lost", Some(failure.to_string())),
    };
    let [registration_ms, features_ms, matching_ms, motion_ms] = frame.stage_ms;
    let truth = true_pose_at(&log.truth, frame.time);
    Row {
        time_s: decimal_seconds(frame.time),
        track: &track.name,
        x_m: t.x,
        y_m: t.y,
        z_m: t.z,
        qx: q.x,
        qy: q.y,
        qz: q.z,
        qw: q.w,
        sigma_x_m: position_sigmas[0],
        sigma_y_m: position_sigmas[1],
        sigma_z_m: position_sigmas[2],
        sigma_about_x_deg: rotation_sigmas[0],
        sigma_about_y_deg: rotation_sigmas[1],
        sigma_about_z_deg: rotation_sigmas[2],
        mode: frame.mode,
        health,
        lost_because,
        features: frame.counts.map(|counts| counts.features),
        matches: frame.counts.map(|counts| counts.matches),
        inliers: frame.counts.map(|counts| counts.inliers),
        keyframe: frame.counts.map(|counts| counts.keyframe),
        depth_valid_share: frame.counts.map(|counts| counts.depth_valid_share),
        registration_ms,
        features_ms,
        matching_ms,
        motion_ms,
        position_error_m: truth.map(|truth| position_error(&frame.world_from_body, &truth)),
        rotation_error_deg: truth.map(|truth| rotation_error(&frame.world_from_body, &truth).to_degrees()),
    }
}
