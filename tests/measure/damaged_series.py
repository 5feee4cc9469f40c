"""Damaged DICOM series: every case writes files below a folder of its own. Needs pydicom, an independent writer.

make(folder, seed) yields (kind, case, path): what is wrong, which of its kind it is, and what to open."""
import io
import os
import random
import shutil
import struct
import subprocess

import numpy
from pydicom.dataset import Dataset, FileDataset, FileMetaDataset
from pydicom.encaps import encapsulate
from pydicom.filebase import DicomBytesIO
from pydicom.sequence import Sequence
from pydicom.uid import ExplicitVRLittleEndian, ImplicitVRLittleEndian, RLELossless

SIDE, SLICES = 24, 5
UNDEFINED = 0xFFFFFFFF
CT, ENHANCED_CT, DICOMDIR = "1.2.840.10008.5.1.4.1.1.2", "1.2.840.10008.5.1.4.1.1.2.1", "1.2.840.10008.1.3.10"


def pixels(z):
    ramp = numpy.arange(SIDE * SIDE).reshape(SIDE, SIDE)
    return (1000 + ramp + 37 * z).astype("<u2")


def base(sop_class=CT, syntax=ExplicitVRLittleEndian):
    meta = FileMetaDataset()
    meta.MediaStorageSOPClassUID, meta.MediaStorageSOPInstanceUID, meta.TransferSyntaxUID = sop_class, "1.2.9.1", syntax
    ds = FileDataset("", {}, file_meta=meta, preamble=b"\0" * 128)
    ds.is_little_endian, ds.is_implicit_VR = True, syntax == ImplicitVRLittleEndian
    ds.SOPClassUID, ds.SOPInstanceUID, ds.Modality = sop_class, "1.2.9.1", "CT"
    ds.PatientName, ds.PatientID = "PHANTOM", "1"
    ds.StudyInstanceUID, ds.SeriesInstanceUID, ds.SeriesNumber = "1.2.9.2", "1.2.9.3", 1
    ds.SamplesPerPixel, ds.PhotometricInterpretation = 1, "MONOCHROME2"
    ds.Rows = ds.Columns = SIDE
    ds.BitsAllocated, ds.BitsStored, ds.HighBit, ds.PixelRepresentation = 16, 16, 15, 0
    return ds


def slice_of(z, syntax=ExplicitVRLittleEndian, **changes):
    ds = base(syntax=syntax)
    ds.ImageType = ["ORIGINAL", "PRIMARY", "AXIAL"]
    ds.InstanceNumber, ds.ImagePositionPatient = z + 1, [-10, -20, 2 * z]
    ds.ImageOrientationPatient, ds.PixelSpacing, ds.SliceThickness = [1, 0, 0, 0, 1, 0], [0.5, 0.5], 2
    ds.RescaleIntercept, ds.RescaleSlope, ds.RescaleType = -1024, 1, "HU"
    ds.WindowCenter, ds.WindowWidth = 40, 400
    ds.PixelData = pixels(z).tobytes()
    for name, value in changes.items():
        if value is None:
            delattr(ds, name)
        else:
            setattr(ds, name, value)
    if "PixelData" in ds:
        ds["PixelData"].VR = "OW"
    return ds


def item(**values):
    ds = Dataset()
    for name, value in values.items():
        setattr(ds, name, value)
    return ds


def enhanced(order=(2, 0, 4, 1, 3), syntax=ExplicitVRLittleEndian):
    """Frames in `order`, with a stack and a temporal index of their own."""
    ds = base(ENHANCED_CT, syntax)
    ds.ImageType, ds.InstanceNumber = ["ORIGINAL", "PRIMARY", "VOLUME", "NONE"], 1
    ds.NumberOfFrames = len(order)
    ds.SharedFunctionalGroupsSequence = Sequence([item(
        PlaneOrientationSequence=Sequence([item(ImageOrientationPatient=[1, 0, 0, 0, 1, 0])]),
        PixelMeasuresSequence=Sequence([item(PixelSpacing=[0.5, 0.5], SliceThickness=2)]))])
    ds.PerFrameFunctionalGroupsSequence = Sequence([item(
        FrameContentSequence=Sequence([item(StackID="1", InStackPositionNumber=z + 1, TemporalPositionIndex=1)]),
        PlanePositionSequence=Sequence([item(ImagePositionPatient=[-10, -20, 2 * z])]),
        PixelValueTransformationSequence=Sequence([item(RescaleIntercept=-1024, RescaleSlope=1, RescaleType="HU")]))
        for z in order])
    ds.PixelData = b"".join(pixels(z).tobytes() for z in order)
    ds["PixelData"].VR = "OW"
    return ds


def run_lengths(ds):
    from pydicom.pixel_data_handlers.rle_handler import rle_encode_frame
    frames = ds.pixel_array.reshape(-1, SIDE, SIDE)
    ds.PixelData = encapsulate([rle_encode_frame(frame) for frame in frames])
    ds["PixelData"].VR, ds["PixelData"].is_undefined_length = "OB", True
    ds.file_meta.TransferSyntaxUID = RLELossless
    return ds


def coded(ds):
    out = io.BytesIO()
    ds.save_as(out, write_like_original=False)
    return out.getvalue()


def boundaries(data):
    """(offset of the head, offset of the value, end) of every element at the top level, pixel data included."""
    file = DicomBytesIO(data)
    file.seek(132)
    found, meta = [], True
    while file.tell() < len(data):
        start = file.tell()
        group, _, vr = struct.unpack("<HH2s", data[start:start + 6])
        short = vr not in (b"OB", b"OW", b"SQ", b"UN", b"UT", b"OF", b"OD", b"OL", b"OV")
        length = struct.unpack("<H", data[start + 6:start + 8])[0] if short else \
            struct.unpack("<I", data[start + 8:start + 12])[0]
        value = start + (8 if short else 12)
        if length == UNDEFINED:
            found.append((start, value, len(data)))
            break
        found.append((start, value, value + length))
        file.seek(value + length)
    return found


class Cases:
    def __init__(self, folder):
        self.folder, self.count = folder, 0

    def place(self):
        self.count += 1
        path = os.path.join(self.folder, "%04d" % self.count)
        os.makedirs(path)
        return path

    def file(self, data, name="a.dcm"):
        path = os.path.join(self.place(), name)
        with open(path, "wb") as out:
            out.write(data)
        return path

    def series(self, damaged, at=2):
        """A series whose slice `at` is replaced by these bytes."""
        folder = self.place()
        for z in range(SLICES):
            with open(os.path.join(folder, "%d.dcm" % z), "wb") as out:
                out.write(damaged if z == at else coded(slice_of(z)))
        return folder


def truncated(cases, name, whole, wide=False):
    cuts = {0, 1, 127, 128, 131, 132}
    for start, value, end in boundaries(whole):
        cuts |= {start, start + 4, value, (value + end) // 2, end - 1}
    for cut in sorted(c for c in cuts if c < len(whole)):
        yield "cut off at a header's boundary, " + name, cut, cases.file(whole[:cut])
        if wide and cut % 3 == 0:
            yield "one slice of five cut off", cut, cases.series(whole[:cut])


def flipped(cases, rng, name, whole, count):
    head = boundaries(whole)[-1][1]
    for k in range(count):
        data = bytearray(whole)
        for _ in range(1 + k % 3):
            data[rng.randrange(132, min(head + 40, len(data)))] ^= 1 << rng.randrange(8)
        yield "bits flipped, " + name, k, cases.file(bytes(data))


def wrong_lengths(cases, whole):
    for start, value, end in boundaries(whole):
        short = value - start == 8
        place, form, most = (start + 6, "<H", 0xFFFF) if short else (start + 8, "<I", UNDEFINED)
        right = end - value
        for length in {0, 1, max(right - 1, 0), right + 1, right + 3, most - 1, most} - {right}:
            data = bytearray(whole)
            struct.pack_into(form, data, place, length & most)
            yield "wrong length of an element", "%d at %d" % (length, start), cases.file(bytes(data))


def wrong_values(cases):
    claims = [("Rows", 65535), ("Columns", 65535), ("Rows", 0), ("Columns", 0), ("Rows", None), ("Columns", None),
              ("BitsAllocated", 1), ("BitsAllocated", 12), ("BitsAllocated", 64), ("BitsAllocated", 0),
              ("BitsAllocated", 8), ("BitsAllocated", None), ("BitsStored", 0), ("BitsStored", 17), ("BitsStored", 9),
              ("HighBit", 3), ("HighBit", 99), ("SamplesPerPixel", 0), ("SamplesPerPixel", 3),
              ("SamplesPerPixel", 65535), ("PixelRepresentation", 7), ("NumberOfFrames", 2147483647),
              ("NumberOfFrames", 65535), ("NumberOfFrames", -1), ("NumberOfFrames", 0), ("SOPClassUID", None),
              ("Modality", None), ("SeriesInstanceUID", None), ("PixelData", b""), ("PixelData", b"\0\0"),
              ("PixelData", None)]
    for name, value in claims:
        yield "a claim that the pixels do not keep", "%s %s" % (name, value), \
            cases.file(coded(slice_of(0, **{name: value})))
    both = coded(slice_of(0, Rows=65535, Columns=65535, BitsAllocated=32))
    yield "a claim that the pixels do not keep", "65535 x 65535", cases.file(both)
    numbers = [("ImagePositionPatient", "nan\\0\\0"), ("ImagePositionPatient", "1e999\\0\\0"),
               ("ImagePositionPatient", "0\\0"), ("ImagePositionPatient", "0\\0\\1e300"),
               ("ImageOrientationPatient", "0\\0\\0\\0\\0\\0"), ("ImageOrientationPatient", "1\\0\\0\\1\\0\\0"),
               ("ImageOrientationPatient", "1\\0\\0"), ("ImageOrientationPatient", "inf\\0\\0\\0\\1\\0"),
               ("PixelSpacing", "0\\0"), ("PixelSpacing", "-1\\1"), ("PixelSpacing", "1e-300\\1"),
               ("PixelSpacing", "1e300\\1e300"), ("PixelSpacing", "a\\b"), ("RescaleSlope", "0"),
               ("RescaleSlope", "1e308"), ("RescaleSlope", "nan"), ("RescaleSlope", "1,5"),
               ("RescaleIntercept", "1e308"), ("RescaleIntercept", "-inf"), ("RescaleSlope", "1e-300")]
    for name, text in numbers:
        ds = slice_of(2)
        raw = coded(ds)
        kept = ds[name].value
        old = "\\".join(str(v) for v in kept) if hasattr(kept, "__iter__") and not isinstance(kept, str) else str(kept)
        data = replace_text(raw, ds[name].tag, text)
        assert data != raw, (name, old)
        yield "a number that is none, or of no scan", "%s %s" % (name, text), cases.series(data)
        yield "a number that is none, or of no scan", "%s %s alone" % (name, text), cases.file(data)


def replace_text(data, tag, text):
    """The file with the value of a short element replaced."""
    text = text.encode() + b" " * (len(text) % 2)
    for start, value, end in boundaries(data):
        if data[start:start + 4] == struct.pack("<HH", tag.group, tag.element):
            return data[:start + 6] + struct.pack("<H", len(text)) + text + data[end:]
    raise KeyError(tag)


def before_pixels(data, extra):
    """The file with bytes in front of group 0028."""
    at = next(start for start, _, _ in boundaries(data) if data[start:start + 2] == b"\x28\0")
    return data[:at] + extra + data[at:]


def sequences(cases):
    whole = coded(slice_of(0))
    head = struct.pack("<HH2sHI", 0x0027, 0x1010, b"SQ", 0, UNDEFINED)
    open_item = struct.pack("<HHI", 0xFFFE, 0xE000, UNDEFINED)
    close_item, close = struct.pack("<HHI", 0xFFFE, 0xE00D, 0), struct.pack("<HHI", 0xFFFE, 0xE0DD, 0)
    for depth in (1, 8, 31, 40, 1000, 100000):
        extra = (head + open_item) * depth + (close_item + close) * depth
        yield "sequences in one another", "%d deep" % depth, cases.file(before_pixels(whole, extra))
        yield "sequences in one another", "%d deep, not closed" % depth, \
            cases.file(before_pixels(whole, (head + open_item) * depth))
    for name, extra in (
            ("no delimiter", head + open_item), ("item of 4 GB", head + struct.pack("<HHI", 0xFFFE, 0xE000, UNDEFINED - 1)),
            ("delimiters alone", close * 50 + close_item * 50), ("no item", head + struct.pack("<HHI", 8, 16, 4) + b"abcd"),
            ("50,000 empty items", head + struct.pack("<HHI", 0xFFFE, 0xE000, 0) * 50000 + close),
            ("a value of 4 GB", struct.pack("<HH2sHI", 0x0027, 0x1011, b"OB", 0, UNDEFINED - 1)),
            ("a value of undefined length", struct.pack("<HH2sHI", 0x0027, 0x1011, b"OB", 0, UNDEFINED)),
            ("unknown VR", struct.pack("<HH2sH", 0x0027, 0x1011, b"ZZ", 4) + b"abcd"),
            ("no VR at all", struct.pack("<HHI", 0x0027, 0x1011, 4) + b"abcd"),
            ("tags in no order", struct.pack("<HH2sH", 0x0008, 0x0060, b"CS", 2) + b"MR")):
        yield "damaged sequences and elements", name, cases.file(before_pixels(whole, extra))


def transfer_syntaxes(cases):
    explicit, implicit = coded(slice_of(0)), coded(slice_of(0, syntax=ImplicitVRLittleEndian))
    uids = {"implicit": "1.2.840.10008.1.2", "explicit": "1.2.840.10008.1.2.1", "big endian": "1.2.840.10008.1.2.2",
            "deflated": "1.2.840.10008.1.2.1.99", "JPEG": "1.2.840.10008.1.2.4.50", "JPEG 2000": "1.2.840.10008.1.2.4.90",
            "RLE": "1.2.840.10008.1.2.5", "MPEG": "1.2.840.10008.1.2.4.100", "unknown": "1.2.3.4.5", "none": ""}
    for kind, data in (("explicit", explicit), ("implicit", implicit)):
        for name, uid in uids.items():
            if name != kind:
                yield "wrong transfer syntax", "%s said to be %s" % (kind, name), cases.file(relabel(data, uid))
    rle = coded(run_lengths(slice_of(0)))
    for name, uid in uids.items():
        if name != "RLE":
            yield "wrong transfer syntax", "RLE said to be %s" % name, cases.file(relabel(rle, uid))


def relabel(data, uid):
    uid = uid.encode() + b"\0" * (len(uid) % 2)
    for start, value, end in boundaries(data):
        if data[start:start + 4] == b"\x02\0\x10\0":
            return data[:start + 6] + struct.pack("<H", len(uid)) + uid + data[end:]
    raise KeyError("transfer syntax")


def starts(cases):
    whole = coded(slice_of(0))
    set_at = next(start for start, _, _ in boundaries(whole) if whole[start:start + 2] == b"\x08\0")
    for name, data in (("empty file", b""), ("one byte", b"D"), ("preamble alone", whole[:132]),
                       ("no preamble", whole[128:]), ("no preamble, no magic", whole[132:]),
                       ("no meta header", whole[:132] + whole[set_at:]), ("data set alone", whole[set_at:]),
                       ("meta header alone", whole[:set_at]), ("meta header twice", whole[:set_at] + whole[132:]),
                       ("preamble of text", b"#" * 128 + whole[128:]), ("zeros", b"\0" * 5000), ("0xFF", b"\xff" * 5000),
                       ("magic and zeros", b"\0" * 128 + b"DICM" + b"\0" * 5000),
                       ("magic and 100 MB of zeros", b"\0" * 128 + b"DICM" + b"\0" * 100000000),
                       ("text", b"ISO_IR 100 CT image\n" * 100), ("odd byte at the end", whole + b"\0")):
        yield "damaged at the start, or nothing there", name, cases.file(data)
    deflate_cases = relabel(whole, "1.2.840.10008.1.2.1.99")
    start = next(s for s, _, _ in boundaries(deflate_cases) if deflate_cases[s:s + 2] == b"\x08\0")
    import zlib
    packer = zlib.compressobj(9, zlib.DEFLATED, -15)
    packed = packer.compress(deflate_cases[start:]) + packer.flush()
    packer = zlib.compressobj(9, zlib.DEFLATED, -15)
    bomb = b"".join(packer.compress(b"\0" * 1000000) for _ in range(1500)) + packer.flush()
    for name, body in (("whole", packed), ("cut off", packed[:len(packed) // 2]), ("bits flipped", packed[:100] + b"\xff" + packed[101:]),
                       ("1.5 GB of zeros in 1.5 MB", bomb), ("empty", b"")):
        yield "deflated data sets", name, cases.file(deflate_cases[:start] + body)


def fragments(cases, rng):
    whole = coded(run_lengths(slice_of(0)))
    at = boundaries(whole)[-1][1]
    stream = whole[at:]
    first = 8 + struct.unpack("<I", stream[4:8])[0]
    yield "encapsulated pixels", "whole", cases.file(whole)
    changes = [("no offset table", 0, stream[first:]), ("table of 4 GB", 4, struct.pack("<I", UNDEFINED - 1)),
               ("fragment of 4 GB", first + 4, struct.pack("<I", UNDEFINED)),
               ("fragment longer than the file", first + 4, struct.pack("<I", 100000)),
               ("fragment of 1 byte", first + 4, struct.pack("<I", 1)), ("no fragment", first, b"\xfe\xff\xdd\xe0\0\0\0\0"),
               ("15 segments", first + 8, struct.pack("<I", 15)), ("segments turned round", first + 12, struct.pack("<II", 900, 64)),
               ("segment behind the end", first + 16, struct.pack("<I", UNDEFINED))]
    for name, place, value in changes:
        data = bytearray(stream)
        data[place:place + len(value)] = value
        yield "encapsulated pixels", name, cases.file(whole[:at] + bytes(data))
    yield "encapsulated pixels", "no delimiter", cases.file(whole[:-8])
    for k in range(20):
        data = bytearray(whole)
        data[rng.randrange(at + first + 8, len(data) - 8)] ^= 1 << rng.randrange(8)
        yield "bits of run lengths flipped", k, cases.file(bytes(data))


def streams(cases, rng, originals):
    """Streams of real codecs with bits flipped and cut off."""
    for path in originals:
        with open(path, "rb") as file:
            whole = file.read()
        body = whole.rfind(b"\xe0\x7f\x10\x00")
        name = os.path.basename(path)[-40:]
        for k in range(6):
            data = bytearray(whole)
            for _ in range(1 + 4 * k):
                data[rng.randrange(body + 20, len(data))] ^= 1 << rng.randrange(8)
            yield "bits of compressed streams flipped", "%s %d" % (name, k), cases.file(bytes(data))
        for k in (0.2, 0.7, 0.99):
            yield "compressed streams cut off", "%s %g" % (name, k), cases.file(whole[:body + int(k * (len(whole) - body))])


def by_dcmtk(cases):
    """Multi-frame images coded by dcmtk, where it is installed; 12 bits, as its codecs want them."""
    ds = enhanced()
    ds.BitsStored, ds.HighBit = 12, 11
    plain = cases.file(coded(ds))
    tools = [("dcmcrle",), ("dcmcjpls",), ("dcmcjpls", "+fs", "1"), ("dcmcjpeg", "+e1"), ("dcmcjpeg", "+el"),
             ("dcmcjpeg", "+e1", "+fs", "1"), ("dcmcjpeg", "+e1", "-ot"), ("dcmconv", "+tb"), ("dcmconv", "+ti"),
             ("dcmconv", "+te", "-e"), ("dcmconv", "+td")]
    for tool in tools:
        out = os.path.join(cases.place(), "a.dcm")
        if shutil.which(tool[0]) and subprocess.run([*tool, plain, out], capture_output=True).returncode == 0:
            yield "multi-frame images by dcmtk", " ".join(tool), out


def multi_frame(cases, rng):
    yield "multi-frame images", "frames in no order", cases.file(coded(enhanced()))
    yield "multi-frame images", "implicit VR", cases.file(coded(enhanced(syntax=ImplicitVRLittleEndian)))
    whole = coded(run_lengths(enhanced()))
    yield "multi-frame images", "run lengths", cases.file(whole)
    for number in (1, 4, 6, 65535, 65536, 2147483647, 0, -5):
        ds = enhanced()
        ds.NumberOfFrames = number
        yield "multi-frame images", "%d frames claimed of 5" % number, cases.file(coded(ds))
    for name in ("PerFrameFunctionalGroupsSequence", "SharedFunctionalGroupsSequence"):
        ds = enhanced()
        delattr(ds, name)
        yield "multi-frame images", "no " + name, cases.file(coded(ds))
    ds = enhanced()
    ds.PerFrameFunctionalGroupsSequence[1].PlanePositionSequence[0].ImagePositionPatient = [1, 1, 2]
    yield "multi-frame images", "two frames at one place", cases.file(coded(ds))
    ds = enhanced()
    del ds.PerFrameFunctionalGroupsSequence[3].PlanePositionSequence
    yield "multi-frame images", "a frame without position", cases.file(coded(ds))
    at = whole.rfind(b"\xe0\x7f\x10\x00") + 12
    for k in range(5):
        data = bytearray(whole)
        struct.pack_into("<I", data, at + 8 + 4 * k, rng.randrange(100000))
        yield "multi-frame images", "offset %d wrong" % k, cases.file(bytes(data))
    for name, data in (("multi-frame", coded(enhanced())), ("multi-frame in run lengths", whole)):
        yield from truncated(cases, name, data)
        yield from flipped(cases, rng, name, data, 40)


def folders(cases):
    folder = cases.place()
    os.makedirs(os.path.join(folder, "a.dcm"))
    yield "what is no file", "a folder named .dcm", os.path.join(folder, "a.dcm")
    folder = cases.series(b"")
    os.makedirs(os.path.join(folder, "b.dcm"))
    os.mkfifo(os.path.join(folder, "fifo.dcm"))
    os.symlink(".", os.path.join(folder, "loop"))
    os.symlink("self.dcm", os.path.join(folder, "self.dcm"))
    os.symlink("nowhere.dcm", os.path.join(folder, "lost.dcm"))
    os.symlink("/dev/zero", os.path.join(folder, "zero.dcm"))
    yield "what is no file", "FIFO, links in circles, /dev/zero beside slices", folder
    for name in ("fifo.dcm", "self.dcm", "lost.dcm", "zero.dcm"):
        yield "what is no file", name, os.path.join(folder, name)
    folder = cases.place()
    for depth in range(60):
        folder_in = os.path.join(folder, *["d"] * (depth + 1))
        os.makedirs(folder_in)
    yield "what is no file", "60 folders in one another, empty", folder
    yield "what is no file", "nothing of this name", os.path.join(folder, "none")


def indices(cases, rng):
    def index(ids, name="DICOMDIR"):
        meta = FileMetaDataset()
        meta.MediaStorageSOPClassUID, meta.MediaStorageSOPInstanceUID = DICOMDIR, "1.2.9.9"
        meta.TransferSyntaxUID = ExplicitVRLittleEndian
        ds = FileDataset("", {}, file_meta=meta, preamble=b"\0" * 128)
        ds.is_little_endian, ds.is_implicit_VR = True, False
        ds.FileSetID = "DISC"
        ds.DirectoryRecordSequence = Sequence([item(
            OffsetOfTheNextDirectoryRecord=400, RecordInUseFlag=0xFFFF, OffsetOfReferencedLowerLevelDirectoryEntity=400,
            DirectoryRecordType="IMAGE", ReferencedFileID=i) for i in ids])
        return coded(ds)

    def disc(data):
        folder = cases.series(coded(slice_of(2)))
        for z in range(SLICES):
            os.rename(os.path.join(folder, "%d.dcm" % z), os.path.join(folder, "im%d" % z))
        with open(os.path.join(folder, "DICOMDIR"), "wb") as out:
            out.write(data)
        return folder

    names = ["IM%d" % z for z in range(SLICES)]
    good = index(names)
    some = [("names in another case, records in a circle", good), ("a missing file", index(names + ["IM9"])),
            ("itself", index(names + ["DICOMDIR"])), ("files outside", index(names + [["..", "..", "0001"], "/etc/passwd"])),
            ("a name 100 times", index(names * 20)), ("empty", b""), ("text", b"no index"), ("no records", index([])),
            ("a value of 4 GB", good[:-60] + b"\xff" * 60)]
    some += [("cut off at %d" % cut, good[:cut]) for cut in range(100, len(good), max(1, len(good) // 9))]
    for k in range(12):
        data = bytearray(good)
        data[rng.randrange(132, len(data))] ^= 1 << rng.randrange(8)
        some.append(("bit %d flipped" % k, bytes(data)))
    for name, data in some:
        folder = disc(data)
        yield "DICOMDIR", name, os.path.join(folder, "DICOMDIR")
        yield "DICOMDIR in its folder", name, folder


def stacks(cases):
    def stack(change):
        folder = cases.place()
        for z in range(SLICES):
            ds = slice_of(z)
            change(z, ds)
            with open(os.path.join(folder, "%d.dcm" % z), "wb") as out:
                out.write(coded(ds))
        return folder

    def put(name, value):
        return lambda z, ds: setattr(ds, name, value(z))

    changes = [("all at one place", put("ImagePositionPatient", lambda z: [0, 0, 0])),
               ("positions 1e9 mm apart", put("ImagePositionPatient", lambda z: [0, 0, 1e9 * z])),
               ("one 1 km away", put("ImagePositionPatient", lambda z: [0, 0, z if z < 4 else 1e6])),
               ("positions 1e-4 mm apart", put("ImagePositionPatient", lambda z: [0, 0, 1e-4 * z])),
               ("positions 0.002 mm apart", put("ImagePositionPatient", lambda z: [0, 0, 0.002 * z])),
               ("slices beside one another", put("ImagePositionPatient", lambda z: [20 * z, 0, 0])),
               ("a slope for each slice", put("RescaleSlope", lambda z: 1 + 0.3 * z)),
               ("slopes of 1e-9 and 1", put("RescaleSlope", lambda z: 1 if z else 1e-9)),
               ("orientation turns", put("ImageOrientationPatient", lambda z: [1, 0, 0, 0, 1, 0] if z < 3 else [0, 1, 0, 0, 0, -1])),
               ("rows differ", lambda z, ds: z == 4 and (setattr(ds, "Rows", SIDE // 2), setattr(ds, "PixelData", ds.PixelData[:SIDE * SIDE]))),
               ("two patients", put("PatientID", lambda z: "1" if z < 3 else "2")),
               ("padding everywhere", lambda z, ds: (ds.add_new(0x00280120, "US", 1000), setattr(ds, "PixelData", struct.pack("<H", 1000) * SIDE * SIDE)))]
    for name, change in changes:
        yield "slices that make no plain stack", name, stack(change)


def make(folder, seed, originals=()):
    cases, rng = Cases(folder), random.Random(seed)
    whole = coded(slice_of(2))
    yield "undamaged", "one slice", cases.file(whole)
    yield "undamaged", "five slices", cases.series(whole)
    yield from truncated(cases, "one slice", whole, wide=True)
    yield from flipped(cases, rng, "one slice", whole, 150)
    yield from wrong_lengths(cases, whole)
    yield from wrong_values(cases)
    yield from sequences(cases)
    yield from transfer_syntaxes(cases)
    yield from starts(cases)
    yield from fragments(cases, rng)
    yield from streams(cases, rng, originals)
    yield from multi_frame(cases, rng)
    yield from by_dcmtk(cases)
    yield from indices(cases, rng)
    yield from stacks(cases)
    yield from folders(cases)
