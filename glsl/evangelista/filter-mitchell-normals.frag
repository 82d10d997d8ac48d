#version 120
// The first of Mitchell's two programs (section 4.1): his five taps (figure 10, right) on the normals alone.
// In:  detectionFactor; tap, of one tap-*.frag.
// Out: the border at this pixel: the differences summed over the normal; 0 none, 1 and more black.

uniform float detectionFactor;

vec4 tap(float x, float y);

float borderResponse() {
    vec3 centre = tap(0.0, 0.0).rgb;
    vec3 response = (abs(centre - tap(-1.0, -1.0).rgb) + abs(centre - tap(1.0, -1.0).rgb)
                   + abs(centre - tap(-1.0, 1.0).rgb) + abs(centre - tap(1.0, 1.0).rgb)) * abs(detectionFactor);
    return response.r + response.g + response.b;
}
