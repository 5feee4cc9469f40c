/* In place of GDCM's codecs: the first two bytes of the entropy-coded data say what to do and what to fill with. */
#include "io/dicom/codec.h"

#include <fcntl.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

enum { data_at = 2 + 13 + 10 }; /* SOI, one frame and one scan of one component */

static void crash(void) {
    volatile int *volatile nowhere = (volatile int *)(uintptr_t)64;
    *nowhere = 1;
}

static void hang(void) {
    for (volatile unsigned long turns = 0;; turns++) continue;
}

/* Waits for itself, without using the processor. */
static void lock_up(void) {
    pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
    pthread_mutex_lock(&lock);
    pthread_mutex_lock(&lock);
}

static bool act(char what) {
    void *memory = NULL;
    int fd;
    switch (what) {
    case 'c':
        crash();
        return false;
    case 'a':
        abort();
    case 'h':
        hang();
        return false;
    case 'l':
        lock_up();
        return false;
    case 'x':
        _exit(0);
    case 'm': /* the picture is small, and so is what it may take */
        memory = malloc(1 << 30);
        if (memory) memset(memory, 1, 1 << 30);
        free(memory);
        return memory != NULL;
    case 'o':
        fd = open("/etc/passwd", O_RDONLY);
        if (fd >= 0) close(fd);
        return fd >= 0;
    case 's':
        return socket(AF_INET, SOCK_STREAM, 0) >= 0;
    case 'p':
        return fork() >= 0;
    default:
        return true;
    }
}

static bool decode(const uint8_t *stream, size_t length, const ang_codec_frame *frame, void *pixels, size_t size,
                   ang_error *err) {
    (void)frame;
    bool done = length > data_at + 1 && act((char)stream[data_at]);
    if (done) {
        for (size_t i = 0; i < size / 2; i++) ((uint16_t *)pixels)[i] = (uint16_t)(1000 + stream[data_at + 1]);
        return true;
    }
    static const char sentence[] = "its pixels cannot\n be decoded";
    if (err) memcpy(err->message, sentence, sizeof sentence);
    return false;
}

__attribute__((visibility("default"))) extern ang_codec_function *const ang_gdcm_decode;
ang_codec_function *const ang_gdcm_decode = decode;
