#version 120
// Ink in the valleys of a shaded picture. Ours, after the image-space algorithm of DeCarlo et al. 2003: a pixel is in a valley if in
// a disc around it no more than a certain share of the pixels are darker, and the brightest is brighter by a certain step.
// In:  facingMap, of facing.frag, the ground 1 and no surface; textureUnit, 1 / picture size in pixels; radius: of the disc, pixels;
//      darkerShare: the largest share of darker pixels; leastDepth: the least step to the brightest.
// Out: gl_FragColor, black with the ink as alpha, 1.

uniform sampler2D facingMap;
uniform vec2 textureUnit;
uniform float radius;
uniform float darkerShare;
uniform float leastDepth;

float shadeOf(vec4 texel) {
    return (texel.r * 65280.0 + texel.g * 255.0) / 65535.0;
}

void main() {
    vec4 middle = texture2D(facingMap, gl_FragCoord.xy * textureUnit);
    if (middle.b < 0.5) discard;
    float shade = shadeOf(middle);
    float count = 0.0, darker = 0.0, brightest = shade;
    // Pixels whose middle is within the radius and half a pixel: a disc of radius 1 has nine.
    float reach = (radius + 0.5) * (radius + 0.5);
    for (float y = -radius; y <= radius; y += 1.0) {
        for (float x = -radius; x <= radius; x += 1.0) {
            if (x * x + y * y <= reach) {
                float other = shadeOf(texture2D(facingMap, (gl_FragCoord.xy + vec2(x, y)) * textureUnit));
                count += 1.0;
                darker += other < shade ? 1.0 : 0.0;
                brightest = max(brightest, other);
            }
        }
    }
    if (darker > darkerShare * count || brightest - shade < leastDepth) discard;
    gl_FragColor = vec4(0.0, 0.0, 0.0, 1.0);
}
