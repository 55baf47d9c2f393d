// A camera: pinhole and motion during the exposure. Camera frame: x right, y down, z forward. Where the lens sends each
// pixel of the sensor does not change and is told apart: directions, (x/z, y/z), row after row.
// Pixel centres lie at whole numbers. The G-buffer is the image of the pinhole alone, larger by a margin.

struct Camera {
    clip_from_world: mat4x4f,
    camera_from_world: mat4x4f,
    // Points in the camera's frame in the middle of the frame interval → its frame at the interval's start, end.
    start_from_camera: mat4x4f,
    end_from_camera: mat4x4f,
    // Pixels.
    focal: vec2f,
    centre: vec2f,
    margin: vec2f,
    gbuffer_size: vec2f,
    size: vec2u,
    // As shares of the frame interval: exposure of a row, first row's to last row's.
    exposure: f32,
    readout: f32,
    // Brightness lost in the image's corners, share.
    vignetting: f32,
    // Of the G-buffer's depth, near/z; metres.
    near: f32,
    padding: vec2f,
}

// The G-buffer's pixel in a direction.
fn gbuffer_pixel(camera: Camera, direction: vec2f) -> vec2f {
    return direction * camera.focal + camera.centre + camera.margin;
}

// The direction that a G-buffer's pixel looks in.
fn direction_of_gbuffer_pixel(camera: Camera, pixel: vec2f) -> vec2f {
    return (pixel - camera.margin - camera.centre) / camera.focal;
}

// How far the thing seen in a direction, at depth 1/inverse_z, moves across the image in a frame interval; pixels.
fn image_motion(camera: Camera, direction: vec2f, inverse_z: f32) -> vec2f {
    let point = vec4f(direction, 1.0, inverse_z);
    let start = camera.start_from_camera * point;
    let end = camera.end_from_camera * point;
    return (end.xy * start.z - start.xy * end.z) * (camera.focal / (end.z * start.z));
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
    let half = vec2f(camera.size) * 0.5;
    let from_middle = (pixel + 0.5 - half) / length(half);
    return 1.0 - camera.vignetting * dot(from_middle, from_middle);
}
