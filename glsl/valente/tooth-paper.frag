#version 120
// Charcoal rubs off on what stands out of the paper and passes over its hollows. Ours.
// In:  the drawing before the paper; toothTexture, the paper's height, one half in the middle; the parts paper-* and spread-*.
// Out: the drawing, darker on heights and lighter in hollows, the more the more charcoal there is; nothing where there is none.

const float DEPTH = 1.0;

uniform sampler2D toothTexture;

vec2 paperPlace();
vec2 onPaper(vec2 place);

vec4 caught(vec4 tone) {
    float height = 2.0 * texture2D(toothTexture, onPaper(paperPlace())).r - 1.0;
    vec3 dark = 1.0 - clamp(tone.rgb, 0.0, 1.0);
    return vec4(tone.rgb - DEPTH * height * dark * (1.0 - 0.5 * dark), tone.a);
}
