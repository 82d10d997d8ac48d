#version 120
// The vertex program of the plane map: nothing but the place. From evangelista/map.vert, without its normal as a colour:
// the plane map takes each pixel's plane from its depth.
// In:  gl_Vertex, the fixed-function matrices.
// Out: gl_Position.

void main() {
    gl_Position = ftransform();
}
