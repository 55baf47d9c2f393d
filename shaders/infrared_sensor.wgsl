// Radiance at 830 nm and the dots in it → the infrared camera's image: rolling exposure, speckle, shot and read noise,
// 10 bits with saturation.
#import lib/camera
#import lib/noise
#import lib/projector

struct InfraredSensor {
    // Of the filter, nm.
    bandwidth: f32,
    // Electrons of a pixel for 1 W m⁻² sr⁻¹, during the exposure.
    electrons_per_radiance: f32,
    // Electrons squared; and 1 with photon noise, 0 without.
    read_variance: f32,
    shot_noise: f32,
    // Digital numbers for an electron, gain included.
    numbers_per_electron: f32,
    // Standard deviation of the dots' brightness by laser speckle, share.
    speckle_contrast: f32,
    noise_key: u32,
    // Changes when anything moves, as speckle does.
    speckle_key: u32,
    // Electrons of a pixel by light that makes no image.
    stray_electrons: f32,
}

@group(0) @binding(0) var<uniform> camera: Camera;
@group(0) @binding(1) var<uniform> sensor: InfraredSensor;
@group(0) @binding(2) var<uniform> projector: Projector;
@group(0) @binding(3) var<storage, read> directions: array<vec2f>;
@group(0) @binding(4) var radiance: texture_2d<f32>;
@group(0) @binding(5) var depths: texture_depth_2d;
@group(0) @binding(6) var bilinear: sampler;
@group(0) @binding(7) var nearest: sampler;
@group(0) @binding(8) var tile: texture_2d<f32>;
@group(0) @binding(9) var repeating: sampler;
@group(0) @binding(10) var<storage, read_write> image: array<u32>;

const LARGEST_NUMBER = 1023.0;
// Neighbouring pixels whose 1/z differ by more than this share lie on different surfaces.
const EDGE = 0.1;

// 1/z between the G-buffer's pixels; at edges the nearest pixel's.
fn inverse_z_at(at: vec2f) -> f32 {
    let corner = floor(at - 0.5);
    // In order: lower left, lower right, upper right, upper left.
    let around = textureGather(depths, nearest, (corner + 1.0) * camera.texel) * camera.nearest;
    let share = at - 0.5 - corner;
    let low = min(min(around.x, around.y), min(around.z, around.w));
    let high = max(max(around.x, around.y), max(around.z, around.w));
    let use_share = select(share, round(share), high - low > EDGE * high);
    return mix(mix(around.w, around.z, use_share.x), mix(around.x, around.y, use_share.x), use_share.y);
}

fn pattern_light(direction: vec2f) -> f32 {
    let place = tile_of_direction(projector, direction);
    let number = floor(place);
    if any(number < vec2f()) || any(number > vec2f(2.0)) {
        return 0.0;
    }
    let brightness = projector.tile_brightness[u32(number.y)][u32(number.x)];
    return brightness * textureSampleLevel(tile, repeating, place, 0.0).r;
}

// How many instants of the exposure are averaged: odd, as one is in the middle; fixed when compiled, as the loop then
// disappears.
override TAPS: u32 = 1u;

fn expose_pixel(id: vec2u) {
    let index = id.y * camera.size.x + id.x;
    let direction = directions[index];
    let middle = gbuffer_pixel(camera, direction) + 0.5;
    let motion = image_motion(camera, direction, textureLoad(radiance, vec2u(middle), 0).w);
    var ambient = 0.0;
    var glint = 0.0;
    // Dots stay where they are while the surface under them passes, and only shift with its depth.
    var dot_peak = 0.0;
    for (var tap = 0u; tap < TAPS; tap++) {
        let seen = middle - motion * tap_instant(camera, id.y, tap, TAPS);
        let light = textureSampleLevel(radiance, bilinear, seen * camera.texel, 0.0);
        ambient += light.x;
        glint += light.z;
        dot_peak = select(dot_peak, light.y, tap == TAPS / 2u);
    }
    let at = middle - motion * row_instant(camera, id.y);
    let from_projector = direction - vec2f(projector.baseline * inverse_z_at(at), 0.0);
    let speckle = 1.0 + sensor.speckle_contrast * normal(hash(sensor.speckle_key + index));
    let dots = dot_peak * pattern_light(from_projector) * max(speckle, 0.0);

    let light = ((ambient * sensor.bandwidth + glint) / f32(TAPS) + dots) * vignette(camera, vec2f(id));
    let electrons = light * sensor.electrons_per_radiance + sensor.stray_electrons;
    let noise = normal(hash(sensor.noise_key + index)) * sqrt(sensor.shot_noise * electrons + sensor.read_variance);
    let number = (electrons + noise) * sensor.numbers_per_electron;
    if all(id < camera.size) {
        image[index] = u32(clamp(round(number), 0.0, LARGEST_NUMBER));
    }
}

// Two rows: what all pixels have in common is fetched once for both.
@compute @workgroup_size(64, 1)
fn infrared_sensor(@builtin(global_invocation_id) id: vec3u) {
    expose_pixel(vec2u(id.x, 2u * id.y));
    expose_pixel(vec2u(id.x, 2u * id.y + 1u));
}
