#version 120
// Sobel's gradient, eight taps, its length per channel.
// In:  borderMap, the framebuffer of the map pass; textureUnit, 1 / picture size in pixels; detectionFactor.
// Out: the border at this pixel: the filter's response summed over normal and depth; 0 none, 1 and more black.

uniform sampler2D borderMap;
uniform vec2 textureUnit;
uniform float detectionFactor;

vec4 tap(float x, float y) {
    return texture2D(borderMap, (gl_FragCoord.xy + vec2(x, y)) * textureUnit);
}

float borderResponse() {
    vec4 a = tap(-1.0, -1.0);
    vec4 c = tap(1.0, -1.0);
    vec4 g = tap(-1.0, 1.0);
    vec4 i = tap(1.0, 1.0);
    vec4 across = c + 2.0 * tap(1.0, 0.0) + i - a - 2.0 * tap(-1.0, 0.0) - g;
    vec4 along = g + 2.0 * tap(0.0, 1.0) + i - a - 2.0 * tap(0.0, -1.0) - c;
    vec4 response = sqrt(across * across + along * along) * abs(detectionFactor);
    return response.r + response.g + response.b + response.a;
}
