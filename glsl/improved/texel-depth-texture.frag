#version 120
// Depth from a copy of the depth buffer instead of 8 bits of alpha (errata E8). From texel-biased.frag.
// In:  borderMap, the map with normals as 0.5 n + 0.5; depthMap, the depth buffer; textureUnit, 1 / their size in pixels.
// Out: normal and depth this many pixels away.

uniform sampler2D borderMap;
uniform sampler2D depthMap;
uniform vec2 textureUnit;

vec4 texel(vec2 offset) {
    vec2 place = (gl_FragCoord.xy + offset) * textureUnit;
    return vec4(texture2D(borderMap, place).rgb * 2.0 - 1.0, texture2D(depthMap, place).r);
}
