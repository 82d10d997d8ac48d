#version 120
// The plane map with the model's own normals in place of depth, which is in the depth buffer.
// In:  normalView: the normal, eye space; footprint: a pixel's width on the surface is footprint.x - footprint.y * window depth.
// Out: gl_FragColor.rg as plane-map.frag has them; .ba the normal towards the eye's side, in a disc whose areas are the sphere's
//      (Lambert), from -1 to 1 as 0 to 1.

uniform vec2 footprint;

varying vec3 normalView;

void main() {
    vec2 slope = vec2(dFdx(gl_FragCoord.z), dFdy(gl_FragCoord.z)) / (footprint.x - footprint.y * gl_FragCoord.z);
    vec2 bounded = clamp(slope / (1.0 + abs(slope)), -0.99, 0.99);
    vec3 normal = normalize(gl_FrontFacing ? normalView : -normalView);
    vec2 disc = normal.xy * inversesqrt(max(2.0 + 2.0 * normal.z, 0.001));
    gl_FragColor = vec4(0.5 + 0.5 * bounded, 0.5 + 0.5 * disc);
}
