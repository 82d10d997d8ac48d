#version 120
// The CET's row kept between the middles of its first and last texels, where no filter reaches round the edge (V3 repaired).
// In: the coordinate t; cetTexel, the height of a texel of the CET. Out: t within the texture.

uniform float cetTexel;

float wrapped(float row) {
    return clamp(row, 0.5 * cetTexel, 1.0 - 0.5 * cetTexel);
}
