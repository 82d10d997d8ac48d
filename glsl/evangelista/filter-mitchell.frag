#version 120
// Mitchell's five taps (figure 10, right): the centre against its four diagonal neighbours, differences summed.
// In:  borderMap, the framebuffer of the map pass; textureUnit, 1 / picture size in pixels; detectionFactor.
// Out: the border at this pixel: the filter's response summed over normal and depth; 0 none, 1 and more black.

uniform sampler2D borderMap;
uniform vec2 textureUnit;
uniform float detectionFactor;

vec4 tap(float x, float y) {
    return texture2D(borderMap, (gl_FragCoord.xy + vec2(x, y)) * textureUnit);
}

float borderResponse() {
    vec4 centre = tap(0.0, 0.0);
    vec4 response = (abs(centre - tap(-1.0, -1.0)) + abs(centre - tap(1.0, -1.0))
                   + abs(centre - tap(-1.0, 1.0)) + abs(centre - tap(1.0, 1.0))) * abs(detectionFactor);
    return response.r + response.g + response.b + response.a;
}
