#version 120
// charcoal.frag in parts, so that each can be exchanged alone. Linked with one file of each kind: operator-*, clamp-*, row-*,
// wrap-*, paper-*, noise-*, finish-*. With operator-power, clamp-discarded, row-original, wrap-repeat, paper-vertex,
// noise-screen and finish-drawing it is the listing.
// In:  as charcoal.frag; what the parts read.
// Out: gl_FragColor, what the finish makes of it.

uniform sampler2D noiseTexture;
uniform sampler2D contrastTexture;
uniform sampler2D paperTexture;
uniform float saturationFactor;
uniform int smudge;

varying vec3 normal;
varying vec3 lightDir1;
varying vec3 lightDir2;

float contrastOperator(float light);
float clamped(float ceo);
float cetRow(float origCeo, float ceo);
float wrapped(float row);
vec2 paperPlace();
vec2 noisePlace();
vec4 finish(float light, vec4 cem, vec4 cet, vec4 drawing);

float calcDiffuse(vec3 normal, vec3 lightDir) {
    return max(dot(normalize(lightDir), normalize(normal)), 0.0);
}

void main() {
    float light = calcDiffuse(normal, lightDir1) + calcDiffuse(normal, lightDir2);
    float origCeo = contrastOperator(light);
    float ceo = clamped(origCeo * saturationFactor);
    vec4 cem = vec4(ceo, ceo, ceo, 1.0);
    vec4 random = texture2D(noiseTexture, noisePlace());
    vec2 cetCoord = vec2((random.r + random.g + random.b) / 3.0, wrapped(cetRow(origCeo, ceo)));
    vec4 cet = texture2D(contrastTexture, cetCoord);
    vec4 textured = cet * cem;
    if (smudge != 0) textured *= cem;
    vec4 paper = 1.0 - texture2D(paperTexture, paperPlace());
    gl_FragColor = finish(light, cem, cet, textured - paper);
}
