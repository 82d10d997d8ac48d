#version 120
// The fixed-function pipeline's vertices without lighting, where a driver has no such pipeline. Ours.
// In:  gl_Vertex, gl_Color, gl_MultiTexCoord0 and 1, the fixed-function matrices.
// Out: gl_Position, the colour, both texture coordinates.

void main() {
    gl_TexCoord[0] = gl_MultiTexCoord0;
    gl_TexCoord[1] = gl_MultiTexCoord1;
    gl_FrontColor = gl_Color;
    gl_Position = ftransform();
}
