// What each pixel of a camera sees, before any light: two variants, each keeping what its camera's light needs.
#import lib/camera
#import lib/surface

@group(0) @binding(0) var<uniform> camera: Camera;

struct Vertex {
    @location(0) position: vec3f,
    @location(1) normal: vec4f,
    @location(2) uv: vec2f,
    // R, G, B in lux, 830 nm in W m⁻² nm⁻¹.
    @location(3) irradiance: vec4f,
    @location(4) material: u32,
}

struct Corner {
    @builtin(position) position: vec4f,
    @location(0) uv: vec2f,
    @location(1) light: vec4f,
    @location(2) @interpolate(flat) material: u32,
}

struct Surface {
    // u, v, 1/z, LEVELS · material + mip level.
    @location(0) place: vec4f,
    // Colour: irradiance in LUX_PER_UNIT, cosine to the sun. Infrared: normal in the camera's frame, spectral irradiance
    // at 830 nm.
    @location(1) light: vec4f,
}

@vertex
fn colour_vertex(vertex: Vertex) -> Corner {
    let position = camera.clip_from_world * vec4f(vertex.position, 1.0);
    let light = vec4f(vertex.irradiance.rgb / LUX_PER_UNIT, dot(vertex.normal.xyz, camera.towards_sun.xyz));
    return Corner(position, vertex.uv, light, vertex.material);
}

@vertex
fn infrared_vertex(vertex: Vertex) -> Corner {
    let position = camera.clip_from_world * vec4f(vertex.position, 1.0);
    let normal = (camera.camera_from_world * vec4f(vertex.normal.xyz, 0.0)).xyz;
    return Corner(position, vertex.uv, vec4f(normal, vertex.irradiance.w), vertex.material);
}

const TEXTURE_SIZE = 512.0;

@fragment
fn surface(corner: Corner) -> Surface {
    let across = dpdx(corner.uv) * TEXTURE_SIZE;
    let down = dpdy(corner.uv) * TEXTURE_SIZE;
    // Half a level sharper than the longer side of the pixel's footprint asks for: floors seen at a grazing angle
    // would lose their texture.
    let level = 0.5 * log2(max(max(dot(across, across), dot(down, down)), 1.0)) - 0.5;
    let layer_and_level = LEVELS * f32(corner.material) + clamp(level, 0.0, LEVELS - 1.0);
    return Surface(vec4f(corner.uv, corner.position.w, layer_and_level), corner.light);
}
