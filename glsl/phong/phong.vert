#version 120
// Phong shading per pixel, the realistic rendering that Evangelista et al. 2005 compare with (figures 5a and 8). Ours: the paper prints none.
// In:  gl_Vertex, gl_Normal, gl_Color, the fixed-function matrices.
// Out: normalEye and positionEye (eye space; unit: the scene's radius), the object's colour.

varying vec3 normalEye;
varying vec3 positionEye;

void main() {
    normalEye = gl_NormalMatrix * gl_Normal;
    positionEye = vec3(gl_ModelViewMatrix * gl_Vertex);
    gl_FrontColor = gl_Color;
    gl_Position = ftransform();
}
