#version 120
// evangelista/toon.vert with a light and an eye that are far away: a flat face has one tone.
// In:  gl_Vertex, gl_Normal, gl_Color, the fixed-function matrices; lightDirection, a unit vector towards the light, eye space.
// Out: as toon.vert: diffuse in [0, 1], reflectVec and viewVec (eye space), the object's colour.

uniform vec3 lightDirection;

varying vec3 reflectVec;
varying vec3 viewVec;
varying float diffuse;

void main() {
    vec3 normal = normalize(gl_NormalMatrix * gl_Normal);
    diffuse = (dot(lightDirection, normal) + 1.0) * 0.5;
    reflectVec = reflect(-lightDirection, normal);
    viewVec = vec3(0.0, 0.0, 1.0);
    gl_FrontColor = gl_Color;
    gl_Position = ftransform();
}
