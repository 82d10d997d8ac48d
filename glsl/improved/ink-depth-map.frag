#version 120
// Depth of 16 bits from the plane map itself.
// In:  a texel of plane-map.frag. Out: its depth, 0 to 1; two roundings.

float depthOf(vec4 texel, vec2 place) {
    return dot(texel.ba, vec2(65280.0, 255.0) / 65535.0);
}

float depthRounding() {
    return 1.5 / 65535.0;
}
