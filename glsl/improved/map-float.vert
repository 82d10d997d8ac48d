#version 120
// The normal as it is: a varying, for colours are clamped on their way (errata E6). From evangelista/map.vert.
// In:  gl_Vertex, gl_Normal, the fixed-function matrices.
// Out: normalView, the normal in eye space.

varying vec3 normalView;

void main() {
    normalView = gl_NormalMatrix * gl_Normal;
    gl_Position = ftransform();
}
