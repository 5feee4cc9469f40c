/* A picture that sharpens in four levels, each of which draws the pixels between those that are there. */
#ifndef ANG_RENDER_PROGRESSIVE_H
#define ANG_RENDER_PROGRESSIVE_H

#include "core/render/method.h"

/* After level 1 every 8th pixel of every 8th row is there, after level 4 each one. */
enum { ANG_PROGRESSIVE_LEVELS = 4 };

/* Zero-initialise; owns its images. */
typedef struct ang_progressive {
    ang_image image; /* once a level is done: the whole picture, what is not yet drawn filled in from what is */
    int level;       /* done; 0: none yet */
    int first;       /* the level that is drawn first, all of it at once */
    int parts;       /* drawn of the next level */
    ang_image part;
} ang_progressive;

/* Begins a picture of the scene's size with level `first`, and forgets the one before; levels before the first that is
 * worth to be seen only cost time. Methods that do not split (ang_method.splits) draw the last level alone. False with
 * ANG_LIMIT, ANG_USAGE. */
bool ang_progressive_start(ang_progressive *picture, const ang_method *method, const ang_scene *scene, int first,
                           ang_error *err);

/* Draws one level more and fills in what still lacks, bilinearly. The same method, scene and options go to all steps of
 * a picture. No pixel is drawn twice, and the last level's image is what `method` draws at once, to the bit. Where this
 * fails, as `render` does, or is interrupted, the image is that of no level until another step ends; the parts that
 * were drawn stay, and the next step goes on from there. */
bool ang_progressive_step(ang_progressive *picture, const ang_method *method, ang_renderer *renderer,
                          const ang_scene *scene, const ang_render_options *options, const ang_progress *progress,
                          ang_error *err);

/* Pixels along each axis from one that is drawn to the next after `level`, 1..ANG_PROGRESSIVE_LEVELS. */
int ang_progressive_stride(int level);

/* Frees what it holds and makes it empty. */
void ang_progressive_clear(ang_progressive *picture);

#endif
