#version 120
// The map of normals and object numbers that Mitchell's filter reads (Evangelista et al. 2005, section 2). From evangelista/map.frag.
// In:  gl_Color.xyz, the interpolated normal; gl_Color.a, the number.
// Out: gl_FragColor: both.

void main() {
    gl_FragColor = gl_Color;
}
