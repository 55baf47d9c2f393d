// Luminance → the colour camera's image: lens, rolling exposure, Bayer mosaic, shot and read noise, 8 bits in sRGB.
#import lib/camera
#import lib/noise
#import lib/surface

struct ColourSensor {
    // Electrons of a pixel for 1 cd/m², during the exposure.
    electrons_per_luminance: f32,
    // Electrons squared; and 1 with photon noise, 0 without.
    read_variance: f32,
    shot_noise: f32,
    noise_key: u32,
    // Share of full scale for an electron in R, G, B, gains included.
    level_per_electron: vec3f,
    padding: u32,
}

@group(0) @binding(0) var<uniform> camera: Camera;
@group(0) @binding(1) var<uniform> sensor: ColourSensor;
@group(0) @binding(2) var luminance: texture_2d<f32>;
@group(0) @binding(3) var bilinear: sampler;
// R, G, B, 255 from the lowest byte up.
@group(0) @binding(4) var<storage, read_write> image: array<u32>;

// How many instants of the exposure are averaged: fixed when compiled, as the loop then disappears.
override TAPS: u32 = 1u;

@compute @workgroup_size(64, 1)
fn colour_sensor(@builtin(global_invocation_id) id: vec3u) {
    let pixel = vec2f(id.xy);
    let direction = direction_of_pixel(camera, pixel);
    let at = gbuffer_pixel(camera, direction) + 0.5;
    // Red and blue have one site in a 2×2 quad: every pixel of it shows the quad's mean of them.
    let to_quad = 0.5 - vec2f(id.xy & vec2u(1u));
    let centre = textureSampleLevel(luminance, bilinear, at / camera.gbuffer_size, 0.0);
    let motion = image_motion(camera, direction, centre.w);
    var light = vec3f();
    for (var tap = 0u; tap < TAPS; tap++) {
        let seen = at - motion * tap_instant(camera, id.y, tap, TAPS);
        let green = textureSampleLevel(luminance, bilinear, seen / camera.gbuffer_size, 0.0).g;
        let red_blue = textureSampleLevel(luminance, bilinear, (seen + to_quad) / camera.gbuffer_size, 0.0).rb;
        light += vec3f(red_blue.x, green, red_blue.y);
    }
    let mean = light * (LUX_PER_UNIT / f32(TAPS)) * vignette(camera, pixel);

    let electrons = mean * sensor.electrons_per_luminance;
    let key = hash(sensor.noise_key + id.y * camera.size.x + id.x);
    let quad_key = hash(sensor.noise_key ^ hash((id.y >> 1u) * camera.size.x + (id.x >> 1u)));
    let draw = vec3f(normal(quad_key), normal(key), normal(hash(quad_key)));
    let noisy = electrons + draw * sqrt(sensor.shot_noise * electrons + sensor.read_variance);
    let level = srgb_from_linear(clamp(noisy * sensor.level_per_electron, vec3f(), vec3f(1.0)));
    if id.x < camera.size.x {
        image[id.y * camera.size.x + id.x] = pack4x8unorm(vec4f(level, 1.0));
    }
}
