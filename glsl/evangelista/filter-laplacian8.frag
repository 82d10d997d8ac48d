#version 120
// The Laplacian with eight neighbours that the paper compares with (figure 10, left; Nienhaus and Doellner 2003).
// In:  detectionFactor; tap and depthResponse, of one tap-*.frag and one depth-*.frag.
// Out: the border at this pixel: the filter's response summed over normal and depth; 0 none, 1 and more black.

uniform float detectionFactor;

vec4 tap(float x, float y);
float depthResponse(float response);

float borderResponse() {
    vec4 neighbours = tap(-1.0, -1.0) + tap(0.0, -1.0) + tap(1.0, -1.0) + tap(-1.0, 0.0) + tap(1.0, 0.0)
                    + tap(-1.0, 1.0) + tap(0.0, 1.0) + tap(1.0, 1.0);
    vec4 response = abs((8.0 * tap(0.0, 0.0) - neighbours) * detectionFactor);
    return response.r + response.g + response.b + depthResponse(response.a);
}
