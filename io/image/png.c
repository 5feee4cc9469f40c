/* PNG files (ISO/IEC 15948) of 8 bits, in stripes that are filtered and compressed at the same time. */
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/base/simd.h"
#include "io/checksum.h"
#include "io/image/encode.h"
#include "io/image/image_io.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

enum {
    STRIPE = 1 << 17, /* bytes that are compressed as one piece, whatever the number of threads */
    WINDOW = 1 << 15, /* how far back deflate looks */
    LEVEL = 3,        /* of zlib: with these filters more takes a third longer for 5 % fewer bytes */
    FILTERS = 5,      /* none, sub, up, average, Paeth: section 9.2 */
    HEADER = 2,       /* bytes of zlib's stream before what is deflated */
    FOOTER = 4        /* and its checksum behind */
};

typedef struct stripe {
    unsigned char *bytes; /* of the zlib stream */
    size_t size;
    uLong adler;
} stripe;

typedef struct png_job {
    const ang_pixels *pixels;
    size_t row;                   /* bytes, without the filter's number */
    size_t total;                 /* bytes of all filtered rows */
    unsigned char *filtered;      /* rows, each led by its filter's number */
    unsigned char *candidates;    /* one row for each filter and worker */
    const unsigned char *nothing; /* the row above the first */
    stripe *stripes;
    size_t count; /* of stripes */
} png_job;

/* A row less what each filter expects there, one filter behind the other: `a` lies on the left, `b` above, `c` above on
 * the left; outside is 0. */
ANG_SIMD static void filter_row(const unsigned char *restrict now, const unsigned char *restrict above, size_t pixel,
                                size_t bytes, unsigned char *restrict out) {
    unsigned char *restrict sub = out + bytes, *restrict up = sub + bytes, *restrict average = up + bytes,
                            *restrict paeth = average + bytes;
    memcpy(out, now, bytes);
    for (size_t i = 0; i < pixel; i++) {
        sub[i] = now[i];
        up[i] = paeth[i] = (unsigned char)(now[i] - above[i]);
        average[i] = (unsigned char)(now[i] - above[i] / 2);
    }
    for (size_t i = pixel; i < bytes; i++) {
        int16_t a = now[i - pixel], b = above[i], c = above[i - pixel];
        int16_t p = (int16_t)(b - c), q = (int16_t)(a - c), r = (int16_t)(p + q);
        int16_t from_a = (int16_t)(p < 0 ? -p : p), from_b = (int16_t)(q < 0 ? -q : q);
        int16_t from_c = (int16_t)(r < 0 ? -r : r), near = from_b <= from_c ? b : c;
        near = from_a <= from_b && from_a <= from_c ? a : near;
        sub[i] = (unsigned char)(now[i] - a);
        up[i] = (unsigned char)(now[i] - b);
        average[i] = (unsigned char)(now[i] - (a + b) / 2);
        paeth[i] = (unsigned char)(now[i] - near);
    }
}

/* The sum of magnitudes, bytes taken as signed: the smaller, the better a row can be compressed. */
ANG_SIMD static unsigned magnitude(const unsigned char *bytes, size_t count) {
    unsigned sum = 0;
    for (size_t i = 0; i < count; i++) sum += bytes[i] < 128 ? bytes[i] : 256u - bytes[i];
    return sum;
}

static void filter_rows(void *context, size_t begin, size_t end, int worker) {
    const png_job *job = context;
    const unsigned char *data = job->pixels->data;
    unsigned char *candidates = job->candidates + (size_t)worker * FILTERS * job->row;
    for (size_t y = begin; y < end; y++) {
        const unsigned char *now = data + y * job->row, *above = y > 0 ? now - job->row : job->nothing;
        filter_row(now, above, (size_t)job->pixels->channels, job->row, candidates);
        size_t best = 0;
        unsigned least = magnitude(candidates, job->row);
        for (size_t f = 1; f < FILTERS; f++) {
            unsigned sum = magnitude(candidates + f * job->row, job->row);
            if (sum < least) best = f;
            least = sum < least ? sum : least;
        }
        unsigned char *out = job->filtered + y * (job->row + 1);
        out[0] = (unsigned char)best;
        memcpy(out + 1, candidates + best * job->row, job->row);
    }
}

/* A stripe by itself, but knowing what lies before it; all but the last end on a whole byte. */
static void deflate_stripes(void *context, size_t begin, size_t end, int worker) {
    (void)worker;
    png_job *job = context;
    for (size_t i = begin; i < end; i++) {
        size_t at = i * STRIPE, size = job->total - at < STRIPE ? job->total - at : STRIPE,
               before = at < WINDOW ? at : WINDOW;
        unsigned char *from = job->filtered + at;
        bool last = i + 1 == job->count;
        z_stream stream = {0};
        if (deflateInit2(&stream, LEVEL, Z_DEFLATED, -MAX_WBITS, MAX_MEM_LEVEL, Z_DEFAULT_STRATEGY) != Z_OK) continue;
        size_t room = deflateBound(&stream, size) + HEADER + FOOTER + 16;
        unsigned char *bytes = malloc(room);
        if (bytes) {
            if (before > 0) deflateSetDictionary(&stream, from - before, (uInt)before);
            stream.next_in = from;
            stream.avail_in = (uInt)size;
            stream.next_out = bytes + HEADER;
            stream.avail_out = (uInt)(room - HEADER - FOOTER);
            int state = deflate(&stream, last ? Z_FINISH : Z_SYNC_FLUSH);
            bool whole = state == (last ? Z_STREAM_END : Z_OK) && stream.avail_in == 0 && stream.avail_out > 0;
            job->stripes[i] = (stripe){bytes, whole ? stream.total_out : 0, adler32(1, from, (uInt)size)};
        }
        deflateEnd(&stream);
    }
}

static unsigned char *put_word(unsigned char *to, uint32_t word) {
    for (int i = 0; i < 4; i++) to[i] = (unsigned char)(word >> (24 - 8 * i));
    return to + 4;
}

/* Section 5.3: length, type, data, checksum. */
static unsigned char *put_chunk(unsigned char *to, const char type[4], const void *data, size_t size) {
    unsigned char *start = to + 4;
    put_word(to, (uint32_t)size);
    memcpy(start, type, 4);
    if (size > 0) memcpy(start + 4, data, size);
    return put_word(start + 4 + size, ang_checksum(0, start, 4 + size));
}

/* Section 11.3.4.5, international text, not compressed: name, four empty fields, UTF-8. */
static unsigned char *put_text(unsigned char *to, const char *name, const char *text) {
    enum { EMPTY = 5 };
    size_t name_size = strlen(name), text_size = strlen(text);
    unsigned char *start = to + 4, *at = start + 4;
    put_word(to, (uint32_t)(name_size + EMPTY + text_size));
    memcpy(start, "iTXt", 4);
    memcpy(at, name, name_size);
    memset(at + name_size, 0, EMPTY);
    memcpy(at + name_size + EMPTY, text, text_size);
    at += name_size + EMPTY + text_size;
    return put_word(at, ang_checksum(0, start, (size_t)(at - start)));
}

/* Zlib's header and checksum (RFC 1950) around what is deflated. */
static void close_stream(png_job *job) {
    stripe *first = &job->stripes[0], *last = &job->stripes[job->count - 1];
    uLong adler = first->adler;
    for (size_t i = 1; i < job->count; i++) {
        size_t size = i + 1 < job->count ? STRIPE : job->total - i * STRIPE;
        adler = adler32_combine(adler, job->stripes[i].adler, (z_off_t)size);
    }
    put_word(last->bytes + HEADER + last->size, (uint32_t)adler);
    last->size += FOOTER;
    first->bytes[0] = 0x78;
    first->bytes[1] = 0x5E;
}

static bool assemble(png_job *job, ang_bytes *out, ang_error *err) {
    static const unsigned char signature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
    const ang_pixels *pixels = job->pixels;
    close_stream(job);
    size_t room = 512 + (pixels->state ? strlen(pixels->state) : 0);
    for (size_t i = 0; i < job->count; i++) room += job->stripes[i].size + HEADER + 12;
    out->data = ang_alloc(room, 1, "picture", err);
    if (!out->data) return false;
    unsigned char header[13] = {0}, *at = out->data;
    memcpy(at, signature, sizeof signature);
    put_word(put_word(header, (uint32_t)pixels->width), (uint32_t)pixels->height);
    header[8] = 8;                             /* bits */
    header[9] = pixels->channels == 4 ? 6 : 2; /* colour, with or without alpha */
    at = put_chunk(at + sizeof signature, "IHDR", header, sizeof header);
    at = put_chunk(at, "sRGB", "", 1); /* perceptual */
    at = put_text(at, "Software", "Angioscope");
    if (pixels->state) at = put_text(at, ANG_IMAGE_STATE, pixels->state);
    for (size_t i = 0; i < job->count; i++) {
        int before = i == 0 ? HEADER : 0;
        at = put_chunk(at, "IDAT", job->stripes[i].bytes + HEADER - before, job->stripes[i].size + (size_t)before);
    }
    at = put_chunk(at, "IEND", NULL, 0);
    out->size = (size_t)(at - out->data);
    return true;
}

bool ang_png_encode(const ang_pixels *pixels, ang_bytes *out, ang_error *err) {
    int workers = ang_thread_count(0);
    size_t height = (size_t)pixels->height;
    png_job job = {.pixels = pixels, .row = (size_t)pixels->width * (size_t)pixels->channels};
    job.total = (job.row + 1) * height;
    job.count = (job.total + STRIPE - 1) / STRIPE;
    unsigned char *scratch = ang_alloc(((size_t)workers * FILTERS + 1) * job.row, 1, "picture", err);
    job.filtered = scratch ? ang_alloc(job.total, 1, "picture", err) : NULL;
    job.stripes = job.filtered ? ang_alloc(job.count, sizeof *job.stripes, "picture", err) : NULL;
    bool good = job.stripes != NULL;
    if (good) {
        job.nothing = scratch;
        job.candidates = scratch + job.row;
        ang_parallel_for(height, 1 + STRIPE / job.row, workers, filter_rows, &job);
        ang_parallel_for(job.count, 1, workers, deflate_stripes, &job);
        for (size_t i = 0; i < job.count && good; i++)
            good = job.stripes[i].size > 0 ||
                   ang_fail(err, ANG_LIMIT, "no memory to encode the picture; use a smaller --size");
        good = good && assemble(&job, out, err);
        for (size_t i = 0; i < job.count; i++) free(job.stripes[i].bytes);
    }
    free(job.stripes);
    free(job.filtered);
    free(scratch);
    return good;
}
