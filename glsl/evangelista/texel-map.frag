#version 120
// The map as border.frag reads it.
// In:  borderMap, the map; textureUnit, 1 / its size in pixels.
// Out: normal and depth this many pixels away.

uniform sampler2D borderMap;
uniform vec2 textureUnit;

vec4 texel(vec2 offset) {
    return texture2D(borderMap, (gl_FragCoord.xy + offset) * textureUnit);
}
