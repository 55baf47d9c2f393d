//! What is deliberately absent, held to: the invariants of ARCHITECTURE.md.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Every Rust source below `folder`, with its text.
fn sources(folder: &str) -> BTreeMap<PathBuf, String> {
    texts(folder, "rs")
}

/// Every file below `folder` with an extension, with its text.
fn texts(folder: &str, wanted: &str) -> BTreeMap<PathBuf, String> {
    let mut found = BTreeMap::new();
    let mut folders = vec![root().join(folder)];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == wanted) {
                let text = fs::read_to_string(&path).unwrap();
                found.insert(path, text);
            }
        }
    }
    assert!(!found.is_empty(), "no sources below {folder}");
    found
}

/// The lines of `sources` that name one of `words` in code (not in a comment), with their places.
fn mentions(sources: &BTreeMap<PathBuf, String>, words: &[&str]) -> Vec<String> {
    let code = |line: &str| line.split("//").next().unwrap_or_default().to_owned();
    let mut found = Vec::new();
    for (path, text) in sources {
        for (number, line) in text.lines().enumerate() {
            if words.iter().any(|word| code(line).contains(word)) {
                found.push(format!("{}:{}: {}", path.display(), number + 1, line.trim()));
            }
        }
    }
    found
}

#[test]
fn the_estimator_depends_on_no_simulation_and_no_gpu() {
    let output = Command::new(env!("CARGO"))
        .args([
            "tree",
            "--locked",
            "--offline",
            "--package",
            "sunblind-estimator",
            "--edges",
            "normal",
            "--prefix",
            "none",
        ])
        .current_dir(root())
        .output()
        .expect("cargo runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let tree = String::from_utf8(output.stdout).unwrap();
    assert!(tree.contains("nalgebra"), "not a dependency tree: {tree}");
    for forbidden in ["wgpu", "rapier", "parry", "sunblind-sim", "image v", "rayon", "tokio"] {
        assert!(!tree.lines().any(|line| line.starts_with(forbidden)), "the estimator depends on {forbidden}");
    }
}

#[test]
fn the_estimator_touches_no_file_clock_thread_or_environment() {
    let found = mentions(
        &sources("estimator/src"),
        &[
            "std::fs",
            "std::io",
            "std::net",
            "std::env",
            "std::thread",
            "std::process",
            "Instant::",
            "SystemTime",
            "println!",
            "eprintln!",
        ],
    );
    assert!(found.is_empty(), "{found:#?}");
}

#[test]
fn nothing_ambient_decides_a_result() {
    // Hash order and generators that nobody seeded differ from run to run.
    let words = ["HashMap", "HashSet", "thread_rng", "rand::rng()", "from_os_rng", "from_entropy", "StdRng"];
    for folder in ["estimator/src", "sim/src"] {
        let found = mentions(&sources(folder), &words);
        assert!(found.is_empty(), "{found:#?}");
    }
}

#[test]
fn only_what_measures_time_holds_a_clock() {
    let mut sources = sources("sim/src");
    sources.retain(|path, _| {
        !path
            .components()
            .any(|part| ["runner", "cli", "render", "tests.rs"].contains(&&*part.as_os_str().to_string_lossy()))
    });
    let found = mentions(&sources, &["Instant::", "SystemTime"]);
    assert!(found.is_empty(), "{found:#?}");
}

#[test]
fn only_the_runner_calls_the_estimator() {
    let mut sources = sources("sim/src");
    sources.retain(|path, _| !path.components().any(|part| part.as_os_str() == "runner"));
    let found = mentions(&sources, &["Estimator::new", ".handle("]);
    assert!(found.is_empty(), "{found:#?}");
}

/// The folder of the rule, and the words that only it may say in code.
fn only_this_room_says(room: &str, words: &[&str]) {
    let inside = |path: &Path| path.starts_with(root().join("sim/src").join(room));
    let (within, outside): (BTreeMap<_, _>, BTreeMap<_, _>) =
        sources("sim/src").into_iter().partition(|(path, _)| inside(path));
    assert!(!mentions(&within, words).is_empty(), "looked in the wrong place: {room} says none of {words:?}");
    let found = mentions(&outside, words);
    assert!(found.is_empty(), "{found:#?}");
}

#[test]
fn physics_decides_what_the_kinect_sees_and_not_a_word_for_the_light() {
    let words = [
        "outdoor",
        "indoor",
        "sun",
        "daylight",
        "night",
        "noon",
        "shade",
        "cloud",
        "overcast",
        "hour",
        "time_of_day",
        "elevation",
        "klx",
        "kilolux",
        "weather",
    ];
    let mut found = mentions(&sources("sim/src/kinect"), &words);
    // What the chips make of light; that the sun lights a surface is the business of the shaders before them.
    let mut sensors = texts("shaders", "wgsl");
    sensors.retain(|path, _| path.to_string_lossy().contains("_sensor"));
    assert_eq!(sensors.len(), 2);
    found.extend(mentions(&sensors, &words));
    // The name of the product is no word for the light; nor is that of an hour's drift in a test.
    found.retain(|line| !line.contains("sunblind") && !line.contains("fn an_hour"));
    assert!(found.is_empty(), "{found:#?}");
    // No branch on how bright it is: exposures follow what the images hold, and only they compare brightness.
    let mut deciding = sources("sim/src/kinect");
    deciding.retain(|path, _| !path.ends_with("exposure.rs") && !path.ends_with("metering.rs"));
    let found = mentions(&deciding, &["if lux", "if brightness", "if ambient", "if light"]);
    let in_shaders =
        mentions(&texts("shaders", "wgsl"), &["if lux", "if ambient", "if light", "if luminance", "if radiance"]);
    assert!(found.is_empty() && in_shaders.is_empty(), "{found:#?} {in_shaders:#?}");
}

#[test]
fn only_physics_names_the_physics_engine() {
    only_this_room_says("physics", &["rapier", "glamx"]);
}

#[test]
fn only_render_names_the_graphics_interface() {
    only_this_room_says("render", &["wgpu::"]);
}

#[test]
fn the_search_for_words_can_fail() {
    let sources = BTreeMap::from([(PathBuf::from("a.rs"), "let now = Instant::now();\n// Instant::now\n".to_owned())]);
    assert_eq!(mentions(&sources, &["Instant::"]).len(), 1);
}
