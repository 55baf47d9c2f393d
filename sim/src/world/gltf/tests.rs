//! Files written here, byte by byte.

use std::fs;

use serde_json::{Value, json};
use tempfile::TempDir;

use super::*;
use crate::world::TEXTURE_SIZE;

/// A square of 2 m, facing glTF's +z, and a document that shows it; `edit` may spoil either.
fn square(edit: impl FnOnce(&mut Value, &mut Vec<u8>)) -> Result<World, String> {
    let positions: [[f32; 3]; 4] = [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 2.0, 0.0], [-1.0, 2.0, 0.0]];
    let mut bytes: Vec<u8> = positions.iter().flatten().flat_map(|value| value.to_le_bytes()).collect();
    bytes.extend([0_u16, 1, 2, 0, 2, 3].iter().flat_map(|index| index.to_le_bytes()));
    let mut document = json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "name": "wall", "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1, "material": 0 }] }],
        "materials": [{ "name": "paint", "pbrMetallicRoughness": { "baseColorFactor": [0.5, 0.1, 0.02, 1.0] } }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
              "min": [-1.0, 0.0, 0.0], "max": [1.0, 2.0, 0.0] },
            { "bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR" },
        ],
        "bufferViews": [
            { "buffer": 0, "byteOffset": 0, "byteLength": 48 },
            { "buffer": 0, "byteOffset": 48, "byteLength": 12 },
        ],
        "buffers": [{ "byteLength": 60, "uri": "wall.bin" }],
    });
    edit(&mut document, &mut bytes);
    let folder = TempDir::new().unwrap();
    let file = folder.path().join("wall.gltf");
    fs::write(&file, document.to_string()).unwrap();
    fs::write(folder.path().join("wall.bin"), bytes).unwrap();
    load(&file).map_err(|error| error.problem)
}

fn problem(edit: impl FnOnce(&mut Value, &mut Vec<u8>)) -> String {
    square(edit).expect_err("a file that gives no world")
}

#[test]
fn a_wall_stands_upright_and_faces_south() {
    let world = square(|_, _| ()).unwrap();
    let [object] = &world.objects[..] else { panic!("one object") };
    assert_eq!((world.name.as_str(), object.name.as_str(), object.collides), ("wall", "wall", true));
    assert!(object.mesh.normals.iter().all(|&normal| (Vec3::from(normal) - Vec3::NEG_Y).length() < 1e-6));
    let corners = object.mesh.triangles.iter().map(|&triangle| object.mesh.corners(triangle));
    let area: f32 = corners
        .map(|[a, b, c]| {
            let cross = (b - a).cross(c - a);
            assert!(cross.normalize().dot(Vec3::NEG_Y) > 0.999, "counter-clockwise from outside");
            cross.length() / 2.0
        })
        .sum();
    assert!((area - 4.0).abs() < 1e-4, "{area}");
    let top = object.mesh.positions.iter().map(|at| at[2]).fold(0.0, f32::max);
    assert_eq!(top, 2.0);
}

#[test]
fn without_a_word_830_nm_is_the_brightest_colour_and_extras_say_otherwise() {
    let texel = |world: &World| world.materials[0].albedo[TEXTURE_SIZE * 7 + 3];
    assert_eq!(texel(&square(|_, _| ()).unwrap()), [188, 89, 39, 128]);
    let told = square(|document, _| document["materials"][0]["extras"] = json!({ "albedo_830nm": 0.2 })).unwrap();
    assert_eq!(texel(&told), [188, 89, 39, 51]);
}

#[test]
fn a_mirrored_wall_still_shows_its_face_and_a_two_sided_one_both() {
    let mirrored = square(|document, _| document["nodes"][0]["scale"] = json!([-1.0, 1.0, 1.0])).unwrap();
    for &triangle in &mirrored.objects[0].mesh.triangles {
        let [a, b, c] = mirrored.objects[0].mesh.corners(triangle);
        assert!((b - a).cross(c - a).y < 0.0);
    }
    let one = square(|_, _| ()).unwrap().objects[0].mesh.triangles.len();
    let both = square(|document, _| document["materials"][0]["doubleSided"] = json!(true)).unwrap();
    assert_eq!(both.objects[0].mesh.triangles.len(), 2 * one);
}

#[test]
fn extras_let_robots_through() {
    let world = square(|document, _| document["nodes"][0]["extras"] = json!({ "collides": false })).unwrap();
    assert!(!world.objects[0].collides);
}

#[test]
fn a_bad_file_is_told_what_is_wrong_with_it() {
    let lacking = problem(|document, _| document["buffers"][0]["uri"] = json!("else.bin"));
    assert!(lacking.contains("buffer 0") && lacking.contains("keep it beside"), "{lacking}");
    let short = problem(|_, bytes| bytes.truncate(40));
    assert!(short.contains("40 bytes of 60"), "{short}");
    let beyond = problem(|document, _| document["bufferViews"][0]["byteLength"] = json!(4800));
    assert!(beyond.contains("buffer view 0"), "{beyond}");
    let long = problem(|document, _| document["accessors"][1]["count"] = json!(9));
    assert!(long.contains("accessor 1"), "{long}");
    let index = problem(|_, bytes| bytes[48] = 9);
    assert!(index.contains("names vertex 9 of 4"), "{index}");
    let nan = problem(|_, bytes| bytes[..4].copy_from_slice(&f32::NAN.to_le_bytes()));
    assert!(nan.contains("vertex 0 is not finite"), "{nan}");
    let tiny = problem(|document, _| document["nodes"][0]["scale"] = json!([0.001, 0.001, 0.001]));
    assert!(tiny.contains("metre"), "{tiny}");
    let empty = problem(|document, _| document["nodes"][0] = json!({ "name": "nothing" }));
    assert!(empty.contains("no triangles"), "{empty}");
    let albedo = problem(|document, _| document["materials"][0]["extras"] = json!({ "albedo_830nm": 7 }));
    assert!(albedo.contains("paint") && albedo.contains("0 to 1"), "{albedo}");
    let lines = problem(|document, _| document["meshes"][0]["primitives"][0]["mode"] = json!(1));
    assert!(lines.contains("\"wall\"") && lines.contains("triangles"), "{lines}");
    let noise = load(std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("Cargo.toml").as_path()).unwrap_err();
    assert!(noise.to_string().contains("no glTF 2.0 file"), "{noise}");
}
