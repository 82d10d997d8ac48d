#version 120
// The normal as a colour, 0.5 n + 0.5, so that no component is clamped away (errata E6). From evangelista/map.vert.
// In:  gl_Vertex, gl_Normal, the fixed-function matrices.
// Out: gl_FrontColor.xyz, the normal in eye space, from [-1, 1] to [0, 1].

void main() {
    gl_FrontColor.xyz = gl_NormalMatrix * gl_Normal * 0.5 + 0.5;
    gl_Position = ftransform();
}
