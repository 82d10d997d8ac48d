#version 120
// The CET's row, as published: by the CEO before it is saturated.
// In: the CEO before and after. Out: the coordinate t.

float cetRow(float origCeo, float ceo) {
    return origCeo;
}
