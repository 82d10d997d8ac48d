#version 120
// Normals stored as 0.5 n + 0.5, by map-biased.vert, back as they were. From texel-map.frag.
// In:  borderMap, the map; textureUnit, 1 / its size in pixels.
// Out: normal and depth this many pixels away.

uniform sampler2D borderMap;
uniform vec2 textureUnit;

vec4 texel(vec2 offset) {
    vec4 stored = texture2D(borderMap, (gl_FragCoord.xy + offset) * textureUnit);
    return vec4(stored.rgb * 2.0 - 1.0, stored.a);
}
