extern "C" {
#include "io/movie/encoder.h"
}

#include <opencv2/videoio.hpp>

#include <cstring>
#include <exception>
#include <new>
#include <string>

struct ang_encoder {
    cv::VideoWriter writer;
    cv::Mat frame; /* BGR */
};

static bool ends_in(const std::string &path, const char *ending) {
    size_t length = std::strlen(ending);
    if (path.size() < length) return false;
    return strcasecmp(path.c_str() + path.size() - length, ending) == 0;
}

static ang_encoder *open_encoder(const char *path, int width, int height, double fps, ang_error *err) {
    try {
        /* H.264 plays nearly everywhere; where this ffmpeg cannot encode it MPEG-4 part 2. */
        static const int shown[] = {cv::VideoWriter::fourcc('a', 'v', 'c', '1'),
                                    cv::VideoWriter::fourcc('m', 'p', '4', 'v'), 0};
        static const int lossless[] = {cv::VideoWriter::fourcc('F', 'F', 'V', '1'), 0};
        auto *encoder = new ang_encoder;
        for (const int *codec = ends_in(path, ".avi") ? lossless : shown; *codec; codec++) {
            if (!encoder->writer.open(path, cv::CAP_FFMPEG, *codec, fps, cv::Size(width, height))) continue;
            encoder->frame.create(height, width, CV_8UC3);
            return encoder;
        }
        delete encoder;
        ang_fail(err, ANG_OUTPUT,
                 "OpenCV cannot begin the film (its ffmpeg has no encoder for it, or the disk is full)");
    } catch (const std::bad_alloc &) {
        ang_fail(err, ANG_LIMIT, "no memory for a film; use a smaller --size");
    } catch (const std::exception &exception) {
        ang_fail(err, ANG_OUTPUT, "OpenCV cannot begin the film (%s)", exception.what());
    }
    return nullptr;
}

static bool add_frame(ang_encoder *encoder, const unsigned char *rgb, ang_error *err) {
    try {
        for (int y = 0; y < encoder->frame.rows; y++) {
            unsigned char *to = encoder->frame.ptr(y);
            for (int x = 0; x < encoder->frame.cols; x++, to += 3, rgb += 3) {
                to[0] = rgb[2];
                to[1] = rgb[1];
                to[2] = rgb[0];
            }
        }
        encoder->writer.write(encoder->frame);
        return true;
    } catch (const std::bad_alloc &) {
        return ang_fail(err, ANG_LIMIT, "no memory for a film; use a smaller --size");
    } catch (const std::exception &exception) {
        return ang_fail(err, ANG_OUTPUT, "OpenCV cannot encode a frame (%s)", exception.what());
    }
}

static void close_encoder(ang_encoder *encoder) {
    try {
        encoder->writer.release();
    } catch (const std::exception &) {
        /* Frames that are missing are found when they are counted. */
    }
    delete encoder;
}

static size_t count_frames(const char *path) {
    try {
        cv::VideoCapture film(path, cv::CAP_FFMPEG);
        size_t count = 0;
        while (film.isOpened() && film.grab()) count++;
        return count;
    } catch (const std::exception &) {
        return 0;
    }
}

extern "C" __attribute__((visibility("default")))
const ang_encoder_functions ang_opencv_module = {open_encoder, add_frame, close_encoder, count_frames};
