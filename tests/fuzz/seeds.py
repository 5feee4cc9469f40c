#!/usr/bin/env python3
"""Writes what the fuzz targets begin with, a folder for each. Usage: seeds.py SOURCE CORPUS

All is made here but for the presets, which are the program's, and inputs that once failed (tests/fuzz/regressions).
"""
import bz2
import gzip
import io
import json
import pathlib
import shutil
import struct
import sys
import warnings
import zipfile
import zlib

source, corpus = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])


def save(target, name, data):
    folder = corpus / target
    folder.mkdir(parents=True, exist_ok=True)
    (folder / name).write_bytes(data if isinstance(data, bytes) else data.encode())


# DICOM (PS3.5 section 7).
LONG = ("OB", "OW", "OF", "SQ", "UT", "UN", "OD", "OL", "UC", "UR")


def element(group, number, vr, value, explicit=True, big=False):
    order = ">" if big else "<"
    if isinstance(value, str):
        value = value.encode()
    value += b" " * (len(value) % 2)
    head = struct.pack(order + "HH", group, number)
    if not explicit:
        return head + struct.pack(order + "I", len(value)) + value
    if vr in LONG:
        return head + vr.encode() + b"\0\0" + struct.pack(order + "I", len(value)) + value
    return head + vr.encode() + struct.pack(order + "H", len(value)) + value


def dicom(z=0.0, syntax="1.2.840.10008.1.2.1", explicit=True, big=False, meta=True, width=4, height=3, changes=None,
          pixels=None, before=b""):
    order = ">" if big else "<"

    def word(value):
        return struct.pack(order + "H", value & 0xFFFF)

    fields = {
        (0x08, 0x05): ("CS", "ISO_IR 100"), (0x08, 0x08): ("CS", "ORIGINAL\\PRIMARY\\AXIAL"),
        (0x08, 0x16): ("UI", "1.2.840.10008.5.1.4.1.1.2"), (0x08, 0x22): ("DA", "20240517"), (0x08, 0x32): ("TM", "101112"),
        (0x08, 0x60): ("CS", "CT"), (0x08, 0x103E): ("LO", "HEAD"), (0x10, 0x10): ("PN", "DOE^JANE"),
        (0x18, 0x50): ("DS", "2"), (0x18, 0x88): ("DS", "2"), (0x18, 0x1120): ("DS", "0"), (0x20, 0x0E): ("UI", "1.2.3"),
        (0x20, 0x11): ("IS", "2"), (0x20, 0x12): ("IS", "1"), (0x20, 0x13): ("IS", str(int(z) + 1)),
        (0x20, 0x32): ("DS", f"-1\\-2\\{z:g}"), (0x20, 0x37): ("DS", "1\\0\\0\\0\\1\\0"), (0x28, 0x02): ("US", word(1)),
        (0x28, 0x04): ("CS", "MONOCHROME2"), (0x28, 0x10): ("US", word(height)), (0x28, 0x11): ("US", word(width)),
        (0x28, 0x30): ("DS", "0.5\\0.25"), (0x28, 0x100): ("US", word(16)), (0x28, 0x101): ("US", word(12)),
        (0x28, 0x102): ("US", word(11)), (0x28, 0x103): ("US", word(0)), (0x28, 0x1050): ("DS", "40"),
        (0x28, 0x1051): ("DS", "400"), (0x28, 0x1052): ("DS", "-1024"), (0x28, 0x1053): ("DS", "1"),
    }
    fields.update(changes or {})
    data = before
    for (group, number), field in sorted(fields.items()):
        if field:
            data += element(group, number, *field, explicit, big)
    if pixels is None:
        values = [(100 * i + 7 * int(z)) % 4096 for i in range(width * height)]
        data += element(0x7FE0, 0x10, "OW", struct.pack(f"{order}{len(values)}H", *values), explicit, big)
    else:
        data += struct.pack("<HH2sHI", 0x7FE0, 0x10, b"OB", 0, 0xFFFFFFFF) + pixels
    if syntax.endswith(".99"):
        packer = zlib.compressobj(9, zlib.DEFLATED, -15)
        data = packer.compress(data) + packer.flush()
    if not meta:
        return data
    head = element(0x02, 0x02, "UI", "1.2.840.10008.5.1.4.1.1.2") + element(0x02, 0x10, "UI", syntax + "\0" * (len(syntax) % 2))
    return b"\0" * 128 + b"DICM" + element(0x02, 0x00, "UL", struct.pack("<I", len(head))) + head + data


def item(data):
    return struct.pack("<HHI", 0xFFFE, 0xE000, len(data)) + data


def run_lengths(width=4, height=3):
    rows = bytes([width * height - 1]) + bytes(range(width * height))
    runs = bytes([257 - width * height, 5])
    return struct.pack("<16I", 2, 64, 64 + len(rows), *[0] * 13) + rows + runs


END = struct.pack("<HHI", 0xFFFE, 0xE0DD, 0)
SEQUENCE = (struct.pack("<HH2sHI", 0x08, 0x1140, b"SQ", 0, 0xFFFFFFFF) + struct.pack("<HHI", 0xFFFE, 0xE000, 0xFFFFFFFF) +
            element(0x08, 0x1150, "UI", "1.2") + struct.pack("<HHI", 0xFFFE, 0xE00D, 0) + END)
RLE = item(b"") + item(run_lengths()) + END
headers = {
    "plain": dicom(), "implicit": dicom(syntax="1.2.840.10008.1.2", explicit=False),
    "big": dicom(syntax="1.2.840.10008.1.2.2", big=True), "no-meta": dicom(meta=False),
    "deflated": dicom(syntax="1.2.840.10008.1.2.1.99"), "sequence": dicom(before=SEQUENCE),
    "rle": dicom(syntax="1.2.840.10008.1.2.5", pixels=RLE), "cut": dicom()[:700],
    "signed": dicom(changes={(0x28, 0x103): ("US", b"\1\0"), (0x28, 0x120): ("SS", struct.pack("<h", -2000))}),
    "frames": dicom(changes={(0x28, 0x08): ("IS", "3")}), "no-image": dicom(changes={(0x28, 0x10): None, (0x28, 0x11): None}),
}


def sequence(group, number, items):
    data = b"".join(item(i) for i in items)
    return struct.pack("<HH2sHI", group, number, b"SQ", 0, len(data)) + data


def enhanced(count, compressed=False):
    """Frames with functional groups, the last first."""
    frames = []
    for i in reversed(range(count)):
        frames.append(sequence(0x20, 0x9111, [element(0x20, 0x9056, "SH", "1") + element(0x20, 0x9057, "UL", struct.pack("<I", i + 1))]) +
                      sequence(0x20, 0x9113, [element(0x20, 0x32, "DS", f"0\\0\\{i}")]))
    shared = (sequence(0x20, 0x9116, [element(0x20, 0x37, "DS", "1\\0\\0\\0\\1\\0")]) +
              sequence(0x28, 0x9110, [element(0x18, 0x50, "DS", "1") + element(0x28, 0x30, "DS", "1\\1")]) +
              sequence(0x28, 0x9145, [element(0x28, 0x1052, "DS", "-1024") + element(0x28, 0x1053, "DS", "1") + element(0x28, 0x1054, "LO", "HU")]))
    changes = {(0x08, 0x16): ("UI", "1.2.840.10008.5.1.4.1.1.2.1"), (0x28, 0x08): ("IS", str(count)), (0x20, 0x32): None,
               (0x20, 0x37): None, (0x28, 0x30): None, (0x28, 0x1052): None, (0x28, 0x1053): None}
    groups = sequence(0x5200, 0x9229, [shared]) + sequence(0x5200, 0x9230, frames)
    if compressed:
        run = run_lengths()
        table = item(struct.pack(f"<{count}I", *(i * (8 + len(run)) for i in range(count))))
        pixels = table + item(run) * count + END
        data = dicom(syntax="1.2.840.10008.1.2.5", changes=changes, pixels=pixels)
    else:
        data = dicom(changes={**changes, (0x7FE0, 0x10): ("OW", bytes(i % 16 for i in range(24 * count)))}, pixels=b"")[:-12]
    at = data.index(struct.pack("<HH", 0x7FE0, 0x10))
    return data[:at] + groups + data[at:]


headers["enhanced"] = enhanced(3)
headers["enhanced-rle"] = enhanced(3, True)
for name, data in headers.items():
    save("fuzz_dicom_header", name, data)


def joined(files):
    return b"".join(struct.pack("<H", len(f)) + f for f in files)


tilt = [dicom(z, changes={(0x20, 0x32): ("DS", f"0\\{0.3 * z:g}\\{z:g}")}) for z in range(4)]
padded = {(0x28, 0x120): ("US", struct.pack("<H", 7)), (0x28, 0x121): ("US", struct.pack("<H", 14))}
series = {
    "even": [dicom(z) for z in range(4)], "gap": [dicom(z) for z in (0, 1, 3, 4)], "twice": [dicom(z) for z in (0, 1, 1, 2)],
    "uneven": [dicom(z) for z in (0, 1, 2.4, 5)], "tilt": tilt, "padded": [dicom(z, changes=padded) for z in range(3)],
    "rescale": [dicom(z, changes={(0x28, 0x1053): ("DS", str(1 + z))}) for z in range(3)],
    "two": [dicom(z, changes={(0x20, 0x0E): ("UI", f"1.2.{z % 2}")}) for z in range(4)],
    "unplaced": [dicom(z, changes={(0x20, 0x32): None}) for z in range(3)],
    "broken": [dicom(0), dicom(1)[:600], dicom(2), dicom(3, syntax="1.2.840.10008.1.2.5", pixels=RLE)],
    "phases": [dicom(z % 2, changes={(0x20, 0x100): ("IS", str(z // 2))}) for z in range(4)],
    "monochrome1": [dicom(z, changes={(0x28, 0x04): ("CS", "MONOCHROME1")}) for z in range(2)],
}
series["enhanced"] = [enhanced(4)]
series["enhanced-rle"] = [enhanced(2, True), enhanced(3)]
for name, files in series.items():
    save("fuzz_dicom_series", name, joined(files))
save("fuzz_dicom_stream", "rle", bytes([12, 1]) + run_lengths())
save("fuzz_decode", "rle", bytes([0, 4, 3, 15]) + item(run_lengths()) + END)
for path in sorted((corpus / "streams").glob("*")):
    save("fuzz_dicom_stream", path.name, bytes([12, 1]) + path.read_bytes())
    kind, bits = path.name.split("-")[:2]
    endings = ["5", "4.50", "4.51", "4.53", "4.55", "4.57", "4.70", "4.80", "4.81", "4.90", "4.91", "4.92"]
    start = bytes([endings.index(kind), 16, 16, int(bits) - 1])
    save("fuzz_decode", path.name, start + item(path.read_bytes()) + END)


# DICOMDIR (PS3.3 annex F).
def directory(names):
    records = b"".join(item(element(0x04, 0x1400, "UL", b"\0" * 4) + element(0x04, 0x1410, "US", b"\xff\xff") +
                            element(0x04, 0x1430, "CS", "IMAGE") + element(0x04, 0x1500, "CS", name)) for name in names)
    data = element(0x04, 0x1130, "CS", "DISC") + element(0x04, 0x1200, "UL", b"\0" * 4) + element(0x04, 0x1212, "US", b"\0\0")
    data += struct.pack("<HH2sHI", 0x04, 0x1220, b"SQ", 0, len(records)) + records
    head = element(0x02, 0x02, "UI", "1.2.840.10008.1.3.10") + element(0x02, 0x10, "UI", "1.2.840.10008.1.2.1")
    return b"\0" * 128 + b"DICM" + head + data


save("fuzz_dicom_directory", "two", directory(["IM1", "IM2"]))
save("fuzz_dicom_directory", "away", directory(["..\\IM1", "A\\B\\IM2", "IM3"]))
save("fuzz_dicom_directory", "empty", directory([]))


# NIfTI-1 (nifti1.h).
def nifti(kind=4, bits=16, order="<", magic=b"n+1\0", dims=(3, 4, 3, 2, 1, 1, 1, 1), sform=1, qform=0, slope=2.0):
    head = struct.pack(order + "i", 348) + b"\0" * 36 + struct.pack(order + "8h", *dims) + b"\0" * 14
    head += struct.pack(order + "hhh", kind, bits, 0) + struct.pack(order + "8f", 1, 0.5, 0.5, 2, 1, 0, 0, 0)
    head += struct.pack(order + "3f", 352, slope, -1024) + b"\0\0\0\2" + b"\0" * 24 + b"made up".ljust(80, b"\0")
    head += b"\0" * 24 + struct.pack(order + "hh", qform, sform) + struct.pack(order + "6f", 0, 0, 0.1, 1, 2, 3)
    head += struct.pack(order + "12f", 0.5, 0, 0, 1, 0, 0.5, 0, 2, 0, 0, 2, 3) + b"\0" * 16 + magic
    count = dims[1] * dims[2] * dims[3] * max(dims[4], 1)
    return head + b"\0" * 4 + bytes(i * 37 % 251 for i in range(count * bits // 8))


volumes = {
    "i16": nifti(), "u8": nifti(2, 8), "f32": nifti(16, 32), "f64": nifti(64, 64), "i32": nifti(8, 32), "big": nifti(order=">"),
    "qform": nifti(sform=0, qform=1), "neither": nifti(sform=0), "4d": nifti(dims=(4, 3, 2, 2, 3, 1, 1, 1)), "pair": nifti(magic=b"ni1\0"),
    "slope": nifti(slope=-1.0), "gz": gzip.compress(nifti(), mtime=0),
}
for name, data in volumes.items():
    save("fuzz_nifti", name, data)

# NRRD and MetaImage.
voxels = bytes(i * 37 % 251 for i in range(2 * 3 * 4 * 2))
geometry = "space: left-posterior-superior\nspace directions: (0.5,0,0) (0,0.5,0) (0,0.1,2)\nspace origin: (1,2,3)\n"
raw = "dimension: 3\ntype: short\nsizes: 2 3 4\nendian: little\n"
nrrds = {
    "raw": ("NRRD0004\n# made up\n" + raw + geometry + "encoding: raw\n\n").encode() + voxels,
    "gzip": ("NRRD0005\n" + raw + geometry + "encoding: gzip\n\n").encode() + gzip.compress(voxels, mtime=0),
    "bzip2": ("NRRD0005\n" + raw + "encoding: bzip2\n\n").encode() + bz2.compress(voxels),
    "text": ("NRRD0001\ndimension: 3\ntype: float\nsizes: 2 2 2\nspacings: 1 1 2\nencoding: ascii\n\n1 2 3.5 -4e1 nan inf 7 8\n").encode(),
    "hex": ("NRRD0003\ndimension: 3\ntype: uchar\nsizes: 2 2 2\nencoding: hex\n\n00 01 02 03 fF A0 b1 07\n").encode(),
    "detached": ("NRRD0004\n" + raw + "encoding: raw\nbyte skip: -1\ndata file: a.raw\n").encode(),
    "list": ("NRRD0004\n" + raw + "encoding: raw\ndata file: LIST 2\na.raw\na.raw\na.raw\na.raw\n").encode(),
    "pattern": ("NRRD0004\n" + raw + "encoding: raw\nline skip: 1\ndata file: a%03d.raw 1 4 1 2\n").encode(),
    "phases": ("NRRD0004\ndimension: 4\ntype: uint8\nsizes: 2 2 3 2\nkinds: list domain domain domain\nspace: RAS\n"
               "space directions: none (1,0,0) (0,1,0) (0,0,1)\nencoding: raw\nkey:=value\n\n").encode() + voxels,
    "old": ("NRRD0002\n" + raw + "axis mins: 0 0 0\naxis maxs: 1 1 1\ncenterings: cell cell cell\nencoding: raw\n\n").encode() + voxels,
}
for name, data in nrrds.items():
    save("fuzz_nrrd", name, data)
meta = ("ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nTransformMatrix = 1 0 0 0 1 0 0 0 -1\n"
        "Offset = 1 2 3\nCenterOfRotation = 0 0 0\nAnatomicalOrientation = RAI\nElementSpacing = 0.5 0.5 2\nDimSize = 2 3 4\n"
        "ElementType = MET_SHORT\n")
packed = zlib.compress(voxels)
metas = {
    "raw": (meta + "ElementDataFile = LOCAL\n").encode() + voxels,
    "packed": (meta + f"CompressedData = True\nCompressedDataSize = {len(packed)}\nElementDataFile = LOCAL\n").encode() + packed,
    "text": (meta.replace("BinaryData = True", "BinaryData = False") + "ElementDataFile = LOCAL\n").encode() + b" ".join(b"%d" % v for v in voxels[:24]),
    "detached": (meta + "HeaderSize = -1\nElementDataFile = a.raw\n").encode(),
    "list": (meta + "ElementDataFile = LIST 2\na.raw\na.raw\na.raw\na.raw\n").encode(),
    "pattern": (meta + "ElementDataFile = a%02d.raw 1 4 1\n").encode(),
    "float": (meta.replace("MET_SHORT", "MET_FLOAT").replace("2 3 4", "2 2 3") + "ElementDataFile = LOCAL\n").encode() + voxels,
    "channels": (meta + "ElementNumberOfChannels = 2\nElementDataFile = LOCAL\n").encode() + voxels * 2,
}
for name, data in metas.items():
    save("fuzz_metaimage", name, data)


# Archives.
def archive(members, packing):
    warnings.simplefilter("ignore")  # of names that come twice, which is what is wanted
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", packing) as packed:
        for name, data in members:
            packed.writestr(zipfile.ZipInfo(name), data, packing)
    return out.getvalue()


save("fuzz_zip", "stored", archive([("a/b.dcm", dicom()), ("c", b"")], zipfile.ZIP_STORED))
save("fuzz_zip", "deflated", archive([("a/b.dcm", dicom()), ("a/", b""), ("d", b"x" * 1000)], zipfile.ZIP_DEFLATED))
save("fuzz_zip", "bzip2", archive([("a", b"y" * 500)], zipfile.ZIP_BZIP2))
save("fuzz_zip", "away", archive([("../a", b"1"), ("/b", b"2"), ("c\\..\\..\\d", b"3"), ("e", b"4"), ("e", b"5")], zipfile.ZIP_STORED))

# JSON.
save("fuzz_stack_sidecar", "whole", json.dumps({"spacing": [1, 1, 2.5], "origin": [1, 2, 3], "directions": [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
                                                "slope": 2, "intercept": -1024, "signed": True}))
save("fuzz_stack_sidecar", "short", json.dumps({"spacing": [1, 1, 2.5], "slope": 1}))
save("fuzz_raw_sidecar", "lists", json.dumps({"dims": [16, 16, 8], "type": "u16", "spacing": [1, 1, 2.5]}))
save("fuzz_raw_sidecar", "texts", json.dumps({"dims": "8x8x16", "type": "f32", "spacing": "1,2,3"}))
save("fuzz_raw_sidecar", "bytes", json.dumps({"dims": [16, 16, 16], "type": "i8"}))
presets = sorted((source / "presets").glob("*.json"))
for path in presets:
    save("fuzz_preset", path.stem, path.read_bytes())
save("fuzz_preset", "simple", '{"unit_mm": 2, "points": [[-100, 0, 0, 0, 0], [200, 1, 0.5, 0, 0.3]], "comment": "x"}')
save("fuzz_preset", "extinction", '{"points": [{"hu": 0, "colour": [1, 1, 1], "extinction": 0.5}], "window": {"centre": 1, "width": 2}}')
preset = json.loads(presets[0].read_text())
state = {
    "angioscope_state": 1, "program": "0.1.0", "input": {"path": "ct", "name": "1a2b3c4d-1"}, "preset": preset,
    "preset_changed": True, "shift_hu": 10, "stretch": 1.5, "render": {"view": "30,10", "zoom": "1.5", "clip": "0%,50%,0,9,1,2"},
    "window": {"centre": 40, "width": 400}, "slab": {"mm": 10, "mode": "mip"}, "crosshair_mm": [1, 2, 3],
    "planes_turn": [1, 0, 0, 0, 1, 0, 0, 0, 1], "axial": {"zoom": 2, "pan_mm": [1, 2]}, "crop": {"lower": [0, 0, 0], "upper": [9, 9, 9]},
    "measures": {"hidden": False, "list": [
        {"kind": "length", "points_mm": [[0, 0, 0], [1, 2, 3]], "label_mm": [1, 2]},
        {"kind": "angle", "points_mm": [[0, 0, 0], [1, 2, 3], [4, 4, 4]], "label_mm": [1, 2]},
        {"kind": "ellipse", "points_mm": [[0, 0, 0], [1, 2, 3]], "right": [1, 0, 0], "down": [0, 1, 0], "label_mm": [0, 0]}]},
    "maximised": "axial", "tool": "window", "method": "auto", "corner_text": True, "live": {"x": 1},
}
save("fuzz_state", "whole", json.dumps(state, indent=1))
for name in state:
    save("fuzz_state", "with-" + name, json.dumps({"angioscope_state": 1, "preset": preset, name: state[name]}))
save("fuzz_json", "point", "points[1].opacity\n" + json.dumps(preset, indent=1))
save("fuzz_json", "escapes", 'a.b[2]\n\ufeff{"a": {"b": [1, "\\u00e4\\"", [true, null]]}}')
preferences = {
    "angioscope_viewer": 1, "theme": "light", "split": [0.4, 0.6], "panel": {"width": 300, "hidden": True}, "window": [1280, 720],
    "corner_text": False, "crosshair": True, "recent": ["/data/a", "/data/b"],
}
save("fuzz_preferences", "whole", json.dumps(preferences))
save("fuzz_costs", "two", json.dumps({"of": "this machine", "measured_ms": 12.5, "methods": [
    {"name": "cpu", "terms": [1, 2, 0.5, 0.25, 3], "spread": 0.1}, {"name": "reference", "terms": [0, 1, 2, 3, 4], "spread": None}]}))


def chunk(name, data):
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


def attribute(name, kind, value):
    return name + b"\0" + kind + b"\0" + struct.pack("<I", len(value)) + value


text = json.dumps(state).encode()
for name, packed in (("plain", chunk(b"tEXt", b"angioscope_state\0" + text)),
                     ("international", chunk(b"iTXt", b"angioscope_state\0\0\0\0\0" + text)),
                     ("packed", chunk(b"zTXt", b"angioscope_state\0\0" + zlib.compress(text)))):
    save("fuzz_picture_state", name, b"\0\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 2, 1, 8, 0, 0, 0, 0)) + packed +
         chunk(b"IDAT", zlib.compress(b"\0\1\2")) + chunk(b"IEND", b""))
box = struct.pack("<4i", 0, 0, 1, 0)
channel = b"G\0" + struct.pack("<iB3xii", 2, 0, 1, 1)
save("fuzz_picture_state", "exr", b"\1\x76\x2f\x31\x01" + struct.pack("<I", 2) + attribute(b"channels", b"chlist", channel + b"\0") +
     attribute(b"compression", b"compression", b"\0") + attribute(b"dataWindow", b"box2i", box) +
     attribute(b"displayWindow", b"box2i", box) + attribute(b"lineOrder", b"lineOrder", b"\0") +
     attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1)) + attribute(b"screenWindowCenter", b"v2f", bytes(8)) +
     attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1)) + attribute(b"angioscope_state", b"string", text) + b"\0" +
     struct.pack("<QiI2f", 0, 0, 8, 1, 2))

# Volume properties of 3D Slicer.
opacity, colour = "6 -100 0 50 0.25 3000 1", "12 -100 0 0 0 50 1 0.5 0 3000 1 1 1"
save("fuzz_slicer", "vp", f"\0001\n1\n0.9\n0.1\n0.2\n10\n{opacity}\n4 0 1 255 1\n{colour}\n")
save("fuzz_slicer", "xml", "\1<?xml version='1.0'?>\n<MRML><!-- x -->\n<VolumeProperty name=\"CT-&quot;A\" id=\"1\" interpolation='1' "
     f"shade='1' diffuse='0.9' ambient='0.1' specular='0.2' specularPower='10' scalarOpacity='{opacity}' gradientOpacity='4 0 1 255 1' "
     f"colorTransfer='{colour}'/></MRML>")
curve = [{"x": -100, "y": 0, "midpoint": 0.5, "sharpness": 0}, {"x": 300, "y": 0.4, "midpoint": 0.3, "sharpness": 0.7}]
save("fuzz_slicer", "json", "\2" + json.dumps({"@schema": "volume-property-schema-v1.0.0.json#", "volumeProperties": [{
    "effectiveRange": [-100, 300], "isoSurfaceValues": [120], "components": [{
        "componentWeight": 1, "shade": True, "lighting": {"diffuse": 0.9, "ambient": 0.1, "specular": 0.2, "specularPower": 10},
        "disableGradientOpacity": False, "scalarOpacityUnitDistance": 2, "interpolationType": "linear",
        "scalarOpacity": {"type": "piecewiseLinearFunction", "points": curve},
        "gradientOpacity": {"type": "piecewiseLinearFunction", "points": curve},
        "rgbTransferFunction": {"type": "colorTransferFunction", "points": [
            {"x": -100, "color": [0, 0, 0], "midpoint": 0.5, "sharpness": 0}, {"x": 300, "color": [1, 0.5, 0], "midpoint": 0.5, "sharpness": 0}]}}]}]}))

# The rest.
save("fuzz_portable", "ppm", b"P6\n# made up\n3 2\n255\n" + bytes(range(18)))
save("fuzz_portable", "pfm", b"PF\n3 2\n-1.0\n" + struct.pack("<18f", *range(18)))
save("fuzz_text", "words", "D\u00fcrer^Albrecht^^Dr.=\u738b^\u5c0f\u6771=x".encode() + b"\xff\x07\xc3")
lines = [
    "\1data\n--output\na.png\n--size\n640x480\n--view\n30,10,5\n--clip\n0%,50%,0,9,1,2\n--clip-plane\n1,2,3,4",
    "\1data\n-o\na.png\n--mode\nmip\n--background\n1,0.5,0,1\n--force\nslabs,gl\n--bricks\n2x3x4\n--step\n1e-1",
    "\0data\n--json\n--series\n3\n--threads\n2", "\6data\n--cut-plane\naxial:5,coronal:30%\n--measure\n1,2,3,4,5,6",
    "\7data\n--preset\ncta-head\n--state\nx.json", "\3-o\nd\n--dims\n8x8x8\n--noise\n3", "\4a\nb\n--threshold=3\n-q",
]
for i, line in enumerate(lines):
    save("fuzz_options", str(i), line)
for path in sorted((source / "tests/fuzz/regressions").glob("*/*")):
    (corpus / path.parent.name).mkdir(parents=True, exist_ok=True)
    shutil.copy(path, corpus / path.parent.name / path.name)
