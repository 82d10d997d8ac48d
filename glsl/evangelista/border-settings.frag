#version 120
// border.frag with its filter in a part of its own, so that it can be chosen and scaled. Linked with one of filter-*.frag.
// In:  what the filter reads.
// Out: gl_FragColor, black with the border as alpha, to be blended over the tones.

float borderResponse();

void main() {
    gl_FragColor = vec4(vec3(0.0), borderResponse());
}
