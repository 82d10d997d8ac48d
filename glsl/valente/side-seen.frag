#version 120
// The normal of the side that is seen, so that the inside of an open model is lit, and two faces that lie on each other are lit
// alike. Ours.
// In: the normal of the outer side; gl_FrontFacing. Out: the normal, turned round on a face seen from behind.

vec3 facing(vec3 normal) {
    return gl_FrontFacing ? normal : -normal;
}
