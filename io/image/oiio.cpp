extern "C" {
#include "io/image/encode.h"
#include "io/image/image_io.h"
}
#include "io/image/oiio_grey.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <string>
#include <vector>

using namespace OIIO;

static bool encode(const char *format, const ang_pixels &pixels, Filesystem::IOProxy *proxy, ang_error *err) {
    auto output = ImageOutput::create(format);
    if (!output) return ang_fail(err, ANG_OUTPUT, "OpenImageIO cannot write %s (%s)", format, geterror().c_str());
    TypeDesc type = pixels.is_float ? TypeDesc::FLOAT : TypeDesc::UINT8;
    ImageSpec spec(pixels.width, pixels.height, pixels.channels, type);
    spec.attribute("Software", "Angioscope");
    /* Where there is none the library adds the time of writing, which identifies. */
    spec.attribute("DateTime", "");
    if (pixels.state && std::strcmp(format, "tiff") != 0) spec.attribute(ANG_IMAGE_STATE, pixels.state);
    if (pixels.channels == 4 && !pixels.is_float) spec.attribute("oiio:UnassociatedAlpha", 1);
    /* Without a colour space: in TIFF it becomes an EXIF folder, which the library, writing to memory, links in place
     * of the picture's own. */
    if (std::strcmp(format, "tiff") == 0) spec.attribute("compression", "zip");
    spec.attribute("oiio:ioproxy", TypeDesc::PTR, &proxy);
    if (!output->open(std::string("picture.") + format, spec) || !output->write_image(type, pixels.data) ||
        !output->close()) {
        return ang_fail(err, ANG_OUTPUT, "the picture cannot be encoded as %s (%s)", format,
                        output->geterror().c_str());
    }
    return true;
}

static bool encode_picture(const char *format, const ang_pixels *pixels, ang_bytes *out, ang_error *err) {
    try {
        std::vector<unsigned char> buffer;
        Filesystem::IOVecOutput proxy(buffer);
        if (!encode(format, *pixels, &proxy, err)) return false;
        out->data = static_cast<unsigned char *>(std::malloc(buffer.empty() ? 1 : buffer.size()));
        if (!out->data) return ang_fail(err, ANG_LIMIT, "no memory to encode the picture; use a smaller --size");
        std::memcpy(out->data, buffer.data(), buffer.size());
        out->size = buffer.size();
        return true;
    } catch (const std::bad_alloc &) {
        return ang_fail(err, ANG_LIMIT, "no memory to encode the picture; use a smaller --size");
    } catch (const std::exception &exception) {
        return ang_fail(err, ANG_OUTPUT, "the picture cannot be encoded as %s (%s)", format, exception.what());
    }
}

/* Grey, grey with alpha, RGB or RGBA into premultiplied RGBA. */
static void spread(const std::vector<float> &pixels, int channels, bool unassociated, ang_image *out) {
    size_t count = size_t(out->width) * size_t(out->height);
    bool alpha = channels == 2 || channels == 4;
    for (size_t i = 0; i < count; i++) {
        const float *from = &pixels[size_t(channels) * i];
        float *to = out->rgba + 4 * i;
        float a = alpha ? from[channels - 1] : 1.0F;
        for (int c = 0; c < 3; c++) {
            float value = channels < 3 ? from[0] : from[c];
            to[c] = unassociated && alpha ? value * a : value;
        }
        to[3] = a;
    }
}

static bool read_picture(const char *path, const char *format, ang_image *out, ang_error *err) {
    try {
        auto input = ImageInput::create(format);
        ImageSpec spec, wish;
        /* Asked for as stored: the library would multiply alpha in with 8 bits. */
        wish.attribute("oiio:UnassociatedAlpha", 1);
        if (!input || !input->open(path, spec, wish)) {
            std::string reason = input ? input->geterror() : geterror();
            std::replace(reason.begin(), reason.end(), '\n', ' ');
            return ang_fail(err, ANG_INPUT, "%s: cannot be read as %s (%s)", path, format, reason.c_str());
        }
        if (spec.width < 1 || spec.height < 1 || spec.depth > 1 || spec.nchannels < 1 || spec.nchannels > 4) {
            return ang_fail(err, ANG_INPUT,
                            "%s: not a picture of 1 to 4 channels in one layer (channels %d, layers %d)", path,
                            spec.nchannels, spec.depth);
        }
        std::vector<float> pixels(size_t(spec.width) * size_t(spec.height) * size_t(spec.nchannels));
        if (!input->read_image(0, 0, 0, spec.nchannels, TypeDesc::FLOAT, pixels.data())) {
            return ang_fail(err, ANG_INPUT, "%s: cannot be read (%s)", path, input->geterror().c_str());
        }
        if (!ang_image_create(out, spec.width, spec.height, err)) return false;
        spread(pixels, spec.nchannels, spec.get_int_attribute("oiio:UnassociatedAlpha", 0) != 0, out);
        return true;
    } catch (const std::bad_alloc &) {
        return ang_fail(err, ANG_LIMIT, "%s: no memory for the picture", path);
    } catch (const std::exception &exception) {
        return ang_fail(err, ANG_INPUT, "%s: cannot be read (%s)", path, exception.what());
    }
}

static bool measure_text(const char *text, int size, const char *font, int *text_width, int *top, int *bottom) {
    try {
        ROI extent = ImageBufAlgo::text_size(text, size, font);
        if (!extent.defined()) return false;
        *text_width = extent.width();
        *top = extent.ybegin;
        *bottom = extent.yend;
        return true;
    } catch (const std::exception &) {
        return false;
    }
}

static bool draw_text(float *mask, int width, int height, int x, int y, const char *text, int size, const char *font,
                      int align) {
    try {
        int extent, top, bottom;
        if (!measure_text(text, size, font, &extent, &top, &bottom)) return false;
        int left = align < 0 ? x : align > 0 ? x - extent : x - extent / 2;
        /* Onto a strip of its own, since the library blends and overlapping coverages must not add up. */
        int border = 2, strip_width = extent + 2 * border, strip_height = bottom - top + 2 * border;
        ImageBuf strip(ImageSpec(strip_width, strip_height, 1, TypeDesc::FLOAT));
        ImageBufAlgo::zero(strip);
        if (!ImageBufAlgo::render_text(strip, border, border - top, text, size, font, 1.0F)) return false;
        for (int row = 0; row < strip_height; row++) {
            for (int column = 0; column < strip_width; column++) {
                int to_x = left - border + column, to_y = y + top - border + row;
                if (to_x < 0 || to_y < 0 || to_x >= width || to_y >= height) continue;
                float &to = mask[size_t(to_y) * size_t(width) + size_t(to_x)];
                to = std::max(to, strip.getchannel(column, row, 0, 0));
            }
        }
        return true;
    } catch (const std::exception &) {
        return false;
    }
}

extern "C" __attribute__((visibility("default")))
const ang_oiio_functions ang_oiio_module = {encode_picture, read_picture,  draw_text,      measure_text,
                                            ang_grey_open,  ang_grey_read, ang_grey_close, ang_grey_settle};
