/* Pictures to a film: .mp4 (H.264, for showing) and .avi (FFV1, without loss). */
#ifndef ANG_IO_MOVIE_MOVIE_H
#define ANG_IO_MOVIE_MOVIE_H

#include "core/base/error.h"
#include "core/scene/image.h"

#include <stdbool.h>

typedef struct ang_movie ang_movie;

/* Whether a path names a film, by its extension: in every build. */
bool ang_movie_is(const char *path);
/* Whether its frames are the pictures without loss, to the bit. */
bool ang_movie_lossless(const char *path);

/* False where a film of this size could not be written as things stand: ANG_USAGE (a build without OpenCV, an odd width
 * or height, which the codecs would cut), ANG_OUTPUT. To be asked before long work. */
bool ang_movie_writable(const char *path, int width, int height, ang_error *err);

/* Begins a film of `fps` pictures a second in a temporary file beside `path`. It holds pictures and nothing else but
 * the encoder's name. NULL with ANG_USAGE or ANG_OUTPUT as above, ANG_LIMIT. One film is for one thread. */
ang_movie *ang_movie_open(const char *path, int width, int height, double fps, ang_error *err);
/* Adds a picture of that size as ang_image_rgb has it. False with ANG_OUTPUT, ANG_LIMIT. */
bool ang_movie_add(ang_movie *movie, const ang_image *image, const double background[4], ang_error *err);
/* Ends the film, reads it back as far as to see that all its frames are there, and renames it to its path; frees
 * `movie`. False with ANG_OUTPUT; what was at the path stays then. */
bool ang_movie_finish(ang_movie *movie, ang_error *err);
/* Gives up: removes the temporary file and frees. NULL is allowed. */
void ang_movie_abandon(ang_movie *movie);

#endif
