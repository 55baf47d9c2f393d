//! How well a feature detector finds the same spots again, judged by depth and known motion: repeatability after
//! Mikolajczyk & Schmid (IJCV 2004), but through the scene's own shape instead of a homography.
//!
//! Depth is registered here a second time, on purpose: a judge must not share code with what it judges.

use nalgebra::{Isometry3, Point2, Point3};
use sunblind_estimator::Rig;
use sunblind_estimator::camera::CameraModel;
use sunblind_estimator::image::{DepthImage, Image};

/// Pixels within which a spot counts as found again.
pub const TOLERANCE_PX: f64 = 3.0;
/// The wider limit: colour against depth is calibrated to about 2 px only.
pub const WIDE_TOLERANCE_PX: f64 = 5.0;
/// Ratio of two scales, each way, up to which they count as the same.
const SCALE_RATIO: f64 = 1.5;
/// Share of depth by which two readings of one surface may differ: the Kinect's noise at 4 m is about 1 %, and depth
/// is of another instant than colour.
const DEPTH_TOLERANCE: f64 = 0.05;
/// Half the side, in pixels, of the window that must show one surface: the calibration's error of 2 px.
const WINDOW_PX: isize = 2;

/// A detected spot, whoever detected it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Keypoint {
    /// Where, in pixels.
    pub pixel: Point2<f64>,
    /// SURF's s, in pixels.
    pub scale: f64,
}

/// One frame as the judge sees it: depth in the colour camera's pixels.
pub struct View {
    camera: CameraModel,
    /// Z in metres, infinite where nothing was seen.
    depth: Image<f64>,
}

/// Where a spot of one view lies in another.
#[derive(Clone, Copy, Debug)]
pub struct Transfer {
    /// The pixel in the other view.
    pub pixel: Point2<f64>,
    /// How much larger the spot looks there.
    pub magnification: f64,
}

impl View {
    /// Registers `depth` to the colour camera; where two surfaces meet in a pixel, the nearer one hides the other.
    pub fn new(rig: &Rig, depth: &DepthImage) -> Self {
        let mut registered = Image::filled(rig.colour.width, rig.colour.height, f64::INFINITY);
        for y in 0..depth.height() {
            for x in 0..depth.width() {
                let Some(z) = rig.depth.depth_of(depth.at(x, y)) else { continue };
                if rig.depth.registered_to_colour {
                    lower(&mut registered, &Point2::new(x as f64, y as f64), z);
                } else {
                    let ray = rig.depth.model.ray(&Point2::new(x as f64, y as f64));
                    let point = rig.colour_from_depth * Point3::from(ray * z);
                    if let Some(pixel) = rig.colour.project(&point) {
                        lower(&mut registered, &pixel, point.z);
                    }
                }
            }
        }
        Self { camera: rig.colour, depth: registered }
    }

    /// Where the surface under `pixel` appears in `other`, to which `motion` (other from self) leads. `None` when it has no single depth (a hole, an edge),
    /// when it leaves the image, or when `other` sees something else there (occlusion, a hole).
    pub fn transfer(&self, pixel: &Point2<f64>, other: &Self, motion: &Isometry3<f64>) -> Option<Transfer> {
        let z = self.surface(pixel)?;
        let there = motion * Point3::from(self.camera.ray(pixel) * z);
        let seen_at = other.camera.project(&there)?;
        let surface = other.surface(&seen_at)?;
        ((surface - there.z).abs() < DEPTH_TOLERANCE * there.z)
            .then_some(Transfer { pixel: seen_at, magnification: z / there.z })
    }

    /// Depth of the one surface around `pixel`: the median of a window that shows no edge.
    fn surface(&self, pixel: &Point2<f64>) -> Option<f64> {
        let (x, y) = (pixel.x.round() as isize, pixel.y.round() as isize);
        let (width, height) = (self.depth.width() as isize, self.depth.height() as isize);
        if x < WINDOW_PX || y < WINDOW_PX || x >= width - WINDOW_PX || y >= height - WINDOW_PX {
            return None;
        }
        let mut window = Vec::new();
        for row in y - WINDOW_PX..=y + WINDOW_PX {
            window
                .extend_from_slice(&self.depth.row(row as usize)[(x - WINDOW_PX) as usize..=(x + WINDOW_PX) as usize]);
        }
        window.retain(|z| z.is_finite());
        // A third of the window may be holes: a Kinect's depth is rarely whole.
        let pixels = (2 * WINDOW_PX + 1).pow(2) as usize;
        if window.len() * 3 < pixels * 2 {
            return None;
        }
        window.sort_by(f64::total_cmp);
        let (nearest, farthest) = (window[0], window[window.len() - 1]);
        (farthest - nearest < DEPTH_TOLERANCE * nearest).then(|| window[window.len() / 2])
    }
}

fn lower(depth: &mut Image<f64>, pixel: &Point2<f64>, z: f64) {
    let (x, y) = (pixel.x.round(), pixel.y.round());
    let (width, height) = depth.size();
    if x >= 0.0 && y >= 0.0 && (x as usize) < width && (y as usize) < height {
        let value = &mut depth.pixels_mut()[y as usize * width + x as usize];
        *value = value.min(z);
    }
}

/// What one detector made of one pair of frames.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Score {
    /// Keypoints of the first frame whose true place in the second is known.
    pub judged: usize,
    /// Of these, how many the second frame has a keypoint for.
    pub repeated: usize,
    /// Matches, true, false or unknown.
    pub matches: usize,
    /// Matches whose true place is known.
    pub judged_matches: usize,
    /// Matches within [`TOLERANCE_PX`] of it.
    pub inliers: usize,
    /// Matches within [`WIDE_TOLERANCE_PX`] of it.
    pub wide_inliers: usize,
}

impl Score {
    /// Share of keypoints found again, 0–1.
    pub fn repeatability(&self) -> f64 {
        self.repeated as f64 / self.judged.max(1) as f64
    }
}

impl std::ops::AddAssign for Score {
    fn add_assign(&mut self, other: Self) {
        self.judged += other.judged;
        self.repeated += other.repeated;
        self.matches += other.matches;
        self.judged_matches += other.judged_matches;
        self.inliers += other.inliers;
        self.wide_inliers += other.wide_inliers;
    }
}

/// One detector's keypoints in both frames, and its matches as indices into them.
#[derive(Clone, Copy, Debug)]
pub struct Found<'a> {
    /// In the first frame.
    pub from: &'a [Keypoint],
    /// In the second frame.
    pub to: &'a [Keypoint],
    /// First to second.
    pub matches: &'a [(usize, usize)],
}

/// Judges what a detector found in two frames, given the motion (second from first) between them.
pub fn score(first: &View, second: &View, motion: &Isometry3<f64>, found: Found) -> Score {
    let Found { from, to, matches } = found;
    let transfers: Vec<_> = from.iter().map(|keypoint| first.transfer(&keypoint.pixel, second, motion)).collect();
    let mut score = Score { matches: matches.len(), ..Score::default() };
    for (keypoint, transfer) in from.iter().zip(&transfers) {
        let Some(transfer) = transfer else { continue };
        score.judged += 1;
        score.repeated += usize::from(to.iter().any(|candidate| is_same_spot(keypoint, transfer, candidate)));
    }
    for &(a, b) in matches {
        let Some(transfer) = transfers[a] else { continue };
        let distance = (transfer.pixel - to[b].pixel).norm();
        score.judged_matches += 1;
        score.inliers += usize::from(distance <= TOLERANCE_PX);
        score.wide_inliers += usize::from(distance <= WIDE_TOLERANCE_PX);
    }
    score
}

fn is_same_spot(keypoint: &Keypoint, transfer: &Transfer, candidate: &Keypoint) -> bool {
    let ratio = candidate.scale / (keypoint.scale * transfer.magnification);
    (transfer.pixel - candidate.pixel).norm() <= TOLERANCE_PX && (1.0 / SCALE_RATIO..=SCALE_RATIO).contains(&ratio)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A wall in front of an uncalibrated Kinect.
    fn wall(z: f64) -> View {
        View::new(&Rig::kinect_default(), &DepthImage::filled(640, 480, (z * 5000.0) as u16))
    }

    /// What the scene does when the camera steps 0.1 m to the right.
    fn step() -> Isometry3<f64> {
        Isometry3::translation(-0.1, 0.0, 0.0)
    }

    fn keypoint(x: f64, y: f64) -> Keypoint {
        Keypoint { pixel: Point2::new(x, y), scale: 2.0 }
    }

    #[test]
    fn a_step_to_the_right_moves_the_wall_to_the_left() {
        // 525 px · 0.1 m / 2 m.
        let there = wall(2.0).transfer(&Point2::new(300.0, 200.0), &wall(2.0), &step()).unwrap();
        assert!((there.pixel - Point2::new(273.75, 200.0)).norm() < 1e-9, "{there:?}");
        assert!((there.magnification - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_step_forward_magnifies() {
        let forward = Isometry3::translation(0.0, 0.0, -1.0);
        let there = wall(2.0).transfer(&Point2::new(300.0, 200.0), &wall(1.0), &forward).unwrap();
        assert!((there.magnification - 2.0).abs() < 1e-12);
    }

    #[test]
    fn what_leaves_the_image_is_not_judged() {
        assert!(wall(2.0).transfer(&Point2::new(20.0, 200.0), &wall(2.0), &step()).is_none());
    }

    #[test]
    fn what_is_hidden_is_not_judged() {
        assert!(wall(2.0).transfer(&Point2::new(300.0, 200.0), &wall(1.0), &step()).is_none());
    }

    #[test]
    fn an_edge_has_no_single_depth() {
        let mut depth = DepthImage::filled(640, 480, 10_000);
        for (index, value) in depth.pixels_mut().iter_mut().enumerate() {
            *value = if index % 640 < 300 { 5_000 } else { 10_000 };
        }
        let view = View::new(&Rig::kinect_default(), &depth);
        assert!(view.transfer(&Point2::new(300.0, 200.0), &view, &Isometry3::identity()).is_none());
        assert!(view.transfer(&Point2::new(320.0, 200.0), &view, &Isometry3::identity()).is_some());
    }

    #[test]
    fn depth_of_another_camera_is_moved_into_the_colour_image() {
        let mut rig = Rig::kinect_default();
        rig.depth.registered_to_colour = false;
        rig.colour_from_depth = Isometry3::translation(-0.02, 0.0, 0.0);
        // A box nearer than the wall moves by 525 px · 0.02 m / 1 m to the left, the wall by half of it.
        let mut depth = DepthImage::filled(640, 480, 10_000);
        for y in 190..210 {
            for x in 290..310 {
                depth.pixels_mut()[y * 640 + x] = 5_000;
            }
        }
        let view = View::new(&rig, &depth);
        assert_eq!(view.depth.at(282, 200), 1.0);
        assert_eq!(view.depth.at(306, 200), 2.0);
    }

    #[test]
    fn true_and_false_keypoints_and_matches_are_told_apart() {
        let from = [keypoint(300.0, 200.0), keypoint(400.0, 200.0), keypoint(500.0, 200.0)];
        let mut to = [keypoint(275.0, 201.0), keypoint(373.75, 204.0), keypoint(473.75, 200.0)];
        to[2].scale = 4.0;
        let found = Found { from: &from, to: &to, matches: &[(0, 0), (1, 1), (2, 0)] };
        let expected = Score { judged: 3, repeated: 1, matches: 3, judged_matches: 3, inliers: 1, wide_inliers: 2 };
        assert_eq!(score(&wall(2.0), &wall(2.0), &step(), found), expected);
    }
}
