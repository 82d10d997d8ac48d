#version 120
// The tones of toon.frag looked up in a one-dimensional texture, as section 3.2 of the paper mentions.
// In:  toneTable: luminance the tone of a diffuse value, alpha the tone of a specular value (0: no highlight here);
//      toneTableScale: x and y take a value in [0, 1] to the table's first and last texel centres;
//      toneGain: 1, or 0 to make every tone 1 (the background square).
// Out: the tone; thresholds are exact to one texel.

uniform sampler1D toneTable;
uniform vec2 toneTableScale;
uniform float toneGain;

float toneOf(float diffuse, float specular) {
    float byDiffuse = texture1D(toneTable, diffuse * toneTableScale.x + toneTableScale.y).r;
    float bySpecular = texture1D(toneTable, specular * toneTableScale.x + toneTableScale.y).a;
    float light = bySpecular > 0.0 ? bySpecular : byDiffuse;
    return mix(1.0, light, toneGain);
}
