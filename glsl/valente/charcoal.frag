#version 120
// Valente 2007, section 3.3, fragment program: two lights, contrast, grain from the CET, smudge, paper.
// In:  normal, lightDir1, lightDir2 (eye space), paperCoord from charcoal.vert; noiseTexture (RGB), contrastTexture (the CET),
//      paperTexture; contrastExp, saturationFactor (1: none), smudge (0: no).
// Out: gl_FragColor, the drawing with the paper's darkness subtracted; opaque.
// Repaired: V1 (lightDir is read twice; lightDir1 and lightDir2 are what the vertex program writes). Kept as published:
// V2 (clamp's result is discarded), V3 (the sum of both lights reaches 2 and wraps as texture coordinate), V4.

// texturas usadas no programa
uniform sampler2D noiseTexture;
uniform sampler2D contrastTexture;
uniform sampler2D paperTexture;
// expoente de contraste
uniform float contrastExp;
// saturação
uniform float saturationFactor;
// usar borrão ou não
uniform int smudge;
// interpolados do vertex program
varying vec3 normal;
varying vec3 lightDir1;
varying vec3 lightDir2;
varying vec2 paperCoord;
// função para calcular a contribuição
// difusa
float calcDiffuse (vec3 normal, vec3 lightDir)
{
    // normalizar vetores
    vec3 L = normalize (lightDir);
    vec3 N = normalize (normal);
    // calcular componente difusa [0,1]
    return max (dot (L, N), 0.0);
}
void main()
{
    // calcular contribuição difusa
    float diffuse1 = calcDiffuse (normal, lightDir1);
    float diffuse2 = calcDiffuse (normal, lightDir2);
    // aplicar operador de contraste
    float ceo = pow (diffuse1 + diffuse2, contrastExp);
    float origCeo = ceo;
    ceo *= saturationFactor;
    clamp (ceo, 0.0, 1.0);
    // cor do constrast enhanced model (CEM)
    vec4 cem = vec4 (ceo, ceo, ceo, 1.0);
    // pode-se usar a própria coordenada do
    // papel como índice para a textura de
    // noise
    vec4 random = texture2D (noiseTexture, paperCoord);
    // acessando a textura de contraste,
    // computando-se a coordenada de textura
    vec2 cetCoord;
    cetCoord.s = (random.r+random.g+random.b)/3.0;
    cetCoord.t = origCeo;
    vec4 cetColor = texture2D (contrastTexture, cetCoord);
    // combinando a cor da textura (como no
    // GL_MODULATE)
    vec4 texturedModelColor = cetColor * cem;
    if (smudge != 0) texturedModelColor *= cem;
    vec4 paperColor = 1.0 - texture2D (paperTexture, paperCoord);
    // cor final
    gl_FragColor = texturedModelColor - paperColor;
}
