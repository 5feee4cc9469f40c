#include "ui/panels/cutting_panel.h"

#include "core/scene/annotation.h"
#include "ui/viewer_private.h"

#include <math.h>
#include <stdio.h>

/* Of two fields in the rest of a line. */
static double half_room(const ang_gui *gui) { return (ang_gui_room(gui) - ang_gui_px(gui, 8)) / 2; }

/* From where to where, in mm from the first voxel as in --clip, along each of the volume's axes. */
static void crop_fields(ang_viewer *viewer) {
    static const char *const names[ANG_CROP_FACES] = {"##crop0", "##crop1", "##crop2", "##crop3", "##crop4", "##crop5"};
    ang_gui *gui = viewer->gui;
    const ang_volume *volume = viewer->study.volume;
    double width = 0;
    ang_crop_box whole;
    ang_volume_box(volume, &whole.lower, &whole.upper);
    for (int face = 0; face < ANG_CROP_FACES; face++) {
        int axis = face / 2;
        ang_crop_box box = ang_crop_box_of(&viewer->document);
        double spacing = ang_volume_spacing(volume, axis), mm = ang_crop_face_at(&box, face) * spacing;
        ang_vec3 along = ang_mat4_column(&volume->affine, axis);
        char from = ang_letters_make(ang_vec3_scale(along, -1)).text[0], to = ang_letters_make(along).text[0], text[32];
        if (face % 2 == 0) {
            snprintf(text, sizeof text, "%c to %c", from, to);
            ang_gui_label(gui, text);
            width = half_room(gui);
        } else {
            ang_gui_same_line(gui);
        }
        if (ang_gui_number(gui, names[face], &mm, spacing / 2, ang_crop_face_at(&whole, face - face % 2) * spacing,
                           ang_crop_face_at(&whole, face - face % 2 + 1) * spacing, "%.1f mm", width)) {
            ang_crop_face_move(&box, volume, face, mm / spacing);
            ang_crop_box_set(&viewer->document, &box);
            viewer->document.crop = true;
        }
        ang_gui_tooltip(gui, "Millimetres from the first voxel along the volume's own axis, as in --clip");
    }
}

static void crop(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    ang_crop_box box = ang_crop_box_of(&viewer->document);
    ang_gui_label(gui, "Crop box");
    double half = half_room(gui);
    ang_gui_checkbox(gui, "Crop##crop", &viewer->document.crop);
    ang_gui_tooltip(gui, "Off keeps the box. The tool \"crop\" (key X) shows its handles.");
    ang_gui_same_line(gui);
    ang_gui_skip(gui, ang_gui_room(gui) - half); /* above the second field of the lines below */
    if (ang_gui_button(gui, "Reset##crop", half, !ang_crop_box_whole(&box, viewer->study.volume)))
        ang_crop_reset(viewer, 0);
    ang_gui_tooltip(gui, "The whole volume");
    if (viewer->document.crop || viewer->tool == ANG_TOOL_CROP) crop_fields(viewer);
}

static void plane_fields(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    ang_clip_plane *clip = &viewer->document.clip;
    double azimuth, elevation, offset = ang_clip_offset(clip, viewer->study.volume);
    ang_clip_plane_angles(clip, &azimuth, &elevation);
    ang_gui_label(gui, "Direction");
    double half = half_room(gui);
    bool turned = ang_gui_number(gui, "##clip-azimuth", &azimuth, 0.5, -180, 180, "%.1f\xc2\xb0", half);
    ang_gui_tooltip(gui, "Azimuth of what is cut away: 0 towards the front, 90 towards the patient's left");
    ang_gui_same_line(gui);
    turned |= ang_gui_number(gui, "##clip-elevation", &elevation, 0.5, -90, 90, "%.1f\xc2\xb0", half);
    ang_gui_tooltip(gui, "Elevation of what is cut away: 90 towards the head");
    if (turned) {
        viewer->cutting.pivot = ang_cutting_foot(viewer);
        *clip = ang_clip_plane_turned(viewer->cutting.pivot, azimuth, elevation);
    }
    ang_gui_label(gui, "Distance");
    if (ang_gui_number(gui, "##clip-offset", &offset, 0.25, -1e4, 1e4, "%.1f mm", half))
        *clip = ang_clip_plane_moved(clip, viewer->study.volume, offset - ang_clip_offset(clip, viewer->study.volume));
    ang_gui_tooltip(gui, "Of the plane from the volume's centre, towards what is cut away");
    ang_gui_same_line(gui);
    if (ang_gui_button(gui, "Other side##clip", half, true)) ang_clip_flip(viewer, 0);
    ang_gui_tooltip(gui, "Cuts away what it showed, and shows what it cut away");
}

void ang_cutting_panel(ang_viewer *viewer) {
    ang_gui *gui = viewer->gui;
    ang_gui_heading(gui, "CROP AND CLIP");
    crop(viewer);
    bool clips = ang_clip_plane_given(&viewer->document.clip);
    ang_gui_label(gui, "Clip plane");
    double half = half_room(gui);
    if (ang_gui_checkbox(gui, "Clip##clip", &clips)) ang_clip_toggle(viewer, 0);
    ang_gui_tooltip(gui,
                    "A plane through the crosshair that cuts away what is before it. The tool \"crop\" (key X) shows "
                    "its handles.");
    ang_gui_same_line(gui);
    ang_gui_skip(gui, ang_gui_room(gui) - half);
    if (ang_gui_button(gui, "Facing me##clip", half, true)) ang_clip_face_viewer(viewer, 0);
    ang_gui_tooltip(gui, "Through the crosshair, across the line of sight. Key K.");
    if (ang_clip_plane_given(&viewer->document.clip)) plane_fields(viewer);
}
