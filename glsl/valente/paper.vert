#version 120
// The paper's square: Valente 2007 describes it in sections 2.2 and 3.2 and prints nothing; ours.
// In:  gl_Vertex, corners from -1 to 1 of a square over the whole picture.
// Out: paperCoord, 0 to 1 over the picture.

varying vec2 paperCoord;

void main() {
    gl_Position = ftransform();
    paperCoord = gl_Vertex.xy * 0.5 + 0.5;
}
