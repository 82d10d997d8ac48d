#version 120
// two-pass.frag with tones and filter in parts of their own. Linked with one of tone-*.frag and one of filter-*.frag.
// In:  diffuse, reflectVec, viewVec from two-pass.vert; gl_Color; what the filter reads.
// Out: gl_FragColor, colour times tone times (1 - border).

varying float diffuse;
varying vec3 reflectVec;
varying vec3 viewVec;

float toneOf(float diffuse, float specular);
float borderResponse();

void main() {
    float specular = max(dot(normalize(reflectVec), normalize(viewVec)), 0.0);
    float light = toneOf(diffuse, specular);
    gl_FragColor = vec4(gl_Color.xyz * light * (1.0 - borderResponse()), 1.0);
}
