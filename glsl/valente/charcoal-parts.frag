#version 120
// charcoal.frag in parts, so that each can be exchanged alone. Linked with one file of each kind: lights-*, side-*, strokes-*,
// operator-*, clamp-*, row-*, wrap-*, paper-*, spread-*, grain-*, noise-*, tooth-*, finish-*. With lights-two, side-outer,
// strokes-none, operator-power, clamp-discarded, row-original, wrap-repeat, paper-vertex, spread-stretched, grain-sample,
// noise-screen, tooth-none and finish-drawing it is the listing.
// In:  as charcoal.frag; what the parts read.
// Out: gl_FragColor, what the finish makes of it.

uniform sampler2D noiseTexture;
uniform sampler2D contrastTexture;
uniform sampler2D paperTexture;
uniform float saturationFactor;
uniform int smudge;

varying vec3 normal;

float lightOn(vec3 normal);
vec3 facing(vec3 normal);
float stroked(float light);
float contrastOperator(float light);
float clamped(float ceo);
float cetRow(float origCeo, float ceo);
float grainRow(float row);
float wrapped(float row);
vec2 paperPlace();
vec2 onPaper(vec2 place);
vec2 noisePlace();
vec4 caught(vec4 tone);
vec4 finish(float light, vec4 cem, vec4 cet, vec4 drawing);

void main() {
    float light = stroked(lightOn(facing(normal)));
    float origCeo = contrastOperator(light);
    float ceo = clamped(origCeo * saturationFactor);
    vec4 cem = vec4(ceo, ceo, ceo, 1.0);
    vec4 random = texture2D(noiseTexture, noisePlace());
    vec2 cetCoord = vec2((random.r + random.g + random.b) / 3.0, wrapped(grainRow(cetRow(origCeo, ceo))));
    vec4 cet = texture2D(contrastTexture, cetCoord);
    vec4 textured = cet * cem;
    if (smudge != 0) textured *= cem;
    vec4 paper = 1.0 - texture2D(paperTexture, onPaper(paperPlace()));
    gl_FragColor = finish(light, cem, cet, caught(textured) - paper);
}
