#version 120
// The CET's row by the saturated CEO: figure 8.
// In: the CEO before and after. Out: the coordinate t.

float cetRow(float origCeo, float ceo) {
    return ceo;
}
