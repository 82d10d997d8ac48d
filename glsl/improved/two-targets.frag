#version 120
// Tones and map at once, into two targets: the paper's future work (section 6). From toon.frag and map.frag.
// In:  diffuse, reflectVec, viewVec, gl_Color and gl_SecondaryColor from two-targets.vert.
// Out: gl_FragData[0], the object's colour times its tone: 0.65, 0.95 or 1; gl_FragData[1], the map: normal and window z.

varying vec3 reflectVec;
varying vec3 viewVec;
varying float diffuse;

void main() {
    float specular = max(dot(normalize(reflectVec), normalize(viewVec)), 0.0);
    float light = 0.65;
    if (specular > 0.65) light = 1.0;
    else if (diffuse >= 0.8) light = 0.95;
    gl_FragData[0] = vec4(gl_Color.xyz * light, 1.0);
    gl_FragData[1] = vec4(gl_SecondaryColor.xyz, gl_FragCoord.z);
}
