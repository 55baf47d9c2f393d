// Noise that depends on nothing but its key and its index: the same on every machine, in every order.

// PCG's output function (O'Neill; as in Jarzynski & Olano, Hash Functions for GPU Rendering, 2020).
fn hash(value: u32) -> u32 {
    let state = value * 747796405u + 2891336453u;
    let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

// Standard normal, nearly: the sum of a hash's four bytes.
fn normal(hash: u32) -> f32 {
    let pairs = (hash & 0x00ff00ffu) + ((hash >> 8u) & 0x00ff00ffu);
    let sum = (pairs & 0xffffu) + (pairs >> 16u);
    return (f32(sum) - 510.0) * (1.0 / 147.8);
}
