//! Only `sim/src/physics` names the physics engine, so that exchanging it, or its vectors, stays one room's work.

use std::path::{Path, PathBuf};

/// The engine, its geometry and its vectors.
const ENGINE: [&str; 3] = ["rapier", "parry3d", "glamx"];

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

#[test]
fn only_the_physics_names_the_engine() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let mut files = Vec::new();
    for folder in ["estimator", "sim", "tests"] {
        sources(&root.join(folder), &mut files);
    }
    let names_it = |path: &&PathBuf| {
        let text = std::fs::read_to_string(path).unwrap();
        ENGINE.iter().any(|name| text.contains(name))
    };
    let room = root.join("sim/src/physics");
    let (inside, outside): (Vec<_>, Vec<_>) = files.iter().filter(names_it).partition(|path| path.starts_with(&room));
    assert!(!inside.is_empty(), "looked in the wrong place");
    let outside: Vec<_> = outside.into_iter().filter(|path| !path.ends_with(file!())).collect();
    assert!(outside.is_empty(), "these name the physics engine, too: {outside:#?}");
}

#[test]
fn the_estimator_depends_on_no_physics() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let manifest = std::fs::read_to_string(root.join("estimator/Cargo.toml")).unwrap();
    assert!(ENGINE.iter().all(|name| !manifest.contains(name)));
}
