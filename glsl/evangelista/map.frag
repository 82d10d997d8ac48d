#version 120
// Evangelista et al. 2005, appendix 1, step 1, fragment program: normal and depth in one RGBA value.
// In:  gl_Color.xyz, the interpolated normal, clamped to [0, 1] on its way here.
// Out: gl_FragColor.rgb the normal map, .a the depth map (window z in [0, 1]).

void main() {
    // Cor relativa aos mapas de normal e profundidade
    gl_FragColor=vec4(gl_Color.xyz,gl_FragCoord.z);
}
