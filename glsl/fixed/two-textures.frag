#version 120
// The fixed-function pipeline's fragments, two texture units switched on (GL_MODULATE). Ours, as transform.vert.
// In:  gl_Color; texture0 and texture1, gl_TexCoord[0] and [1].
// Out: gl_FragColor, the colour times both textures.

uniform sampler2D texture0;
uniform sampler2D texture1;

void main() {
    gl_FragColor = gl_Color * texture2D(texture0, gl_TexCoord[0].st) * texture2D(texture1, gl_TexCoord[1].st);
}
