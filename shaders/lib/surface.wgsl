// What the G-buffer says of a pixel, besides its depth: 16 bytes, as the bytes are what it costs.

// Irradiance and luminance are kept in this many lux (cd/m²), so that half floats hold moonlight and noon.
const LUX_PER_UNIT = 256.0;
// Mip levels are below this.
const LEVELS = 16u;
const PI = 3.14159265;

struct Surface {
    // In the texture, which repeats: 0 to 1.
    uv: vec2f,
    material: u32,
    level: f32,
}

// Two numbers in 16 bits each: of a fraction the part after the point is kept.
fn packed(numbers: vec2f, scale: f32) -> u32 {
    let whole = vec2u(vec2i(numbers * scale));
    return (whole.x & 0xffffu) | (whole.y << 16u);
}

// First component: the surface. Second, upper half: its material and mip level. Fourth: its normal. The rest is the
// camera's.
fn surface_of(texel: vec4u) -> Surface {
    let what = texel.y >> 16u;
    // Signed, as that is what processors convert.
    let uv = vec2f(vec2i(vec2u(texel.x & 0xffffu, texel.x >> 16u))) * (1.0 / 65536.0);
    return Surface(uv, what / LEVELS, f32(i32(what % LEVELS)));
}

// Colour: irradiance, R, G, B in LUX_PER_UNIT.
fn irradiance_of(texel: vec4u) -> vec3f {
    return vec3f(unpack2x16float(texel.z), unpack2x16float(texel.y).x);
}

// Infrared: spectral irradiance at 830 nm, W m⁻² nm⁻¹.
fn near_infrared_of(texel: vec4u) -> f32 {
    return unpack2x16float(texel.y).x;
}

// The normal in the camera's frame, which faces the camera.
fn normal_of(texel: vec4u) -> vec3f {
    let across = vec2f(vec2i(vec2u(texel.w << 16u, texel.w)) >> vec2u(16u)) * (1.0 / 32767.0);
    return vec3f(across, -sqrt(max(1.0 - dot(across, across), 0.0)));
}

// sRGB's curve, to linear light. A polynomial within 0.001 of it, for speed.
fn linear_from_srgb(encoded: vec3f) -> vec3f {
    return encoded * (encoded * (encoded * 0.305306011 + 0.682171111) + 0.012522878);
}

// Linear light, 0 to 1, to sRGB's curve: within 0.002 of it, made of roots, which cost a fraction of `pow`.
fn srgb_from_linear(linear: vec3f) -> vec3f {
    let root = sqrt(linear);
    let fourth = sqrt(root);
    let eighth = sqrt(fourth);
    return max(0.585122381 * root + 0.783140355 * fourth - 0.368262736 * eighth, vec3f());
}
