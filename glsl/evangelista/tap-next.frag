#version 120
// A filter's taps as in border.frag: the pixels next to this one.
// In:  texel, of one texel-*.frag.
// Out: the map at this tap, x and y from -1 to 1.

vec4 texel(vec2 offset);

vec4 tap(float x, float y) {
    return texel(vec2(x, y));
}
