#version 120
// The tone of tone-steps.frag where no light reaches a threshold: no light is asked for, so that the driver leaves it out of
// both shaders.
// In:  toneLevels: the tone below both thresholds; the light.
// Out: the tone.

uniform vec3 toneLevels;

float toneOf(float diffuse, float specular) {
    return toneLevels.x;
}
