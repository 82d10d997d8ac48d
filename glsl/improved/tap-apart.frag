#version 120
// Line width: taps stand apart, so that a step answers in as many pixels as they reach over. From tap-next.frag.
// In:  reach: how far they reach, in pixels, to the left or below and to the right or above; texel, of one texel-*.frag.
// Out: the map at this tap, x and y from -1 to 1.

uniform vec2 reach;

vec4 texel(vec2 offset);

vec4 tap(float x, float y) {
    vec2 direction = vec2(x, y);
    return texel(max(direction, 0.0) * reach.y + min(direction, 0.0) * reach.x);
}
