#version 120
// The part of depth in the border, by a threshold that knows the surface's slope: black where the straight continuations of
// the depths on both sides do not meet between two taps. A plane never answers, however steep, and a step from one surface
// to another does at any distance from the eye. From depth-as-filtered.frag.
// In:  footprint: a pixel's width on the surface is footprint.x - footprint.y * depth of window depth;
//      leastGap: the least step that is a line, x in such widths, y in window depth, for what the map rounds away;
//      reach: how far apart taps are, in pixels, to the left or below and to the right or above; texel.
// Out: 1 or 0.

uniform vec2 footprint;
uniform vec2 leastGap;
uniform vec2 reach;

vec4 texel(vec2 offset);

float gapTowards(vec2 offset) {
    float here = texel(vec2(0.0)).a;
    float next = texel(offset).a;
    float mine = next - 2.0 * here + texel(-offset).a;
    float theirs = texel(2.0 * offset).a - 2.0 * next + here;
    // Both on one side of the step: the continuations pass each other by.
    return mine * -theirs > 0.0 ? min(abs(mine), abs(theirs)) : 0.0;
}

float depthResponse(float response) {
    float gap = max(max(gapTowards(vec2(reach.y, 0.0)), gapTowards(vec2(-reach.x, 0.0))),
                    max(gapTowards(vec2(0.0, reach.y)), gapTowards(vec2(0.0, -reach.x))));
    float width = footprint.x - footprint.y * texel(vec2(0.0)).a;
    return gap > leastGap.x * width + leastGap.y ? 1.0 : 0.0;
}
