/* What is written onto a picture: orientation letters, a millimetre bar, preset and mode. Drawn by io/image/annotate.h.
 */
#ifndef ANG_SCENE_ANNOTATION_H
#define ANG_SCENE_ANNOTATION_H

#include "core/scene/scene.h"

/* The letters of a direction in the patient, largest component first (DICOM PS3.3 C.7.6.1.1.1), and an end. */
typedef struct ang_letters {
    char text[4];
} ang_letters;

/* Words in the picture, centred. */
typedef struct ang_annotation_label {
    double x, y; /* pixels from the left top corner */
    char text[24];
} ang_annotation_label;

enum { ANG_ANNOTATION_LABELS = 80 }; /* at most; more are left out */

/* Plain value, owns nothing. */
typedef struct ang_annotation {
    ang_letters left, right, top, bottom; /* where each edge of the picture points to in the patient */
    double mm_per_pixel;                  /* at the depth of the box's centre; NAN where there is none */
    double bar_mm;                        /* 1, 2 or 5 times a power of ten; 0: no bar */
    double bar_pixels;                    /* its length in the picture */
    char bar_label[48];                   /* "50 mm", in perspective "50 mm at the centre" */
    bool dark_ink;                        /* black with a light outline, for light backgrounds; else white */
    char caption[128];                    /* "cta-head, dvr" */
    char remark[96];                      /* a line above the caption; empty: none */
    ang_annotation_label label[ANG_ANNOTATION_LABELS]; /* of the scene's objects */
    int labels;
} ang_annotation;

/* Letters of a direction in LPS: L R for x, P A for y, H F for z; the largest component first, then each further one
 * above 0.38 of the largest (about 21 degrees). Empty for a zero or not finite vector. */
ang_letters ang_letters_make(ang_vec3 direction);

/* The greatest of 1, 2, 5 times a power of ten that is at most `limit` (> 0); 0 where `limit` is not positive. */
double ang_round_length(double limit);

/* Where the scene's picture shows a place (LPS mm), in pixels from its left top corner, and how far away it is along
 * the line of sight, in mm. False where it lies beside or behind the eye. */
bool ang_annotation_place(const ang_scene *scene, ang_vec3 at, double *x, double *y, double *depth_mm);

/* What to write on the scene's picture. The bar is the longest round length within a fifth of the picture's width.
 * `preset_name` (NULL: none) is shown as given: a preset's own name, never a path. Pure, thread safe. */
ang_annotation ang_annotation_make(const ang_scene *scene, const char *preset_name);
/* Only the labels of the scene's objects. */
ang_annotation ang_annotation_of_objects(const ang_scene *scene);

/* Makes the remark say about how wrong the picture is and how long it took: its largest error in levels, rounded up to
 * two figures, or where that is NAN its RMS, or that neither is known. */
void ang_annotation_add_error(ang_annotation *annotation, double levels, double rms, double milliseconds);

#endif
