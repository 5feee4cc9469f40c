#include "ui/host/surveying.h"

#include <string.h>

static bool update(void *context, const char *what, double fraction) {
    (void)what;
    (void)fraction;
    ang_surveying *surveying = context;
    pthread_mutex_lock(&surveying->lock);
    bool going = !surveying->stop;
    pthread_mutex_unlock(&surveying->lock);
    return going;
}

static void listed(void *context, const ang_series_list *list) {
    ang_surveying *surveying = context;
    pthread_mutex_lock(&surveying->lock);
    if (ang_series_list_make(&surveying->found, list->count)) {
        memcpy(surveying->found.entry, list->entry, list->count * sizeof *list->entry);
        surveying->listed = true;
    }
    pthread_mutex_unlock(&surveying->lock);
    ang_window_wake();
}

static void looked_at(void *context, size_t index, const ang_series_entry *entry) {
    ang_surveying *surveying = context;
    pthread_mutex_lock(&surveying->lock);
    if (index < surveying->found.count) {
        surveying->found.entry[index] = *entry;
        surveying->looked_at = index + 1;
    }
    pthread_mutex_unlock(&surveying->lock);
    ang_window_wake();
}

static void *work(void *argument) {
    ang_surveying *surveying = argument;
    ang_progress progress = {.update = update, .context = surveying};
    ang_series_sink sink = {listed, looked_at, surveying};
    ang_error err = {0};
    bool done = surveying->host->survey(surveying->host->context, &surveying->source, &sink, &progress, &err);
    pthread_mutex_lock(&surveying->lock);
    if (!done) surveying->err = err;
    surveying->finished = true;
    pthread_mutex_unlock(&surveying->lock);
    ang_window_wake();
    return NULL;
}

bool ang_surveying_start(ang_surveying *surveying, const ang_viewer_host *host, const ang_source *source,
                         ang_error *err) {
    *surveying = (ang_surveying){.host = host, .source = ang_source_of_series(source, 0)};
    if (surveying->source.count == 0) return ang_fail(err, ANG_LIMIT, "no memory for a path");
    pthread_mutex_init(&surveying->lock, NULL);
    surveying->running = pthread_create(&surveying->thread, NULL, work, surveying) == 0;
    if (surveying->running) return true;
    pthread_mutex_destroy(&surveying->lock);
    ang_source_clear(&surveying->source);
    return ang_fail(err, ANG_LIMIT, "no thread can be made for looking at series");
}

int ang_surveying_take(ang_surveying *surveying, ang_series_list *list, bool *listed) {
    int index = -1;
    *listed = false;
    if (!surveying->running) return -1;
    pthread_mutex_lock(&surveying->lock);
    const ang_series_list *found = &surveying->found;
    if (surveying->listed && ang_series_list_make(list, found->count)) {
        memcpy(list->entry, found->entry, found->count * sizeof *found->entry);
        *listed = true;
    }
    surveying->listed = false;
    if (surveying->next < surveying->looked_at && surveying->next < list->count) {
        index = (int)surveying->next++;
        list->entry[index] = found->entry[index];
    }
    pthread_mutex_unlock(&surveying->lock);
    return index;
}

static void join(ang_surveying *surveying) {
    pthread_join(surveying->thread, NULL);
    pthread_mutex_destroy(&surveying->lock);
    ang_series_list_clear(&surveying->found);
    ang_source_clear(&surveying->source);
    surveying->running = false;
}

bool ang_surveying_finished(ang_surveying *surveying, ang_error *err) {
    if (!surveying->running) return false;
    pthread_mutex_lock(&surveying->lock);
    bool finished = surveying->finished && !surveying->listed && surveying->next >= surveying->looked_at;
    pthread_mutex_unlock(&surveying->lock);
    if (!finished) return false;
    *err = surveying->err;
    join(surveying);
    return true;
}

void ang_surveying_stop(ang_surveying *surveying) {
    if (!surveying->running) return;
    pthread_mutex_lock(&surveying->lock);
    surveying->stop = true;
    pthread_mutex_unlock(&surveying->lock);
}

void ang_surveying_end(ang_surveying *surveying) {
    if (!surveying->running) return;
    ang_surveying_stop(surveying);
    join(surveying);
}
