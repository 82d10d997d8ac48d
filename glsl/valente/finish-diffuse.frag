#version 120
// The light alone: figure 4, left.
// In: light, CEM, CET, drawing. Out: the light, opaque.

vec4 finish(float light, vec4 cem, vec4 cet, vec4 drawing) {
    return vec4(light, light, light, 1.0);
}
