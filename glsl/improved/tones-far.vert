#version 120
// The light of tones whose light and eye are far away: a flat face has one tone.
// In:  gl_Vertex, gl_Normal of any length, gl_Color, the fixed-function matrices; lightDirection, a unit vector towards the light,
//      eye space.
// Out: light, the cosine between the two times the normal's length: linear in each triangle; the object's colour.

uniform vec3 lightDirection;

varying float light;

void main() {
    light = dot(lightDirection, gl_NormalMatrix * gl_Normal);
    gl_FrontColor = gl_Color;
    gl_Position = ftransform();
}
