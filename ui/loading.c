#include "ui/loading.h"

#include "core/base/clock.h"
#include "ui/toolkit/window.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double wake_every_ms = 50;

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

static void *work(void *argument) {
    ang_loading *loading = argument;
    ang_progress progress = {update, loading};
    bool done = loading->host->load(loading->host->context, loading->path, &loading->study, &progress, &loading->err);
    pthread_mutex_lock(&loading->lock);
    loading->done = done;
    loading->finished = true;
    pthread_mutex_unlock(&loading->lock);
    ang_window_wake();
    return NULL;
}

bool ang_loading_start(ang_loading *loading, const ang_viewer_host *host, const char *path, ang_error *err) {
    *loading = (ang_loading){.host = host, .path = strdup(path)};
    if (!loading->path) return ang_fail(err, ANG_LIMIT, "no memory for a path");
    pthread_mutex_init(&loading->lock, NULL);
    loading->running = pthread_create(&loading->thread, NULL, work, loading) == 0;
    if (loading->running) return true;
    pthread_mutex_destroy(&loading->lock);
    free(loading->path);
    loading->path = NULL;
    return ang_fail(err, ANG_LIMIT, "no thread can be made for loading");
}

double ang_loading_progress(ang_loading *loading, char what[64]) {
    pthread_mutex_lock(&loading->lock);
    memcpy(what, loading->what, 64);
    double fraction = loading->fraction;
    pthread_mutex_unlock(&loading->lock);
    return fraction;
}

void ang_loading_stop(ang_loading *loading) {
    if (!loading->running) return;
    pthread_mutex_lock(&loading->lock);
    loading->stop = true;
    pthread_mutex_unlock(&loading->lock);
}

static void join(ang_loading *loading) {
    pthread_join(loading->thread, NULL);
    pthread_mutex_destroy(&loading->lock);
    free(loading->path);
    loading->path = NULL;
    loading->running = false;
}

bool ang_loading_take(ang_loading *loading, bool *done, ang_study *study, ang_error *err) {
    if (!loading->running) return false;
    pthread_mutex_lock(&loading->lock);
    bool finished = loading->finished;
    pthread_mutex_unlock(&loading->lock);
    if (!finished) return false;
    join(loading);
    *done = loading->done;
    *study = loading->study;
    *err = loading->err;
    return true;
}

void ang_loading_end(ang_loading *loading) {
    if (!loading->running) return;
    ang_loading_stop(loading);
    join(loading);
    if (loading->done) loading->host->release(loading->host->context, &loading->study);
}
