#include "app/verb_table.h"

/* What PATH may be: docs/formats.md. */
#define INPUTS                                                                                                         \
    "PATH is a folder or file of DICOM, or NIfTI-1, NRRD, MetaImage, a folder of numbered PNG or TIFF pictures, a "    \
    "TIFF of many pages, a raw volume, or a zip archive of any of these."

const ang_verb_entry ang_verb_table[] = {
    {"view", ANG_VERB_VIEW, "[view] [PATH...] [options]", "a window with slices and volume rendering",
     "Opens a window with three linked slices and a volume rendering of what is in PATH, or a browser of files without "
     "one. F1 lists its keys. The verb may be left out. " INPUTS,
     NULL, true},
    {"info", ANG_VERB_INFO, "info PATH [options]", "what is in a folder or file, and what was assumed",
     "Lists the series in PATH, and for the one chosen its geometry and every assumption and warning of loading "
     "it. " INPUTS,
     NULL, true},
    {"render", ANG_VERB_RENDER, "render PATH -o OUT.png [options]", "a picture of a volume",
     "Writes a picture of a volume, or several. Needs no display, and OpenGL only for the methods that use it. " INPUTS,
     NULL, true},
    {"report", ANG_VERB_REPORT, "report PATH -o DIR [options]",
     "error against run time, all methods, as a page to read",
     "Draws one scene with every method over many steps, compares the pictures with the exact one, and writes what "
     "follows as report.html, .csv and .json. An interrupted report goes on when it is asked for again.",
     NULL, true},
    {"presets", ANG_VERB_PRESETS, "presets list|show|import|export|sheet ...",
     "the presets there are; from and for 3D Slicer; a sheet of their pictures",
     "Lists the presets, the user's own before those of the installation, prints one as JSON, takes over and writes "
     "those of "
     "3D Slicer, or draws a volume with each of them on one sheet.",
     "list|show|import|export|sheet", true},
    {"phantom", ANG_VERB_PHANTOM, "phantom -o DIR [options]", "a synthetic head CTA as a DICOM series",
     "Writes a synthetic CT angiogram of a head as a DICOM series, with what is in it, exactly, in truth.json.", NULL,
     false},
    {"check", ANG_VERB_CHECK, "check A.png B.png [options]", "how far two pictures differ",
     "Prints the largest and the RMS difference in levels of 255, PSNR and SSIM of two pictures of one size.", NULL,
     true},
    {"selfcheck", ANG_VERB_SELFCHECK, "selfcheck [options]", "stiff and extreme scenes on this machine's OpenGL",
     "Draws scenes whose pictures are known with every method on every OpenGL of this machine, and says what was "
     "measured and what is allowed.",
     NULL, false},
};
const int ang_verb_count = sizeof ang_verb_table / sizeof *ang_verb_table;

const ang_exit_code ang_exit_codes[] = {
    {ANG_OK, "ok", "Everything was done."},
    {ANG_CHECK_FAILED, "pictures differ", "Pictures differ by more than is allowed: check, selfcheck."},
    {ANG_USAGE, "usage", "The command line cannot be understood, or a preset or state is broken or unknown."},
    {ANG_INPUT, "input", "The input cannot be read, or holds no volume."},
    {ANG_GEOMETRY, "geometry", "The slices make no volume that could be shown truly; with --strict, any warning."},
    {ANG_GL, "no OpenGL", "There is no OpenGL that can draw what was asked for."},
    {ANG_LIMIT, "memory", "There is not enough memory, or a limit of the textures is passed."},
    {ANG_OUTPUT, "output", "An output cannot be written; what was there before is untouched."},
    {ANG_INTERRUPTED, "interrupted", "It was interrupted by SIGINT or SIGTERM."},
};
const int ang_exit_code_count = sizeof ang_exit_codes / sizeof *ang_exit_codes;
