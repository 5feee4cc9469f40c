/* Grey pictures as voxels, page after page. */
#include "core/base/memory.h"
#include "io/formats.h"
#include "io/image/encode.h"
#include "io/voxels/decoder.h"

#include <stdlib.h>
#include <string.h>

typedef struct paging {
    void *pictures;
    ang_grey_form form;
    int next;       /* page to be read next */
    size_t at, end; /* of the page that is held */
    uint8_t page[];
} paging;

static void *start(FILE *file, const ang_byte_parts *parts, const ang_byte_part *part, ang_error *err) {
    (void)file;
    const char *label = ang_base_name(part->path);
    ang_grey_form form;
    void *pictures = ang_sandbox_grey_open(parts->sandbox, part->path, &form, err);
    if (!pictures) return NULL;
    bool alike = form.width == parts->width && form.height == parts->height &&
                 (form.type == parts->type || ang_sample_signed(form.type) == parts->type);
    if (!alike)
        ang_fail(err, ANG_INPUT,
                 "%s: is %d x %d of %zu bit, unlike the first of its stack, %d x %d of %zu bit, or of "
                 "another number type",
                 label, form.width, form.height, 8 * ang_sample_size(form.type), parts->width, parts->height,
                 8 * ang_sample_size(parts->type));
    size_t bytes = ang_product3((size_t)form.width, (size_t)form.height, ang_sample_size(form.type));
    paging *self = alike ? ang_alloc(1, sizeof *self + bytes, label, err) : NULL;
    if (!self) {
        ang_sandbox_grey_close(pictures);
        return NULL;
    }
    *self = (paging){.pictures = pictures, .form = form, .at = bytes, .end = bytes};
    return self;
}

static ptrdiff_t read_pages(void *context, uint8_t *out, size_t size, ang_error *err) {
    paging *self = context;
    if (self->at == self->end) {
        if (self->next == self->form.pages) return 0;
        if (!ang_sandbox_grey_read(self->pictures, self->next++, self->page, err)) return -1;
        self->at = 0;
    }
    size_t length = self->end - self->at < size ? self->end - self->at : size;
    memcpy(out, self->page + self->at, length);
    self->at += length;
    return (ptrdiff_t)length;
}

static void end(void *context) {
    paging *self = context;
    ang_sandbox_grey_close(self->pictures);
    free(self);
}

const ang_decoder ang_decoder_picture = {start, read_pages, end};
