// What each pixel of a camera sees, before any light: two variants of the vertices, each with what its
// camera's light needs.
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

struct ColourCorner {
    @builtin(position) position: vec4f,
    @location(0) uv: vec2f,
    // Across the camera's frame.
    @location(1) normal: vec2f,
    // R, G, B in LUX_PER_UNIT.
    @location(2) light: vec3f,
    @location(3) @interpolate(flat) material: u32,
}

struct InfraredCorner {
    @builtin(position) position: vec4f,
    @location(0) uv: vec2f,
    // Across the camera's frame.
    @location(1) normal: vec2f,
    @location(2) irradiance: f32,
    @location(3) @interpolate(flat) material: u32,
}

@vertex
fn colour_vertex(vertex: Vertex) -> ColourCorner {
    let position = camera.clip_from_world * vec4f(vertex.position, 1.0);
    let normal = (camera.camera_from_world * vec4f(vertex.normal.xyz, 0.0)).xy;
    return ColourCorner(position, vertex.uv, normal, vertex.irradiance.rgb / LUX_PER_UNIT, vertex.material);
}

@vertex
fn infrared_vertex(vertex: Vertex) -> InfraredCorner {
    let position = camera.clip_from_world * vec4f(vertex.position, 1.0);
    let normal = (camera.camera_from_world * vec4f(vertex.normal.xyz, 0.0)).xy;
    return InfraredCorner(position, vertex.uv, normal, vertex.irradiance.w, vertex.material);
}

const TEXTURE_SIZE = 512.0;

// Material and mip level in the upper half, a half float in the lower.
fn what(uv: vec2f, material: u32, light: f32) -> u32 {
    let across = dpdx(uv) * TEXTURE_SIZE;
    let down = dpdy(uv) * TEXTURE_SIZE;
    // Half a level sharper than the longer side of the pixel's footprint asks for, and the nearest: floors seen at a
    // grazing angle would lose their texture. Half the logarithm of the square is half its exponent.
    let square = max(max(dot(across, across), dot(down, down)), 1.0);
    let level = min(((bitcast<u32>(square) >> 23u) - 127u) >> 1u, LEVELS - 1u);
    return ((LEVELS * material + level) << 16u) | pack2x16float(vec2f(light, 0.0));
}

@fragment
fn colour_surface(corner: ColourCorner) -> @location(0) vec4u {
    let light = corner.light;
    let what = what(corner.uv, corner.material, light.z);
    return vec4u(packed(corner.uv, 65536.0), what, pack2x16float(light.xy), packed(corner.normal, 32767.0));
}

@fragment
fn infrared_surface(corner: InfraredCorner) -> @location(0) vec4u {
    let what = what(corner.uv, corner.material, corner.irradiance);
    return vec4u(packed(corner.uv, 65536.0), what, 0u, packed(corner.normal, 32767.0));
}
