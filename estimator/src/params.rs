//! Every parameter of the estimator: one home, each with its unit, meaning and source.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::estimator::PoseSource;
use crate::features::matching::MatchParams;
use crate::features::surf::SurfParams;
use crate::fusion::{FusionParams, GyroParams, WheelOdometryParams};
use crate::mode::{Breakpoints, ModeChoice, SwitchParams};
use crate::motion::{PaperMotionParams, RansacParams, RefineParams};
use crate::odometry::{KeyframeParams, OutdoorParams};
use crate::structure::{DepthNoise, MAX_WINDOW};

/// All that can be set. In a file every key carries its unit.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct EstimatorParams {
    /// Which visual odometry.
    pub variant: Variant,
    /// Which of the four poses is the estimate on a robot with wheels; without wheels it is `mvo`.
    pub pose_from: PoseSource,
    /// Which sensors the pose rests on: `auto` goes by what the images hold; `indoor` (colour + depth), `night`
    /// (infrared + depth), `outdoor` (colour, with the wheels' length) or `wheels` is so whatever they hold.
    pub mode: ModeChoice,
    /// How the images' energies become a mode, where that is `auto`.
    pub switch: SwitchParams,
    /// Detector.
    pub surf: SurfParams,
    /// Matching of descriptors.
    pub matching: MatchParams,
    /// How uncertain pixels and depths are.
    pub depth_noise: DepthNoise,
    /// Search for a first motion.
    pub ransac: RansacParams,
    /// Weighted refinement (variant `keyframes`).
    pub refine: RefineParams,
    /// Keyframes (variant `keyframes`).
    pub keyframes: KeyframeParams,
    /// Reject and refit (variant `paper`).
    pub paper: PaperMotionParams,
    /// Odometry without depth (mode `outdoor`).
    pub outdoor: OutdoorParams,
    /// Wheels and visual odometry together.
    pub fusion: FusionParams,
}

impl EstimatorParams {
    /// Checks every number once, so that the estimator need not.
    ///
    /// # Errors
    /// The first number outside its range.
    pub fn validate(&self) -> Result<(), ParamError> {
        let at_least_one = |key, value: usize| (key, value as f64, value >= 1, "at least 1");
        let positive = |key, value: f64| (key, value, value.is_finite() && value > 0.0, "a positive number");
        let share = |key, value: f64| (key, value, (0.0..=1.0).contains(&value), "between 0 and 1");
        let checks = [
            at_least_one("surf.max_features", self.surf.max_features),
            at_least_one("surf.cell_px", self.surf.cell),
            ("surf.octaves", self.surf.octaves as f64, (1..=4).contains(&self.surf.octaves), "1 to 4"),
            positive("surf.min_response", self.surf.min_response.into()),
            share("matching.max_ratio", self.matching.max_ratio.into()),
            positive("depth_noise.axial_per_m", self.depth_noise.axial),
            positive("depth_noise.pixel_sigma_px", self.depth_noise.pixel_sigma),
            positive("depth_noise.max_depth_m", self.depth_noise.max_depth),
            positive("depth_noise.max_scatter", self.depth_noise.max_scatter),
            ("depth_noise.window_px", self.depth_noise.window as f64, self.depth_noise.window <= MAX_WINDOW, "0 to 5"),
            at_least_one("ransac.max_iterations", self.ransac.max_iterations),
            positive("ransac.miss_probability", self.ransac.miss_probability),
            positive("ransac.max_distance_sigma", self.ransac.max_distance_sigma),
            ("ransac.min_inliers", self.ransac.min_inliers as f64, self.ransac.min_inliers >= 3, "at least 3"),
            at_least_one("refine.max_iterations", self.refine.max_iterations),
            positive("refine.step_tolerance", self.refine.step_tolerance),
            positive("refine.cauchy_sigma", self.refine.cauchy_sigma),
            positive("refine.max_distance_sigma", self.refine.max_distance_sigma),
            positive("refine.max_weakest_sigma_m", self.refine.max_weakest_sigma),
            at_least_one("keyframes.window", self.keyframes.window),
            positive("keyframes.max_flow_px", self.keyframes.max_flow),
            share("keyframes.min_overlap", self.keyframes.min_overlap),
            share("keyframes.systematic_share", self.keyframes.systematic_share),
            positive("keyframes.share_per_misalignment", self.keyframes.share_per_misalignment),
            positive("keyframes.lost_sigma_m", self.keyframes.lost_translation),
            positive("keyframes.lost_sigma_rad", self.keyframes.lost_rotation),
            positive("paper.max_distance_m", self.paper.max_distance),
            at_least_one("paper.max_iterations", self.paper.max_iterations),
            positive("paper.max_depth_m", self.paper.max_depth),
        ];
        let FusionParams { max_delay, max_wait, wheels, gyro, svsf, gate, .. } = self.fusion;
        let WheelOdometryParams {
            distance_per_metre,
            shift_per_radian,
            side_per_metre,
            turn_per_metre,
            turn_per_radian,
            position_per_second,
            turn_per_second,
            max_speed,
            silent_speed,
            silent_turn,
        } = wheels;
        let GyroParams { noise, bias, bias_walk, rest, max_bias, max_gap } = gyro;
        // Up to far beyond any robot, so that no square of them runs over.
        let sigma = |key, value: f64| (key, value, (0.0..1e6).contains(&value), "zero or a positive number");
        let fusion = [
            positive("fusion.max_delay_s", max_delay),
            positive("fusion.max_wait_s", max_wait),
            sigma("fusion.wheels.distance_noise_m_per_sqrt_m", distance_per_metre),
            sigma("fusion.wheels.shift_noise_m_per_sqrt_rad", shift_per_radian),
            sigma("fusion.wheels.side_noise_m_per_sqrt_m", side_per_metre),
            sigma("fusion.wheels.turn_noise_rad_per_sqrt_m", turn_per_metre),
            sigma("fusion.wheels.turn_noise_rad_per_sqrt_rad", turn_per_radian),
            sigma("fusion.wheels.position_noise_m_per_sqrt_s", position_per_second),
            sigma("fusion.wheels.turn_noise_rad_per_sqrt_s", turn_per_second),
            positive("fusion.wheels.max_speed_m_per_s", max_speed),
            sigma("fusion.wheels.silent_speed_m_per_s", silent_speed),
            sigma("fusion.wheels.silent_turn_rad_per_s", silent_turn),
            positive("fusion.gyro.noise_rad_per_sqrt_s", noise),
            sigma("fusion.gyro.bias_rad_per_s", bias),
            sigma("fusion.gyro.bias_walk_rad_per_s_per_sqrt_s", bias_walk),
            sigma("fusion.gyro.rest_s", rest),
            sigma("fusion.gyro.max_bias_rad_per_s", max_bias),
            positive("fusion.gyro.max_gap_s", max_gap),
            share("fusion.svsf.gamma", svsf.gamma),
            sigma("fusion.svsf.layer_sigma", svsf.layer_sigma),
            positive("fusion.gate.limit", gate.limit),
        ];
        let SwitchParams { margin, dwell, stale, look_every, look, rgb, infrared, depth, .. } = self.switch;
        let rising = |key, Breakpoints { low, high }: Breakpoints| {
            (key, high, (0.0..1.0).contains(&low) && low < high && high <= 1.0, "low < high, both between 0 and 1")
        };
        let switch = [
            share("switch.margin", margin),
            sigma("switch.dwell_s", dwell),
            positive("switch.stale_s", stale),
            positive("switch.look_every_s", look_every),
            ("switch.look_s", look, look.is_finite() && look > stale, "a number larger than switch.stale_s"),
            rising("switch.rgb", rgb),
            rising("switch.infrared", infrared),
            rising("switch.depth", depth),
        ];
        match checks.into_iter().chain(fusion).chain(switch).find(|(.., holds, _)| !holds) {
            Some((key, value, _, wanted)) => Err(ParamError::OutOfRange { key, value, wanted }),
            None => Ok(()),
        }
    }
}

/// Which visual odometry runs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Variant {
    /// Weighted by depth noise, against a window of keyframes.
    #[default]
    Keyframes,
    /// As in paper A: frame to frame, every point with equal weight.
    Paper,
}

/// A parameter no estimator can run with.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ParamError {
    /// The calibration describes no camera.
    #[error(transparent)]
    Rig(#[from] crate::camera::RigError),
    /// A number outside its range.
    #[error("{key} = {value} is out of range: {wanted}")]
    OutOfRange {
        /// The parameter's key.
        key: &'static str,
        /// The value found.
        value: f64,
        /// What would do.
        wanted: &'static str,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_defaults_hold() {
        assert_eq!(EstimatorParams::default().validate(), Ok(()));
    }

    #[test]
    fn a_number_out_of_range_is_named() {
        let mut params = EstimatorParams::default();
        params.matching.max_ratio = f32::NAN;
        assert!(params.validate().unwrap_err().to_string().starts_with("matching.max_ratio = NaN"));
        params = EstimatorParams::default();
        params.ransac.min_inliers = 2;
        assert!(params.validate().unwrap_err().to_string().contains("at least 3"));
        params = EstimatorParams::default();
        params.switch.rgb = Breakpoints { low: 0.2, high: 0.1 };
        assert!(params.validate().unwrap_err().to_string().starts_with("switch.rgb = 0.1"));
        params = EstimatorParams::default();
        params.switch.look = params.switch.stale;
        assert!(params.validate().unwrap_err().to_string().contains("larger than switch.stale_s"));
    }
}
