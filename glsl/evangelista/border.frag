#version 120
// Evangelista et al. 2005, appendix 1, step 3, fragment program: the five-tap border filter (figure 11).
// In:  borderMap, the framebuffer of step 1; textureUnit, 1 / picture size in pixels.
// Out: gl_FragColor, black with the border as alpha, to be blended over step 2; alpha above 1 is clamped by GL (errata E9).
// Repaired: E2 (uniform borderMap), E3 (#version 120: f suffixes, 4*E), E5 (1/512 becomes textureUnit).

uniform sampler2D borderMap;
// Utilizado para cálculo da coordenada da textura
uniform vec2 textureUnit;
#define texPosX(trans) ((gl_FragCoord.x+trans)*textureUnit.x)
#define texPosY(trans) ((gl_FragCoord.y+trans)*textureUnit.y)
#define DETECTION_FACTOR 0.2f // Fator de detecção de bordas
void main() {
    // Filtro
    vec4 B=texture2D(borderMap,vec2(texPosX(0),texPosY(-1)));
    vec4 D=texture2D(borderMap,vec2(texPosX(-1),texPosY(0)));
    vec4 E=texture2D(borderMap,vec2(texPosX(0),texPosY(0)));
    vec4 F=texture2D(borderMap,vec2(texPosX(1),texPosY(0)));
    vec4 H=texture2D(borderMap,vec2(texPosX(0),texPosY(1)));
    vec4 filter=abs((-B-D+4*E-F-H)*DETECTION_FACTOR);
    float border=filter.r+filter.g+filter.b+filter.a;
    gl_FragColor=vec4(vec3(0.0f),border);
}
