#version 120
// Grain where the sample itself has it, as published.
// In: a place in a texture, or a row of the contrast-enhanced texture. Out: the same.

vec2 grainPlace(vec2 place) {
    return place;
}

float grainRow(float row) {
    return row;
}
