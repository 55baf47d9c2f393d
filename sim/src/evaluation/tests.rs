//! The figures beside evo's and closed forms, and what they may not depend on.

use approx::assert_relative_eq;
use nalgebra::{Isometry3, Matrix6, Quaternion, Translation3, UnitQuaternion, Vector3, Vector6};
use proptest::prelude::*;
use sunblind_estimator::geometry::exp_se3;
use sunblind_estimator::{Health, Mode, Timestamp};

use super::*;

fn frame(pose: &StampedPose) -> FrameLog {
    FrameLog {
        time: pose.time,
        world_from_body: pose.world_from_body,
        covariance: Matrix6::zeros(),
        mode: Mode::Indoor,
        health: Health::Good,
        counts: None,
        stage_ms: [0.0; 4],
    }
}

fn at(seconds: f64, world_from_body: Isometry3<f64>) -> StampedPose {
    StampedPose { time: Timestamp::from_secs(seconds).unwrap(), world_from_body }
}

fn judge(estimate: &[StampedPose], truth: &[StampedPose]) -> Evaluation {
    evaluate(&estimate.iter().map(frame).collect::<Vec<_>>(), truth).unwrap()
}

/// Straight ahead along x at 1 m/s, ten poses a second, `count` poses, every length multiplied by `stretch`.
fn straight(count: u32, stretch: f64) -> Vec<StampedPose> {
    let seconds = (0..count).map(|index| 0.1 * f64::from(index));
    seconds.map(|t| at(t, Isometry3::translation(stretch * t, 0.0, 0.0))).collect()
}

fn poses_from_tum(text: &str) -> Vec<StampedPose> {
    let numbers = |line: &str| line.split(' ').map(|number| number.parse().unwrap()).collect::<Vec<f64>>();
    text.lines()
        .map(numbers)
        .map(|n| {
            let rotation = UnitQuaternion::from_quaternion(Quaternion::new(n[7], n[4], n[5], n[6]));
            at(n[0], Isometry3::from_parts(Translation3::new(n[1], n[2], n[3]), rotation))
        })
        .collect()
}

#[test]
fn evo_finds_the_same() {
    let expected: serde_json::Value = serde_json::from_str(include_str!("../../tests/evo/expected.json")).unwrap();
    let cases = [
        ("drive", include_str!("../../tests/evo/drive_truth.tum"), include_str!("../../tests/evo/drive_estimate.tum")),
        (
            "hand_held",
            include_str!("../../tests/evo/hand_held_truth.tum"),
            include_str!("../../tests/evo/hand_held_estimate.tum"),
        ),
    ];
    for (name, truth, estimate) in cases {
        let found = judge(&poses_from_tum(estimate), &poses_from_tum(truth));
        let found = [
            ("ape_xy_m", found.rmse_x_m.hypot(found.rmse_y_m)),
            ("rmse_theta_deg", found.rmse_theta_deg),
            ("ate_m", found.ate_m),
            ("rpe_m", found.rpe_m),
            ("rpe_deg", found.rpe_deg),
            ("rpe_frame_m", found.rpe_frame_m),
            ("rpe_frame_deg", found.rpe_frame_deg),
        ];
        for (metric, value) in found {
            let expected = expected[name][metric].as_f64().unwrap();
            assert!((value / expected - 1.0).abs() < 1e-6, "{name}, {metric}: {value}, evo {expected}");
        }
    }
}

#[test]
fn a_constant_offset_is_no_error_of_shape() {
    let truth = straight(30, 1.0);
    let offset = Translation3::new(0.3, -0.4, 0.0);
    let shifted: Vec<_> =
        truth.iter().map(|pose| StampedPose { world_from_body: offset * pose.world_from_body, ..*pose }).collect();
    let found = judge(&shifted, &truth);
    assert_relative_eq!(found.rmse_x_m, 0.3, epsilon = 1e-12);
    assert_relative_eq!(found.rmse_y_m, 0.4, epsilon = 1e-12);
    assert_relative_eq!(found.end_error_m, 0.5, epsilon = 1e-12);
    assert_relative_eq!(found.path_m, 2.9, epsilon = 1e-12);
    for zero in [found.ate_m, found.rpe_m, found.rpe_deg, found.rpe_frame_m, found.drift_percent] {
        assert_relative_eq!(zero, 0.0, epsilon = 1e-9);
    }
}

#[test]
fn a_heading_error_is_the_angle_it_is() {
    let truth = straight(20, 1.0);
    let turn = UnitQuaternion::from_scaled_axis(Vector3::z() * 0.1);
    let turned: Vec<_> =
        truth.iter().map(|pose| StampedPose { world_from_body: pose.world_from_body * turn, ..*pose }).collect();
    assert_relative_eq!(judge(&turned, &truth).rmse_theta_deg, 0.1_f64.to_degrees(), epsilon = 1e-9);
}

#[test]
fn steps_two_percent_too_long_are_two_percent_of_drift() {
    for count in [20, 300] {
        let found = judge(&straight(count, 1.02), &straight(count, 1.0));
        assert_relative_eq!(found.drift_percent, 2.0, epsilon = 1e-9);
        assert_relative_eq!(found.rpe_m, 0.02, epsilon = 1e-9);
        assert_relative_eq!(found.rpe_frame_m, 0.002, epsilon = 1e-9);
    }
}

#[test]
fn what_the_recording_is_too_short_for_meets_no_bound() {
    let found = judge(&straight(9, 1.0), &straight(9, 1.0));
    assert!(found.rpe_m.is_nan() && found.rpe_deg.is_nan());
    assert_relative_eq!(found.rpe_frame_m, 0.0, epsilon = 1e-12);
    let standing = straight(9, 0.0);
    assert!(judge(&straight(9, 1.0), &standing).drift_percent.is_nan());
    assert_eq!(serde_json::to_value(found).unwrap()["rpe_m"], serde_json::Value::Null);
}

#[test]
fn fewer_than_three_frames_with_truth_are_not_judged() {
    let truth = straight(10, 1.0);
    let between: Vec<_> = truth.iter().map(|pose| at(pose.time.as_secs() + 0.05, pose.world_from_body)).collect();
    assert_eq!(evaluate(&between.iter().map(frame).collect::<Vec<_>>(), &truth), None);
    assert_eq!(evaluate(&truth.iter().map(frame).collect::<Vec<_>>(), &truth[..2]), None);
    assert!(evaluate(&truth[..5].iter().map(frame).collect::<Vec<_>>(), &truth[2..]).is_some());
}

fn rigid_motion() -> impl Strategy<Value = Isometry3<f64>> {
    (prop::array::uniform3(-50.0..50.0_f64), prop::array::uniform3(-1.5..1.5_f64))
        .prop_map(|(rho, phi)| exp_se3(&Vector6::new(rho[0], rho[1], rho[2], phi[0], phi[1], phi[2])))
}

fn jittered_walk() -> impl Strategy<Value = (Vec<StampedPose>, Vec<StampedPose>)> {
    let step = prop::array::uniform6(-0.1..0.1_f64);
    prop::collection::vec((step.clone(), step), 15..40).prop_map(|steps| {
        let mut poses = [Isometry3::identity(); 2];
        let walk = steps.iter().enumerate().map(|(index, (step, error))| {
            let step = exp_se3(&Vector6::from(*step));
            poses = [poses[0] * step, poses[1] * step * exp_se3(&(Vector6::from(*error) * 0.1))];
            poses.map(|pose| at(0.1 * index as f64, pose)).into()
        });
        walk.unzip()
    })
}

proptest! {
    #[test]
    fn where_the_world_lies_is_of_no_matter((truth, estimate) in jittered_walk(), motion in rigid_motion()) {
        let moved = |poses: &[StampedPose]| -> Vec<StampedPose> {
            poses.iter().map(|pose| StampedPose { world_from_body: motion * pose.world_from_body, ..*pose }).collect()
        };
        let (here, there) = (judge(&estimate, &truth), judge(&moved(&estimate), &moved(&truth)));
        for (here, there) in [
            (here.ate_m, there.ate_m),
            (here.rpe_m, there.rpe_m),
            (here.rpe_deg, there.rpe_deg),
            (here.rpe_frame_m, there.rpe_frame_m),
            (here.rpe_frame_deg, there.rpe_frame_deg),
            (here.rmse_theta_deg, there.rmse_theta_deg),
            (here.drift_percent, there.drift_percent),
        ] {
            prop_assert!((here - there).abs() < 1e-8, "{here} became {there}");
        }
    }

    #[test]
    fn alignment_undoes_a_motion_of_the_estimate((truth, _) in jittered_walk(), motion in rigid_motion()) {
        let moved: Vec<_> =
            truth.iter().map(|pose| StampedPose { world_from_body: motion * pose.world_from_body, ..*pose }).collect();
        prop_assert!(judge(&moved, &truth).ate_m < 1e-9);
    }
}
