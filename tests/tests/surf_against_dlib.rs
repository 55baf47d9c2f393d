//! Our SURF against dlib's, on recorded frames with truth.

use std::collections::BTreeMap;

use sunblind_tests::oracle::{DlibSurf, FrameId, frame_pairs};
use sunblind_tests::recorded::Recording;
use sunblind_tests::repeatability::{Score, View, score};

/// The recordings that the frame pairs come from; `None` when one is missing.
fn recordings() -> Option<BTreeMap<&'static str, Recording>> {
    let names = frame_pairs().into_iter().map(|(from, _)| from.recording);
    names.map(|name| Some((name, Recording::open(name)?))).collect()
}

#[test]
fn dlib_alone() {
    let Some(recordings) = recordings() else { return };
    let dlib = DlibSurf::load();
    for (from, to) in frame_pairs() {
        let recording = &recordings[from.recording];
        let view = |frame: &FrameId| View::new(&recording.rig, &recording.depth(frame.index), recording.world_from_colour(frame.index));
        let (first, second) = (view(&from), view(&to));
        let s = score(&first, &second, dlib.keypoints(&from), dlib.keypoints(&to), dlib.matches(&from, &to));
        let wrong = score(&first, &first, dlib.keypoints(&from), dlib.keypoints(&to), dlib.matches(&from, &to));
        println!("{:28} {:3} rep {:.3} {:?}  no motion {:.3} {}", from.name(), to.index - from.index, s.repeatability(), s, wrong.repeatability(), wrong.inliers);
    }
}
