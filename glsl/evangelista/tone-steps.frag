#version 120
// The tones of toon.frag with thresholds and levels as uniforms.
// In:  toneThresholds: x the diffuse value from which (>=), y the specular value above which (>) the next tone begins;
//      toneLevels: the tone below both, the diffuse tone, the specular tone.
// Out: the tone. A threshold above 1 is never reached: that is how fewer than three tones are made.

uniform vec2 toneThresholds;
uniform vec3 toneLevels;

float toneOf(float diffuse, float specular) {
    float light = toneLevels.x;
    if (specular > toneThresholds.y) light = toneLevels.z;
    else if (diffuse >= toneThresholds.x) light = toneLevels.y;
    return light;
}
