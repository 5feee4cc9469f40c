#include "ui/host/loading.h"

#include "core/base/clock.h"
#include "core/base/memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double wake_every_ms = 50;
static const double picture_every_ms = 40; /* a preview takes as long as reading a slice */

static bool update(void *context, const char *what, double fraction) {
    ang_loading *loading = context;
    double now = ang_now_ms();
    pthread_mutex_lock(&loading->lock);
    snprintf(loading->what, sizeof loading->what, "%s", what);
    loading->fraction = fraction;
    bool going = !loading->stop, wake = now - loading->told_ms >= wake_every_ms;
    if (wake) loading->told_ms = now;
    pthread_mutex_unlock(&loading->lock);
    if (wake) ang_window_wake();
    return going;
}

/* One reader at a time makes a picture, and none before the last has been taken: others go on reading. */
static void take_slice(void *context, const ang_raw_slice *slice) {
    ang_loading *loading = context;
    if (!loading->next || atomic_exchange(&loading->previewing, true)) return;
    double now = ang_now_ms();
    if (now - loading->pictured_ms < picture_every_ms) {
        atomic_store(&loading->previewing, false);
        return;
    }
    loading->pictured_ms = now;
    ang_preview_make(slice, ANG_PREVIEW_SIDE, loading->next);
    pthread_mutex_lock(&loading->lock);
    loading->next_index = slice->index;
    loading->next_count = slice->count;
    loading->fresh = true;
    pthread_mutex_unlock(&loading->lock);
    ang_window_wake();
}

static void *work(void *argument) {
    ang_loading *loading = argument;
    const ang_viewer_host *host = loading->host;
    ang_progress progress = {.update = update, .context = loading};
    ang_slice_sink slices = {take_slice, loading};
    bool done = host->load(host->context, &loading->source, &slices, &loading->study, &progress, &loading->err);
    pthread_mutex_lock(&loading->lock);
    loading->done = done;
    loading->finished = true;
    pthread_mutex_unlock(&loading->lock);
    ang_window_wake();
    return NULL;
}

bool ang_loading_start(ang_loading *loading, const ang_viewer_host *host, ang_source *source, ang_error *err) {
    *loading = (ang_loading){.host = host};
    ang_source_move(&loading->source, source);
    if (loading->source.count == 0) return ang_fail(err, ANG_LIMIT, "no memory for a path");
    loading->next = calloc(1, sizeof *loading->next); /* without memory there are no previews */
    pthread_mutex_init(&loading->lock, NULL);
    loading->running = pthread_create(&loading->thread, NULL, work, loading) == 0;
    if (loading->running) return true;
    pthread_mutex_destroy(&loading->lock);
    ang_source_clear(&loading->source);
    free(loading->next);
    return ang_fail(err, ANG_LIMIT, "no thread can be made for loading");
}

double ang_loading_progress(ang_loading *loading, char what[64]) {
    pthread_mutex_lock(&loading->lock);
    memcpy(what, loading->what, 64);
    double fraction = loading->fraction;
    pthread_mutex_unlock(&loading->lock);
    return fraction;
}

bool ang_loading_preview(ang_loading *loading, ang_preview *preview, size_t *index, size_t *count) {
    if (!loading->running) return false;
    pthread_mutex_lock(&loading->lock);
    bool fresh = loading->fresh;
    if (fresh) {
        *preview = *loading->next;
        *index = loading->next_index;
        *count = loading->next_count;
        loading->fresh = false;
        atomic_store(&loading->previewing, false);
    }
    pthread_mutex_unlock(&loading->lock);
    return fresh;
}

void ang_loading_stop(ang_loading *loading) {
    if (!loading->running) return;
    pthread_mutex_lock(&loading->lock);
    loading->stop = true;
    pthread_mutex_unlock(&loading->lock);
}

bool ang_loading_stopping(ang_loading *loading) {
    if (!loading->running) return false;
    pthread_mutex_lock(&loading->lock);
    bool stop = loading->stop;
    pthread_mutex_unlock(&loading->lock);
    return stop;
}

static void join(ang_loading *loading) {
    pthread_join(loading->thread, NULL);
    pthread_mutex_destroy(&loading->lock);
    free(loading->next);
    loading->next = NULL;
    loading->running = false;
}

bool ang_loading_take(ang_loading *loading, bool *done, ang_source *source, ang_study *study, ang_error *err) {
    if (!loading->running) return false;
    pthread_mutex_lock(&loading->lock);
    bool finished = loading->finished;
    pthread_mutex_unlock(&loading->lock);
    if (!finished) return false;
    join(loading);
    ang_source_move(source, &loading->source);
    *done = loading->done;
    *study = loading->study;
    *err = loading->err;
    return true;
}

void ang_loading_end(ang_loading *loading) {
    if (!loading->running) return;
    ang_loading_stop(loading);
    join(loading);
    ang_source_clear(&loading->source);
    if (loading->done) loading->host->release(loading->host->context, &loading->study);
}
