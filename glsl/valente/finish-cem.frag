#version 120
// The contrast-enhanced model: figure 4, right.
// In: light, CEM, CET, drawing. Out: the CEM, opaque.

vec4 finish(float light, vec4 cem, vec4 cet, vec4 drawing) {
    return cem;
}
