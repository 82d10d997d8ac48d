#version 120
// The tones of tone-steps.frag where no highlight reaches its threshold: specular light is not asked for, so that the driver
// leaves it out of both shaders.
// In:  toneThresholds: x the diffuse value from which (>=) the second tone begins; toneLevels: the tone below it, the
//      diffuse tone; the light.
// Out: the tone.

uniform vec2 toneThresholds;
uniform vec3 toneLevels;

float toneOf(float diffuse, float specular) {
    return diffuse >= toneThresholds.x ? toneLevels.y : toneLevels.x;
}
