#version 120
// The fixed-function pipeline's fragments, no texture unit switched on. Ours, as transform.vert.
// In:  gl_Color.
// Out: gl_FragColor, the same.

void main() {
    gl_FragColor = gl_Color;
}
