#version 120
// The hardware's own outline, after S. Dietrich, "Cartoon Rendering and Advanced Texture Features of the GeForce 256"
// (NVIDIA), as C. Dachsbacher's text describes it: normal against view position, per pixel. The shader is ours.
//
// In: position, normal, colour. Out: eye-space normal and direction to the eye, colour.

varying vec3 normalView;
varying vec3 towardsEye;

void main()
{
    normalView = gl_NormalMatrix * gl_Normal;
    // In a parallel projection the eye is infinitely far along z.
    bool isParallel = gl_ProjectionMatrix[3][3] == 1.0;
    towardsEye = isParallel ? vec3(0.0, 0.0, 1.0) : -vec3(gl_ModelViewMatrix * gl_Vertex);
    gl_FrontColor = gl_Color;
    gl_BackColor = gl_Color;
    gl_Position = ftransform();
}
