#include "io/archive/scratch.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

enum { deepest = 64 };

/* As the kernel writes it. */
struct entry {
    uint64_t inode;
    int64_t offset;
    unsigned short length;
    unsigned char type;
    char name[];
};

/* Calls nothing but the system, as a process that was forked from many threads must. */
static void remove_tree(int at, const char *name, int depth) {
    _Alignas(struct entry) char list[2048];
    int folder = openat(at, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (folder < 0) return;
    for (bool removed = true; removed;) { /* again, since removing may hide entries from the list */
        removed = false;
        lseek(folder, 0, SEEK_SET);
        for (long size; (size = syscall(SYS_getdents64, folder, list, sizeof list)) > 0;)
            for (long i = 0; i < size;) {
                const struct entry *entry = (const struct entry *)(list + i);
                i += entry->length;
                bool self = entry->name[0] == '.' && (!entry->name[1] || (entry->name[1] == '.' && !entry->name[2]));
                if (self) continue;
                if (unlinkat(folder, entry->name, 0) == 0)
                    removed = true;
                else if (depth < deepest)
                    remove_tree(folder, entry->name, depth + 1);
            }
    }
    close(folder);
    unlinkat(at, name, AT_REMOVEDIR);
}

/* The guard: waits until nobody holds the other end of the line, by whatever end, then clears up. */
static void keep_guard(int line, const char *path) {
    static const int unheard[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT};
    setsid();
    for (size_t i = 0; i < sizeof unheard / sizeof *unheard; i++) signal(unheard[i], SIG_IGN);
    dup2(line, 0);
    close_range(1, ~0U, 0); /* files and pipes of others must not stay open through this process */
    char byte;
    while (read(0, &byte, 1) < 0 && errno == EINTR) {
    }
    remove_tree(AT_FDCWD, path, 0);
    _exit(0);
}

/* Without a guard the folder still goes when it is removed. */
static void start_guard(ang_scratch *scratch) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) return;
    pid_t guard = fork();
    if (guard == 0) {
        close(ends[1]);
        keep_guard(ends[0], scratch->path);
    }
    close(ends[0]);
    scratch->line = ends[1];
    scratch->guard = guard > 0 ? guard : 0;
}

bool ang_scratch_make(ang_scratch *scratch, ang_error *err) {
    const char *below = getenv("TMPDIR");
    *scratch = (ang_scratch){.line = -1};
    if (!below || below[0] != '/' || strlen(below) > 200) below = "/tmp";
    snprintf(scratch->path, sizeof scratch->path, "%s/angioscope-XXXXXX", below);
    if (!mkdtemp(scratch->path)) { /* its owner's alone */
        scratch->path[0] = '\0';
        return ang_fail(err, ANG_OUTPUT, "%s: no folder for an archive's files can be made there (%s)", below,
                        strerror(errno));
    }
    start_guard(scratch);
    return true;
}

void ang_scratch_remove(ang_scratch *scratch) {
    if (scratch->path[0]) remove_tree(AT_FDCWD, scratch->path, 0);
    if (scratch->line >= 0) close(scratch->line);
    if (scratch->guard > 0)
        while (waitpid(scratch->guard, NULL, 0) < 0 && errno == EINTR) {
        }
    *scratch = (ang_scratch){.line = -1};
}
