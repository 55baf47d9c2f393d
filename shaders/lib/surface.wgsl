// What the G-buffer says of a pixel. Target 0: u, v, 1/z, material and mip level in one number; 1/z = 0: nothing there.

// Irradiance and luminance are kept in this many lux (cd/m²), so that half floats hold moonlight and noon.
const LUX_PER_UNIT = 256.0;
// Mip levels are below this.
const LEVELS = 16.0;
const PI = 3.14159265;

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
