#version 120
// Evangelista et al. 2005, appendix 1, step 2, vertex program: light at the vertices.
// In:  gl_Vertex, gl_Normal, gl_Color, the fixed-function matrices; eye-space unit: the scene's radius (errata E11).
// Out: diffuse in [0, 1], reflectVec and viewVec (eye space), the object's colour.
// Repaired: E1 (parentheses of the diffuse line), E3 (#version 120 for the f suffixes).

varying vec3 reflectVec;
varying vec3 viewVec;
varying float diffuse;
// Pode ser trocado para uniform
const vec3 lightPos = vec3(1.0f,1.0f,1.0f);
void main() {
    vec3 normal=normalize(gl_NormalMatrix*gl_Normal);
    vec3 vertexPos=vec3(gl_ModelViewMatrix*gl_Vertex);
    vec3 lightDir=normalize(lightPos-vertexPos);
    // Luz difusa
    diffuse=max((dot(lightDir,normal)+1.0f)*0.5f,0.0f);
    // Luz especular
    reflectVec=normalize(reflect(-lightDir,normal));
    viewVec=normalize(-vertexPos);
    gl_FrontColor=gl_Color;
    gl_Position=ftransform();
}
