#version 120
// The vertex program of the plane map: the place, and how far away it is. From evangelista/map.vert, without its normal as a
// colour: the plane map takes each pixel's plane from its depth.
// In:  gl_Vertex, the fixed-function matrices.
// Out: gl_Position; eyeDistance: along the view, scene radii.

varying float eyeDistance;

void main() {
    eyeDistance = -(gl_ModelViewMatrix * gl_Vertex).z;
    gl_Position = ftransform();
}
