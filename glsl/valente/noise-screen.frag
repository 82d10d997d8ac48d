#version 120
// Noise by the paper's coordinate, as published: it stands still on the picture while the model turns.
// In: the parts paper-* and spread-*. Out: the noise texture's coordinate.

vec2 paperPlace();
vec2 onNoise(vec2 place);

vec2 noisePlace() {
    return onNoise(paperPlace());
}
