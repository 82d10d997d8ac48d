#version 120
// GLSL's own noise, which the report could not use because it was 0 everywhere (Valente 2007, section 3.1): what this driver
// makes of it.
// In:  nothing.
// Out: gl_FragColor, how far noise1 to noise4 are from 0, in red, green, blue and alpha.

void main() {
    // Off the whole numbers, where gradient noise is 0 by itself.
    vec4 place = gl_FragCoord.xyxy * vec4(0.137, 0.211, 0.071, 0.053) + 0.31;
    gl_FragColor = abs(vec4(noise1(place.x), noise2(place.xy).x, noise3(place.xyz).x, noise4(place).x));
}
