// The dot projector. Its frame is the infrared camera's, moved along x; directions are (x/z, y/z).
// The same in Rust, for the stored reference image: sim/src/kinect/projector.rs.

struct Projector {
    // Metres along x.
    baseline: f32,
    // Tangent by which the pattern's middle points towards the camera.
    toe_in: f32,
    // Of the lens, on r².
    pincushion: f32,
    // Of a dot's peak on a facing plane at 1 m, W/m².
    peak_irradiance: f32,
    // In a tangent of 1: tiles, and edges of the map of what the projector sees.
    tiles: vec2f,
    map: vec2f,
    // Three by three, rows down.
    tile_brightness: array<vec4f, 3>,
}

// Where a direction falls in the pattern, in tiles: (0, 0) is the pattern's corner, (3, 3) the opposite one.
fn tile_of_direction(projector: Projector, direction: vec2f) -> vec2f {
    let aimed = direction + vec2f(projector.toe_in, 0.0);
    // The lens stretches by 1 + pincushion · r² of where it comes from: undone by the root of s · (1 + bend · s²) = 1.
    let bend = projector.pincushion * dot(aimed, aimed);
    // Its first terms, then one step of Newton's: a millionth is left.
    let near = 1.0 - bend * (1.0 - bend * (3.0 - 12.0 * bend));
    let square = near * near;
    let shrink = (1.0 + 2.0 * bend * square * near) / (1.0 + 3.0 * bend * square);
    return aimed * shrink * projector.tiles + 1.5;
}

// Where a direction falls in the map of what the projector sees; 0 to 1.
fn map_of_direction(projector: Projector, direction: vec2f) -> vec2f {
    return (direction + vec2f(projector.toe_in, 0.0)) * projector.map + 0.5;
}
