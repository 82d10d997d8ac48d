#version 120
// Contrast operator, as published: the light to the power of the exponent.
// In: light, 0 to 2; contrastExp. Out: the CEO, 0 to 2^contrastExp.

uniform float contrastExp;

float contrastOperator(float light) {
    return pow(light, contrastExp);
}
