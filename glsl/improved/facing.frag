#version 120
// The shade that valleys are looked for in: how far the surface faces the eye. Ours, after DeCarlo et al. 2003, whose picture has a
// light at the eye and nothing else; 16 bits instead of 8, for smooth surfaces have less than a step between two pixels.
// In:  normalView, towardsEye of dietrich.vert.
// Out: gl_FragColor.rg the cosine between normal and view, high byte and low byte; .b 1, the mark of a surface.

varying vec3 normalView;
varying vec3 towardsEye;

void main() {
    vec3 normal = normalize(gl_FrontFacing ? normalView : -normalView);
    float steps = floor(clamp(dot(normal, normalize(towardsEye)), 0.0, 1.0) * 65535.0 + 0.5);
    float high = floor(steps / 256.0);
    gl_FragColor = vec4(high / 255.0, (steps - 256.0 * high) / 255.0, 1.0, 1.0);
}
