#version 120
// Contrast operator of ours: C. Schlick's bias (Graphics Gems IV, 1994), which darkens middle tones more evenly than a power.
// In: light, 0 to 2, taken as 1 beyond 1; contrastExp, at 1 no change. Out: the CEO, 0 to 1.

uniform float contrastExp;

float contrastOperator(float light) {
    float tone = min(light, 1.0);
    return tone / (tone + contrastExp * (1.0 - tone));
}
