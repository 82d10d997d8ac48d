#version 120
// Normal and depth into a floating-point target: nothing is clamped (errata E6) and depth keeps its digits (E8). From
// evangelista/map.frag.
// In:  normalView of map-float.vert.
// Out: gl_FragColor.rgb the normal, .a window z in [0, 1].

varying vec3 normalView;

void main() {
    gl_FragColor = vec4(normalView, gl_FragCoord.z);
}
