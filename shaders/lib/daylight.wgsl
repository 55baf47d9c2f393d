// Light from the open sky, and from the one thing in it that casts sharp shadows: the sun, at night the moon. In the
// camera's frame. Visible light in LUX_PER_UNIT, in the fourth channel 830 nm.

struct Daylight {
    // A place in the camera's frame → the sun's map: across, down (pixels), and what the map holds: nearer is more.
    map_from_camera: mat4x4f,
    // What a facing surface gets of the sun.
    beam: vec4f,
    // The sky's radiance: at the horizon, from there to the zenith, about the sun; and the ground's at the horizon.
    level: vec4f,
    rise: vec4f,
    glow: vec4f,
    ground: vec4f,
    // Unit vectors: to the sun, and up.
    towards: vec3f,
    // A pixel of the map as a share of its edge.
    map_texel: f32,
    up: vec3f,
    // What one of its pixels' widths is in its depth.
    map_step: f32,
}

// Cosine of the sun's radius, 0.267°, and the solid angle of its disc in sr.
const DISC = 0.99998914;
const DISC_SIZE = 6.8e-5;
// Half floats hold this much, and it saturates any sensor.
const BRIGHTEST = 60000.0;
// How fast the glow about the sun fades with the angle, 1/rad (CIE's clear sky).
const GLOW_FADES = 3.0;
// Surfaces that turn further away than this cosine from the sun are hardly lit: no need to look deeper there.
const GRAZING = 0.05;

// Share of the sun that reaches a place on a surface which faces it by a cosine.
fn sunlit(daylight: Daylight, map: texture_depth_2d, nearest: sampler, place: vec3f, facing: f32) -> f32 {
    let mapped = (daylight.map_from_camera * vec4f(place, 1.0)).xyz;
    let corner = floor(mapped.xy);
    // In order: lower left, lower right, upper right, upper left.
    let around = textureGather(map, nearest, (corner + 1.0) * daylight.map_texel);
    // As much as the surface itself may rise towards the sun from here to the furthest of the four pixels.
    let cosine = max(facing, GRAZING);
    let slope = sqrt(1.0 - cosine * cosine) / cosine;
    let own = mapped.z + daylight.map_step * (0.5 + 1.5 * slope);
    let lit = select(vec4f(), vec4f(1.0), around <= vec4f(own));
    let share = mapped.xy - corner;
    return mix(mix(lit.w, lit.z, share.x), mix(lit.x, lit.y, share.x), share.y);
}

// What is seen in a direction where nothing is.
fn sky(daylight: Daylight, direction: vec3f) -> vec4f {
    let way = normalize(direction);
    let height = dot(way, daylight.up);
    let cosine = dot(way, daylight.towards);
    let apart = sqrt(max(2.0 - 2.0 * cosine, 0.0));
    let air = daylight.level + daylight.rise * height + daylight.glow * exp(-GLOW_FADES * apart);
    let disc = select(vec4f(), daylight.beam / DISC_SIZE, cosine > DISC);
    return min(select(daylight.ground, air + disc, height > 0.0), vec4f(BRIGHTEST));
}
