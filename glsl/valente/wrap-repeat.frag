#version 120
// The CET's row as published: as it comes, so that GL_REPEAT takes what is beyond 1 round again (V3).
// In: the coordinate t. Out: the same.

float wrapped(float row) {
    return row;
}
