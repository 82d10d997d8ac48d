#version 120
// The normal as published: that of the outer side, whichever is seen.
// In: the normal. Out: the same.

vec3 facing(vec3 normal) {
    return normal;
}
