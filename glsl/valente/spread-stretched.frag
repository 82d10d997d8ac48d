#version 120
// Paper and noise stretched once over the picture, as published.
// In: a place in the picture, 0 to 1; the part grain-*. Out: the texture's coordinate.

vec2 grainPlace(vec2 place);

vec2 onPaper(vec2 place) {
    return grainPlace(place);
}

vec2 onNoise(vec2 place) {
    return grainPlace(place);
}
