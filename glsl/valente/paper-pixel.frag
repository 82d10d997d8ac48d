#version 120
// Paper and noise by the pixel's place in the picture (V4 repaired).
// In: gl_FragCoord; corner, the picture's lower left, pixels; textureUnit, 1 / picture size in pixels. Out: 0 to 1 over the picture.

uniform vec2 corner;
uniform vec2 textureUnit;

vec2 paperPlace() {
    return (gl_FragCoord.xy - corner) * textureUnit;
}
