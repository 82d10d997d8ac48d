#version 120
// Valente 2007, section 4, vertex program of "sand rendering": charcoal.vert and the line that passes on the model's own
// texture coordinate.
// In:  as charcoal.vert; gl_MultiTexCoord0.
// Out: as charcoal.vert; gl_TexCoord[0].
// Repaired: V6 (the text prints one line, its place in the program is ours). Kept as published: V4.

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
    // Coordenada de textura original
    // do modelo
    gl_TexCoord[0].st = gl_MultiTexCoord0.st;
}
