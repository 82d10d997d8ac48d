#version 120
// The light of two directional lights, as published.
// In: a normal of any length; lightDir1, lightDir2 from the vertex program, all in eye space. Out: the light, 0 to 2.

varying vec3 lightDir1;
varying vec3 lightDir2;

float calcDiffuse(vec3 normal, vec3 lightDir) {
    return max(dot(normalize(lightDir), normalize(normal)), 0.0);
}

float lightOn(vec3 normal) {
    return calcDiffuse(normal, lightDir1) + calcDiffuse(normal, lightDir2);
}
