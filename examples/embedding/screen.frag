#version 120
// Lines across the picture, wider the less light there is.
// In: normalEye, positionEye of phong/phong.vert; distance of the lines, pixels. Out: the object's colour, or a dark line.

uniform float distance;
varying vec3 normalEye;
varying vec3 positionEye;

void main() {
    float light = max(dot(normalize(vec3(1.0) - positionEye), normalize(normalEye)), 0.0);
    float from_middle = abs(2.0 * fract(gl_FragCoord.y / distance) - 1.0);
    gl_FragColor = vec4(gl_Color.rgb * (from_middle < light ? 1.0 : 0.3), 1.0);
}
