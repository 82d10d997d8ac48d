#version 120
// Contrast operator of ours, as the text's last section suggests: an S about half light, steeper with the exponent.
// In: light, 0 to 2, taken as 1 beyond 1; contrastExp. Out: the CEO, 0 to 1; darkens shadows and lightens lights.

uniform float contrastExp;

float contrastOperator(float light) {
    float tone = min(light, 1.0);
    float dark = pow(tone, contrastExp);
    return dark / (dark + pow(1.0 - tone, contrastExp));
}
