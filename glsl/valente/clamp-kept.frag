#version 120
// The saturated CEO as meant: clamped (V2 repaired).
// In: the CEO times the saturation. Out: 0 to 1.

float clamped(float ceo) {
    return clamp(ceo, 0.0, 1.0);
}
