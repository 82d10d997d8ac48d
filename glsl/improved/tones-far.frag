#version 120
// The tones of tones-far.vert, smooth at the picture's own size: light is linear in a triangle, so its change from pixel to pixel tells
// how far the border of a tone is, and the pixels that it cuts get both tones.
// In:  light; gl_Color; toneThresholds: the light from which the second and the third tone begin, ascending; toneLevels: the three
//      tones.
// Out: gl_FragColor, the object's colour times its tone. The side that is seen is lit. A flat face has no border.

uniform vec2 toneThresholds;
uniform vec3 toneLevels;

varying float light;

// The share of a pixel above a threshold.
float shareAbove(float threshold, float seen, float change) {
    return change < 0.00001 ? float(seen >= threshold) : clamp((seen - threshold) / change + 0.5, 0.0, 1.0);
}

void main() {
    float seen = gl_FrontFacing ? light : -light;
    float change = length(vec2(dFdx(light), dFdy(light)));
    float tone = toneLevels.x;
    tone += (toneLevels.y - toneLevels.x) * shareAbove(toneThresholds.x, seen, change);
    tone += (toneLevels.z - toneLevels.y) * shareAbove(toneThresholds.y, seen, change);
    gl_FragColor = vec4(gl_Color.xyz * tone, 1.0);
}
