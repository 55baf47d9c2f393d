// How far a light reaches, the projector's or the sun's: depth only, seen from it.

@group(0) @binding(0) var<uniform> clip_from_world: mat4x4f;

@vertex
fn depth_vertex(@location(0) position: vec3f) -> @builtin(position) vec4f {
    return clip_from_world * vec4f(position, 1.0);
}
