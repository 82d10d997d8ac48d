#version 120
// Mitchell's five taps (figure 10, right): the centre against its four diagonal neighbours, differences summed.
// In:  detectionFactor; tap and depthResponse, of one tap-*.frag and one depth-*.frag.
// Out: the border at this pixel: the filter's response summed over normal and depth; 0 none, 1 and more black.

uniform float detectionFactor;

vec4 tap(float x, float y);
float depthResponse(float response);

float borderResponse() {
    vec4 centre = tap(0.0, 0.0);
    vec4 response = (abs(centre - tap(-1.0, -1.0)) + abs(centre - tap(1.0, -1.0))
                   + abs(centre - tap(-1.0, 1.0)) + abs(centre - tap(1.0, 1.0))) * abs(detectionFactor);
    return response.r + response.g + response.b + depthResponse(response.a);
}
