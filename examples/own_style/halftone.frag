#version 120
// Dots on a grid turned by 45 degrees, the larger the less light there is.
// In: light, 0 to 1; distance of the dots, pixels. Out: the dot's colour, or white between dots.

uniform float distance;
varying float light;

void main() {
    vec2 turned = vec2(gl_FragCoord.x + gl_FragCoord.y, gl_FragCoord.x - gl_FragCoord.y) * 0.70710678;
    vec2 from_middle = mod(turned, distance) / distance - 0.5;
    float radius = 0.75 * sqrt(1.0 - clamp(light, 0.0, 1.0));
    vec3 paper = vec3(1.0);
    gl_FragColor = vec4(length(from_middle) < radius ? gl_Color.rgb * 0.6 : paper, 1.0);
}
