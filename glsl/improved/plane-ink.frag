#version 120
// Ink from the plane map: where the planes of the pixels on both sides do not meet between them one surface hides another; where
// the surface turns between them there is a crease. From evangelista/border.frag, whose filter answers to any change of normal or
// depth. Linked with one file of each kind: ink-depth-*, ink-turn-*.
// In:  planeMap, of plane-map.frag or normal-map.frag; textureUnit, 1 / picture size in pixels; footprint, as there;
//      reach: how many pixels away these are, to the left or below and to the right or above; together the width of the outline, what
//      borders on the background; innerReach: the same for all other lines;
//      gapThreshold: the least gap between two surfaces that is a line, in widths of a pixel.
// Out: gl_FragColor, black with the ink as alpha, 0 or 1.

uniform sampler2D planeMap;
uniform vec2 textureUnit;
uniform vec2 footprint;
uniform vec2 reach;
uniform vec2 innerReach;
uniform float gapThreshold;

// Added to it for each unit of slope towards the eye, because the map is less exact on steep surfaces.
const float gapPerSlope = 0.3;

float depthOf(vec4 texel, vec2 place);
// What depths and their differences are known to.
float depthRounding();
bool turns(vec4 left, vec4 right, vec4 below, vec4 above);

vec2 decodedSlope(vec4 texel) {
    vec2 bounded = texel.rg * 2.0 - 1.0;
    vec2 rest = 1.0 - abs(bounded);
    // Both quotients by one division.
    return bounded * rest.yx * (1.0 / (rest.x * rest.y));
}

// One of two is the background.
bool isRim(vec4 left, vec4 right, vec4 below, vec4 above) {
    return (left.r == 0.0) != (right.r == 0.0) || (below.r == 0.0) != (above.r == 0.0);
}

void main() {
    vec2 place = gl_FragCoord.xy * textureUnit;
    vec2 toLeft = place - vec2(reach.x * textureUnit.x, 0.0), toRight = place + vec2(reach.y * textureUnit.x, 0.0);
    vec2 toBelow = place - vec2(0.0, reach.x * textureUnit.y), toAbove = place + vec2(0.0, reach.y * textureUnit.y);
    vec4 left = texture2D(planeMap, toLeft), right = texture2D(planeMap, toRight);
    vec4 below = texture2D(planeMap, toBelow), above = texture2D(planeMap, toAbove);
    if (left.r + right.r + below.r + above.r == 0.0) discard;
    bool isOutline = isRim(left, right, below, above);
    if (innerReach != reach && !isOutline) {
        toLeft = place - vec2(innerReach.x * textureUnit.x, 0.0);
        toRight = place + vec2(innerReach.y * textureUnit.x, 0.0);
        toBelow = place - vec2(0.0, innerReach.x * textureUnit.y);
        toAbove = place + vec2(0.0, innerReach.y * textureUnit.y);
        left = texture2D(planeMap, toLeft);
        right = texture2D(planeMap, toRight);
        below = texture2D(planeMap, toBelow);
        above = texture2D(planeMap, toAbove);
        isOutline = isRim(left, right, below, above);
    }

    vec2 depth = vec2(depthOf(left, toLeft), depthOf(below, toBelow));
    vec2 away = vec2(depthOf(right, toRight), depthOf(above, toAbove)) - depth;
    vec2 pixel = footprint.x - footprint.y * depth;
    away /= pixel;
    // By how much the step in depth differs from what one plane and the other expect.
    float span = innerReach.x + innerReach.y;
    vec2 near = span * vec2(decodedSlope(left).x, decodedSlope(below).y);
    vec2 far = span * vec2(decodedSlope(right).x, decodedSlope(above).y);
    vec2 first = away - near;
    vec2 second = away - far;
    // The planes meet between the pixels where the two expectations lie on either side of the step.
    vec2 gap = min(abs(first), abs(second)) * step(0.0, first * second);
    // The map's rounding is no gap: wide where planes are far apart, a hundredth of a pixel where they were fitted.
    vec2 least = gapThreshold + gapPerSlope * min(abs(near), abs(far)) + depthRounding() / pixel;
    bool hides = any(greaterThan(gap, least));
    if (!(isOutline || hides || turns(left, right, below, above))) discard;
    gl_FragColor = vec4(0.0, 0.0, 0.0, 1.0);
}
