// Reflection where a surface begins: Fresnel's share of the light is mirrored there, by facets of any slope (GGX); the
// rest enters the body, which scatters it evenly, and must come out again. Cosines are to the normal unless said.

struct Gloss {
    // Share mirrored at normal incidence; 0: matt, nothing is mirrored at any angle.
    reflectance: f32,
    // Of GGX's distribution, alpha.
    roughness: f32,
}

fn gloss_of(glosses: texture_2d<f32>, material: u32) -> Gloss {
    let gloss = textureLoad(glosses, vec2u(material, 0u), 0).xy;
    return Gloss(gloss.x, gloss.y);
}

// What is mirrored at grazing incidence: all, by whatever is no less clear than water.
fn grazing(gloss: Gloss) -> f32 {
    return min(50.0 * gloss.reflectance, 1.0);
}

// Schlick's approximation.
fn mirrored_share(gloss: Gloss, cosine: f32) -> f32 {
    let rest = 1.0 - cosine;
    let square = rest * rest;
    return gloss.reflectance + (grazing(gloss) - gloss.reflectance) * square * square * rest;
}

// Of what a matt surface would scatter from one direction into another (Kelemen & Szirmay-Kalos 2001): energy is
// conserved, and the directions may change places.
fn scattered_share(gloss: Gloss, incoming: f32, outgoing: f32) -> f32 {
    // The mean over all directions, weighted by the cosine.
    let mean = gloss.reflectance + (grazing(gloss) - gloss.reflectance) / 21.0;
    return (1.0 - mirrored_share(gloss, incoming)) * (1.0 - mirrored_share(gloss, outgoing)) / (1.0 - mean);
}

// Radiance for a unit of irradiance, sr⁻¹ (Cook & Torrance; GGX; Schlick's masking). `normal`: cosine between the normal
// and the half-way direction; `half_way`: between that and either direction.
fn mirrored(gloss: Gloss, incoming: f32, outgoing: f32, normal: f32, half_way: f32) -> f32 {
    let alpha = gloss.roughness * gloss.roughness;
    let spread = normal * normal * (alpha - 1.0) + 1.0;
    let masking = 0.5 * gloss.roughness;
    let shadow = (incoming * (1.0 - masking) + masking) * (outgoing * (1.0 - masking) + masking);
    return mirrored_share(gloss, half_way) * alpha / (4.0 * 3.14159265 * spread * spread * shadow);
}

// The same for two unit vectors, away from the surface.
fn mirrored_between(gloss: Gloss, normal: vec3f, towards_light: vec3f, towards_eye: vec3f) -> f32 {
    let half_way = normalize(towards_light + towards_eye);
    let incoming = max(dot(normal, towards_light), 0.0);
    let outgoing = max(dot(normal, towards_eye), 0.0);
    return mirrored(gloss, incoming, outgoing, dot(normal, half_way), dot(half_way, towards_eye));
}
