/* Volume properties of 3D Slicer and VTK: what those programs call a preset. Three forms of files are read and written:
 *   .vp       nine lines: interpolation, shade, diffuse, ambient, specular, specular power, scalar opacity, gradient
 *             opacity, colour (vtkMRMLVolumePropertyStorageNode)
 *   .xml      MRML, a VolumeProperty element a preset, as in Slicer's presets.xml (vtkMRMLVolumePropertyNode)
 *   .vp.json  volume-property-schema-v1 (vtkMRMLVolumePropertyJsonStorageNode)
 * Functions are "N v v v ...", N counting numbers, in the first two forms. Only the third tells a unit distance;
 * without one it is VTK's default, 1 mm. */
#ifndef ANG_IO_SLICER_PROPERTY_H
#define ANG_IO_SLICER_PROPERTY_H

#include "core/base/error.h"
#include "core/base/notes.h"
#include "core/transfer/preset.h"

#include <stdbool.h>
#include <stddef.h>

typedef enum ang_property_form {
    ANG_PROPERTY_NONE, /* not a volume property's name */
    ANG_PROPERTY_VP,
    ANG_PROPERTY_XML,
    ANG_PROPERTY_JSON
} ang_property_form;

/* By the file's name. */
ang_property_form ang_property_form_of(const char *path);

/* A point of a function of the value: `y` has one number (opacity) or three (colour). */
typedef struct ang_property_point {
    double x;
    double y[3];
    double midpoint, sharpness; /* of the piece that begins here, as in vtkPiecewiseFunction: 0.5 and 0 is a line */
} ang_property_point;

/* Owns `points`. By rising x; two at one x are a step. */
typedef struct ang_property_function {
    ang_property_point *points;
    size_t count;
    int channels; /* 1 or 3 */
} ang_property_function;

/* A volume property as its file has it, of one component. Owns what it points to. */
typedef struct ang_property {
    char *name;
    bool nearest; /* values are not interpolated */
    bool shade;
    double ambient, diffuse, specular, power;
    double unit_distance; /* mm */
    bool unit_given;      /* the file tells it */
    bool gradient_off;    /* gradient opacity is there but not in use */
    double iso;           /* the first iso value; NaN: none */
    size_t iso_count;     /* how many there are */
    size_t components;    /* in the file, of which the first is kept */
    ang_property_function opacity, gradient, colour;
} ang_property;

/* All of one file. */
typedef struct ang_property_list {
    ang_property *item;
    size_t count;
} ang_property_list;

void ang_property_clear(ang_property *property);
void ang_property_list_clear(ang_property_list *list);

/* Reads `size` bytes of a file of this form; `file` labels errors and, where the form has no name, gives it. False with
 * ANG_USAGE and a sentence with file, line or preset; ANG_LIMIT. Pure but for memory; thread safe. */
bool ang_property_parse(ang_property_form form, const char *file, const char *text, size_t size,
                        ang_property_list *list, ang_error *err);
/* The same from the file itself, of at most 4 MB. ANG_USAGE too where it cannot be read or is of none of the forms. */
bool ang_property_read(const char *path, ang_property_list *list, ang_error *err);

/* The values of a function at x just below it and from it on, as VTK has them: end values hold outside, pieces are as
 * midpoint and sharpness say. Zeros where there are no points. */
void ang_property_value(const ang_property_function *function, double x, bool below, double y[3]);

/* A preset of a property: points wherever opacity or colour has one, and more where a piece is no line, so that opacity
 * and colour differ by at most 1/1000. What is lost or assumed goes to `notes`, a sentence each. NULL with ANG_USAGE
 * (nothing in it, numbers out of range) or ANG_LIMIT. Free with ang_preset_free. */
ang_preset *ang_property_to_preset(const ang_property *property, ang_notes *notes, ang_error *err);
/* The other way. `keeps_unit`: the form tells the unit distance; else opacities become those of 1 mm, with points
 * between so that they differ by at most 1/1000. False with ANG_LIMIT. Clear with ang_property_clear. */
bool ang_property_from_preset(const ang_preset *preset, bool keeps_unit, ang_property *property, ang_notes *notes,
                              ang_error *err);

/* The text of a file of this form. .vp has room for one, else ANG_USAGE; what Slicer would not read of it goes to
 * `notes`. NULL with ANG_LIMIT. Free with free(). */
char *ang_property_print(ang_property_form form, const ang_property_list *list, ang_notes *notes, ang_error *err);

#endif
