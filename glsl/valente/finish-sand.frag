#version 120
// The drawing mixed with the model's own texture in sepia, as in sand.frag. Linked with one of luminance-*.
// In: drawing; origTexture and gl_TexCoord[0]. Out: 0.4 drawing and 0.6 sepia.

uniform sampler2D origTexture;

float luminanceOf(vec4 color);

vec4 finish(float light, vec4 cem, vec4 cet, vec4 drawing) {
    float luminance = luminanceOf(texture2D(origTexture, vec2(gl_TexCoord[0])));
    vec4 sepia = vec4(luminance * 1.2, luminance, luminance * 0.8, 1.0);
    return mix(drawing, sepia, 0.6);
}
