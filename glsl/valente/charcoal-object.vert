#version 120
// sand.vert with the place on the model, for a noise that lies on it (noise-object.frag). Ours.
// In:  as sand.vert.
// Out: as sand.vert; objectPosition and objectNormal (object space; unit: the scene's radius).

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
varying vec3 objectPosition;
varying vec3 objectNormal;
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
    gl_TexCoord[0].st = gl_MultiTexCoord0.st;
    objectPosition = gl_Vertex.xyz;
    objectNormal = gl_Normal;
}
