#version 120
// The part of object numbers in the border: black where the filter answers to them at all. From evangelista/depth-as-filtered.frag.
// In:  the filter's response to the numbers, which are steps of 1 / 255; detectionFactor.
// Out: 1 or 0.

uniform float detectionFactor;

float depthResponse(float response) {
    return response > 0.5 / 255.0 * abs(detectionFactor) ? 1.0 : 0.0;
}
