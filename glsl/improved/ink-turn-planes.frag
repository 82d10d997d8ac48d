#version 120
// A crease where the planes of opposite pixels differ by more than an angle.
// In:  texels of plane-map.frag on four sides; creaseCosine, cosine of the angle;
//      pixelAngle: tangent of the angle from pixel to pixel at the picture's middle, 0 in parallel projection;
//      middle: the middle of the picture, pixels.
// Out: whether there is one.

uniform float creaseCosine;
uniform float pixelAngle;
uniform vec2 middle;

vec2 decodedSlope(vec4 texel);

bool turns(vec4 left, vec4 right, vec4 below, vec4 above) {
    vec2 l = decodedSlope(left), r = decodedSlope(right), b = decodedSlope(below), a = decodedSlope(above);
    // Normals: the slopes lie in a frame along the eye's ray.
    vec2 ray = (gl_FragCoord.xy - middle) * pixelAngle;
    vec4 along = 1.0 + vec4(dot(ray, l), dot(ray, b), dot(ray, r), dot(ray, a));
    vec4 squares = vec4(dot(l, l), dot(b, b), dot(r, r), dot(a, a)) + along * along;
    vec2 cosine = along.xy * along.zw + vec2(dot(l, r), dot(b, a));
    return any(lessThan(cosine * abs(cosine), creaseCosine * abs(creaseCosine) * squares.xy * squares.zw));
}
