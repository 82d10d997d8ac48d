#version 120
// Light as Evangelista et al. 2005 compute it, for the halftone of examples/own_style.rs.
// In: vertices in scene space, whose radius is 1. Out: light, 0 to 1, and the vertex's colour.

varying float light;

void main() {
    vec3 normal = normalize(gl_NormalMatrix * gl_Normal);
    vec3 position = vec3(gl_ModelViewMatrix * gl_Vertex);
    light = (dot(normalize(vec3(1.0) - position), normal) + 1.0) * 0.5;
    gl_FrontColor = gl_Color;
    gl_Position = ftransform();
}
