#include "core/base/parallel.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>

typedef struct job {
    size_t count, grain;
    atomic_size_t next;
    ang_parallel_body *body;
    void *context;
} job;

typedef struct worker {
    job *job;
    int index;
} worker;

int ang_thread_count(int requested) {
    if (requested > 0) return requested < ANG_MAX_THREADS ? requested : ANG_MAX_THREADS;
    cpu_set_t set;
    int count = sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
    return count < 1 ? 1 : count < ANG_MAX_THREADS ? count : ANG_MAX_THREADS;
}

static void *work(void *argument) {
    worker *self = argument;
    job *job = self->job;
    for (;;) {
        size_t begin = atomic_fetch_add_explicit(&job->next, job->grain, memory_order_relaxed);
        if (begin >= job->count) return NULL;
        size_t end = job->count - begin > job->grain ? begin + job->grain : job->count;
        job->body(job->context, begin, end, self->index);
    }
}

void ang_parallel_for(size_t count, size_t grain, int threads, ang_parallel_body *body, void *context) {
    if (count == 0) return;
    job shared = {.count = count, .grain = grain ? grain : 1, .body = body, .context = context};
    atomic_init(&shared.next, 0);
    size_t pieces = (count + shared.grain - 1) / shared.grain;
    int wanted = ang_thread_count(threads);
    if ((size_t)wanted > pieces) wanted = (int)pieces;

    pthread_t handles[ANG_MAX_THREADS];
    worker workers[ANG_MAX_THREADS];
    int started = 0;
    for (int i = 1; i < wanted; i++) {
        workers[i] = (worker){&shared, i};
        if (pthread_create(&handles[started], NULL, work, &workers[i]) != 0) break;
        started++;
    }
    workers[0] = (worker){&shared, 0};
    work(&workers[0]);
    for (int i = 0; i < started; i++) pthread_join(handles[i], NULL);
}
