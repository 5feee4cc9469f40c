extern "C" {
#include "io/dicom/encode.h"
}

#include <gdcmDataSet.h>
#include <gdcmFile.h>
#include <gdcmFileMetaInformation.h>
#include <gdcmWriter.h>

#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <sstream>
#include <string>

static void put(gdcm::DataSet &set, uint32_t tag, gdcm::VR vr, const char *data, size_t size) {
    gdcm::DataElement element(gdcm::Tag(uint16_t(tag >> 16), uint16_t(tag & 0xFFFF)), 0, vr);
    element.SetByteValue(data, uint32_t(size));
    set.Replace(element);
}

static void put_text(gdcm::DataSet &set, const ang_dicom_text &text) {
    std::string value(text.value);
    if (value.size() % 2) value.push_back(std::strcmp(text.vr, "UI") == 0 ? '\0' : ' ');
    put(set, text.tag, gdcm::VR::GetVRTypeFromFile(text.vr), value.data(), value.size());
}

static void put_short(gdcm::DataSet &set, uint32_t tag, int value) {
    const char bytes[2] = {char(value & 0xFF), char(value >> 8 & 0xFF)};
    put(set, tag, gdcm::VR::US, bytes, 2);
}

static std::string encode(const ang_dicom_text *texts, size_t count, int rows, int columns, const uint16_t *pixels) {
    gdcm::Writer writer;
    gdcm::File &file = writer.GetFile();
    gdcm::DataSet &set = file.GetDataSet();
    for (size_t i = 0; i < count; i++) put_text(set, texts[i]);
    put_short(set, 0x00280002, 1); /* SamplesPerPixel */
    put_short(set, 0x00280010, rows);
    put_short(set, 0x00280011, columns);
    put_short(set, 0x00280100, 16); /* BitsAllocated */
    put_short(set, 0x00280101, 16); /* BitsStored */
    put_short(set, 0x00280102, 15); /* HighBit */
    put_short(set, 0x00280103, 0);  /* PixelRepresentation: unsigned */

    size_t values = size_t(rows) * size_t(columns);
    std::string bytes(2 * values, '\0');
    for (size_t i = 0; i < values; i++) {
        bytes[2 * i] = char(pixels[i] & 0xFF);
        bytes[2 * i + 1] = char(pixels[i] >> 8);
    }
    put(set, 0x7FE00010, gdcm::VR::OW, bytes.data(), bytes.size());
    file.GetHeader().SetDataSetTransferSyntax(gdcm::TransferSyntax::ExplicitVRLittleEndian);
    std::ostringstream stream(std::ios::binary);
    writer.SetStream(stream);
    return writer.Write() ? stream.str() : std::string();
}

static bool encode_safely(const ang_dicom_text *texts, size_t count, int rows, int columns, const uint16_t *pixels,
                          unsigned char **out, size_t *size, ang_error *err) {
    try {
        std::string file = encode(texts, count, rows, columns, pixels);
        if (file.empty()) return ang_fail(err, ANG_OUTPUT, "GDCM cannot encode the slice");
        *out = static_cast<unsigned char *>(std::malloc(file.size()));
        if (!*out) return ang_fail(err, ANG_LIMIT, "no memory to encode a slice");
        std::memcpy(*out, file.data(), file.size());
        *size = file.size();
        return true;
    } catch (const std::bad_alloc &) {
        return ang_fail(err, ANG_LIMIT, "no memory to encode a slice");
    } catch (const std::exception &exception) {
        return ang_fail(err, ANG_OUTPUT, "GDCM cannot encode the slice (%s)", exception.what());
    }
}

extern "C" __attribute__((visibility("default"))) ang_dicom_function *const ang_gdcm_encoder = encode_safely;
