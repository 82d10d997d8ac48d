#version 120
// The vertex program of the normal map: place and normal. From evangelista/map.vert, whose normal is a colour and so clamped.
// In:  gl_Vertex, gl_Normal, the fixed-function matrices.
// Out: gl_Position; normalView: in eye space, of any length.

varying vec3 normalView;

void main() {
    normalView = gl_NormalMatrix * gl_Normal;
    gl_Position = ftransform();
}
