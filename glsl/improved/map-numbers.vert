#version 120
// The normal as a colour, 0.5 n + 0.5, and in alpha the object's number. From improved/map-biased.vert.
// In:  gl_Vertex, gl_Normal, gl_Color.a: the number, one for each part and material; the fixed-function matrices.
// Out: gl_FrontColor.xyz, the normal in eye space, from [-1, 1] to [0, 1]; gl_FrontColor.a, the number.

void main() {
    gl_FrontColor = vec4(gl_NormalMatrix * gl_Normal * 0.5 + 0.5, gl_Color.a);
    gl_Position = ftransform();
}
