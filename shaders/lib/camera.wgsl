// A camera: pinhole and motion during the exposure. Camera frame: x right, y down, z forward. Where the lens sends each
// pixel of the sensor does not change and is told apart: directions, (x/z, y/z), row after row.
// Pixel centres lie at whole numbers. The G-buffer is the image of the pinhole alone, larger by a margin.

struct Camera {
    clip_from_world: mat4x4f,
    camera_from_world: mat4x4f,
    // How points move in the camera's frame in a frame interval: by turn × point + shift. Radians, metres.
    turn: vec3f,
    // As shares of the frame interval: exposure of a row, first row's to last row's.
    exposure: f32,
    shift: vec3f,
    readout: f32,
    // Pixels, and tangents in a pixel.
    focal: vec2f,
    pitch: vec2f,
    // The G-buffer's pixel on the optical axis, and one of its pixels as a share of its edges.
    centre: vec2f,
    texel: vec2f,
    size: vec2u,
    // Brightness lost with the distance from the image's middle, share for each pixel squared.
    vignetting: f32,
    // 1/z for a G-buffer's depth of 1: that of the near plane, metres⁻¹.
    nearest: f32,
}

// The G-buffer's pixel in a direction.
fn gbuffer_pixel(camera: Camera, direction: vec2f) -> vec2f {
    return direction * camera.focal + camera.centre;
}

// The direction that a G-buffer's pixel looks in.
fn direction_of_gbuffer_pixel(camera: Camera, pixel: vec2f) -> vec2f {
    return (pixel - camera.centre) * camera.pitch;
}

// How far the thing seen in a direction, at depth 1/inverse_z, moves across the image in a frame interval, at its speed
// in the interval's middle; pixels (Longuet-Higgins & Prazdny 1980).
fn image_motion(camera: Camera, direction: vec2f, inverse_z: f32) -> vec2f {
    let moved = cross(camera.turn, vec3f(direction, 1.0)) + camera.shift * inverse_z;
    return (moved.xy - direction * moved.z) * camera.focal;
}

// When the middle of a row's exposure is, as a share of the frame interval, 0 in its middle.
fn row_instant(camera: Camera, row: u32) -> f32 {
    return ((f32(row) + 0.5) / f32(camera.size.y) - 0.5) * camera.readout;
}

// When number `tap` of the `taps` instants is that are averaged for a row, likewise.
fn tap_instant(camera: Camera, row: u32, tap: u32, taps: u32) -> f32 {
    return row_instant(camera, row) + ((f32(tap) + 0.5) / f32(taps) - 0.5) * camera.exposure;
}

// What the lens lets through to a pixel, 1 in the middle. Falls with the square of the distance; in the corners, where
// cos⁴ would leave about half, camera chips correct most of it.
fn vignette(camera: Camera, pixel: vec2f) -> f32 {
    let from_middle = pixel + 0.5 - vec2f(camera.size) * 0.5;
    return 1.0 - camera.vignetting * dot(from_middle, from_middle);
}
