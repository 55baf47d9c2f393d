//! What others found on recorded frames, kept in `oracle/`: dlib its SURF, OpenCV the camera's motion. And which frames
//! those are.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use nalgebra::{Isometry3, Point2, Quaternion, Translation3, UnitQuaternion};

use crate::repeatability::Keypoint;

/// One frame of one recording.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct FrameId {
    /// The recording's folder.
    pub recording: &'static str,
    /// The frame's index in it.
    pub index: usize,
}

/// The pairs of frames that detectors are compared on: from five frames spread over 10 s of a hand-held walk to the
/// frames 5, 15 and 30 later, and from the first of ten lossless frames to three later ones.
pub fn frame_pairs() -> Vec<(FrameId, FrameId)> {
    let pair = |recording, from, gap| (FrameId { recording, index: from }, FrameId { recording, index: from + gap });
    let walk = [0, 65, 130, 195, 260].into_iter().flat_map(|from| [5, 15, 30].map(|gap| (from, gap)));
    let mut pairs: Vec<_> = walk.map(|(from, gap)| pair("kinect1_redkitchen", from, gap)).collect();
    pairs.extend([3, 6, 9].map(|gap| pair("kinect1_tum_fr1_10", 0, gap)));
    pairs
}

/// dlib's keypoints (strongest first) and matches.
pub struct DlibSurf {
    keypoints: BTreeMap<String, Vec<Keypoint>>,
    matches: BTreeMap<(String, String), Vec<(usize, usize)>>,
}

impl DlibSurf {
    /// Reads the committed file. Panics where it is missing or damaged: without it there is nothing to compare with.
    pub fn load() -> Self {
        Self::parse(&committed("dlib_surf.txt"))
    }

    /// Sections headed `points NAME` with lines `x y scale`, and `matches NAME NAME` with lines `index index`.
    fn parse(text: &str) -> Self {
        let mut found = Self { keypoints: BTreeMap::new(), matches: BTreeMap::new() };
        let mut lines = text.lines().filter(|line| !line.starts_with('#')).peekable();
        while let Some(head) = lines.next() {
            let body = std::iter::from_fn(|| lines.next_if(|line| line.starts_with(|c: char| c.is_ascii_digit())));
            match head.split(' ').collect::<Vec<_>>()[..] {
                ["points", name] => {
                    let keypoint = |line| {
                        let [x, y, scale] = numbers(line);
                        Keypoint { pixel: Point2::new(x, y), scale }
                    };
                    found.keypoints.insert(name.to_owned(), body.map(keypoint).collect());
                }
                ["matches", from, to] => {
                    let indices = |line| numbers(line).into();
                    found.matches.insert((from.to_owned(), to.to_owned()), body.map(indices).collect());
                }
                _ => panic!("not a section of dlib's results: {head:?}"),
            }
        }
        found
    }

    /// Keypoints of a frame, strongest first.
    pub fn keypoints(&self, frame: &FrameId) -> &[Keypoint] {
        &self.keypoints[&frame.name()]
    }

    /// Matches between two frames, as indices into their keypoints.
    pub fn matches(&self, from: &FrameId, to: &FrameId) -> &[(usize, usize)] {
        &self.matches[&(from.name(), to.name())]
    }
}

impl FrameId {
    /// What the frame is called in files.
    pub fn name(&self) -> String {
        format!("{}_{}", self.recording, self.index)
    }
}

/// Motion of the colour camera from `from` to `to` (to_from_from), as OpenCV found it with SIFT and PnP. The recordings'
/// own truth differs from what the colour images show by 5 px and more in some pairs.
pub fn colour_motion(from: &FrameId, to: &FrameId) -> Isometry3<f64> {
    let (text, head) = (committed("colour_motion.txt"), format!("{} {} ", from.name(), to.name()));
    let line = text.lines().find_map(|line| line.strip_prefix(&head)).unwrap_or_else(|| panic!("no motion for {head}"));
    let [x, y, z, qx, qy, qz, qw] = numbers(line);
    let rotation = UnitQuaternion::from_quaternion(Quaternion::new(qw, qx, qy, qz));
    Isometry3::from_parts(Translation3::new(x, y, z), rotation)
}

/// A file in `oracle/`.
fn committed(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("oracle").join(name);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn numbers<T: std::str::FromStr, const N: usize>(line: &str) -> [T; N] {
    let numbers: Option<Vec<T>> = line.split(' ').map(|number| number.parse().ok()).collect();
    numbers.and_then(|numbers| numbers.try_into().ok()).unwrap_or_else(|| panic!("{N} numbers expected: {line:?}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sections_are_told_apart() {
        let a = FrameId { recording: "kitchen", index: 0 };
        let b = FrameId { recording: "kitchen", index: 5 };
        let found = DlibSurf::parse(
            "# dlib\npoints kitchen_0\n1.5 2 3\n4 5 6\npoints kitchen_5\nmatches kitchen_0 kitchen_5\n1 0\n",
        );
        assert_eq!(found.keypoints(&a)[0], Keypoint { pixel: Point2::new(1.5, 2.0), scale: 3.0 });
        assert_eq!(found.keypoints(&a).len(), 2);
        assert!(found.keypoints(&b).is_empty());
        assert_eq!(found.matches(&a, &b), [(1, 0)]);
    }
}
