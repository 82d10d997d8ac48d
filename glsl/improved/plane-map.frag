#version 120
// The plane map: of each pixel the plane of its own triangle and a depth of 16 bits. From evangelista/map.frag, whose normal
// is the vertices', clamped (errata E6), and whose depth has 8 bits (E8).
// In:  eyeDistance: of the surface along the view, scene radii; depthOfDistance: depth is x + y / eyeDistance + z eyeDistance, from 0
//      to 1 where the scene is, however far apart the camera's planes are;
//      footprint: a pixel's width on the surface is footprint.x - footprint.y * depth.
// Out: gl_FragColor.rg how far the surface recedes from one pixel to the next, to the right and upwards, in widths of a
//      pixel on the surface: a slope s as 0.5 + 0.5 s / (1 + |s|); .ba depth, high byte and low byte.
//      Rows of 0 are left to the background: a slope never is.

uniform vec2 footprint;
uniform vec3 depthOfDistance;

varying float eyeDistance;

void main() {
    float depth = clamp(depthOfDistance.x + depthOfDistance.y / eyeDistance + depthOfDistance.z * eyeDistance, 0.0, 1.0);
    vec2 slope = vec2(dFdx(depth), dFdy(depth)) / (footprint.x - footprint.y * depth);
    vec2 bounded = clamp(slope / (1.0 + abs(slope)), -0.99, 0.99);
    float steps = floor(depth * 65535.0 + 0.5);
    float high = floor(steps / 256.0);
    gl_FragColor = vec4(0.5 + 0.5 * bounded, high / 255.0, (steps - 256.0 * high) / 255.0);
}
