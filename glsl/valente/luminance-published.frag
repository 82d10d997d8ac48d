#version 120
// Luminance as printed: the alpha counts whole, red and green hardly (V5).
// In: a colour. Out: its luminance, 1 to 1.2 where it is opaque.

float luminanceOf(vec4 color) {
    return dot(vec4(0.1125, 0.0154, 0.0721, 1.0), color);
}
