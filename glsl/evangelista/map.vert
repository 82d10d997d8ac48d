#version 120
// Evangelista et al. 2005, appendix 1, step 1, vertex program: the normal as a colour.
// In:  gl_Vertex, gl_Normal, the fixed-function matrices.
// Out: gl_FrontColor.xyz, the normal in eye space, unbiased (errata E6) and not normalised (E7).

void main() {
    // Define a cor do vértice como a cor de sua normal
    gl_FrontColor.xyz=gl_NormalMatrix*gl_Normal;
    gl_Position=ftransform();
}
