//! What needs a graphics adapter, with one and without.

use std::path::{Path, PathBuf};
use std::process::Command;

use sunblind_tests::command::{stderr_of, stdout_of, sunblind};

fn shipped(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios").join(name)
}

/// Renders into `out`.
fn render(scenario: &str, arguments: &[&str], out: &Path) -> Command {
    let mut command = sunblind();
    command.arg("render").arg(shipped(scenario)).args(arguments).arg("--out").arg(out);
    command
}

/// As on a machine on which no driver is installed: Mesa's loaders look in these places only.
fn without_drivers(command: &mut Command) -> &mut Command {
    for name in ["VK_DRIVER_FILES", "VK_ICD_FILENAMES", "__EGL_VENDOR_LIBRARY_FILENAMES", "LIBGL_DRIVERS_PATH"] {
        command.env(name, "/nonexistent");
    }
    command
}

#[test]
fn without_an_adapter_the_exit_code_is_3_and_the_package_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let mut doctor = sunblind();
    doctor.arg("doctor");
    let mut run = sunblind();
    run.arg("run").arg(shipped("lab_loop.toml")).arg("--out").arg(&out);
    for mut command in [render("lab_loop.toml", &[], &out), run, doctor] {
        let run = without_drivers(&mut command).output().unwrap();
        assert_eq!(run.status.code(), Some(3), "{}", stderr_of(&run));
        let stderr = stderr_of(&run);
        assert!(stderr.contains("error: no graphics adapter") && stderr.contains("mesa-vulkan-drivers"), "{stderr}");
    }
    assert!(!out.exists());
}

#[test]
fn the_doctor_names_the_driver() {
    let run = sunblind().arg("doctor").output().unwrap();
    assert_eq!(run.status.code(), Some(0), "{}", stderr_of(&run));
    let table = stdout_of(&run);
    for row in ["sunblind ", "wgpu ", "adapter ", "driver ", "backend ", "processors ", "kept light "] {
        assert!(table.lines().any(|line| line.starts_with(row)), "no {row:?} in: {table}");
    }
}

#[test]
fn pictures_of_two_instants_fill_a_folder() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let run = render("lab_loop.toml", &["--at", "0", "--at", "20.5"], &out).output().unwrap();
    assert_eq!(run.status.code(), Some(0), "{}", stderr_of(&run));
    let size = |name: &str| image::image_dimensions(out.join(name)).unwrap();
    assert_eq!(size("contact_sheet.png"), (1320, 544));
    for name in ["0s/rgb.png", "0s/ir.png", "20.5s/depth.png", "20.5s/true_depth.png"] {
        assert_eq!(size(name), (640, 480), "{name}");
    }
    let metres = |name: &str| image::open(out.join(name)).unwrap().into_luma16().into_raw();
    let (depth, truth) = (metres("0s/depth.png"), metres("0s/true_depth.png"));
    let with_depth = || depth.iter().zip(&truth).filter(|(depth, _)| **depth > 0);
    let right = with_depth().filter(|(depth, truth)| depth.abs_diff(**truth) <= **truth / 10).count();
    assert!(with_depth().count() > 150_000, "hardly any depth: {}", with_depth().count());
    assert!(right as f64 > 0.98 * with_depth().count() as f64, "{right} of {} are right", with_depth().count());
}

#[test]
fn what_can_not_be_rendered_is_said_before_anything_is() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    for (scenario, arguments, problem) in [
        ("lab_loop.toml", &["--at", "1000"][..], "the path ends after 7"),
        ("lab_loop.toml", &["--at", "-3"], "0 or more"),
        ("textured_room.toml", &[], "sunblind record"),
    ] {
        let run = render(scenario, arguments, &out).output().unwrap();
        assert_eq!(run.status.code(), Some(2), "{}", stderr_of(&run));
        assert!(stderr_of(&run).contains(problem), "{}", stderr_of(&run));
    }
    assert!(!out.exists());
}
