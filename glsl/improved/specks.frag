#version 120
// Ink without specks: what of it is small and touches no other ink is left out. Ours.
// A box grows around each pixel of ink to whatever ink touches it, until none does, a speck, or it is wider or higher than a
// speck is: so all pixels of a speck are left out, and none of anything larger. Most pixels of a line need no box: from them ink
// goes on for long enough along a row, a column or a diagonal.
// In:  inkMask, the ink alone, its alpha 0 or 1; textureUnit, 1 / its size in pixels; speckSize: the width and height, in pixels,
//      up to which ink is a speck, at most 16. Ink at the picture's edge goes on beyond it.
// Out: gl_FragColor, black with the ink as alpha, 1.

uniform sampler2D inkMask;
uniform vec2 textureUnit;
uniform float speckSize;

const int LARGEST = 16;

float inkAt(vec2 pixel) {
    return texture2D(inkMask, pixel * textureUnit).a;
}

// Whether ink goes on from a pixel, back and forth together, for more pixels than a speck has.
bool isLine(vec2 middle) {
    // Along a row, a column and both diagonals.
    vec4 forth = vec4(1.0), back = vec4(1.0), count = vec4(1.0);
    for (int step = 1; step <= LARGEST; ++step) {
        float far = float(step);
        vec2 rising = vec2(far, far), falling = vec2(far, -far), right = vec2(far, 0.0), up = vec2(0.0, far);
        forth *= vec4(inkAt(middle + right), inkAt(middle + up), inkAt(middle + rising), inkAt(middle + falling));
        back *= vec4(inkAt(middle - right), inkAt(middle - up), inkAt(middle - rising), inkAt(middle - falling));
        count += forth + back;
        if (any(greaterThan(count, vec4(speckSize + 0.5)))) return true;
        if (forth + back == vec4(0.0)) return false;
    }
    return false;
}

bool isSpeck(vec2 middle) {
    vec2 low = middle - 1.0, high = middle + 1.0;
    for (int growth = 0; growth < 2 * LARGEST; ++growth) {
        // Ink around the box: on its left and right, below and above.
        vec4 touches = vec4(0.0);
        for (float x = low.x; x < high.x + 0.5; x += 1.0) {
            touches.zw += vec2(inkAt(vec2(x, low.y)), inkAt(vec2(x, high.y)));
        }
        for (float y = low.y; y < high.y + 0.5; y += 1.0) {
            touches.xy += vec2(inkAt(vec2(low.x, y)), inkAt(vec2(high.x, y)));
        }
        if (touches == vec4(0.0)) return true;
        vec4 grown = step(0.5, touches);
        low -= grown.xz;
        high += grown.yw;
        if (max(high.x - low.x, high.y - low.y) > speckSize + 1.5) return false;
    }
    return false;
}

void main() {
    if (inkAt(gl_FragCoord.xy) < 0.5) discard;
    if (!isLine(gl_FragCoord.xy) && isSpeck(gl_FragCoord.xy)) discard;
    gl_FragColor = vec4(0.0, 0.0, 0.0, 1.0);
}
