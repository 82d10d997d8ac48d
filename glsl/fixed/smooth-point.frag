#version 120
// GL_POINT_SMOOTH where a driver has none: a pixel's alpha is how much of it a disc covers. Ours, as transform.vert.
// In:  gl_Color; gl_TexCoord[0], the disc's middle, pixels from the picture's lower left corner, the same at every corner; width, of
//      the disc, pixels.
// Out: gl_FragColor, the colour, its alpha times the cover, of two pixels at least: it fades over the disc's outermost pixel; nothing outside.

uniform float width;

void main() {
    float radius = max(width * 0.5, 1.0);
    vec2 place = (gl_FragCoord.xy - gl_TexCoord[0].st) / radius;
    float square = dot(place, place);
    if (square > 1.0) discard;
    float inner = max(1.0 - 1.0 / radius, 0.0);
    float cover = clamp((1.0 - square) / (1.0 - inner * inner), 0.0, 1.0);
    gl_FragColor = vec4(gl_Color.rgb, gl_Color.a * cover);
}
