#version 120
// The part of depth in the border as in border.frag: the filter's response to it.
// In:  that response.
// Out: the same.

float depthResponse(float response) {
    return response;
}
