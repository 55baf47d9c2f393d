//! The fusion as a whole: a small robot with known noise, and what may not happen whatever is measured.

use nalgebra::{Isometry3, Matrix2, Matrix3, Matrix6, Point2, Vector3, Vector6};
use proptest::prelude::*;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::*;
use crate::geometry::{adjoint, exp_se3};

fn at(secs: f64) -> Timestamp {
    Timestamp::from_secs(secs).unwrap()
}

/// A robot that drives S-bends, its wheels as uncertain as the parameters say, and a camera on it that measures
/// against a keyframe in three frames out of four.
struct Robot {
    random: ChaCha8Rng,
    params: WheelOdometryParams,
    truth: PlanarPose,
    /// Rolled by the wheels, metres.
    rolled: [f64; 2],
    /// True pose of the keyframe, and visual odometry's idea of it.
    keyframe: (PlanarPose, Isometry3<f64>, Matrix6<f64>),
    time: f64,
    frames: usize,
}

/// Wheels at 50 Hz, frames at 12.5 Hz.
const TICK: f64 = 0.02;
const TICKS_PER_FRAME: usize = 4;
/// σ of a frame's motion since the keyframe, metres and radians.
const VISUAL_SIGMA: [f64; 2] = [0.004, 0.003];

impl Robot {
    fn new(seed: u64) -> Self {
        Self {
            random: ChaCha8Rng::seed_from_u64(seed),
            params: WheelOdometryParams::default(),
            truth: PlanarPose::default(),
            rolled: [0.0; 2],
            keyframe: (PlanarPose::default(), Isometry3::identity(), Matrix6::zeros()),
            time: 0.0,
            frames: 0,
        }
    }

    fn normal(&mut self) -> f64 {
        StandardNormal.sample(&mut self.random)
    }

    /// One step of the wheels; what the encoders read after it.
    fn drive(&mut self) -> (i64, i64) {
        let distance = 0.4 * TICK;
        let turn = 0.5 * (0.4 * self.time).sin() * TICK;
        self.time += TICK;
        // The wheels see what was commanded; the robot does something near it.
        let (left, right) = (distance - turn * 0.294, distance + turn * 0.294);
        self.rolled = [self.rolled[0] + left, self.rolled[1] + right];
        let arc = self.params.arc(distance, turn, TICK);
        let done = Arc {
            distance: distance + arc.distance_variance.sqrt() * self.normal(),
            turn: turn + arc.turn_variance.sqrt() * self.normal(),
            ..arc
        };
        let aside = arc.side_variance.sqrt() * self.normal();
        let half = turn / 2.0;
        let slip = PlanarPose::new(-half.sin() * aside, half.cos() * aside, 0.0);
        let motion = done.motion().pose;
        self.truth = self.truth * PlanarPose::new(motion.x + slip.x, motion.y + slip.y, motion.heading);
        let ticks = self.rolled.map(|metres| (metres * 138_000.0).round() as i64);
        (ticks[0], ticks[1])
    }

    /// The frame of this instant.
    fn look(&mut self) -> VisualPose {
        let [shift, turn] = VISUAL_SIGMA;
        let noise = Vector6::from_fn(|_, _| StandardNormal.sample(&mut self.random));
        let sigma = Vector6::new(shift, shift, shift, turn, turn, turn);
        let (keyframe, start_from_keyframe, covariance) = &self.keyframe;
        let motion = (keyframe.inverse() * self.truth).to_isometry() * exp_se3(&noise.component_mul(&sigma));
        let start_from_robot = start_from_keyframe * motion;
        let carry = adjoint(&start_from_robot);
        let own = carry * Matrix6::from_diagonal(&sigma.component_mul(&sigma)) * carry.transpose();
        let visual = VisualPose {
            keyframe: self.frames.is_multiple_of(4),
            ..VisualPose::keyframe(at(self.time), start_from_robot, covariance + own)
        };
        if visual.keyframe {
            self.keyframe = (self.truth, start_from_robot, visual.covariance);
        }
        self.frames += 1;
        visual
    }
}

/// The fusion and the truth after a drive, frames arriving `delay` ticks late; the last have not arrived yet.
fn run(
    seed: u64,
    seconds: f64,
    delay: usize,
    params: FusionParams,
) -> (Fusion, PlanarPose, VecDeque<(usize, VisualPose)>) {
    let mut robot = Robot::new(seed);
    let mut fusion = Fusion::new(params, Drive::default());
    fusion.handle_ticks(at(0.0), 0, 0).unwrap();
    let first = robot.look();
    robot.keyframe = (robot.truth, Isometry3::identity(), Matrix6::zeros());
    let first = VisualPose { start_from_robot: Isometry3::identity(), covariance: Matrix6::zeros(), ..first };
    let mut late: VecDeque<(usize, VisualPose)> = VecDeque::from([(0, first)]);
    for tick in 1..=(seconds / TICK) as usize {
        let (left, right) = robot.drive();
        fusion.handle_ticks(at(robot.time), left, right).unwrap();
        if tick % TICKS_PER_FRAME == 0 {
            late.push_back((tick + delay, robot.look()));
        }
        while late.front().is_some_and(|(due, _)| *due <= tick) {
            fusion.handle_visual(late.pop_front().unwrap().1).unwrap();
        }
    }
    assert_eq!(fusion.time(), Some(at(robot.time)));
    (fusion, robot.truth, late)
}

fn nees(estimate: &UncertainPose, truth: &PlanarPose) -> f64 {
    let error = truth.minus(&estimate.pose);
    error.dot(&(estimate.covariance.try_inverse().unwrap() * error))
}

#[test]
fn the_covariances_are_honest() {
    // Three numbers, so 3 when all is right. Over 100 drives: 20 leave ± 0.55.
    let drives = 100;
    for delay in [0, 5] {
        let mut sums = [0.0; 3];
        let mut squares = [0.0; 3];
        for seed in 0..drives {
            let (fusion, truth, _) = run(seed, 20.0, delay, FusionParams::default());
            for (index, estimate) in [fusion.odometry(), fusion.ekf(), fusion.svsf()].iter().enumerate() {
                sums[index] += nees(estimate, &truth) / drives as f64;
                squares[index] += estimate.pose.distance(&truth).powi(2) / drives as f64;
            }
        }
        let [odometry, ekf, svsf] = sums;
        let rmse = squares.map(f64::sqrt);
        assert!((1.5..6.0).contains(&odometry) && (1.5..6.0).contains(&ekf) && (1.5..6.0).contains(&svsf), "{sums:?}");
        // Either filter is worth having, and the optimal one is best where all noise is as it is said to be.
        assert!(rmse[1] < 0.5 * rmse[0] && rmse[2] < 0.5 * rmse[0] && rmse[1] < 1.05 * rmse[2], "{rmse:?}");
    }
}

/// Half a metre a second straight on, wheels at 10 Hz, a frame between every two readings.
fn straight_on(
    fusion: &mut Fusion,
    from: usize,
    to: usize,
    wheels: bool,
    mut look: impl FnMut(f64) -> Option<VisualPose>,
) {
    for step in from..to {
        let time = 0.1 * step as f64;
        if wheels {
            let ticks = (0.5 * time * 138_000.0) as i64;
            fusion.handle_ticks(at(time), ticks, ticks).unwrap();
        }
        if let Some(frame) = look(time + 0.05) {
            fusion.handle_visual(frame).unwrap();
        }
    }
}

fn frame(time: f64, x: f64) -> VisualPose {
    VisualPose::keyframe(at(time), Isometry3::translation(x, 0.0, 0.0), Matrix6::identity() * (1e-6 * (1.0 + time)))
}

#[test]
fn a_frame_between_two_wheel_readings_is_fused_at_its_own_instant() {
    let mut fusion = Fusion::new(FusionParams::default(), Drive::default());
    // Wheels and camera agree: were a frame taken for one of the newest reading, half a step would be missing.
    straight_on(&mut fusion, 0, 21, true, |time| Some(frame(time, 0.5 * time - 0.025)));
    for estimate in [fusion.odometry(), fusion.ekf(), fusion.svsf()] {
        assert!((estimate.pose.x - 1.0).abs() < 1e-4, "{estimate:?}");
    }
    // The last frame, at 2.05 s, still waits for the wheels.
    assert_eq!((fusion.time(), fusion.waiting.len()), (Some(at(2.0)), 1));
}

#[test]
fn a_late_frame_changes_nothing_but_when_it_is_known() {
    let (on_time, ..) = run(1, 4.0, 0, FusionParams::default());
    let (mut late, _, missing) = run(1, 4.0, 7, FusionParams::default());
    assert!(missing.len() == 2 && late.ekf().covariance[(0, 0)] > on_time.ekf().covariance[(0, 0)]);
    for (_, frame) in missing {
        late.handle_visual(frame).unwrap();
    }
    assert_eq!((late.ekf(), late.svsf()), (on_time.ekf(), on_time.svsf()));
    let mut fusion = Fusion::new(FusionParams::default(), Drive::default());
    straight_on(&mut fusion, 0, 31, true, |_| None);
    assert_eq!(fusion.handle_visual(frame(1.0, 0.5)), Err(Rejection::OutOfOrder));
    assert_eq!(fusion.handle_visual(frame(2.5, 1.25)), Ok(()));
    assert_eq!(fusion.handle_visual(frame(2.5, 1.25)), Err(Rejection::OutOfOrder));
}

#[test]
fn where_one_is_silent_the_other_carries_on() {
    let mut fusion = Fusion::new(FusionParams::default(), Drive::default());
    let mut seen = 0.0;
    straight_on(&mut fusion, 0, 11, true, |time| Some(frame(time, 0.5 * time)));
    assert!(fusion.wheels_speak());
    straight_on(&mut fusion, 11, 31, false, |time| {
        seen = time;
        Some(frame(time, 0.5 * time))
    });
    assert!(!fusion.wheels_speak());
    // Without wheels frames are fused when they have waited long enough; the newest two or three still do.
    let (time, ekf, svsf) = (fusion.time().unwrap().as_secs(), fusion.ekf(), fusion.svsf());
    assert!(seen - time < 0.31 && (ekf.pose.x - 0.5 * time).abs() < 0.01 && (svsf.pose.x - 0.5 * time).abs() < 0.01);
    // The wheels come back with all they have rolled in between: not counted twice. Then the camera is covered.
    straight_on(&mut fusion, 31, 61, true, |time| {
        Some(VisualPose { tracked: false, keyframe: false, ..frame(time, 1.5) })
    });
    assert!((fusion.ekf().pose.x - 3.0).abs() < 0.03, "{:?}", fusion.ekf());
    assert!(fusion.ekf().covariance[(0, 0)] > ekf.covariance[(0, 0)]);
    // A frame that starts visual odometry anew is no measurement, the one after it is.
    let anew = VisualPose { tracked: false, ..frame(6.07, 1.5) };
    fusion.handle_visual(anew).unwrap();
    straight_on(&mut fusion, 61, 71, true, |time| Some(frame(time, 1.5 + 0.5 * (time - 6.07))));
    assert!((fusion.ekf().pose.x - 3.5).abs() < 0.03 && (fusion.svsf().pose.x - 3.5).abs() < 0.03);
}

#[test]
fn free_running_follows_the_camera_wherever_it_drifts() {
    for (visual, expected) in [(VisualMeasurement::FreeRunning, 1.0), (VisualMeasurement::SinceKeyframe, 1.5)] {
        let mut fusion = Fusion::new(FusionParams { visual, ..FusionParams::default() }, Drive::default());
        // Half a metre is lost at once, as when visual odometry starts anew: the frame says so by `tracked`.
        straight_on(&mut fusion, 0, 31, true, |time| {
            let (x, lost) = (0.5 * time - if time > 1.5 { 0.5 } else { 0.0 }, (time - 1.55).abs() < 0.01);
            Some(VisualPose { tracked: !lost, ..frame(time, x - 0.025) })
        });
        for estimate in [fusion.ekf(), fusion.svsf()] {
            assert!((estimate.pose.x - expected).abs() < 0.05, "{visual:?} {estimate:?}");
        }
    }
}

#[test]
fn what_is_wrong_in_another_way_each_time_is_kept_out() {
    for enabled in [false, true] {
        let gate = GateParams { enabled, ..GateParams::default() };
        let mut fusion = Fusion::new(FusionParams { gate, ..FusionParams::default() }, Drive::default());
        let mut random = ChaCha8Rng::seed_from_u64(5);
        let mut step = || -> f64 { 0.3 * <StandardNormal as Distribution<f64>>::sample(&StandardNormal, &mut random) };
        straight_on(&mut fusion, 0, 101, true, |time| {
            // Each frame a motion that a few bad features agree on by chance, against the same keyframe.
            let x = if time < 0.1 { 0.0 } else { 0.5 * time + step() };
            Some(VisualPose { keyframe: time < 0.1, ..frame(time, x) })
        });
        for estimate in [fusion.ekf(), fusion.svsf()] {
            let error = (estimate.pose.x - 5.0).abs();
            assert!(if enabled { error < 0.1 } else { error > 0.1 }, "gate: {enabled}, {error} m");
        }
    }
}

#[test]
fn wheels_that_spin_are_found_out() {
    // From the second second on the wheels turn on the spot; the camera says so in each frame.
    for keyframes in [1, 4] {
        let mut fusion = Fusion::new(FusionParams::default(), Drive::default());
        let mut frames = 0;
        straight_on(&mut fusion, 0, 61, true, |time| {
            frames += 1;
            let x = 0.5 * time.min(2.0);
            Some(VisualPose { keyframe: frames % keyframes == 0, ..frame(time, x) })
        });
        for estimate in [fusion.ekf(), fusion.svsf()] {
            assert!((estimate.pose.x - 1.0).abs() < 0.35, "{keyframes} {estimate:?}");
        }
    }
}

#[test]
fn a_slip_that_was_seen_is_taken_off_what_the_wheels_say() {
    // One metre in twenty is none; how far, the frames do not know.
    let mut fusion = Fusion::new(FusionParams::default(), Drive::default());
    straight_on(&mut fusion, 0, 61, true, |time| {
        let covariance = Matrix6::identity() * (1.0 + time);
        Some(VisualPose { way_share: 0.95, covariance, ..frame(time, 0.475 * time) })
    });
    assert!((fusion.odometry().pose.x - 3.0).abs() < 1e-9);
    for estimate in [fusion.ekf(), fusion.svsf()] {
        assert!((estimate.pose.x - 2.85).abs() < 0.02, "{estimate:?}");
    }
}

#[test]
fn an_encoder_that_was_reset_costs_one_reading() {
    let mut fusion = Fusion::new(FusionParams::default(), Drive::default());
    for (time, ticks) in [(0.0, 0), (0.1, 6_900), (0.2, 13_800)] {
        fusion.handle_ticks(at(time), ticks, ticks).unwrap();
    }
    assert!(matches!(fusion.handle_ticks(at(0.3), 5_000_000, 0), Err(Rejection::ImpossibleSpeed { .. })));
    fusion.handle_ticks(at(0.4), 5_006_900, 6_900).unwrap();
    for pose in [fusion.odometry(), fusion.ekf(), fusion.svsf()] {
        assert!((pose.pose.x - 0.15).abs() < 1e-9, "{pose:?}");
    }
}

#[test]
fn a_doubtful_mode_weighs_little() {
    let fused = |doubt: f64| {
        let params = FusionParams { gate: GateParams::open(), ..FusionParams::default() };
        let mut fusion = Fusion::new(params, Drive::default());
        let random = |time: f64| 0.02 * (37.0 * time).sin();
        straight_on(&mut fusion, 0, 41, true, |time| {
            let covariance = Matrix6::identity() * (1e-4 * (1.0 + time));
            Some(VisualPose { doubt, covariance, ..frame(time, 0.5 * time + random(time) * time.min(1.0)) })
        });
        fusion.ekf()
    };
    let (sure, doubtful, none) = (fused(1.0), fused(25.0), fused(1e7));
    let away = |estimate: &UncertainPose| (estimate.pose.x - none.pose.x).abs();
    assert!(away(&doubtful) < 0.3 * away(&sure), "{} {}", away(&doubtful), away(&sure));
    assert!(doubtful.covariance[(0, 0)] > sure.covariance[(0, 0)]);
}

/// What may happen to a filter.
#[derive(Clone, Debug)]
enum Event {
    Drive(Arc),
    Pose([f64; 3], [f64; 9]),
    Landmark([f64; 2], [f64; 2], [f64; 2]),
    Anchor,
}

fn event() -> impl Strategy<Value = Event> {
    let variance = 0.0..0.1_f64;
    let arc = (-2.0..2.0_f64, -3.0..3.0_f64, variance.clone(), variance.clone(), variance);
    prop_oneof![
        arc.prop_map(|(distance, turn, distance_variance, turn_variance, side_variance)| {
            Event::Drive(Arc { distance, turn, distance_variance, turn_variance, turn_drift: 0.0, side_variance })
        }),
        (prop::array::uniform3(-9.0..9.0_f64), prop::array::uniform9(-1.0..1.0_f64))
            .prop_map(|(pose, root)| Event::Pose(pose, root)),
        (
            prop::array::uniform2(-9.0..9.0_f64),
            prop::array::uniform2(-9.0..9.0_f64),
            prop::array::uniform2(1e-6..1.0_f64)
        )
            .prop_map(|(seen, landmark, variance)| Event::Landmark(seen, landmark, variance)),
        Just(Event::Anchor),
    ]
}

fn happen<G: Gain>(filter: &mut PoseFilter<G>, event: &Event) {
    match event {
        Event::Drive(arc) => filter.predict(&arc.motion()),
        Event::Pose([x, y, heading], root) => {
            let root = Matrix3::from_row_slice(root);
            let pose = PlanarPose::new(*x, *y, *heading);
            filter.update_pose(&UncertainPose { pose, covariance: root * root.transpose() });
        }
        Event::Landmark([range, bearing], [x, y], variance) => {
            let covariance = Matrix2::from_diagonal(&(*variance).into());
            let sighting = RangeBearing { range: *range, bearing: *bearing, covariance };
            filter.update_landmark(&sighting, &Point2::new(*x, *y));
        }
        Event::Anchor => filter.restart(),
    }
}

fn assert_covariance(estimate: &UncertainPose) {
    let UncertainPose { covariance, .. } = estimate;
    assert!(estimate.is_finite(), "{estimate:?}");
    assert_eq!(*covariance, covariance.transpose());
    let least = covariance.symmetric_eigenvalues().min();
    assert!(least > -1e-9 * covariance.trace().max(1e-3), "{least} of {covariance}");
    assert!(estimate.pose.heading.abs() <= std::f64::consts::PI);
}

proptest! {
    #[test]
    fn a_covariance_stays_one_whatever_happens(events in prop::collection::vec(event(), 1..40), gated in any::<bool>()) {
        let gate = GateParams { enabled: gated, ..GateParams::default() };
        let start = UncertainPose { covariance: Matrix3::identity() * 0.01, ..UncertainPose::default() };
        let mut ekf = Ekf::new(start, gate);
        let mut svsf = Svsf::new(start, SvsfParams::default(), gate);
        for event in &events {
            happen(&mut ekf, event);
            happen(&mut svsf, event);
            assert_covariance(ekf.estimate());
            assert_covariance(svsf.estimate());
        }
    }

    #[test]
    fn whatever_is_measured_numbers_come_out(
        readings in prop::collection::vec((-9.0..9.0_f64, any::<[i64; 2]>(), prop::array::uniform8(prop_oneof![-9.0..9.0_f64, any::<f64>()]), any::<[bool; 3]>()), 1..30),
        free_running in any::<bool>(),
    ) {
        let visual = if free_running { VisualMeasurement::FreeRunning } else { VisualMeasurement::SinceKeyframe };
        let mut fusion = Fusion::new(FusionParams { visual, ..FusionParams::default() }, Drive::default());
        let mut time = 0.0;
        for (step, [left, right], numbers, [wheels, tracked, keyframe]) in readings {
            time += step.exp2().min(1.0) - 0.002;
            if wheels {
                let _ = fusion.handle_ticks(at(time), left >> 45, right >> 45);
                let _ = fusion.handle_gyro(at(time), numbers[0]);
            }
            let turn = nalgebra::UnitQuaternion::from_scaled_axis(Vector3::new(numbers[3].sin(), 0.1, numbers[4].sin()));
            let start_from_robot = Isometry3::from_parts(nalgebra::Translation3::new(numbers[0], numbers[1], numbers[2]), turn);
            let root = Vector6::new(numbers[5], numbers[6], numbers[7], 1.0, 0.1, 0.3);
            let covariance = Matrix6::from_diagonal(&root.abs()) + root * root.transpose();
            let _ = fusion.handle_visual(VisualPose { tracked, keyframe, ..VisualPose::keyframe(at(time - 0.01), start_from_robot, covariance) });
            for estimate in [fusion.odometry(), fusion.ekf(), fusion.svsf()] {
                prop_assert!(estimate.is_finite(), "{estimate:?}");
            }
        }
    }
}
