#version 120
// Ink where the surface is seen at a grazing angle: |N.V| below the threshold.
//
// In: eye-space normal and direction to the eye, colour, the threshold and the ink's colour. Out: ink or colour.
// Both sides of a face count, hence the absolute value: open models show their insides.

uniform float threshold;
uniform vec3 inkColor;

varying vec3 normalView;
varying vec3 towardsEye;

void main()
{
    float facing = abs(dot(normalize(normalView), normalize(towardsEye)));
    gl_FragColor = facing < threshold ? vec4(inkColor, 1.0) : gl_Color;
}
