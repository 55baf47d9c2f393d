// G-buffer → radiance at 830 nm, as the pinhole sees it at one instant: the lamps' and the sun's, and what a dot of the
// projector would add. Where dots are is the sensor's business: they do not move with the scene.
#import lib/camera
#import lib/daylight
#import lib/projector
#import lib/surface

@group(0) @binding(0) var<uniform> camera: Camera;
@group(0) @binding(1) var surfaces: texture_2d<u32>;
@group(0) @binding(2) var depths: texture_depth_2d;
@group(0) @binding(3) var albedos: texture_2d_array<f32>;
@group(0) @binding(4) var repeating: sampler;
@group(0) @binding(5) var<uniform> projector: Projector;
@group(0) @binding(6) var projector_map: texture_depth_2d;
@group(0) @binding(7) var nearest: sampler;
@group(0) @binding(8) var<uniform> daylight: Daylight;
@group(0) @binding(9) var sun_map: texture_depth_2d;
// Ambient in W m⁻² sr⁻¹ nm⁻¹; a dot's peak in W m⁻² sr⁻¹; unused; 1/z in metres⁻¹.
@group(0) @binding(10) var radiance: texture_storage_2d<rgba16float, write>;

// How much further than the mapped depth a surface may lie and still be lit, share: the map's pixels are coarse.
const TOLERANCE = 0.01;

// What there is of daylight: fixed when compiled, so that what is not there costs nothing.
override SKY: bool = false;
override SUN: bool = false;

@compute @workgroup_size(64, 1)
fn infrared_light(@builtin(global_invocation_id) id: vec3u) {
    // Past the edge, loads repeat it and stores do nothing: a test would only cost time.
    let texel = textureLoad(surfaces, id.xy, 0);
    let surface = surface_of(texel);
    let inverse_z = textureLoad(depths, id.xy, 0) / camera.near;
    let albedo = textureSampleLevel(albedos, repeating, surface.uv, surface.material, surface.level).a;

    let normal = normal_of(texel);
    let direction = direction_of_gbuffer_pixel(camera, vec2f(id.xy));
    let from_projector = direction - vec2f(projector.baseline * inverse_z, 0.0);
    // A plane across the view at depth z gets peak/z²; this surface as much as it faces the light.
    let facing_projector = max(-dot(normal, vec3f(from_projector, 1.0)), 0.0);
    let mapped = textureGather(projector_map, nearest, map_of_direction(projector, from_projector));
    let own = inverse_z * projector.map_near * (1.0 + TOLERANCE);
    let lit = dot(select(vec4f(), vec4f(0.25), mapped <= vec4f(own)), vec4f(1.0));
    let dot_peak = projector.peak_irradiance * inverse_z * inverse_z * facing_projector * lit;

    let view = vec3f(direction, 1.0);
    var irradiance = near_infrared_of(texel);
    if SUN {
        let facing = max(dot(normal, daylight.towards), 0.0);
        irradiance += daylight.beam.w * facing * sunlit(daylight, sun_map, nearest, view / inverse_z, facing);
    }
    var seen = vec2f(irradiance, dot_peak) * albedo / PI;
    if SKY {
        seen = select(vec2f(sky(daylight, view).w, 0.0), seen, inverse_z > 0.0);
    }
    textureStore(radiance, id.xy, vec4f(seen, 0.0, inverse_z));
}
