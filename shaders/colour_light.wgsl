// G-buffer → luminance, as the pinhole sees it at one instant.
#import lib/surface

@group(0) @binding(0) var places: texture_2d<f32>;
@group(0) @binding(1) var lights: texture_2d<f32>;
@group(0) @binding(2) var albedos: texture_2d_array<f32>;
@group(0) @binding(3) var repeating: sampler;
// R, G, B in LUX_PER_UNIT cd/m²; 1/z in metres⁻¹.
@group(0) @binding(4) var luminance: texture_storage_2d<rgba16float, write>;

@compute @workgroup_size(64, 1)
fn colour_light(@builtin(global_invocation_id) id: vec3u) {
    // Past the edge, loads repeat it and stores do nothing: a test would only cost time.
    let place = textureLoad(places, id.xy, 0);
    let irradiance = textureLoad(lights, id.xy, 0).rgb;
    let layer = floor(place.w / LEVELS);
    let albedo = textureSampleLevel(albedos, repeating, place.xy, u32(layer), place.w - LEVELS * layer).rgb;
    // Lambertian: luminance = albedo · irradiance / π.
    textureStore(luminance, id.xy, vec4f(linear_from_srgb(albedo) * irradiance / PI, place.z));
}
