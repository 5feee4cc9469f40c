/* Between movie.c and OpenCV's VideoWriter, which lies in a module of its own (angioscope-opencv.so): with ffmpeg it
 * brings some 100 libraries. Private to io/movie/. */
#ifndef ANG_IO_MOVIE_ENCODER_H
#define ANG_IO_MOVIE_ENCODER_H

#include "core/base/error.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct ang_encoder ang_encoder;

/* What the module exports under the name ANG_OPENCV_SYMBOL. */
typedef struct ang_encoder_functions {
    /* Writes to `path`, whose extension tells the container. NULL with ANG_OUTPUT, ANG_LIMIT. */
    ang_encoder *(*open)(const char *path, int width, int height, double fps, ang_error *err);
    /* Rows from the top of 3 bytes a pixel: red, green, blue. False with ANG_OUTPUT, ANG_LIMIT. */
    bool (*add)(ang_encoder *encoder, const unsigned char *rgb, ang_error *err);
    void (*close)(ang_encoder *encoder);
    /* How many frames of a film can be decoded; 0 where it cannot be opened. */
    size_t (*count)(const char *path);
} ang_encoder_functions;
#define ANG_OPENCV_MODULE "angioscope-opencv.so"
#define ANG_OPENCV_SYMBOL "ang_opencv_module"

#endif
