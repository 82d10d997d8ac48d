#version 120
// The finished drawing.
// In: light, CEM, CET, drawing. Out: the drawing.

vec4 finish(float light, vec4 cem, vec4 cet, vec4 drawing) {
    return drawing;
}
