#version 120
// Painting with the light computed on the graphics card: the last section of C. Dachsbacher, "Beethoven aus Bits und
// Bytes" (PC Underground), names this variant; the text prints no shader for it, so this is ours, after its CPU listing.
//
// In: position, normal, colour, texture coordinate 0 (its t is the row of the ramp) and 1 (the model's own).
// Out: for fixed-function fragments, texture coordinate 0 (light, row) and 1, colour.

void main()
{
    vec3 normal = normalize(gl_NormalMatrix * gl_Normal);
    vec3 lightDirection = normalize(vec3(0.0, 1.0, 1.0));
    float light = clamp(dot(lightDirection, normal), 0.1, 0.9);
    gl_TexCoord[0] = vec4(light, gl_MultiTexCoord0.t, 0.0, 1.0);
    gl_TexCoord[1] = gl_MultiTexCoord1;
    gl_FrontColor = gl_Color;
    gl_Position = ftransform();
}
