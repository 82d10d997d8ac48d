#version 120
// Sobel's gradient, eight taps, its length per channel.
// In:  detectionFactor; tap and depthResponse, of one tap-*.frag and one depth-*.frag.
// Out: the border at this pixel: the filter's response summed over normal and depth; 0 none, 1 and more black.

uniform float detectionFactor;

vec4 tap(float x, float y);
float depthResponse(float response);

float borderResponse() {
    vec4 a = tap(-1.0, -1.0);
    vec4 c = tap(1.0, -1.0);
    vec4 g = tap(-1.0, 1.0);
    vec4 i = tap(1.0, 1.0);
    vec4 across = c + 2.0 * tap(1.0, 0.0) + i - a - 2.0 * tap(-1.0, 0.0) - g;
    vec4 along = g + 2.0 * tap(0.0, 1.0) + i - a - 2.0 * tap(0.0, -1.0) - c;
    vec4 response = sqrt(across * across + along * along) * abs(detectionFactor);
    return response.r + response.g + response.b + depthResponse(response.a);
}
