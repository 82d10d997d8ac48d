#version 120
// two-targets.frag with its tones in a part of their own, so that they can be set. Linked with one of tone-*.frag.
// In:  diffuse, reflectVec, viewVec, gl_Color and gl_SecondaryColor from two-targets.vert.
// Out: gl_FragData[0], the object's colour times its tone; gl_FragData[1], the map: normal and window z.

varying vec3 reflectVec;
varying vec3 viewVec;
varying float diffuse;

float toneOf(float diffuse, float specular);

void main() {
    float specular = max(dot(normalize(reflectVec), normalize(viewVec)), 0.0);
    gl_FragData[0] = vec4(gl_Color.xyz * toneOf(diffuse, specular), 1.0);
    gl_FragData[1] = vec4(gl_SecondaryColor.xyz, gl_FragCoord.z);
}
