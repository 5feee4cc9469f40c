#include "io/movie/movie.h"

#include "core/base/memory.h"
#include "io/image/image_io.h"
#include "io/module.h"
#include "io/movie/encoder.h"
#include "io/replace.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

struct ang_movie {
    char path[PATH_MAX], temporary[PATH_MAX];
    const ang_encoder_functions *functions;
    ang_encoder *encoder;
    size_t frames;
};

static const char *extension_of(const char *path) {
    const char *slash = strrchr(path, '/'), *dot = strrchr(slash ? slash : path, '.');
    return dot ? dot : "";
}

bool ang_movie_is(const char *path) {
    const char *extension = extension_of(path);
    return strcasecmp(extension, ".mp4") == 0 || strcasecmp(extension, ".avi") == 0;
}

bool ang_movie_lossless(const char *path) { return strcasecmp(extension_of(path), ".avi") == 0; }

bool ang_movie_writable(const char *path, int width, int height, ang_error *err) {
#ifndef ANG_WITH_OPENCV
    (void)width, (void)height;
    return ang_fail(err, ANG_USAGE,
                    "%s: films are left out of this build (ANG_WITH_OPENCV); write pictures, -o OUT.png, instead",
                    path);
#else
    if (width % 2 || height % 2)
        return ang_fail(err, ANG_USAGE, "%s: a film's width and height must be even; use --size %dx%d", path,
                        width + width % 2, height + height % 2);
    return ang_file_replaceable(path, err);
#endif
}

ang_movie *ang_movie_open(const char *path, int width, int height, double fps, ang_error *err) {
    ang_movie *movie = NULL;
    if (!ang_movie_writable(path, width, height, err)) return NULL;
    if (!(movie = ang_alloc(1, sizeof *movie, "film", err))) return NULL;
    movie->functions = ang_module_symbol(ANG_OPENCV_MODULE, ANG_OPENCV_SYMBOL, "films", ANG_OUTPUT, err);
    ang_error own = {0};
    if (movie->functions && strlen(path) < sizeof movie->path) {
        strcpy(movie->path, path);
        if (ang_file_temporary(path, extension_of(path), movie->temporary, sizeof movie->temporary, err)) {
            movie->encoder = movie->functions->open(movie->temporary, width, height, fps, &own);
            if (movie->encoder) return movie;
            ang_fail(err, own.code, "%s: %s", path, own.message);
        }
    } else if (movie->functions) {
        ang_fail(err, ANG_OUTPUT, "%s: is too long a name", path);
    }
    ang_movie_abandon(movie);
    return NULL;
}

bool ang_movie_add(ang_movie *movie, const ang_image *image, const double background[4], ang_error *err) {
    unsigned char *rgb = NULL;
    ang_error own = {0};
    if (!ang_image_rgb(image, background, &rgb, err)) return false;
    bool added = movie->functions->add(movie->encoder, rgb, &own);
    free(rgb);
    if (added) movie->frames++;
    return added || ang_fail(err, own.code, "%s: %s", movie->path, own.message);
}

bool ang_movie_finish(ang_movie *movie, ang_error *err) {
    movie->functions->close(movie->encoder);
    movie->encoder = NULL;
    /* The encoder does not say where a disk is full. */
    size_t whole = movie->functions->count(movie->temporary);
    bool finished = whole == movie->frames
                        ? ang_file_rename(movie->temporary, movie->path, err)
                        : ang_fail(err, ANG_OUTPUT, "%s: of %zu frames %zu were written: is there space on the disk?",
                                   movie->path, movie->frames, whole);
    if (finished) movie->temporary[0] = '\0';
    ang_movie_abandon(movie);
    return finished;
}

void ang_movie_abandon(ang_movie *movie) {
    if (!movie) return;
    if (movie->encoder) movie->functions->close(movie->encoder);
    if (movie->temporary[0]) unlink(movie->temporary);
    free(movie);
}
