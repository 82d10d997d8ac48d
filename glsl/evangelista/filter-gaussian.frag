#version 120
// The centre against the Gaussian mean of the 3 x 3 pixels around it, weights 1 2 1 / 2 4 2 / 1 2 1 over 16. The paper names a
// Gaussian among the filters and prints none; a Gaussian alone smooths and detects nothing, so this reading is ours. Scaled
// by 16 / 3, so that the centre weighs 4 as in the paper's own filter.
// In:  detectionFactor; tap and depthResponse, of one tap-*.frag and one depth-*.frag.
// Out: the border at this pixel: the filter's response summed over normal and depth; 0 none, 1 and more black.

uniform float detectionFactor;

vec4 tap(float x, float y);
float depthResponse(float response);

float borderResponse() {
    vec4 beside = tap(0.0, -1.0) + tap(-1.0, 0.0) + tap(1.0, 0.0) + tap(0.0, 1.0);
    vec4 corners = tap(-1.0, -1.0) + tap(1.0, -1.0) + tap(-1.0, 1.0) + tap(1.0, 1.0);
    vec4 response = abs((4.0 * tap(0.0, 0.0) - (2.0 * beside + corners) / 3.0) * detectionFactor);
    return response.r + response.g + response.b + depthResponse(response.a);
}
