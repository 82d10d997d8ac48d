#version 120
// Ink from the plane map: where the planes of the pixels on both sides do not meet between them one surface hides another; where
// they meet at more than the crease angle there is a crease. From evangelista/border.frag, whose filter answers to any
// change of normal or depth.
// In:  planeMap, of plane-map.frag; textureUnit, 1 / picture size in pixels; footprint, as there;
//      pixelAngle: tangent of the angle from pixel to pixel at the picture's middle, 0 in parallel projection;
//      middle: the middle of the picture, pixels;
//      reach: how many pixels away these are, to the left or below and to the right or above; together the lines' width;
//      gapThreshold: x the least gap between two surfaces that is a line, in widths of a pixel; y what is added for each
//      unit of slope; creaseCosine: cosine of the crease angle.
// Out: gl_FragColor, black with the ink as alpha, 0 or 1.

uniform sampler2D planeMap;
uniform vec2 textureUnit;
uniform vec2 footprint;
uniform float pixelAngle;
uniform vec2 middle;
uniform vec2 reach;
uniform vec2 gapThreshold;
uniform float creaseCosine;

// Two depths of 16 bits, each rounded.
const float depthRounding = 1.5 / 65535.0;

vec2 decodedSlope(vec4 texel) {
    vec2 bounded = texel.rg * 2.0 - 1.0;
    vec2 rest = 1.0 - abs(bounded);
    // Both quotients by one division.
    return bounded * rest.yx * (1.0 / (rest.x * rest.y));
}

void main() {
    vec2 place = gl_FragCoord.xy * textureUnit;
    vec4 left = texture2D(planeMap, place - vec2(reach.x * textureUnit.x, 0.0));
    vec4 right = texture2D(planeMap, place + vec2(reach.y * textureUnit.x, 0.0));
    vec4 below = texture2D(planeMap, place - vec2(0.0, reach.x * textureUnit.y));
    vec4 above = texture2D(planeMap, place + vec2(0.0, reach.y * textureUnit.y));
    if (left.r + right.r + below.r + above.r == 0.0) discard;
    // One of two is the background.
    bool isRim = (left.r == 0.0) != (right.r == 0.0) || (below.r == 0.0) != (above.r == 0.0);

    vec2 weights = vec2(65280.0, 255.0) / 65535.0;
    vec2 depth = vec2(dot(left.ba, weights), dot(below.ba, weights));
    vec2 away = vec2(dot(right.ba, weights), dot(above.ba, weights)) - depth;
    vec2 pixel = footprint.x - footprint.y * depth;
    away /= pixel;
    vec2 l = decodedSlope(left), r = decodedSlope(right), b = decodedSlope(below), a = decodedSlope(above);
    // By how much the step in depth differs from what one plane and the other expect.
    float span = reach.x + reach.y;
    vec2 near = span * vec2(l.x, b.y);
    vec2 far = span * vec2(r.x, a.y);
    vec2 first = away - near;
    vec2 second = away - far;
    // The planes meet between the pixels where the two expectations lie on either side of the step.
    vec2 gap = min(abs(first), abs(second)) * step(0.0, first * second);
    // The map's rounding is no gap: wide where planes are far apart, a hundredth of a pixel where they were fitted.
    vec2 least = gapThreshold.x + gapThreshold.y * min(abs(near), abs(far)) + depthRounding / pixel;
    bool hides = any(greaterThan(gap, least));

    // Normals: the slopes lie in a frame along the eye's ray.
    vec2 ray = (gl_FragCoord.xy - middle) * pixelAngle;
    vec4 along = 1.0 + vec4(dot(ray, l), dot(ray, b), dot(ray, r), dot(ray, a));
    vec4 squares = vec4(dot(l, l), dot(b, b), dot(r, r), dot(a, a)) + along * along;
    vec2 cosine = along.xy * along.zw + vec2(dot(l, r), dot(b, a));
    bool turns = any(lessThan(cosine * abs(cosine), creaseCosine * abs(creaseCosine) * squares.xy * squares.zw));
    if (!(isRim || hides || turns)) discard;
    gl_FragColor = vec4(0.0, 0.0, 0.0, 1.0);
}
