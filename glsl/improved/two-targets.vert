#version 120
// What toon.vert and map.vert compute, for one pass that draws tones and map at once. From toon.vert.
// In:  gl_Vertex, gl_Normal, gl_Color, the fixed-function matrices; eye-space unit: the scene's radius (errata E11).
// Out: diffuse in [0, 1], reflectVec and viewVec (eye space), the object's colour; gl_FrontSecondaryColor, the normal in eye
//      space as map.vert's colour: clamped to [0, 1] on its way (errata E6) and not normalised (E7).

varying vec3 reflectVec;
varying vec3 viewVec;
varying float diffuse;
const vec3 lightPos = vec3(1.0, 1.0, 1.0);

void main() {
    vec3 normalColor = gl_NormalMatrix * gl_Normal;
    vec3 normal = normalize(normalColor);
    vec3 vertexPos = vec3(gl_ModelViewMatrix * gl_Vertex);
    vec3 lightDir = normalize(lightPos - vertexPos);
    diffuse = max((dot(lightDir, normal) + 1.0) * 0.5, 0.0);
    reflectVec = normalize(reflect(-lightDir, normal));
    viewVec = normalize(-vertexPos);
    gl_FrontColor = gl_Color;
    gl_FrontSecondaryColor = vec4(normalColor, 1.0);
    gl_Position = ftransform();
}
