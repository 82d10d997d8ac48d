#version 120
// Evangelista et al. 2005, appendix 1, step 3, vertex program: the full-screen square.
// In:  gl_Vertex, already in clip space.
// Out: gl_Position.

void main() {
    // Projeção paralela utilizada
    gl_Position=gl_Vertex;
}
