#include "io/sandbox/worker.h"

#include "core/base/clock.h"
#include "core/base/memory.h"
#include "io/module.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

extern char **environ;

/* How much longer than its processor time a frame may take by the clock, on a busy machine; and a start. */
static const double wall_factor = 5, start_ms = 30000;

/* Out of the way of the numbers that the worker inherits. */
static int move_up(int fd) {
    if (fd < 0) return fd;
    int moved = fcntl(fd, F_DUPFD_CLOEXEC, ANG_WORKER_MEMORY + 1);
    close(fd);
    return moved;
}

/* posix_spawn and no fork: other threads and OpenGL's drivers must not notice. A group of its own keeps the terminal's
 * signals away: the program decides what an interruption means. */
static int spawn(const char *path, const char *module, int socket, int memory, pid_t *pid) {
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    sigset_t none, standard;
    sigemptyset(&none);
    sigemptyset(&standard);
    sigaddset(&standard, SIGPIPE);
    sigaddset(&standard, SIGINT);
    sigaddset(&standard, SIGTERM);
    if (posix_spawn_file_actions_init(&actions) != 0) return ENOMEM;
    if (posix_spawnattr_init(&attributes) != 0) {
        posix_spawn_file_actions_destroy(&actions);
        return ENOMEM;
    }
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &standard);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
#ifndef __SANITIZE_ADDRESS__ /* whose reports must be seen */
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
#endif
    posix_spawn_file_actions_adddup2(&actions, socket, ANG_WORKER_SOCKET);
    posix_spawn_file_actions_adddup2(&actions, memory, ANG_WORKER_MEMORY);
    char name[] = ANG_WORKER_PROGRAM, *argument = strdup(module);
    char *arguments[] = {name, argument, NULL};
    int failed = argument ? posix_spawn(pid, path, &actions, &attributes, arguments, environ) : ENOMEM;
    free(argument);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return failed;
}

/* Waits for a packet until the clock says `until_ms`. */
static bool receive(int socket, void *out, size_t size, double until_ms) {
    for (;;) {
        double left = until_ms - ang_now_ms();
        struct pollfd poll_on = {.fd = socket, .events = POLLIN};
        int ready = poll(&poll_on, 1, left > 0 ? (int)ceil(left) : 0);
        if (ready < 0 && errno == EINTR) continue;
        if (ready <= 0) return false;
        ssize_t got = recv(socket, out, size, MSG_DONTWAIT);
        if (got < 0 && (errno == EINTR || errno == EAGAIN)) continue;
        return got == (ssize_t)size;
    }
}

ang_worker *ang_worker_start(const char *module, ang_error *err) {
    char path[PATH_MAX];
    ang_worker *worker = ang_alloc(1, sizeof *worker, "a decoder", err);
    if (!worker) return NULL;
    *worker = (ang_worker){.socket = -1, .memory = -1};
    int sockets[2] = {-1, -1}, failed = 0;
    if (!ang_module_path(ANG_WORKER_PROGRAM, path, sizeof path)) failed = ENOENT;
    if (!failed && socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, sockets) != 0) failed = errno;
    worker->socket = move_up(sockets[0]);
    int theirs = move_up(sockets[1]);
    worker->memory = move_up(memfd_create(ANG_WORKER_PROGRAM, MFD_CLOEXEC | MFD_ALLOW_SEALING));
    /* Else the worker could take pages away that the program is reading. */
    if (!failed && fcntl(worker->memory, F_ADD_SEALS, F_SEAL_SHRINK) != 0) failed = errno;
    if (!failed && theirs < 0) failed = EMFILE;
    if (!failed) failed = spawn(path, module, theirs, worker->memory, &worker->pid);
    if (theirs >= 0) close(theirs);
    if (!failed && (!receive(worker->socket, &worker->hello, sizeof worker->hello, ang_now_ms() + start_ms) ||
                    worker->hello.version != ANG_WORKER_VERSION))
        failed = EPROTO;
    if (!failed) return worker;
    ang_worker_stop(worker);
    ang_fail(err, ANG_INPUT,
             "the program that decodes it, " ANG_WORKER_PROGRAM
             ", cannot be started (%s); install it again or decode in this "
             "process with --no-sandbox",
             strerror(failed));
    return NULL;
}

bool ang_worker_reserve(ang_worker *worker, size_t size, ang_error *err) {
    if (size <= worker->size) return true;
    if (worker->size) munmap(worker->shared, worker->size);
    worker->size = 0;
    void *at = ftruncate(worker->memory, (off_t)size) == 0
                   ? mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED, worker->memory, 0)
                   : MAP_FAILED;
    if (at == MAP_FAILED) return ang_fail(err, ANG_LIMIT, "no memory for compressed pixels");
    worker->shared = at;
    worker->size = size;
    return true;
}

/* Limits of the other process, raised as its work goes on: hard ones could not be. */
static void limit(const ang_worker *worker, size_t bytes, double seconds) {
#ifdef __SANITIZE_ADDRESS__
    (void)bytes; /* AddressSanitizer's shadow takes terabytes of address space */
#else
    struct rlimit space = {worker->hello.memory + worker->size + bytes, RLIM_INFINITY};
    if (worker->hello.memory) prlimit(worker->pid, RLIMIT_AS, &space, NULL);
#endif
    clockid_t clock;
    struct timespec used;
    if (clock_getcpuclockid(worker->pid, &clock) != 0 || clock_gettime(clock, &used) != 0) return;
    struct rlimit time = {(rlim_t)ceil((double)used.tv_sec + 1e-9 * (double)used.tv_nsec + seconds), RLIM_INFINITY};
    prlimit(worker->pid, RLIMIT_CPU, &time, NULL);
}

ang_worker_end ang_worker_ask(ang_worker *worker, const ang_worker_request *request, size_t bytes, double seconds,
                              ang_worker_reply *reply) {
    double until = ang_now_ms() + 1000 * wall_factor * (seconds + 1);
    limit(worker, bytes, seconds);
    if (send(worker->socket, request, sizeof *request, MSG_NOSIGNAL) == (ssize_t)sizeof *request &&
        receive(worker->socket, reply, sizeof *reply, until)) {
        reply->message[sizeof reply->message - 1] = '\0';
        return ANG_WORKER_REPLIED;
    }
    bool late = ang_now_ms() >= until;
    int status = 0;
    /* What crashed keeps the signal that it died of. */
    kill(worker->pid, SIGKILL);
    close(worker->socket);
    worker->socket = -1;
    while (waitpid(worker->pid, &status, 0) < 0 && errno == EINTR) continue;
    worker->pid = 0;
    int number = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    if (late || number == SIGXCPU) return ANG_WORKER_SLOW;
    return number == SIGSYS ? ANG_WORKER_FORBIDDEN : ANG_WORKER_CRASHED;
}

void ang_worker_stop(ang_worker *worker) {
    if (worker->socket >= 0) close(worker->socket);
    if (worker->memory >= 0) close(worker->memory);
    if (worker->size) munmap(worker->shared, worker->size);
    if (worker->pid > 0) {
        kill(worker->pid, SIGKILL);
        while (waitpid(worker->pid, NULL, 0) < 0 && errno == EINTR) continue;
    }
    free(worker);
}
