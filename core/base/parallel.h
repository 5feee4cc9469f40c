/* Loops over index ranges on all cores. */
#ifndef ANG_BASE_PARALLEL_H
#define ANG_BASE_PARALLEL_H

#include <stddef.h>

/* Works on indices [begin, end); `worker` is in [0, threads) and is never used by two threads at once. */
typedef void ang_parallel_body(void *context, size_t begin, size_t end, int worker);

/* ang_thread_count never gives more: as many slots hold what each worker needs. */
enum { ANG_MAX_THREADS = 256 };

/* The number of threads to use: `requested` where positive, else the processors this process may run on. At most
 * ANG_MAX_THREADS. */
int ang_thread_count(int requested);

/* Calls `body` over [0, count) in pieces of at most `grain` indices, handed out dynamically to
 * ang_thread_count(threads) threads, the caller's among them; returns when all are done. Where a thread cannot be
 * started the others do its work. `body` must not fail: it records failures in `context` itself. */
void ang_parallel_for(size_t count, size_t grain, int threads, ang_parallel_body *body, void *context);

#endif
