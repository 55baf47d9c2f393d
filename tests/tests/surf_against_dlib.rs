//! Our SURF against dlib's, on recorded frames with known motion.

use nalgebra::Point2;
use sunblind_estimator::features::matching::{MatchParams, match_features};
use sunblind_estimator::features::surf::{Feature, Surf, SurfParams};
use sunblind_sim::record::Recording;
use sunblind_tests::oracle::{DlibSurf, FrameId, colour_motion, frame_pairs};
use sunblind_tests::recorded;
use sunblind_tests::repeatability::{Found, Keypoint, Score, View, score};

/// Least share of dlib's repeatability and of its inlier matches.
const AT_LEAST: f64 = 0.9;
/// dlib's keypoints a frame, and so ours.
const KEYPOINTS: usize = 600;
/// dlib describes no point nearer to the border than this, in scales. Ours must look at the same part of the image:
/// the colour image's rim has no depth, so points there can't be judged.
const BORDER: f32 = 16.0;

/// Everything that our detector finds above dlib's threshold, strongest first.
fn detect(recording: &Recording, frame: &FrameId) -> Vec<Feature> {
    let params = SurfParams { max_features: usize::MAX / 2, min_response: 1.0, ..SurfParams::default() };
    Surf::new(params).detect(&recorded::frame(recording, frame.index).rgb.to_luma())
}

/// As many of them as dlib has, from the part of the image where dlib looks.
fn as_many_as_dlib(mut features: Vec<Feature>, (width, height): (usize, usize)) -> Vec<Feature> {
    features.retain(|feature| {
        let border = BORDER * feature.scale;
        let inside = |position: f32, size: usize| position >= border && position < size as f32 - border;
        inside(feature.x, width) && inside(feature.y, height)
    });
    features.truncate(KEYPOINTS);
    assert_eq!(features.len(), KEYPOINTS, "fewer keypoints than dlib's");
    features
}

fn keypoint(feature: &Feature) -> Keypoint {
    Keypoint { pixel: Point2::new(f64::from(feature.x), f64::from(feature.y)), scale: f64::from(feature.scale) }
}

/// Our score on one pair, and dlib's.
fn scores(dlib: &DlibSurf, recording: &Recording, from: &FrameId, to: &FrameId) -> [Score; 2] {
    let [first, second] =
        [from, to].map(|frame| View::new(&recording.rig, &recorded::frame(recording, frame.index).depth));
    let motion = colour_motion(from, to);

    let features = [from, to].map(|frame| as_many_as_dlib(detect(recording, frame), recording.rig.colour.size()));
    let matches = match_features(&features[0], &features[1], &MatchParams::default());
    let matches: Vec<_> = matches.iter().map(|found| (found.from, found.to)).collect();
    let keypoints = features.map(|features| features.iter().map(keypoint).collect::<Vec<_>>());

    let ours = Found { from: &keypoints[0], to: &keypoints[1], matches: &matches };
    let theirs = Found { from: dlib.keypoints(from), to: dlib.keypoints(to), matches: dlib.matches(from, to) };
    [ours, theirs].map(|found| score(&first, &second, &motion, found))
}

#[test]
#[cfg_attr(not(recorded_data), ignore = "no recorded data")]
fn ours_finds_spots_again_as_well_as_dlib() {
    let dlib = DlibSurf::load();
    let pairs = frame_pairs();
    let (mut repeatability, mut totals) = ([0.0; 2], [Score::default(); 2]);
    println!("{:>42}{:>14}{:>14}{:>14}", "repeated %", "matches", "within 3 px", "within 5 px");
    println!("{:32}{}", "", "  ours   dlib".repeat(4));
    for (from, to) in &pairs {
        let recording = recorded::open(from.recording);
        let [ours, theirs] = scores(&dlib, &recording, from, to);
        let table: String = [
            [ours, theirs].map(|score| 100.0 * score.repeatability()),
            [ours, theirs].map(|score| score.matches as f64),
            [ours, theirs].map(|score| score.inliers as f64),
            [ours, theirs].map(|score| score.wide_inliers as f64),
        ]
        .iter()
        .map(|[ours, theirs]| format!("{ours:7.0}{theirs:7.0}"))
        .collect();
        println!("{:28}{:>4}{table}", from.name(), format!("+{}", to.index - from.index));
        for (k, score) in [ours, theirs].into_iter().enumerate() {
            repeatability[k] += score.repeatability() / pairs.len() as f64;
            totals[k] += score;
        }
    }
    let inliers = totals.map(|total| total.inliers as f64);
    println!("ours: mean repeatability {:.3}, {:?}", repeatability[0], totals[0]);
    println!("dlib: mean repeatability {:.3}, {:?}", repeatability[1], totals[1]);
    assert!(repeatability[0] >= AT_LEAST * repeatability[1], "repeatability {repeatability:?}");
    assert!(inliers[0] >= AT_LEAST * inliers[1], "inlier matches {inliers:?}");
}

#[test]
#[cfg_attr(not(recorded_data), ignore = "no recorded data")]
fn dlibs_keypoints_are_ours_too() {
    let dlib = DlibSurf::load();
    let (mut shared, mut total) = (0, 0);
    for (frame, _) in frame_pairs() {
        let recording = recorded::open(frame.recording);
        let ours: Vec<_> = detect(&recording, &frame).iter().map(keypoint).collect();
        let same = |theirs: &Keypoint, ours: &Keypoint| {
            (theirs.pixel - ours.pixel).norm() < 2.0 && (0.8..1.25).contains(&(ours.scale / theirs.scale))
        };
        let theirs = dlib.keypoints(&frame);
        shared += theirs.iter().filter(|theirs| ours.iter().any(|ours| same(theirs, ours))).count();
        total += theirs.len();
    }
    let share = f64::from(shared as u32) / f64::from(total as u32);
    println!("{share:.3} of dlib's keypoints are ours too");
    // dlib looks at six filters an octave where the paper has four, so some of its scales have no like.
    assert!(share > 0.85, "{share}");
}

#[test]
#[cfg_attr(not(recorded_data), ignore = "no recorded data")]
fn the_judge_notices_a_wrong_motion() {
    let dlib = DlibSurf::load();
    for (from, to) in frame_pairs().into_iter().filter(|(from, to)| to.index - from.index >= 15) {
        let recording = recorded::open(from.recording);
        let [first, second] =
            [&from, &to].map(|frame| View::new(&recording.rig, &recorded::frame(&recording, frame.index).depth));
        let found = Found { from: dlib.keypoints(&from), to: dlib.keypoints(&to), matches: dlib.matches(&from, &to) };
        let motion = colour_motion(&from, &to);
        let right = score(&first, &second, &motion, found);
        let wrong = score(&first, &second, &motion.inverse(), found);
        assert!(wrong.repeatability() < 0.5 * right.repeatability(), "{}: {wrong:?}", from.name());
        assert!(wrong.inliers * 10 < right.inliers, "{}: {wrong:?}", from.name());
    }
}
