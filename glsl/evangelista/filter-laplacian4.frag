#version 120
// The paper's filter (figure 11), four neighbours, as in border.frag but with its factor as a uniform.
// In:  detectionFactor; tap and depthResponse, of one tap-*.frag and one depth-*.frag.
// Out: the border at this pixel: the filter's response summed over normal and depth; 0 none, 1 and more black.

uniform float detectionFactor;

vec4 tap(float x, float y);
float depthResponse(float response);

float borderResponse() {
    vec4 laplacian = -tap(0.0, -1.0) - tap(-1.0, 0.0) + 4.0 * tap(0.0, 0.0) - tap(1.0, 0.0) - tap(0.0, 1.0);
    vec4 response = abs(laplacian * detectionFactor);
    return response.r + response.g + response.b + depthResponse(response.a);
}
