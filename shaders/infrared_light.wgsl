// G-buffer → radiance at 830 nm, as the pinhole sees it at one instant: the lamps' and the sun's, and what a dot of the
// projector would add. Where dots are is the sensor's business: they do not move with the scene.
#import lib/camera
#import lib/daylight
#import lib/gloss
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
@group(0) @binding(10) var glosses: texture_2d<f32>;
// Ambient in W m⁻² sr⁻¹ nm⁻¹; a dot's peak and the projector's glint in W m⁻² sr⁻¹; 1/z in metres⁻¹.
@group(0) @binding(11) var radiance: texture_storage_2d<rgba16float, write>;

// How much further than the mapped depth a surface may lie and still be lit, share: the map's pixels are coarse.
const TOLERANCE = 0.01;
// Of the pattern's light, relative to a dot's peak: one grid position in nine, of a Gaussian of 0.62 positions.
const MEAN_OF_PATTERN = 0.27;

// What there is of daylight: fixed when compiled, so that what is not there costs nothing.
override SKY: bool = false;
override SUN: bool = false;

fn radiance_of_pixel(id: vec2u) {
    // Past the edge, loads repeat it and stores do nothing: a test would only cost time.
    let texel = textureLoad(surfaces, id, 0);
    let surface = surface_of(texel);
    let depth = textureLoad(depths, id, 0);
    let inverse_z = depth * camera.nearest;
    let albedo = textureSampleLevel(albedos, repeating, surface.uv, surface.material, surface.level).a;

    let normal = normal_of(texel);
    let direction = direction_of_gbuffer_pixel(camera, vec2f(id));
    let from_projector = direction - vec2f(projector.baseline * inverse_z, 0.0);
    // A plane across the view at depth z gets peak/z²; this surface as much as it faces the light.
    let facing_projector = max(-dot(normal, vec3f(from_projector, 1.0)), 0.0);
    let mapped = textureGather(projector_map, nearest, map_of_direction(projector, from_projector));
    // The map has the near plane of the camera.
    let own = depth * (1.0 + TOLERANCE);
    let lit = dot(select(vec4f(), vec4f(0.25), mapped <= vec4f(own)), vec4f(1.0));
    let dot_peak = projector.peak_irradiance * inverse_z * inverse_z * facing_projector * lit;

    let gloss = gloss_of(glosses, surface.material);
    let view = vec3f(direction, 1.0);
    let towards_eye = -normalize(view);
    let towards_projector = -normalize(vec3f(from_projector, 1.0));
    let outgoing = max(dot(normal, towards_eye), 0.0);
    let body = albedo / PI;
    // What is mirrored of the surroundings: as bright as what lights the surface.
    var ambient = near_infrared_of(texel) * mix(body, 1.0 / PI, mirrored_share(gloss, outgoing));
    if SUN {
        let facing = max(dot(normal, daylight.towards), 0.0);
        let sun = daylight.beam.w * facing * sunlit(daylight, sun_map, nearest, view / inverse_z, facing);
        let glint = mirrored_between(gloss, normal, daylight.towards, towards_eye);
        ambient += sun * (body * scattered_share(gloss, facing, outgoing) + glint);
    }
    let scattered = body * scattered_share(gloss, max(dot(normal, towards_projector), 0.0), outgoing);
    // A mirror shows the projector's lens and no dots.
    let glint = MEAN_OF_PATTERN * mirrored_between(gloss, normal, towards_projector, towards_eye);
    var beyond = 0.0;
    if SKY {
        beyond = sky(daylight, view).w;
    }
    let seen = min(vec3f(ambient, dot_peak * vec2f(scattered, glint)), vec3f(BRIGHTEST));
    textureStore(radiance, id, vec4f(select(vec3f(beyond, 0.0, 0.0), seen, inverse_z > 0.0), inverse_z));
}

// Two rows: what all pixels have in common is fetched once for both.
@compute @workgroup_size(64, 1)
fn infrared_light(@builtin(global_invocation_id) id: vec3u) {
    radiance_of_pixel(vec2u(id.x, 2u * id.y));
    radiance_of_pixel(vec2u(id.x, 2u * id.y + 1u));
}
