#version 120
// Evangelista et al. 2005, appendix 1, step 2, fragment program: uniform shading in three tones.
// In:  diffuse, reflectVec, viewVec from toon.vert; gl_Color.
// Out: gl_FragColor, the object's colour times its tone: 0.65, 0.95 or 1.
// Repaired: E3 (#version 120 for the f suffixes), E4 (varyings are read-only here: local copies).

varying vec3 reflectVec;
varying vec3 viewVec;
varying float diffuse;
void main() {
    // Luz especular
    vec3 reflectDir=normalize(reflectVec);
    vec3 viewDir=normalize(viewVec);
    float specular=max(dot(reflectDir,viewDir),0.0f);
    // Faixas de tons
    float lightIntensity=0.65f;
    if (specular>0.65f) lightIntensity=1.0f;
    else if (diffuse>=0.8f) lightIntensity=0.95f;
    gl_FragColor=vec4(gl_Color.xyz*lightIntensity,1.0f);
}
