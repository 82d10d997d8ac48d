#version 120
// The light as published, without strokes.
// In: the light. Out: the same.

float stroked(float light) {
    return light;
}
