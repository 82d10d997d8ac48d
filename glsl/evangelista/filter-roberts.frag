#version 120
// Roberts' cross, four taps: the two diagonal differences of a 2 x 2 block, their length per channel.
// In:  detectionFactor; tap and depthResponse, of one tap-*.frag and one depth-*.frag.
// Out: the border at this pixel: the filter's response summed over normal and depth; 0 none, 1 and more black.

uniform float detectionFactor;

vec4 tap(float x, float y);
float depthResponse(float response);

float borderResponse() {
    vec4 falling = tap(0.0, 0.0) - tap(1.0, 1.0);
    vec4 rising = tap(1.0, 0.0) - tap(0.0, 1.0);
    vec4 response = sqrt(falling * falling + rising * rising) * abs(detectionFactor);
    return response.r + response.g + response.b + depthResponse(response.a);
}
