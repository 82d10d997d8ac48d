#version 120
// toon.frag with its tones in a part of their own, so that they can be set. Linked with one of tone-*.frag.
// In:  diffuse, reflectVec, viewVec from toon.vert; gl_Color.
// Out: gl_FragColor, the object's colour times its tone.

varying vec3 reflectVec;
varying vec3 viewVec;
varying float diffuse;

float toneOf(float diffuse, float specular);

void main() {
    float specular = max(dot(normalize(reflectVec), normalize(viewVec)), 0.0);
    gl_FragColor = vec4(gl_Color.xyz * toneOf(diffuse, specular), 1.0);
}
