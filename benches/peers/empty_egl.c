/* The least a headless GL program can do: an EGL pbuffer context, two shaders, one triangle, read-back.
   cc -O2 empty_egl.c -o empty_egl -lEGL -lGL; the process is timed from outside. */
#define GL_GLEXT_PROTOTYPES
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <GL/glext.h>
#include <stdio.h>
#include <stdlib.h>

enum { SIZE = 512 };

static GLuint compile(GLenum kind, const char *text) {
    GLuint shader = glCreateShader(kind);
    glShaderSource(shader, 1, &text, NULL);
    glCompileShader(shader);
    return shader;
}

int main(void) {
    EGLDeviceEXT devices[8];
    EGLint count = 0, configs = 0;
    PFNEGLQUERYDEVICESEXTPROC query = (PFNEGLQUERYDEVICESEXTPROC)eglGetProcAddress("eglQueryDevicesEXT");
    PFNEGLGETPLATFORMDISPLAYEXTPROC get =
        (PFNEGLGETPLATFORMDISPLAYEXTPROC)eglGetProcAddress("eglGetPlatformDisplayEXT");
    if (!query || !get || !query(8, devices, &count) || count < 1) return 1;
    EGLDisplay display = get(EGL_PLATFORM_DEVICE_EXT, devices[count - 1], NULL);
    if (!eglInitialize(display, NULL, NULL) || !eglBindAPI(EGL_OPENGL_API)) return 1;
    const EGLint wanted[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_ALPHA_SIZE, 8,
                             EGL_DEPTH_SIZE, 24, EGL_NONE};
    const EGLint size[] = {EGL_WIDTH, SIZE, EGL_HEIGHT, SIZE, EGL_NONE};
    EGLConfig config;
    if (!eglChooseConfig(display, wanted, &config, 1, &configs) || configs < 1) return 1;
    EGLSurface surface = eglCreatePbufferSurface(display, config, size);
    EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, NULL);
    if (!eglMakeCurrent(display, surface, surface, context)) return 1;

    GLuint program = glCreateProgram();
    glAttachShader(program, compile(GL_VERTEX_SHADER, "#version 120\nvoid main() { gl_Position = gl_Vertex; }"));
    glAttachShader(program, compile(GL_FRAGMENT_SHADER, "#version 120\nvoid main() { gl_FragColor = vec4(0.5); }"));
    glLinkProgram(program);
    glUseProgram(program);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glBegin(GL_TRIANGLES);
    glVertex2f(-1, -1);
    glVertex2f(1, -1);
    glVertex2f(0, 1);
    glEnd();
    unsigned char *pixels = malloc(4 * SIZE * SIZE);
    if (!pixels) return 1;
    glReadPixels(0, 0, SIZE, SIZE, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    printf("%s %d\n", (const char *)glGetString(GL_RENDERER), pixels[4 * (SIZE / 2 * SIZE + SIZE / 2)]);
    return glGetError() != GL_NO_ERROR;
}
