#version 120
// The saturated CEO as published: unclamped, for the listing discards clamp's result (V2).
// In: the CEO times the saturation. Out: the same.

float clamped(float ceo) {
    return ceo;
}
