#version 120
// GL_LINE_SMOOTH where a driver has none: a pixel's alpha is how much of it a line covers. Ours, as transform.vert; computed as Mesa
// does, whose square over a line is two triangles in perspective, so that its middle is not quite in the middle.
// In:  gl_Color; gl_TexCoord[0] and [1], the line's ends, s and t in pixels from the picture's lower left corner, p in clip space's w,
//      the same at every corner, so that it does not matter how finely a driver places corners; width, of the line, pixels.
// Out: gl_FragColor, the colour, its alpha times the cover: all of the line, fading over a pixel around it.

uniform float width;

void main() {
    vec2 begin = gl_TexCoord[0].st;
    vec2 halfLine = (gl_TexCoord[1].st - begin) * 0.5;
    float halfLength = length(halfLine);
    // A line seen end-on is a pixel of any direction.
    vec2 along = halfLength > 0.0 ? halfLine / halfLength : vec2(1.0, 0.0);
    vec2 extent = vec2(max(width, 1.0) * 0.5, halfLength) + 0.5;
    vec2 from = gl_FragCoord.xy - begin - halfLine;
    // From 0 to 1 across and along the square.
    vec2 place = (vec2(dot(from, vec2(-along.y, along.x)), dot(from, along)) / extent + 1.0) * 0.5;
    // The two triangles meet from one corner at the beginning to the other at the end; each corner's share counts by its nearness.
    vec2 near = 1.0 / vec2(gl_TexCoord[0].p, gl_TexCoord[1].p);
    bool isFirst = place.x + place.y <= 1.0;
    vec4 corners = isFirst ? vec4(1.0 - place.x - place.y, place.x, place.y, 0.0)
                           : vec4(0.0, 1.0 - place.y, 1.0 - place.x, place.x + place.y - 1.0);
    corners *= near.xxyy;
    float sum = corners.x + corners.y + corners.z + corners.w;
    vec2 distance = vec2(corners.y + corners.w - corners.x - corners.z, corners.z + corners.w - corners.x - corners.y) / sum;
    // Beyond Mesa's square, where a driver that places corners coarsely still has pixels: they must leave depth as it is.
    if (abs(distance.x) > 1.0 || abs(distance.y) > 1.0) discard;
    vec2 cover = clamp(extent - extent * abs(distance), 0.0, 1.0);
    gl_FragColor = vec4(gl_Color.rgb, gl_Color.a * cover.x * cover.y);
}
