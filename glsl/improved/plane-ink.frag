#version 120
// Ink from the plane map: where two neighbouring pixels' planes do not meet between them one surface hides another; where
// they meet at more than the crease angle there is a crease. From evangelista/border.frag, whose filter answers to any
// change of normal or depth.
// In:  planeMap, of plane-map.frag; textureUnit, 1 / picture size in pixels; footprint, as there;
//      pixelAngle: tangent of the angle from pixel to pixel at the picture's middle, 0 in parallel projection;
//      middle: the middle of the picture, pixels;
//      reach: how many pixels away neighbours are, to the left or below and to the right or above: the lines' width;
//      gapThreshold: x the least gap between two surfaces that is a line, in widths of a pixel; y what is added for each
//      unit of slope; creaseCosine: cosine of the crease angle, above 0.
// Out: gl_FragColor, black with the ink as alpha, 0 or 1.

uniform sampler2D planeMap;
uniform vec2 textureUnit;
uniform vec2 footprint;
uniform float pixelAngle;
uniform vec2 middle;
uniform vec2 reach;
uniform vec2 gapThreshold;
uniform float creaseCosine;

vec2 decodedSlope(vec4 texel) {
    vec2 bounded = texel.rg * 2.0 - 1.0;
    return bounded / (1.0 - abs(bounded));
}

void main() {
    vec2 place = gl_FragCoord.xy * textureUnit;
    vec4 here = texture2D(planeMap, place);
    vec4 right = texture2D(planeMap, place + vec2(reach.y * textureUnit.x, 0.0));
    vec4 left = texture2D(planeMap, place - vec2(reach.x * textureUnit.x, 0.0));
    vec4 above = texture2D(planeMap, place + vec2(0.0, reach.y * textureUnit.y));
    vec4 below = texture2D(planeMap, place - vec2(0.0, reach.x * textureUnit.y));
    // Only the background is the same everywhere.
    if (here.r + right.r + left.r + above.r + below.r == 0.0) discard;
    vec4 taken = vec4(right.r, left.r, above.r, below.r);
    bool rim = here.r == 0.0 || any(equal(taken, vec4(0.0)));

    vec2 weights = vec2(65280.0, 255.0) / 65535.0;
    float depth = dot(here.ba, weights);
    vec2 s = decodedSlope(here);
    vec2 sRight = decodedSlope(right), sLeft = decodedSlope(left), sAbove = decodedSlope(above), sBelow = decodedSlope(below);
    vec4 away = vec4(dot(right.ba, weights), dot(left.ba, weights), dot(above.ba, weights), dot(below.ba, weights)) - depth;
    away /= footprint.x - footprint.y * depth;
    // What this pixel's plane and the neighbour's own expect the step in depth to be.
    vec4 mine = vec4(s.x, -s.x, s.y, -s.y) * reach.yxyx;
    vec4 theirs = vec4(sRight.x, -sLeft.x, sAbove.y, -sBelow.y) * reach.yxyx;
    vec4 a = away - mine;
    vec4 b = away - theirs;
    // The planes meet between the pixels where the two expectations lie on either side of the step.
    vec4 gap = min(abs(a), abs(b)) * step(0.0, a * b);
    vec4 threshold = gapThreshold.x + gapThreshold.y * min(abs(mine), abs(theirs));
    bool hides = any(greaterThan(gap, threshold));

    // Normals: the slopes lie in a frame along the eye's ray.
    vec2 r = (gl_FragCoord.xy - middle) * pixelAngle;
    float m = 1.0 + dot(r, s);
    vec4 others = 1.0 + vec4(dot(r, sRight), dot(r, sLeft), dot(r, sAbove), dot(r, sBelow));
    vec4 cosine = m * others + vec4(dot(s, sRight), dot(s, sLeft), dot(s, sAbove), dot(s, sBelow));
    vec4 squares = (dot(s, s) + m * m)
        * (vec4(dot(sRight, sRight), dot(sLeft, sLeft), dot(sAbove, sAbove), dot(sBelow, sBelow)) + others * others);
    bool turns = any(lessThan(cosine * abs(cosine), creaseCosine * creaseCosine * squares));
    if (!(rim || hides || turns)) discard;
    gl_FragColor = vec4(0.0, 0.0, 0.0, 1.0);
}
