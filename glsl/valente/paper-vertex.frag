#version 120
// Paper and noise by the coordinate of the vertex program, as published: it swims on large triangles (V4).
// In: paperCoord from charcoal.vert. Out: the same.

varying vec2 paperCoord;

vec2 paperPlace() {
    return paperCoord;
}
