#version 120
// Supersampling's last step: each pixel is the mean of its samples, weighted by their alpha.
// In:  samples, the large picture; textureUnit, 1 / its size in pixels; count, samples a pixel along an axis, 1 to 4.
// Out: gl_FragColor. No published shader has this step.

uniform sampler2D samples;
uniform vec2 textureUnit;
uniform int count;

void main() {
    vec2 corner = floor(gl_FragCoord.xy) * float(count) + 0.5;
    vec4 sum = vec4(0.0);
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 4; ++x) {
            if (x < count && y < count) {
                vec4 texel = texture2D(samples, (corner + vec2(float(x), float(y))) * textureUnit);
                sum += vec4(texel.rgb * texel.a, texel.a);
            }
        }
    }
    gl_FragColor = vec4(sum.a > 0.0 ? sum.rgb / sum.a : vec3(0.0), sum.a / float(count * count));
}
