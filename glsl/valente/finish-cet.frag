#version 120
// The contrast-enhanced texture where the model reads it.
// In: light, CEM, CET, drawing. Out: the CET's colour, opaque.

vec4 finish(float light, vec4 cem, vec4 cet, vec4 drawing) {
    return cet;
}
