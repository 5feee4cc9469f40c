#!/usr/bin/env python3
"""Volumes written by other tools (nibabel, VTK, teem) as `angioscope info` reads them: size, affine, values.

Usage: other_tools.py ANGIOSCOPE FOLDER. Exit code 77 where none of them is installed."""
import json
import os
import shutil
import subprocess
import sys
import zlib

try:
    import numpy as np
except ImportError:
    print("skipped: no numpy")
    sys.exit(77)
try:
    import nibabel
except ImportError:
    nibabel = None
try:
    from vtkmodules.util.numpy_support import numpy_to_vtk
    from vtkmodules.vtkCommonDataModel import vtkImageData
    from vtkmodules.vtkIOImage import vtkMetaImageWriter, vtkPNGWriter
    has_vtk = True
except ImportError:
    has_vtk = False

PROGRAM, FOLDER = sys.argv[1:3]
RAS_TO_LPS = np.diag([-1.0, -1.0, 1.0, 1.0])
failures = []


def values(shape, kind):
    """Distinct whole numbers, x fastest; of both signs where the type has them."""
    numbers = np.arange(int(np.prod(shape))) * 37 % 50000
    if np.dtype(kind).itemsize == 1:
        numbers = numbers % 127
    if np.dtype(kind).kind in "if":
        numbers = numbers - numbers.max() // 2
    return numbers.reshape(shape, order="F").astype(kind)


def check(name, path, volume, affine, *options):
    """`volume` is indexed x, y, z, as numbers; `affine` leads to LPS."""
    done = subprocess.run([PROGRAM, "info", path, "--json", "--quiet", *options], capture_output=True, text=True)
    if done.returncode != 0:
        failures.append(f"{name}: {done.stderr.strip()}")
        return
    report = json.loads(done.stdout)
    report = report.get("input", report)
    low, high = report["hu_range"]
    slope, intercept = report["slope"], report["intercept"]
    signed = volume.dtype.kind == "i" and volume.dtype.itemsize <= 2
    stored = np.rint((volume.astype(float) - intercept) / slope) + (32768 if signed else 0)
    sum_of = zlib.crc32(stored.astype("<u2").tobytes(order="F"))
    wrong = []
    if report["dims"] != list(volume.shape):
        wrong.append(f"size {report['dims']}")
    if not np.allclose(np.array(report["affine"]), affine, atol=1e-5):
        wrong.append(f"affine {report['affine']}, not {affine.tolist()}")
    if abs(low - volume.min()) > abs(slope) or abs(high - volume.max()) > abs(slope):
        wrong.append(f"range {low} to {high}, not {volume.min()} to {volume.max()}")
    if f"{sum_of:08x}" != str(report["stored_crc32"]) and sum_of != report["stored_crc32"]:
        wrong.append(f"values (checksum {report['stored_crc32']}, not {sum_of:08x})")
    print(f"{'FAILED' if wrong else 'ok':6}  {name}")
    failures.extend(f"{name}: {what}" for what in wrong)


def with_nibabel():
    rng = np.random.default_rng(5)
    for case in range(8):
        kind = [np.int16, np.uint8, np.uint16, np.float32][case % 4]
        volume = values((5, 4, 3), kind)
        affine = np.eye(4)
        rotation, _ = np.linalg.qr(rng.normal(size=(3, 3)))
        if case % 4 > 1:
            rotation[:, 0] *= -1  # the other hand
        affine[:3, :3] = rotation * rng.uniform(0.3, 3, size=3)
        affine[:3, 3] = rng.uniform(-200, 200, size=3)
        sheared = case % 3 == 2
        if sheared:
            affine[0, 2] += 0.7
        image = nibabel.Nifti1Image(volume, affine)
        by = "sform"
        if case % 2 == 0 and not sheared:
            image.set_qform(affine, code=1)
            image.set_sform(None, code=0)
            affine, by = image.get_qform(), "qform"
        path = f"{FOLDER}/n{case}.nii" + (".gz" if case % 2 else "")
        image.to_filename(path)
        turn = "left" if np.linalg.det(affine) < 0 else "right"
        check(f"nibabel: {by}, {np.dtype(kind).name}, {turn}-handed{', sheared' if sheared else ''}", path, volume,
              RAS_TO_LPS @ affine)
    phases = values((5, 4, 3, 6), np.int16)
    nibabel.Nifti1Image(phases, np.eye(4)).to_filename(f"{FOLDER}/phases.nii.gz")
    for phase in (1, 4, 6):
        check(f"nibabel: phase {phase} of 6", f"{FOLDER}/phases.nii.gz", phases[..., phase - 1], RAS_TO_LPS, "--phase",
              str(phase))


def with_vtk():
    for kind in (np.int16, np.uint8, np.uint16, np.int32, np.float32, np.float64):
        volume = values((5, 4, 3), kind)
        image = vtkImageData()
        image.SetDimensions(*volume.shape)
        image.SetSpacing(0.5, 0.75, 2)
        image.SetOrigin(-10, 20, 30)
        image.GetPointData().SetScalars(numpy_to_vtk(volume.ravel(order="F"), deep=True))
        affine = np.diag([0.5, 0.75, 2, 1.0])
        affine[:3, 3] = -10, 20, 30
        for ending in ("mha", "mhd"):
            for packed in (False, True):
                path = f"{FOLDER}/{np.dtype(kind).name}-{packed}.{ending}"
                writer = vtkMetaImageWriter()
                writer.SetInputData(image)
                writer.SetFileName(path)
                writer.SetCompression(packed)
                writer.Write()
                check(f"VTK: {np.dtype(kind).name}, .{ending}{', packed' if packed else ''}", path, volume, affine)
        if np.dtype(kind).itemsize <= 2:
            tiff_stack(image, volume)


def tiff_stack(image, volume):
    """Single pictures; VTK writes the row with the greatest y first."""
    if volume.dtype.kind != "u":
        return
    folder = f"{FOLDER}/stack-{volume.dtype.name}"
    os.makedirs(folder, exist_ok=True)
    writer = vtkPNGWriter()
    writer.SetInputData(image)
    writer.SetFilePattern("%s/im%d.png")
    writer.SetFilePrefix(folder)
    writer.Write()
    with open(f"{folder}/stack.json", "w") as out:
        json.dump({"spacing": [0.5, 0.75, 2], "origin": [0, 0, 0]}, out)
    check(f"VTK: stack of PNG, {volume.dtype.name}", folder, volume[:, ::-1, :], np.diag([0.5, 0.75, 2, 1.0]))


def with_teem(unu):
    volume = values((5, 4, 3), np.int16)
    raw, first = f"{FOLDER}/teem.raw", f"{FOLDER}/teem.nrrd"
    with open(raw, "wb") as out:
        out.write(volume.astype("<i2").tobytes(order="F"))
    subprocess.run([unu, "make", "-i", raw, "-t", "short", "-s", "5", "4", "3", "-e", "raw", "-en", "little", "-spc",
                    "right-anterior-superior", "-dirs", "(0.5,0,0.1) (0,0.75,0) (0,0,-2)", "-orig", "(-10,20,30)",
                    "-o", first], check=True)
    affine = np.array([[0.5, 0, 0, -10], [0, 0.75, 0, 20], [0.1, 0, -2, 30], [0, 0, 0, 1.0]])
    for coding in ("raw", "gzip", "bzip2", "ascii", "hex"):
        for ending in ("nrrd", "nhdr"):
            # teem writes the bytes of text in the wrong order where another is asked for
            for order in ("little",) if coding == "ascii" else ("little", "big"):
                path = f"{FOLDER}/teem-{coding}-{order}.{ending}"
                done = subprocess.run([unu, "save", "-f", "nrrd", "-e", coding, "-en", order, "-i", first, "-o", path],
                                      capture_output=True)
                if done.returncode != 0:
                    print(f"skipped: {unu} writes no {coding}")
                    continue
                check(f"teem: {coding}, {order} endian, .{ending}", path, volume, RAS_TO_LPS @ affine)


unu = shutil.which("teem-unu") or shutil.which("unu")
if not nibabel and not has_vtk and not unu:
    print("skipped: neither nibabel nor VTK nor teem")
    sys.exit(77)
os.makedirs(FOLDER, exist_ok=True)
if nibabel:
    with_nibabel()
else:
    print("skipped: no nibabel")
if has_vtk:
    with_vtk()
else:
    print("skipped: no VTK")
if unu:
    with_teem(unu)
else:
    print("skipped: no teem-unu (package teem-apps)")
for failure in failures:
    print(failure, file=sys.stderr)
sys.exit(1 if failures else 0)
