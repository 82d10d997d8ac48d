#version 120
// The light of one directional light: the report calls their number a parameter.
// In: a normal of any length; lightDir1 from the vertex program, both in eye space. Out: the light, 0 to 1.

varying vec3 lightDir1;

float lightOn(vec3 normal) {
    return max(dot(normalize(lightDir1), normalize(normal)), 0.0);
}
