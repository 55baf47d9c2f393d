//! WGSL sources, `#import lib/name` lines replaced by what they name. A file imports all it needs itself; a library
//! file imports nothing.

macro_rules! sources {
    ($($name:literal),* $(,)?) => {
        /// Name and text of every file under `shaders/`.
        const SOURCES: &[(&str, &str)] = &[$(($name, include_str!(concat!("../../../shaders/", $name, ".wgsl")))),*];
    };
}

sources![
    "lib/camera",
    "lib/daylight",
    "lib/gloss",
    "lib/noise",
    "lib/projector",
    "lib/surface",
    "colour_light",
    "colour_sensor",
    "depth_map",
    "gbuffer",
    "infrared_light",
    "infrared_sensor",
];

fn text(name: &str) -> &'static str {
    let found = SOURCES.iter().find(|(known, _)| *known == name);
    found.unwrap_or_else(|| panic!("there is no shader {name}")).1
}

/// A shader with its imports in it.
///
/// # Panics
/// When it, or one of its imports, does not exist: a bug.
pub(super) fn source(name: &str) -> String {
    let mut whole = String::new();
    for line in text(name).lines() {
        whole += line.strip_prefix("#import ").map_or(line, text);
        whole.push('\n');
    }
    whole
}

/// Compiles a shader.
pub(super) fn module(device: &wgpu::Device, name: &str) -> wgpu::ShaderModule {
    device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(name),
        source: wgpu::ShaderSource::Wgsl(source(name).into()),
    })
}

#[cfg(test)]
pub(super) fn parsed(name: &str) -> naga::Module {
    let source = source(name);
    naga::front::wgsl::parse_str(&source).unwrap_or_else(|error| panic!("{name}: {}", error.emit_to_string(&source)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shader_is_valid() {
        for (name, _) in SOURCES {
            let module = parsed(name);
            let mut validator = naga::valid::Validator::new(
                naga::valid::ValidationFlags::all(),
                naga::valid::Capabilities::SHADER_FLOAT16_IN_FLOAT32,
            );
            validator
                .validate(&module)
                .unwrap_or_else(|error| panic!("{name}: {}", error.emit_to_string(&source(name))));
            assert_eq!(module.entry_points.is_empty(), name.starts_with("lib/"), "{name}");
        }
    }

    #[test]
    fn every_file_is_listed() {
        let shaders = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../shaders");
        for folder in ["", "lib/"] {
            for entry in std::fs::read_dir(shaders.join(folder)).unwrap() {
                let file = entry.unwrap().file_name().into_string().unwrap();
                if let Some(name) = file.strip_suffix(".wgsl") {
                    text(&format!("{folder}{name}"));
                }
            }
        }
    }
}
