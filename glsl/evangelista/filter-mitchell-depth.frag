#version 120
// The second of Mitchell's two programs (section 4.1): his five taps (figure 10, right) once more, on the depth alone.
// In:  detectionFactor; tap and depthResponse, of one tap-*.frag and one depth-*.frag.
// Out: the border at this pixel: the differences of depth; 0 none, 1 and more black.

uniform float detectionFactor;

vec4 tap(float x, float y);
float depthResponse(float response);

float borderResponse() {
    float centre = tap(0.0, 0.0).a;
    float response = (abs(centre - tap(-1.0, -1.0).a) + abs(centre - tap(1.0, -1.0).a)
                    + abs(centre - tap(-1.0, 1.0).a) + abs(centre - tap(1.0, 1.0).a)) * abs(detectionFactor);
    return depthResponse(response);
}
