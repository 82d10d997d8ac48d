#version 120
// Grain as wide as the picture's pixels where several samples are drawn for each: all samples of a pixel read what they would at its
// middle, so that their mean has the grain of a picture drawn at its own size, not a grey of several grains. Ours.
// In: a place in a texture, or a row of the contrast-enhanced texture, as the sample has it; samples, along a side of a pixel.
// Out: the same at the pixel's middle, as far as it changes evenly from sample to sample.

uniform float samples;

vec2 toMiddle() {
    return (floor(gl_FragCoord.xy / samples) + 0.5) * samples - gl_FragCoord.xy;
}

vec2 grainPlace(vec2 place) {
    vec2 distance = toMiddle();
    return place + dFdx(place) * distance.x + dFdy(place) * distance.y;
}

float grainRow(float row) {
    vec2 distance = toMiddle();
    // Beyond the first and the last row the texture begins again, where the sample itself does not read.
    return clamp(row + dFdx(row) * distance.x + dFdy(row) * distance.y, 0.0, max(row, 1.0));
}
