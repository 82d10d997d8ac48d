#version 120
// Depth from a copy of the depth buffer, where the map's bytes hold something else.
// In:  depthMap; a place in it. Out: window depth there, 0 to 1; two roundings of 24 bits.

uniform sampler2D depthMap;

float depthOf(vec4 texel, vec2 place) {
    return texture2D(depthMap, place).r;
}

float depthRounding() {
    return 1.5 / 16777215.0;
}
