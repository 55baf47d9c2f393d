// G-buffer → luminance, as the pinhole sees it at one instant.
#import lib/camera
#import lib/daylight
#import lib/gloss
#import lib/surface

@group(0) @binding(0) var<uniform> camera: Camera;
@group(0) @binding(1) var surfaces: texture_2d<u32>;
@group(0) @binding(2) var depths: texture_depth_2d;
@group(0) @binding(3) var albedos: texture_2d_array<f32>;
@group(0) @binding(4) var repeating: sampler;
@group(0) @binding(5) var<uniform> daylight: Daylight;
@group(0) @binding(6) var sun_map: texture_depth_2d;
@group(0) @binding(7) var nearest: sampler;
@group(0) @binding(8) var glosses: texture_2d<f32>;
// R, G, B in LUX_PER_UNIT cd/m²; 1/z in metres⁻¹.
@group(0) @binding(9) var luminance: texture_storage_2d<rgba16float, write>;

// What there is of daylight: fixed when compiled, so that what is not there costs nothing.
override SKY: bool = false;
override SUN: bool = false;

fn luminance_of_pixel(id: vec2u) {
    // Past the edge, loads repeat it and stores do nothing: a test would only cost time.
    let texel = textureLoad(surfaces, id, 0);
    let surface = surface_of(texel);
    let inverse_z = textureLoad(depths, id, 0) * camera.nearest;
    let albedo = textureSampleLevel(albedos, repeating, surface.uv, surface.material, surface.level).rgb;
    let direction = vec3f(direction_of_gbuffer_pixel(camera, vec2f(id)), 1.0);
    let gloss = gloss_of(glosses, surface.material);
    let normal = normal_of(texel);
    let towards_eye = -normalize(direction);
    let outgoing = max(dot(normal, towards_eye), 0.0);
    let body = linear_from_srgb(albedo) / PI;
    // What is mirrored of the surroundings: as bright as what lights the surface.
    let mirrored = mirrored_share(gloss, outgoing);
    var seen = irradiance_of(texel) * mix(body, vec3f(1.0 / PI), mirrored);
    if SUN {
        let facing = max(dot(normal, daylight.towards), 0.0);
        let sun = daylight.beam.rgb * facing * sunlit(daylight, sun_map, nearest, direction / inverse_z, facing);
        let glint = mirrored_between(gloss, normal, daylight.towards, towards_eye);
        seen += sun * (body * scattered_share(gloss, facing, outgoing) + glint);
    }
    var beyond = vec3f();
    if SKY {
        beyond = sky(daylight, direction).rgb;
    }
    seen = select(beyond, min(seen, vec3f(BRIGHTEST)), inverse_z > 0.0);
    textureStore(luminance, id, vec4f(seen, inverse_z));
}

// Two rows: what all pixels have in common is fetched once for both.
@compute @workgroup_size(64, 1)
fn colour_light(@builtin(global_invocation_id) id: vec3u) {
    luminance_of_pixel(vec2u(id.x, 2u * id.y));
    luminance_of_pixel(vec2u(id.x, 2u * id.y + 1u));
}
