#version 120
// The drawing as published: the paper's tooth does not touch it.
// In: the drawing before the paper. Out: the same.

vec4 caught(vec4 tone) {
    return tone;
}
