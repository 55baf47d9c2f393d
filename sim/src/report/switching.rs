//! `modes.csv`: how the modes came about, and what the images held in truth; one row a frame.

use std::io;

use serde::Serialize;
use sunblind_estimator::Mode;
use sunblind_estimator::mode::{Degrees, Energies, Memberships, ModeReport};

use crate::modes::{StampedInformation, StampedReport};
use crate::record::stamp::decimal_seconds;
use crate::runner::log::RunLog;

/// The columns. Energies, memberships, strengths and degrees are numbers from 0 to 1, as are the shares. A rule is named by
/// the classes that it asks for of colour, infrared and depth: `rule_lhh` fires where colour is Low and the others are
/// High.
#[derive(Serialize)]
struct Row {
    time_s: String,
    mode: Mode,
    answer: Mode,
    energy_rgb: Option<f64>,
    energy_infrared: Option<f64>,
    energy_depth: Option<f64>,
    age_rgb_s: Option<f64>,
    age_infrared_s: Option<f64>,
    age_depth_s: Option<f64>,
    high_rgb: f64,
    high_infrared: f64,
    high_depth: f64,
    rule_lll: f64,
    rule_llh: f64,
    rule_lhl: f64,
    rule_lhh: f64,
    rule_hll: f64,
    rule_hlh: f64,
    rule_hhl: f64,
    rule_hhh: f64,
    degree_indoor: f64,
    degree_outdoor: f64,
    degree_night: f64,
    degree_odometer: f64,
    best_mode: Option<Mode>,
    rgb_contrast_share: Option<f64>,
    infrared_contrast_share: Option<f64>,
    depth_right_share: Option<f64>,
}

/// Truth is left empty where there is none.
pub(super) fn to_csv(log: &RunLog) -> io::Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for said in &log.modes {
        let known = log.information.binary_search_by_key(&said.time, |known| known.time).ok();
        writer.serialize(row(said, known.map(|index| &log.information[index])))?;
    }
    writer.into_inner().map_err(|error| error.into_error())
}

fn row(StampedReport { time, report }: &StampedReport, known: Option<&StampedInformation>) -> Row {
    let ModeReport { mode, answer, energies, ages_s, memberships, inference } = *report;
    let Energies { rgb, infrared, depth } = energies;
    let [age_rgb_s, age_infrared_s, age_depth_s] = ages_s;
    let Memberships { rgb: of_rgb, infrared: of_infrared, depth: of_depth } = memberships;
    let Degrees { indoor, outdoor, night, odometer } = inference.degrees;
    // In the order of the table.
    let [rule_lll, rule_llh, rule_lhl, rule_lhh, rule_hll, rule_hlh, rule_hhl, rule_hhh] = inference.strengths;
    let known = known.map(|known| known.information);
    Row {
        time_s: decimal_seconds(*time),
        mode,
        answer,
        energy_rgb: rgb,
        energy_infrared: infrared,
        energy_depth: depth,
        age_rgb_s,
        age_infrared_s,
        age_depth_s,
        high_rgb: of_rgb.high,
        high_infrared: of_infrared.high,
        high_depth: of_depth.high,
        rule_lll,
        rule_llh,
        rule_lhl,
        rule_lhh,
        rule_hll,
        rule_hlh,
        rule_hhl,
        rule_hhh,
        degree_indoor: indoor,
        degree_outdoor: outdoor,
        degree_night: night,
        degree_odometer: odometer,
        best_mode: known.map(|known| known.best_mode()),
        rgb_contrast_share: known.map(|known| known.rgb),
        infrared_contrast_share: known.map(|known| known.infrared),
        depth_right_share: known.map(|known| known.depth),
    }
}
