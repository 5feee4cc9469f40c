/* Pages of grey pictures. The process keeps the file open between its pages. */
#include "core/base/memory.h"
#include "io/formats.h"
#include "io/sandbox/pool.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { page_size = 4096, longest_file = 1 << 30 };

typedef struct boxed_picture {
    ang_sandbox *sandbox; /* NULL: `here` is the module's own */
    void *here;
    ang_worker *worker; /* NULL: gone */
    ang_worker_request request;
    char label[256];
    ang_grey_form form;
} boxed_picture;

/* The whole file into the memory that the process shares. */
static bool share_file(boxed_picture *picture, const char *path, ang_error *err) {
    struct stat status;
    int fd = open(path, O_RDONLY | O_CLOEXEC);
    if (fd < 0 || fstat(fd, &status) != 0) {
        ang_fail(err, ANG_INPUT, "%s: %s", picture->label, strerror(errno));
        if (fd >= 0) close(fd);
        return false;
    }
    bool ok =
        status.st_size <= longest_file ||
        ang_fail(err, ANG_INPUT, "%s: pictures of more than 1 GB are read with --no-sandbox only", picture->label);
    size_t length = ok ? (size_t)status.st_size : 0;
    ok = ok && ang_worker_reserve(picture->worker, length + 1, err);
    for (size_t done = 0; ok && done < length;) {
        ssize_t got = pread(fd, picture->worker->shared + done, length - done, (off_t)done);
        if (got < 0 && errno == EINTR) continue;
        ok = got > 0 || ang_fail(err, ANG_INPUT, "%s: cannot be read", picture->label);
        done += got > 0 ? (size_t)got : 0;
    }
    close(fd);
    picture->request.length = length;
    picture->request.offset = (length + page_size - 1) / page_size * page_size;
    return ok;
}

static bool ask(boxed_picture *picture, ang_worker_task task, size_t pixels, ang_worker_reply *reply, ang_error *err) {
    bool gone;
    char what[300];
    snprintf(what, sizeof what, "%s:", picture->label);
    picture->request.task = (int32_t)task;
    picture->request.total = picture->worker->size;
    bool done = ang_sandbox_ask(picture->worker, &picture->request, pixels, what, reply, &gone, err);
    if (gone) {
        ang_worker_stop(picture->worker);
        picture->worker = NULL;
    }
    return done;
}

/* Nothing is allocated for a form that cannot be. */
static bool take_form(boxed_picture *picture, const ang_worker_reply *reply, ang_error *err) {
    picture->form = (ang_grey_form){reply->width, reply->height, reply->pages, (ang_sample)reply->type};
    if (reply->width >= 1 && reply->height >= 1 && reply->pages >= 1 && reply->type >= 0 &&
        reply->type <= ANG_SAMPLE_F64)
        return true;
    return ang_fail(err, ANG_INPUT, "%s: cannot be read as a picture", picture->label);
}

void *ang_sandbox_grey_open(ang_sandbox *sandbox, const char *path, ang_grey_form *form, ang_error *err) {
    boxed_picture *picture = ang_alloc(1, sizeof *picture, "a picture", err);
    if (!picture) return NULL;
    bool ok;
    ang_worker_reply reply;
    snprintf(picture->label, sizeof picture->label, "%s", ang_base_name(path));
    snprintf(picture->request.name, sizeof picture->request.name, "%s", picture->label);
    picture->sandbox = sandbox;
    if (!sandbox) {
        picture->here = ang_oiio_grey_open(path, &picture->form, err);
        ok = picture->here != NULL;
    } else {
        picture->worker = ang_sandbox_take(sandbox, err);
        ok = picture->worker && share_file(picture, path, err) && ask(picture, ANG_WORKER_OPEN, 0, &reply, err) &&
             take_form(picture, &reply, err);
    }
    if (ok) {
        *form = picture->form;
        return picture;
    }
    ang_sandbox_grey_close(picture);
    return NULL;
}

bool ang_sandbox_grey_read(void *handle, int page, void *out, ang_error *err) {
    boxed_picture *picture = handle;
    if (!picture->sandbox) return ang_oiio_grey_read(picture->here, page, out, err);
    if (!picture->worker) return ang_fail(err, ANG_INPUT, "%s: cannot be read further", picture->label);
    size_t size =
        ang_product3((size_t)picture->form.width, (size_t)picture->form.height, ang_sample_size(picture->form.type));
    if (size == 0) return ang_fail(err, ANG_INPUT, "%s: its pages are too large", picture->label);
    ang_worker_request *request = &picture->request;
    request->page = page;
    request->size = size;
    /* The memory may only grow while nothing is open in it. */
    size_t needed = request->offset + size;
    ang_worker_reply reply;
    if (needed > picture->worker->size &&
        (!ang_worker_reserve(picture->worker, needed, err) || !ask(picture, ANG_WORKER_OPEN, 0, &reply, err)))
        return false;
    if (!ask(picture, ANG_WORKER_PAGE, (size_t)picture->form.width * (size_t)picture->form.height, &reply, err))
        return false;
    memcpy(out, picture->worker->shared + request->offset, size);
    return true;
}

void ang_sandbox_grey_close(void *handle) {
    boxed_picture *picture = handle;
    if (picture->here) ang_oiio_grey_close(picture->here);
    if (picture->worker) ang_sandbox_give_back(picture->sandbox, picture->worker);
    free(picture);
}
