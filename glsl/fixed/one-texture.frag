#version 120
// The fixed-function pipeline's fragments, one texture unit switched on (GL_MODULATE). Ours, as transform.vert.
// In:  gl_Color; texture0 and gl_TexCoord[0].
// Out: gl_FragColor, the colour times the texture.

uniform sampler2D texture0;

void main() {
    gl_FragColor = gl_Color * texture2D(texture0, gl_TexCoord[0].st);
}
