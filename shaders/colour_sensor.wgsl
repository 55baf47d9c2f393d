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
@group(0) @binding(2) var<storage, read> directions: array<vec2f>;
@group(0) @binding(3) var luminance: texture_2d<f32>;
@group(0) @binding(4) var bilinear: sampler;
// R, G, B, 255 from the lowest byte up.
@group(0) @binding(5) var<storage, read_write> image: array<u32>;

// How many instants of the exposure are averaged: fixed when compiled, as the loop then disappears.
override TAPS: u32 = 1u;

fn luminance_at(at: vec2f) -> vec3f {
    return textureSampleLevel(luminance, bilinear, at * camera.texel, 0.0).rgb;
}

// One quad of the mosaic: green is seen by every pixel for itself; red and blue have one site, and every pixel shows the
// quad's mean of them.
@compute @workgroup_size(64, 1)
fn colour_sensor(@builtin(global_invocation_id) id: vec3u) {
    let width = camera.size.x;
    let corner = 2u * id.xy;
    let first = corner.y * width + corner.x;
    let sites = array(first, first + 1u, first + width, first + width + 1u);
    var places: array<vec2f, 4>;
    for (var site = 0; site < 4; site++) {
        places[site] = gbuffer_pixel(camera, directions[sites[site]]) + 0.5;
    }
    let middle = (places[0] + places[3]) * 0.5;
    let direction = (directions[sites[0]] + directions[sites[3]]) * 0.5;
    let motion = image_motion(camera, direction, textureLoad(luminance, vec2u(middle), 0).w);
    var red_blue = vec2f();
    var green = vec4f();
    for (var tap = 0u; tap < TAPS; tap++) {
        let upper = motion * tap_instant(camera, corner.y, tap, TAPS);
        let lower = motion * tap_instant(camera, corner.y + 1u, tap, TAPS);
        red_blue += luminance_at(middle - 0.5 * (upper + lower)).rb;
        green += vec4f(
            luminance_at(places[0] - upper).g,
            luminance_at(places[1] - upper).g,
            luminance_at(places[2] - lower).g,
            luminance_at(places[3] - lower).g,
        );
    }
    let quad_key = hash(sensor.noise_key ^ hash(id.y * width + id.x));
    let red_blue_draw = vec2f(normal(quad_key), normal(hash(quad_key)));
    let electrons_per_sum = sensor.electrons_per_luminance * LUX_PER_UNIT / f32(TAPS);
    for (var site = 0u; site < 4u; site++) {
        let pixel = corner + vec2u(site & 1u, site >> 1u);
        let gain = electrons_per_sum * vignette(camera, vec2f(pixel));
        let electrons = vec3f(red_blue.x, green[site], red_blue.y) * gain;
        let key = hash(sensor.noise_key + sites[site]);
        let draw = vec3f(red_blue_draw.x, normal(key), red_blue_draw.y);
        let noisy = electrons + draw * sqrt(sensor.shot_noise * electrons + sensor.read_variance);
        let level = srgb_from_linear(clamp(noisy * sensor.level_per_electron, vec3f(), vec3f(1.0)));
        if all(pixel < camera.size) {
            image[sites[site]] = pack4x8unorm(vec4f(level, 1.0));
        }
    }
}
