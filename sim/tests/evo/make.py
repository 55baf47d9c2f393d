#!/usr/bin/env python3
"""Makes the trajectories in this folder and asks evo what it makes of them.

Needs numpy, scipy and evo (1.38 made the committed numbers) on the PATH:

    python3 make.py

Each pair `<name>_truth.tum`, `<name>_estimate.tum` gets an entry in `expected.json`.
"""

import json
import pathlib
import subprocess
import tempfile
import zipfile

import numpy as np
from scipy.spatial.transform import Rotation

HERE = pathlib.Path(__file__).parent


def poses(times, positions, rotations):
    return np.column_stack([times, positions, rotations.as_quat()])


def with_drift(truth, step_sigma_m, step_sigma_rad, random):
    """Chains the truth's steps, each disturbed: what odometry does. Starts where the truth starts."""
    positions, rotations = truth[:, 1:4], Rotation.from_quat(truth[:, 4:8])
    position, rotation = positions[0], rotations[0]
    out = [np.concatenate([position, rotation.as_quat()])]
    for i in range(1, len(truth)):
        step = rotations[i - 1].inv().apply(positions[i] - positions[i - 1])
        turn = rotations[i - 1].inv() * rotations[i]
        position = position + rotation.apply(step + random.normal(0.0, step_sigma_m, 3))
        rotation = rotation * turn * Rotation.from_rotvec(random.normal(0.0, step_sigma_rad, 3))
        out.append(np.concatenate([position, rotation.as_quat()]))
    return np.column_stack([truth[:, 0], np.array(out)])


def drive():
    """A figure eight on the floor at 10 Hz, 13 m long."""
    t = np.arange(0.0, 20.0, 0.1)
    phase = 2.0 * np.pi * t / 20.0
    positions = np.column_stack([2.0 * np.sin(phase), 1.2 * np.sin(2.0 * phase), np.zeros_like(t)])
    heading = np.arctan2(2.4 * np.cos(2.0 * phase), 2.0 * np.cos(phase))
    return poses(t, positions, Rotation.from_euler("z", heading[:, None]))


def hand_held(random):
    """A camera carried about for 3 s at 30 Hz, with jitter in the time stamps, far from the world's origin."""
    t = 1305031102.0 + np.arange(0.0, 3.0, 1.0 / 30.0) + random.uniform(-0.002, 0.002, 90)
    s = t - t[0]
    positions = np.column_stack([
        7.0 + 0.4 * np.sin(1.3 * s), -3.0 + 0.3 * np.cos(0.9 * s), 1.5 + 0.1 * np.sin(2.1 * s)
    ])
    angles = np.column_stack([0.5 * np.sin(0.7 * s), 0.3 * np.cos(1.1 * s), 2.9 + 0.4 * np.sin(s)])
    return poses(t, positions, Rotation.from_euler("xyz", angles))


def write(name, rows):
    lines = [" ".join([f"{row[0]:.6f}"] + [f"{value:.12f}" for value in row[1:]]) for row in rows]
    (HERE / name).write_text("\n".join(lines) + "\n")


def evo(tool, name, *options):
    """RMSE that `evo_ape` or `evo_rpe` finds."""
    with tempfile.TemporaryDirectory() as folder:
        results = pathlib.Path(folder) / "results.zip"
        files = [str(HERE / f"{name}_{kind}.tum") for kind in ("truth", "estimate")]
        command = [tool, "tum", *files, *options, "--save_results", str(results)]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        with zipfile.ZipFile(results) as archive:
            return json.loads(archive.read("stats.json"))["rmse"]


def expected(name, frames_in_a_second):
    def rpe(delta, *options):
        return evo("evo_rpe", name, "--delta", str(delta), "--delta_unit", "f", "--all_pairs", *options)

    return {
        "ape_xy_m": evo("evo_ape", name, "--project_to_plane", "xy"),
        "rmse_theta_deg": evo("evo_ape", name, "-r", "angle_deg"),
        "ate_m": evo("evo_ape", name, "-a"),
        "rpe_m": rpe(frames_in_a_second),
        "rpe_deg": rpe(frames_in_a_second, "-r", "angle_deg"),
        "rpe_frame_m": rpe(1),
        "rpe_frame_deg": rpe(1, "-r", "angle_deg"),
    }


def main():
    random = np.random.default_rng(1)
    truths = {"drive": (drive(), 10), "hand_held": (hand_held(random), 30)}
    numbers = {}
    for name, (truth, frames_in_a_second) in truths.items():
        write(f"{name}_truth.tum", truth)
        write(f"{name}_estimate.tum", with_drift(truth, 0.004, 0.003, random))
        numbers[name] = expected(name, frames_in_a_second)
    (HERE / "expected.json").write_text(json.dumps(numbers, indent=2) + "\n")


main()
