/* Volumes as dcm2niix reads them. Define SCRATCH, a folder of its own, before this; needs tests/io/loading.h. */
#ifndef ANG_TESTS_IO_DCM2NIIX_H
#define ANG_TESTS_IO_DCM2NIIX_H

typedef struct nifti {
    int dim[3], type;
    double slope, inter, srow[3][4];
    uint8_t *bytes, *voxels;
} nifti;

static inline nifti read_nifti(const char *path) {
    nifti n = {0};
    FILE *in = fopen(path, "rb");
    assert_non_null(in);
    fseek(in, 0, SEEK_END);
    size_t size = (size_t)ftell(in);
    rewind(in);
    n.bytes = malloc(size);
    assert_int_equal(fread(n.bytes, 1, size, in), size);
    fclose(in);
    int16_t dim[8], type;
    float offset, slope, inter, srow[12];
    memcpy(dim, n.bytes + 40, sizeof dim);
    memcpy(&type, n.bytes + 70, 2);
    memcpy(&offset, n.bytes + 108, 4);
    memcpy(&slope, n.bytes + 112, 4);
    memcpy(&inter, n.bytes + 116, 4);
    memcpy(srow, n.bytes + 280, sizeof srow);
    for (int i = 0; i < 3; i++) n.dim[i] = dim[i + 1];
    n.type = type;
    n.slope = slope != 0 ? (double)slope : 1;
    n.inter = slope != 0 ? (double)inter : 0;
    for (int i = 0; i < 12; i++) n.srow[i / 4][i % 4] = (double)srow[i];
    n.voxels = n.bytes + (size_t)offset;
    return n;
}

static inline double nifti_hu(const nifti *n, size_t index) {
    int16_t value;
    memcpy(&value, n->voxels + 2 * index, 2);
    double stored = n->type == 512 ? (double)(uint16_t)value : (double)value;
    return n->slope * stored + n->inter;
}

/* Skips the test where dcm2niix is not installed. */
static inline void need_dcm2niix(void) {
    if (system("dcm2niix -h > /dev/null 2>&1") == 0) return;
    print_message("skipped: dcm2niix is not installed\n");
    skip();
}

/* Loads `folder` here and by dcm2niix, whose file is called `name` where its option -f is `format`: the same values at
 * the same places. */
static inline void compare_dcm2niix(const char *folder, const char *format, const char *name) {
    fresh_folder(SCRATCH);
    char command[1024];
    snprintf(command, sizeof command, "dcm2niix -z n -b n -f '%s' -o '" SCRATCH "' '%s' > '" SCRATCH "/log' 2>&1",
             format, folder);
    assert_int_equal(system(command), 0);
    char path[512];
    snprintf(path, sizeof path, SCRATCH "/%s.nii", name);
    nifti n = read_nifti(path);
    ang_load_report report;
    ang_volume *v = load(folder, &report);
    assert_true(n.type == 4 || n.type == 512);
    for (int i = 0; i < 3; i++) assert_int_equal(n.dim[i], v->dims[i]);
    /* dcm2niix turns the rows over: its row j is ours height - 1 - j. Same points in the patient, RAS against LPS. */
    for (int corner = 0; corner < 8; corner++) {
        int x = corner & 1 ? v->dims[0] - 1 : 0, y = corner & 2 ? v->dims[1] - 1 : 0,
            z = corner & 4 ? v->dims[2] - 1 : 0;
        ang_vec3 p = ang_mat4_point(&v->affine, (ang_vec3){x, y, z});
        double q[3], ours[3] = {-p.x, -p.y, p.z};
        for (int r = 0; r < 3; r++)
            q[r] = n.srow[r][0] * x + n.srow[r][1] * (v->dims[1] - 1 - y) + n.srow[r][2] * z + n.srow[r][3];
        for (int r = 0; r < 3; r++) assert_float_equal(q[r], ours[r], 2e-3);
    }
    size_t index = 0, wrong = 0;
    for (int z = 0; z < v->dims[2]; z++) {
        for (int y = 0; y < v->dims[1]; y++) {
            for (int x = 0; x < v->dims[0]; x++, index++) {
                size_t theirs =
                    ((size_t)z * (size_t)v->dims[1] + (size_t)(v->dims[1] - 1 - y)) * (size_t)v->dims[0] + (size_t)x;
                double hu = ang_volume_is_padding(v, index) ? report.padding_hu : ang_volume_hu(v, v->data[index]);
                wrong += hu != nifti_hu(&n, theirs);
            }
        }
    }
    assert_int_equal(wrong, 0);
    free(n.bytes);
    ang_volume_free(v);
    ang_load_report_clear(&report);
}

#endif
