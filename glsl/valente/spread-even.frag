#version 120
// Paper and noise in their own proportion: each covers the picture as a whole, and part of it is beyond the shorter side. Ours.
// In: a place in the picture, 0 to 1; paperSpread, noiseSpread, the share of each texture along x and y that covers the picture;
//     the part grain-*.
// Out: the texture's coordinate.

uniform vec2 paperSpread;
uniform vec2 noiseSpread;

vec2 grainPlace(vec2 place);

vec2 onPaper(vec2 place) {
    return grainPlace(place) * paperSpread;
}

vec2 onNoise(vec2 place) {
    return grainPlace(place) * noiseSpread;
}
