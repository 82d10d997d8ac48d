#version 120
// Luminance by the weights of ITU-R Rec. 709, of which the printed ones look like a misprint (V5 repaired).
// In: a colour. Out: its luminance, 0 to 1.

float luminanceOf(vec4 color) {
    return dot(vec3(0.2125, 0.7154, 0.0721), color.rgb);
}
