"""Motion of the colour camera between the frames of each pair, by OpenCV's SIFT and PnP.

The recordings' truth differs from what the colour images show by 5 px and more in some pairs (likely because colour,
depth and truth are of different instants): too much to judge keypoints by. This is sharper, and shares nothing with
SURF but the images. Where it differs from the truth by more than a delay can explain, it is refused.

    colour_motion.py DATA PAIRS.txt > colour_motion.txt
"""

import sys
import tomllib
from pathlib import Path

import cv2
import numpy as np
from scipy.spatial.transform import Rotation

FEATURES = 3000
RATIO = 0.75
REPROJECTION_PX = 2.0
# Some 30 ms of a hand-held camera's motion, and the truth's own error.
AGREEMENT_M, AGREEMENT_DEG = 0.06, 3.0


class Recording:
    def __init__(self, folder):
        self.folder = folder
        calibration = tomllib.loads((folder / "calibration.toml").read_text())
        matrix = lambda c: np.array([[c["fx_px"], 0, c["cx_px"]], [0, c["fy_px"], c["cy_px"]], [0, 0, 1]])
        self.colour, self.depth = matrix(calibration["colour"]), matrix(calibration["depth"])
        self.distortion = np.array(calibration["colour"]["distortion"])
        self.units_per_m = calibration["depth"]["units_per_m"]
        self.registered = calibration["registered"]
        transform = calibration["colour_from_depth"]
        self.colour_from_depth = rigid(transform["translation_m"], transform["rotation_xyzw"])
        truth_is_depth = calibration["truth"]["camera"] == "depth"
        self.colour_from_truth = self.colour_from_depth if truth_is_depth else np.eye(4)

    def row(self, name, index):
        lines = [line.split() for line in (self.folder / name).read_text().splitlines() if not line.startswith("#")]
        return lines[index][1:]

    def world_from_colour(self, index):
        numbers = [float(number) for number in self.row("groundtruth.txt", index)]
        return rigid(numbers[:3], numbers[3:]) @ np.linalg.inv(self.colour_from_truth)

    def grey(self, index):
        return cv2.imread(str(self.folder / self.row("rgb.txt", index)[0]), cv2.IMREAD_GRAYSCALE)

    def registered_depth(self, index):
        """Z in metres in the colour camera's pixels, the nearest surface, NaN where nothing was seen."""
        z = cv2.imread(str(self.folder / self.row("depth.txt", index)[0]), cv2.IMREAD_UNCHANGED) / self.units_per_m
        if self.registered:
            return np.where(z > 0, z, np.nan)
        v, u = np.nonzero(z)
        points = np.linalg.inv(self.depth) @ np.stack([u, v, np.ones(len(u))]) * z[v, u]
        points = self.colour_from_depth[:3, :3] @ points + self.colour_from_depth[:3, 3:]
        x, y, _ = np.rint(self.colour @ (points / points[2])).astype(int)
        seen = (x >= 0) & (y >= 0) & (x < z.shape[1]) & (y < z.shape[0])
        registered = np.full(z.shape, np.inf)
        np.minimum.at(registered, (y[seen], x[seen]), points[2, seen])
        return np.where(np.isfinite(registered), registered, np.nan)


def rigid(translation, rotation_xyzw):
    transform = np.eye(4)
    transform[:3, :3] = Rotation.from_quat(rotation_xyzw).as_matrix()
    transform[:3, 3] = translation
    return transform


def motion(recording, first, second):
    """Transform from the first frame's colour camera to the second's, and how well it is supported."""
    sift = cv2.SIFT_create(FEATURES)
    keypoints_a, a = sift.detectAndCompute(recording.grey(first), None)
    keypoints_b, b = sift.detectAndCompute(recording.grey(second), None)
    matches = [m for m, n in cv2.BFMatcher().knnMatch(a, b, k=2) if m.distance < RATIO * n.distance]
    depth = recording.registered_depth(first)
    points, pixels = [], []
    for match in matches:
        x, y = keypoints_a[match.queryIdx].pt
        column, row = round(x), round(y)
        window = depth[max(0, row - 2) : row + 3, max(0, column - 2) : column + 3]
        # One surface only: at an edge the calibration's error of 2 px decides which.
        if np.isnan(window).any() or np.ptp(window) > 0.05 * window.min():
            continue
        ray = cv2.undistortPoints(np.array([[[x, y]]]), recording.colour, recording.distortion)[0, 0]
        points.append(np.append(ray, 1) * np.median(window))
        pixels.append(keypoints_b[match.trainIdx].pt)
    points, pixels = np.array(points), np.array(pixels)
    cv2.setRNGSeed(1)
    camera = (recording.colour, recording.distortion)
    _, rotation, translation, inliers = cv2.solvePnPRansac(
        points, pixels, *camera, iterationsCount=2000, reprojectionError=REPROJECTION_PX, confidence=0.9999
    )
    inliers = inliers[:, 0]
    rotation, translation = cv2.solvePnPRefineLM(points[inliers], pixels[inliers], *camera, rotation, translation)
    second_from_first = np.eye(4)
    second_from_first[:3, :3] = cv2.Rodrigues(rotation)[0]
    second_from_first[:3, 3] = translation[:, 0]
    return second_from_first, len(inliers), len(points)


def main(data, pairs):
    print(f"# OpenCV {cv2.__version__}, SIFT + PnP: from, to, then to_from_from: tx_m ty_m tz_m qx qy qz qw.")
    for line in Path(pairs).read_text().splitlines():
        (name, first), (_, second) = (frame.rsplit("_", 1) for frame in line.split())
        recording = Recording(Path(data) / name)
        found, inliers, total = motion(recording, int(first), int(second))
        truth = np.linalg.inv(recording.world_from_colour(int(second))) @ recording.world_from_colour(int(first))
        apart = np.linalg.inv(truth) @ found
        distance = np.linalg.norm(apart[:3, 3])
        angle = np.degrees(Rotation.from_matrix(apart[:3, :3]).magnitude())
        print(f"{line}: {inliers}/{total} inliers, {distance:.3f} m, {angle:.2f}° from the truth", file=sys.stderr)
        if distance > AGREEMENT_M or angle > AGREEMENT_DEG:
            sys.exit(f"{line}: does not agree with the truth")
        quaternion = Rotation.from_matrix(found[:3, :3]).as_quat()
        print(line, *(f"{number:.6f}" for number in [*found[:3, 3], *quaternion]))


if __name__ == "__main__":
    main(*sys.argv[1:])
