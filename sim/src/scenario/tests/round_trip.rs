//! Any valid scenario comes back as it was written, any text gets an answer.

use proptest::option;
use proptest::prelude::*;
use sunblind_estimator::params::Variant;

use super::*;
use crate::scenario::path::PathKind;

fn point() -> impl Strategy<Value = [f64; 2]> {
    prop::array::uniform2(-900.0..900.0)
}

fn heading() -> impl Strategy<Value = Option<f64>> {
    option::of(-360.0..360.0)
}

fn path() -> impl Strategy<Value = PathSpec> {
    let empty = PathSpec {
        kind: PathKind::Circle,
        points: None,
        corner_radius: None,
        start: None,
        start_heading_deg: None,
        radius: None,
        size: None,
        laps: 1,
        speed: 0.4,
    };
    // Points that lie far apart, on a curve that bends gently enough for small corners.
    let ys = prop::collection::vec(-1.0..1.0, 2..6);
    let points = ys.prop_map(|ys: Vec<f64>| (0..).zip(ys).map(|(i, y)| [f64::from(i) * 4.0, y]).collect::<Vec<_>>());
    let of_points = {
        let empty = empty.clone();
        let kind = prop_oneof![Just(PathKind::Waypoints), Just(PathKind::Spline)];
        (kind, points, option::of(0.1..0.5)).prop_map(move |(kind, points, radius)| PathSpec {
            kind,
            points: Some(points),
            corner_radius: radius.filter(|_| kind == PathKind::Waypoints),
            ..empty.clone()
        })
    };
    let round = {
        let empty = empty.clone();
        (point(), heading(), 0.2..50.0_f64, any::<bool>(), 1..9_u32).prop_map(
            move |(start, heading, size, eight, laps)| PathSpec {
                kind: if eight { PathKind::FigureEight } else { PathKind::Circle },
                start: Some(start),
                start_heading_deg: heading,
                radius: (!eight).then_some(-size),
                size: eight.then_some(size),
                laps,
                ..empty.clone()
            },
        )
    };
    (prop_oneof![of_points, round], 0.01..0.7).prop_map(|(path, speed)| PathSpec { speed, ..path })
}

fn robot() -> impl Strategy<Value = Robot> {
    let floor = prop_oneof![Just(Floor::Tile), Just(Floor::Carpet), Just(Floor::Asphalt), Just(Floor::Ideal)];
    let area = (floor.clone(), point(), prop::array::uniform2(0.1..50.0)).prop_map(|(floor, min, size)| FloorArea {
        floor,
        min,
        max: [min[0] + size[0], min[1] + size[1]],
    });
    (option::of(floor), prop::collection::vec(area, 0..3), any::<bool>(), option::of(point()), heading()).prop_map(
        |(floor, floor_areas, gyro, start, start_heading_deg)| Robot {
            urdf: None,
            floor,
            floor_areas,
            gyro,
            start,
            start_heading_deg,
        },
    )
}

fn kinect() -> impl Strategy<Value = Kinect> {
    let streams = prop_oneof![Just(StreamMode::Simultaneous), Just(StreamMode::Exclusive)];
    let exposure = prop_oneof![
        Just(InfraredExposure::Free),
        Just(InfraredExposure::LimitedExposure),
        Just(InfraredExposure::GainOnly)
    ];
    let numbers = (0.3..2.0, -27.0..27.0, 1.0..30.0, 0.0..2.0, 0.0..2.0, 0.0..0.5);
    let unit = (option::of(0.0..7200.0), option::of(0..i64::MAX as u64));
    let covered = (0.0..9.0, 9.0..20.0).prop_map(|(from_s, until_s)| Covered { from_s, until_s });
    let covered = prop::collection::vec(covered, 0..3);
    (numbers, unit, streams, exposure, any::<[bool; 6]>(), covered).prop_map(
        |(
            (lens_height, tilt_deg, rate, stream_switch, residual_px, residual_deg),
            (warm_up, unit_seed),
            streams,
            infrared_exposure,
            [noise, motion_blur, rolling_shutter, white_balance, truth_depth, full],
            covered,
        )| Kinect {
            lens_height,
            tilt_deg,
            rate,
            streams,
            stream_switch,
            noise,
            motion_blur,
            rolling_shutter,
            white_balance,
            infrared_exposure,
            warm_up,
            unit_seed,
            residual_px,
            quality: if full { Quality::Full } else { Quality::Fast },
            residual_deg,
            truth_depth,
            covered,
        },
    )
}

fn estimator() -> impl Strategy<Value = Estimator> {
    let drives = prop_oneof![
        Just(Drives::Svsf),
        Just(Drives::Ekf),
        Just(Drives::Mvo),
        Just(Drives::Odometry),
        Just(Drives::Truth)
    ];
    (drives, any::<bool>(), 1..5000_usize, 0.0..1.0_f32).prop_map(|(drives, paper, max_features, max_ratio)| {
        let variant = if paper { Variant::Paper } else { Variant::Keyframes };
        let mut params = EstimatorParams { variant, ..EstimatorParams::default() };
        params.surf.max_features = max_features;
        params.matching.max_ratio = max_ratio;
        Estimator { drives, odometry_without_gyro: paper, params }
    })
}

fn expectations() -> impl Strategy<Value = Vec<Expectation>> {
    let metric = prop_oneof![Just("svsf.ate_m"), Just("odometry.drift_percent"), Just("path_m")];
    let expectation = (metric.clone(), option::of(metric), option::of(-9.0..0.0), 0.0..9.0_f64).prop_map(
        |(metric, relative_to, min, max)| Expectation {
            metric: metric.into(),
            relative_to: relative_to.map(str::to_owned),
            min,
            max: Some(max),
        },
    );
    prop::collection::vec(expectation, 0..3)
}

fn light() -> impl Strategy<Value = Light> {
    let direction = (-90.0..90.0, -360.0..360.0)
        .prop_map(|(elevation_deg, azimuth_deg)| light::Direction { elevation_deg, azimuth_deg });
    let change = (0.0..10.0, option::of(any::<bool>()), option::of(0.0..1.0), option::of(0.0..9.0)).prop_map(
        |(over_s, lamps, cloud_cover, brightness)| light::Change {
            at_s: 5.0,
            over_s,
            lamps,
            cloud_cover,
            lamp_brightness: brightness.map(|value| ("ceiling".to_owned(), value)).into_iter().collect(),
            ..light::Change::default()
        },
    );
    (option::of(direction), 0.0..1.0, prop::collection::vec(change, 0..3))
        .prop_map(|(sun, cloud_cover, timeline)| Light { sun, cloud_cover, timeline, ..Light::default() })
}

prop_compose! {
    fn scenario()(
        seed in 0..i64::MAX as u64, duration in 10.0..3600.0, lamps: bool, daylight_scale in 0.0..100.0,
        light in light(), robot in robot(), kinect in kinect(), path in path(), estimator in estimator(), expect in expectations(),
        short in (option::of(1.0..10.0), expectations()),
    ) -> Scenario {
        Scenario {
            seed,
            duration,
            world: World { name: Some(WorldName::Laboratory), gltf: None },
            light: Light { lamps, daylight_scale, ..light },
            robot,
            kinect,
            path,
            estimator,
            expect,
            short: Short { duration: short.0, expect: short.1 },
        }
    }
}

proptest! {
    #[test]
    fn any_valid_scenario_comes_back_as_it_was_written(scenario in scenario()) {
        prop_assert_eq!(scenario.check(), Ok(()));
        let text = toml::to_string(&scenario).unwrap();
        let back = parse(&text).map_err(|error| TestCaseError::fail(format!("{error}\n{text}")))?;
        prop_assert_eq!(back, AnyScenario::Robot(Box::new(scenario)));
    }

    #[test]
    fn any_text_is_a_scenario_or_an_error(text in "\\PC*", key in "[a-z_]{1,5}(\\.[a-z_]{1,5}){0,2}", value in "\\PC*") {
        let change: Override = format!("{key}={value}").parse().unwrap();
        for text in [text.as_str(), GOOD] {
            let source = Source::new(text, Path::new("s.toml"), std::slice::from_ref(&change));
            let _ = source.scenario().map_err(|error| error.to_string());
        }
    }
}
