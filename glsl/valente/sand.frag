#version 120
// Valente 2007, section 4, fragment program of "sand rendering": the drawing mixed with the model's own texture in sepia.
// In:  as charcoal.frag; origTexture, the model's own, and gl_TexCoord[0] from sand.vert.
// Out: gl_FragColor, 0.4 drawing and 0.6 sepia; opaque.
// Repaired: V1, V6 (origTexture is not declared). Kept as published: V2, V3, V4, V5 (the weights of the luminance).

uniform sampler2D origTexture;
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
    // Determinar cor do modelo com o papel
    // (original)
    vec4 color = texturedModelColor - paperColor;
    // cor da textura original
    vec4 orig = texture2D (origTexture, vec2(gl_TexCoord[0]));
    float luminance = dot (vec4(0.1125, 0.0154, 0.0721,1.0), orig);
    orig = vec4 (luminance*1.2, luminance, luminance*0.8, 1.0);
    // misturando a textura original
    gl_FragColor = mix (color, orig, 0.6);
}
