#include "io/sandbox/process.h"

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

/* Out of the way of the numbers that the decoder inherits. */
static int move_up(int fd) {
    if (fd < 0) return fd;
    int moved = fcntl(fd, F_DUPFD_CLOEXEC, ANG_DECODER_MEMORY + 1);
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
    posix_spawn_file_actions_adddup2(&actions, socket, ANG_DECODER_SOCKET);
    posix_spawn_file_actions_adddup2(&actions, memory, ANG_DECODER_MEMORY);
    char name[] = ANG_DECODER, *argument = strdup(module);
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

ang_decoder *ang_decoder_start(const char *module, ang_error *err) {
    char path[PATH_MAX];
    ang_decoder *decoder = ang_alloc(1, sizeof *decoder, "a decoder", err);
    if (!decoder) return NULL;
    *decoder = (ang_decoder){.socket = -1, .memory = -1};
    int sockets[2] = {-1, -1}, failed = 0;
    if (!ang_module_path(ANG_DECODER, path, sizeof path)) failed = ENOENT;
    if (!failed && socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, sockets) != 0) failed = errno;
    decoder->socket = move_up(sockets[0]);
    int theirs = move_up(sockets[1]);
    decoder->memory = move_up(memfd_create(ANG_DECODER, MFD_CLOEXEC | MFD_ALLOW_SEALING));
    /* Else the decoder could take pages away that the program is reading. */
    if (!failed && fcntl(decoder->memory, F_ADD_SEALS, F_SEAL_SHRINK) != 0) failed = errno;
    if (!failed && theirs < 0) failed = EMFILE;
    if (!failed) failed = spawn(path, module, theirs, decoder->memory, &decoder->pid);
    if (theirs >= 0) close(theirs);
    if (!failed && (!receive(decoder->socket, &decoder->hello, sizeof decoder->hello, ang_now_ms() + start_ms) ||
                    decoder->hello.version != ANG_DECODER_VERSION))
        failed = EPROTO;
    if (!failed) return decoder;
    ang_decoder_stop(decoder);
    ang_fail(err, ANG_INPUT,
             "the program that decodes it, " ANG_DECODER ", cannot be started (%s); install it again or decode in this "
             "process with --no-sandbox",
             strerror(failed));
    return NULL;
}

bool ang_decoder_reserve(ang_decoder *decoder, size_t size, ang_error *err) {
    if (size <= decoder->size) return true;
    if (decoder->size) munmap(decoder->shared, decoder->size);
    decoder->size = 0;
    void *at = ftruncate(decoder->memory, (off_t)size) == 0
                   ? mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED, decoder->memory, 0)
                   : MAP_FAILED;
    if (at == MAP_FAILED) return ang_fail(err, ANG_LIMIT, "no memory for compressed pixels");
    decoder->shared = at;
    decoder->size = size;
    return true;
}

/* Limits of the other process, raised as its work goes on: hard ones could not be. */
static void limit(const ang_decoder *decoder, size_t bytes, double seconds) {
#ifdef __SANITIZE_ADDRESS__
    (void)bytes; /* AddressSanitizer's shadow takes terabytes of address space */
#else
    struct rlimit space = {decoder->hello.memory + decoder->size + bytes, RLIM_INFINITY};
    if (decoder->hello.memory) prlimit(decoder->pid, RLIMIT_AS, &space, NULL);
#endif
    clockid_t clock;
    struct timespec used;
    if (clock_getcpuclockid(decoder->pid, &clock) != 0 || clock_gettime(clock, &used) != 0) return;
    struct rlimit time = {(rlim_t)ceil((double)used.tv_sec + 1e-9 * (double)used.tv_nsec + seconds), RLIM_INFINITY};
    prlimit(decoder->pid, RLIMIT_CPU, &time, NULL);
}

ang_decoder_end ang_decoder_ask(ang_decoder *decoder, const ang_decoder_request *request, size_t bytes, double seconds,
                                ang_decoder_reply *reply) {
    double until = ang_now_ms() + 1000 * wall_factor * (seconds + 1);
    limit(decoder, bytes, seconds);
    if (send(decoder->socket, request, sizeof *request, MSG_NOSIGNAL) == (ssize_t)sizeof *request &&
        receive(decoder->socket, reply, sizeof *reply, until)) {
        reply->message[sizeof reply->message - 1] = '\0';
        return ANG_DECODER_REPLIED;
    }
    bool late = ang_now_ms() >= until;
    int status = 0;
    /* What crashed keeps the signal that it died of. */
    kill(decoder->pid, SIGKILL);
    close(decoder->socket);
    decoder->socket = -1;
    while (waitpid(decoder->pid, &status, 0) < 0 && errno == EINTR) continue;
    decoder->pid = 0;
    int number = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    if (late || number == SIGXCPU) return ANG_DECODER_SLOW;
    return number == SIGSYS ? ANG_DECODER_FORBIDDEN : ANG_DECODER_CRASHED;
}

void ang_decoder_stop(ang_decoder *decoder) {
    if (decoder->socket >= 0) close(decoder->socket);
    if (decoder->memory >= 0) close(decoder->memory);
    if (decoder->size) munmap(decoder->shared, decoder->size);
    if (decoder->pid > 0) {
        kill(decoder->pid, SIGKILL);
        while (waitpid(decoder->pid, NULL, 0) < 0 && errno == EINTR) continue;
    }
    free(decoder);
}
