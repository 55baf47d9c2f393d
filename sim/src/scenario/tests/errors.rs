//! What is said of a scenario that is wrong, and where.

use super::*;

fn error_of(text: &str) -> String {
    parse(text).unwrap_err().to_string()
}

/// `text` with `line` instead of the line that sets the same key, or at the end.
fn with(text: &str, line: &str) -> String {
    let key = line.split('=').next().unwrap();
    let old = text.lines().find(|old| old.starts_with(key));
    old.map_or_else(|| format!("{text}{line}\n"), |old| text.replace(old, line))
}

/// What is said of `GOOD` with one line changed or added; `place` is `line:column`.
fn assert_refused(line: &str, place: &str, parts: &[&str]) {
    let message = error_of(&with(GOOD, line));
    assert!(message.starts_with(&format!("s.toml:{place}: ")), "{line}: {message}");
    assert!(parts.iter().all(|part| message.contains(part)), "{line}: {message}");
    assert_eq!(message.lines().count(), 1, "{message}");
}

#[test]
fn an_unknown_key_is_placed_and_the_nearest_valid_one_named() {
    assert_refused("speed_m_s = 0.3", "9:1", &["unknown key `speed_m_s`", "did you mean `speed_m_per_s`?"]);
    // A wrong unit is an unknown key.
    assert_refused("radius_cm = 50", "9:1", &["did you mean `radius_m`?"]);
    assert_refused("[kinekt]", "9:2", &["did you mean `kinect`?"]);
    assert_refused("[robot]\ngyros = true", "10:1", &["did you mean `gyro`?"]);
    assert_refused("[estimator.params.surf]\nfeatures = 5", "10:1", &["did you mean `max_features`?"]);
    assert_refused("[short]\nduration = 3", "10:1", &["did you mean `duration_s`?"]);
}

#[test]
fn an_unknown_name_is_answered_with_the_nearest() {
    assert_refused("name = \"laboratry\"", "4:8", &["`textured_room`", "did you mean `laboratory`?"]);
    assert_refused("kind = \"cycle\"", "6:8", &["did you mean `circle`?"]);
    assert_refused("[estimator]\ndrives = \"kalman\"", "10:10", &["expected one of `svsf`, `ekf`"]);
    assert_refused("[robot]\nfloor = \"tiles\"", "10:9", &["did you mean `tile`?"]);
    assert_refused("[[expect]]\nmetric = \"svsf.ate\"\nmax = 1", "10:10", &["did you mean `svsf.ate_m`?"]);
}

#[test]
fn a_wrong_type_is_said_in_the_users_words() {
    assert_refused("radius_m = \"0.5\"", "8:12", &["string \"0.5\"", "expected a number"]);
    assert_refused("seed = -1", "1:8", &["expected a whole number, 0 or more"]);
    assert_refused("start_m = [1.0]", "7:11", &["length 1", "length 2"]);
    let message = error_of(&format!("kinect = 15\n{GOOD}"));
    assert!(message.starts_with("s.toml:1:10: ") && message.ends_with("expected a table"), "{message}");
}

#[test]
fn what_is_no_toml_is_placed() {
    assert_refused("seed = ", "1:8", &["expected"]);
    assert_refused("radius_m = [4.0", "8:16", &["array"]);
}

#[test]
fn a_missing_key_is_answered_with_one_to_copy() {
    for (key, place, advice) in [
        ("seed", "1:1", "write seed = 1"),
        ("duration_s", "1:1", "write duration_s = 60.0"),
        ("kind", "5:1", "write kind = \"circle\""),
        ("radius_m", "5:1", "write radius_m = 1.5"),
        ("start_m", "5:1", "write start_m = [3.0, 2.0]"),
    ] {
        // A line less, and an empty one at its place, so that lines keep their numbers.
        let old = GOOD.lines().find(|line| line.starts_with(key)).unwrap();
        let message = error_of(&GOOD.replace(old, ""));
        assert!(message.starts_with(&format!("s.toml:{place}: ")) && message.ends_with(advice), "{message}");
    }
    assert!(error_of("").contains("missing key `seed`"));
}

#[test]
fn numbers_that_make_no_sense_are_refused_where_they_stand() {
    for number in ["0", "-1.0", "nan", "inf", "1e9"] {
        assert_refused(&format!("duration_s = {number}"), "2:14", &["duration_s = ", "from 0.1 to 3600"]);
        assert_refused(&format!("speed_m_per_s = {number}"), "9:17", &["from 0.01 to 0.7"]);
        assert_refused(&format!("[kinect]\nrate_hz = {number}"), "10:11", &["from 0.1 to 30"]);
    }
    for (line, place, advice) in [
        ("radius_m = 0", "8:12", "radius_m = 0: write"),
        ("laps = 0", "9:8", "from 1 to 100"),
        ("start_m = [nan, 1.0]", "7:12", "start_m = NaN"),
        ("start_m = [1.0, 1e9]", "7:17", "start_m = 1000000000"),
        ("start_heading_deg = 1000", "9:21", "from -360 to 360"),
        ("[light]\ndaylight_scale = -1", "10:18", "from 0 to 100"),
        ("[kinect]\nlens_height_m = 60", "10:17", "from 0.3 to 2"),
        ("[kinect]\ntilt_deg = 90", "10:12", "from -27 to 27"),
        ("[kinect]\nstream_switch_s = -0.1", "10:19", "from 0 to 10"),
        ("[kinect]\nwarm_up_s = nan", "10:13", "warm_up_s = NaN"),
        ("[kinect]\nresidual_px = 99", "10:15", "from 0 to 50"),
        ("[kinect]\nresidual_deg = 9", "10:16", "from 0 to 5"),
        ("[[kinect.covered]]\nfrom_s = 5\nuntil_s = 4", "11:11", "later until_s"),
        ("[estimator.params.surf]\noctaves = 9", "10:11", "surf.octaves = 9"),
        ("[short]\nduration_s = 61", "10:14", "to 60"),
        ("[[robot.floor_areas]]\nfloor = \"carpet\"\nmin_m = [2, 2]\nmax_m = [1, 3]", "12:9", "north-east"),
        ("[[expect]]\nmetric = \"path_m\"", "10:10", "write max = "),
        ("[[expect]]\nmetric = \"path_m\"\nmin = 2\nmax = 1", "11:7", "exchange min and max"),
    ] {
        // Such a line stands at the end, also where `GOOD` has the key in another table.
        let text = if line.starts_with('[') { format!("{GOOD}{line}\n") } else { with(GOOD, line) };
        let message = error_of(&text);
        assert!(message.starts_with(&format!("s.toml:{place}: ")) && message.contains(advice), "{line}: {message}");
    }
    let no_frame = format!("{}[kinect]\nrate_hz = 1\n", with(GOOD, "duration_s = 0.5"));
    assert!(error_of(&no_frame).starts_with("s.toml:2:14: 0.5 s hold no frame"));
}

#[test]
fn a_path_has_the_keys_of_its_kind() {
    assert_refused("points_m = [[0, 0], [1, 1]]", "9:12", &["says nothing of a circle", "radius_m"]);
    assert_refused("kind = \"spline\"", "7:11", &["start_m says nothing of a spline"]);
    let of_points = |kind: &str, rest: &str| {
        let (head, _) = GOOD.split_once("kind").unwrap();
        error_of(&format!("{head}kind = \"{kind}\"\n{rest}\n"))
    };
    assert!(of_points("waypoints", "").contains("write points_m = [["));
    assert!(
        of_points("waypoints", "points_m = [[1, 1], [1, 1]]").starts_with("s.toml:7:12: a path needs at least two")
    );
    assert!(of_points("waypoints", "points_m = [[1, 1], [2, 1]]\nlaps = 2").contains("repeat the first point"));
    assert!(of_points("spline", "points_m = [[1, 1], [2, 1]]\nlaps = 2").starts_with("s.toml:8:8: "));
    let tight = of_points("waypoints", "points_m = [[0, 0], [1, 0], [1, 1]]\ncorner_radius_m = 2");
    assert!(tight.starts_with("s.toml:8:19: no room") && tight.contains("smaller corner_radius_m"), "{tight}");
}

#[test]
fn a_missing_file_is_named() {
    assert_refused("[robot]\nurdf = \"nowhere.urdf\"", "10:8", &["nowhere.urdf: no such file", "built-in robot"]);
    assert!(load(Path::new("nowhere.toml")).unwrap_err().to_string().starts_with("nowhere.toml: can't be read"));
}

#[test]
fn the_textured_room_has_a_schema_of_its_own() {
    let good = "seed = 1\nduration_s = 6.0\nrate_hz = 30.0\n[world]\nname = \"textured_room\"\n";
    let AnyScenario::TexturedRoom(scenario) = parse(good).unwrap() else { panic!("another world") };
    assert_eq!(scenario.frames(), 180);
    assert_eq!(scenario.shortened().frames(), 60);
    for number in ["0.0", "-1.0", "nan", "inf", "1e9"] {
        assert!(error_of(&good.replace("6.0", number)).starts_with("s.toml:2:14: duration_s"));
        assert!(error_of(&good.replace("30.0", number)).starts_with("s.toml:3:11: rate_hz"));
    }
    assert!(error_of(&good.replace("6.0", "0.01")).contains("no frame"));
    let message = error_of(&format!("{good}[kinect]\ndepth_nois = true\n"));
    assert!(message.starts_with("s.toml:7:1: ") && message.ends_with("did you mean `depth_noise`?"), "{message}");
}

fn changed(pairs: &[&str], seed: Option<u64>) -> Result<AnyScenario, ScenarioError> {
    let overrides = pairs.iter().map(|pair| pair.parse().unwrap()).chain(seed.map(Override::seed));
    Source::new(GOOD, Path::new("s.toml"), &overrides.collect::<Vec<_>>()).scenario()
}

#[test]
fn overrides_change_what_is_written_and_add_what_is_not() {
    let pairs = ["path.radius_m=2", "kinect.streams=exclusive", "estimator.params.surf.max_features=99", "seed=3"];
    let Ok(AnyScenario::Robot(scenario)) = changed(&pairs, Some(4)) else { panic!("a robot's scenario") };
    assert_eq!((scenario.path.radius, scenario.seed), (Some(2.0), 4), "the last one counts");
    assert_eq!(scenario.kinect.streams, StreamMode::Exclusive);
    assert_eq!(scenario.estimator.params.surf.max_features, 99);
    assert_eq!(scenario.path.start, Some([4.0, 1.0]));
}

#[test]
fn an_error_names_the_override_that_caused_it() {
    for (pairs, blamed, problem) in [
        (&["path.laps=2", "path.radus_m=2"][..], "path.radus_m=2", "did you mean `radius_m`?"),
        (&["path.radius_m=0", "path.laps=2"], "path.radius_m=0", "write a number"),
        (&["path.radius_m=wide"], "path.radius_m=\"wide\"", "expected a number"),
        (&["seed=1.5"], "seed=1.5", "whole number"),
        (&["seed.x=1"], "seed.x=1", "invalid type"),
        (&["world.name=moon"], "world.name=\"moon\"", "unknown world"),
        (&["expect=[{metric=\"path_m\"}]"], "expect=[{ metric = \"path_m\" }]", "write max"),
    ] {
        let message = changed(pairs, None).unwrap_err().to_string();
        assert!(message.starts_with(&format!("s.toml with --set {blamed}: ")), "{message}");
        assert!(message.contains(problem), "{message}");
    }
    let message = changed(&["path.laps=2"], Some(u64::MAX)).map(drop);
    assert!(message.is_ok(), "{message:?}");
}
