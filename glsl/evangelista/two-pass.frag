#version 120
// Evangelista et al. 2005, appendix 2, step 2, fragment program of the two-pass form: border, tone and their product.
// In:  diffuse, reflectVec, viewVec from two-pass.vert; gl_Color; borderMap, the framebuffer of step 1;
//      textureUnit, 1 / picture size in pixels.
// Out: gl_FragColor, colour times tone times (1 - border).
// Repaired: E3 (#version 120: f suffixes, 4*E), E4 (local copies of the varyings), E5 (1/512 becomes textureUnit).

// Utilizado para cálculo da coordenada da textura
uniform vec2 textureUnit;
#define texPosX(trans) ((gl_FragCoord.x+trans)*textureUnit.x)
#define texPosY(trans) ((gl_FragCoord.y+trans)*textureUnit.y)
#define DETECTION_FACTOR 0.2f // Fator de detecção de bordas
varying float diffuse;
varying vec3 reflectVec;
varying vec3 viewVec;
// Textura contendo os mapas de normal e profundidade
uniform sampler2D borderMap;
void main() {
    // Luz especular
    vec3 reflectDir=normalize(reflectVec);
    vec3 viewDir=normalize(viewVec);
    float specular=max(dot(reflectDir,viewDir),0.0f);
    // Filtro
    vec4 B=texture2D(borderMap,vec2(texPosX(0),texPosY(-1)));
    vec4 D=texture2D(borderMap,vec2(texPosX(-1),texPosY(0)));
    vec4 E=texture2D(borderMap,vec2(texPosX(0),texPosY(0)));
    vec4 F=texture2D(borderMap,vec2(texPosX(1),texPosY(0)));
    vec4 H=texture2D(borderMap,vec2(texPosX(0),texPosY(1)));
    vec4 filter=abs((-B-D+4*E-F-H)*DETECTION_FACTOR);
    float border=1.0f-(filter.r+filter.g+filter.b+filter.a);
    // Faixas de tons
    float light=0.65f;
    if (specular>0.65f) light=1.0f;
    else if (diffuse>=0.8f) light=0.95f;
    gl_FragColor=vec4(gl_Color.xyz*light*border,1.0f);
}
