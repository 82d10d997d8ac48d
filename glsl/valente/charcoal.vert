#version 120
// Valente 2007, section 3.2, vertex program: normal and lights in eye space, the paper's texture coordinate.
// In:  gl_Vertex, gl_Normal, the fixed-function matrices; inputLight1 and inputLight2, directions towards the lights, eye space.
// Out: lightDir1, lightDir2, normal (eye space); paperCoord, 0 to 1 over the picture.
// Nothing repaired. Kept as published: V4, paperCoord is divided by w here and then interpolated in perspective.

// “posição” da fonte de luz em
// eye-space.
uniform vec3 inputLight1;
uniform vec3 inputLight2;
// direção da luz e normal do vértice
// em eye-space, a serem interpoladas
varying vec3 lightDir1;
varying vec3 lightDir2;
varying vec3 normal;
// coordenada para se aplicar a textura
// do papel
varying vec2 paperCoord;
void main()
{
    // posição transformada e projetada
    gl_Position = ftransform();
    // direção da luz em eye-space
    lightDir1 = inputLight1;
    lightDir2 = inputLight2;
    // normal em eye space
    normal = gl_NormalMatrix * gl_Normal;
    // Calcular coordenadas de textura do
    // papel [0, 1]
    paperCoord.st = (gl_Position.xy / gl_Position.w) * 0.5 + 0.5;
}
