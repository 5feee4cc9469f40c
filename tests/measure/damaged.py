#!/usr/bin/env python3
"""Runs info and render on damaged series and on real oddities, and compares stored values with pydicom and dcmtk.

Usage: damaged.py PROGRAM [--data FOLDER] [--seed N] [--table OUT.md] [--verbose]
Exit code 1 where the program crashed, took more than 2 s of processor time or did not end, gave info and render
different verdicts, or showed without a warning values that another reader reads differently."""
import argparse
import collections
import json
import os
import resource
import subprocess
import sys
import tempfile
import time
import warnings
import zlib

import numpy
import pydicom

import damaged_series

MOST_SECONDS, GIVEN_UP = 2.0, 60
REAL = ("odd-dicom", "transfer-syntaxes", "phantom-study")
DCMTK = ("dcmdjpeg", "dcmdjpls", "dcmdrle")


def run(command):
    """(exit code, seconds of processor time, output, error output); the code is None where it did not end."""
    before, started = resource.getrusage(resource.RUSAGE_CHILDREN), time.time()
    try:
        done = subprocess.run(command, capture_output=True, timeout=GIVEN_UP, stdin=subprocess.DEVNULL)
        code, out, err = done.returncode, done.stdout, done.stderr.decode("utf-8", "replace")
    except subprocess.TimeoutExpired:
        code, out, err = None, b"", ""
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return code, (time.time() - started if code is None else spent), out, err


def stored(ds, values):
    """Values as the file stores them: the bits below and at HighBit, signed where it says so."""
    bits, shift = int(ds.BitsStored), int(ds.HighBit) - int(ds.BitsStored) + 1
    whole = values.astype(numpy.int64) >> max(shift, 0) & (1 << bits) - 1
    if ds.PixelRepresentation == 1:
        whole = (whole ^ 1 << bits - 1) - (1 << bits - 1) + 32768
    return whole.astype("<u2")


def group_value(ds, frame, group, name):
    for where in (ds.get("PerFrameFunctionalGroupsSequence"), ds.get("SharedFunctionalGroupsSequence")):
        if not where:
            continue
        item = where[frame if where is ds.get("PerFrameFunctionalGroupsSequence") else 0]
        if group in item and name in item[group][0]:
            return item[group][0][name].value
    return ds.get(name)


def place(ds, frame):
    position = group_value(ds, frame, "PlanePositionSequence", "ImagePositionPatient")
    axes = group_value(ds, frame, "PlaneOrientationSequence", "ImageOrientationPatient") or [1, 0, 0, 0, 1, 0]
    if position is None:
        raise ValueError("nothing says where the frame lies")
    normal = numpy.cross([float(v) for v in axes[:3]], [float(v) for v in axes[3:]])
    return float(numpy.dot(normal, [float(v) for v in position]))


def read_native(path, scratch):
    """A data set whose pixels pydicom can decode, through dcmtk where it cannot by itself; else None."""
    ds = pydicom.dcmread(path, force=True)
    if "PixelData" not in ds:
        return None
    try:
        ds.pixel_array
        return ds
    except Exception:  # whatever it stumbles over
        pass
    for tool in DCMTK:
        out = os.path.join(scratch, "native.dcm")
        if run([tool, path, out])[0] == 0:
            ds = pydicom.dcmread(out)
            ds.pixel_array
            return ds
    return None


def theirs(path, scratch):
    """Stored values of the file in the order of positions, with its data set; None where nobody else reads it."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            ds = read_native(path, scratch)
            if ds is None or ds.SamplesPerPixel != 1:
                return None
            values = stored(ds, ds.pixel_array).reshape(-1, ds.Rows, ds.Columns)
            order = sorted(range(len(values)), key=lambda frame: place(ds, frame)) if len(values) > 1 else [0]
            return ds, b"".join(values[frame].tobytes() for frame in order)
    except Exception:  # pydicom raises whatever comes
        return None


def differences(shown, path, scratch):
    """What another reader reads otherwise in a file that is shown; None where there is no other reader."""
    other = theirs(path, scratch)
    if not other or "dims" not in shown:
        return None
    ds, values = other
    frames = len(values) // 2 // (ds.Rows * ds.Columns)
    if frames != shown["slices_read"] or shown["slices_missing"]:
        return None  # several series in the file
    found = []
    if zlib.crc32(values) != shown["stored_crc32"]:
        found.append("stored values")
    if shown["dims"][:2] != [ds.Columns, ds.Rows]:
        found.append("size")
    try:
        slope = group_value(ds, 0, "PixelValueTransformationSequence", "RescaleSlope")
        if slope and shown["slope"] is not None and shown["slope"] > 0 and abs(shown["slope"] - float(slope)) > 1e-9 * abs(float(slope)):
            found.append("slope")
        spacing = group_value(ds, 0, "PixelMeasuresSequence", "PixelSpacing")
        if spacing and abs(float(spacing[1]) - shown["spacing_mm"][0]) > 1e-6 * shown["spacing_mm"][0]:
            found.append("spacing")
    except Exception:  # pydicom raises whatever comes
        pass
    return found


class Tally:
    def __init__(self):
        self.cases = self.shown = self.warned = self.refused = self.compared = self.equal = 0
        self.codes, self.slowest = collections.Counter(), 0.0

    def row(self, kind):
        codes = ", ".join("%s" % code for code in sorted(self.codes, key=str))
        same = "%d of %d" % (self.equal, self.compared) if self.compared else "-"
        return "| %s | %d | %d | %d | %d | %s | %s | %.2f |" % (
            kind, self.cases, self.shown, self.warned, self.refused, codes, same, self.slowest)


class Trial:
    def __init__(self, program, scratch, verbose):
        self.program, self.scratch, self.verbose = program, scratch, verbose
        self.tallies, self.wrong = collections.OrderedDict(), []
        self.sentences = collections.defaultdict(collections.Counter)

    def complain(self, kind, case, path, what):
        self.wrong.append("%s: %s: %s: %s" % (kind, case, path, what))
        print("WRONG  " + self.wrong[-1], flush=True)

    def try_one(self, kind, case, path):
        tally = self.tallies.setdefault(kind, Tally())
        code, seconds, out, err = run([self.program, "info", "--json", "-q", path])
        picture = os.path.join(self.scratch, "picture.png")
        drawn, more, _, render_err = run([self.program, "render", path, "-o", picture, "--size", "32x32", "--method", "cpu", "-q"])
        for name, got in (("info", code), ("render", drawn)):
            if got is None or got < 0 or got not in (0, 3, 4, 6):
                self.complain(kind, case, path, "%s: exit code %s" % (name, got))
        if max(seconds, more) > MOST_SECONDS:
            self.complain(kind, case, path, "%.1f s" % max(seconds, more))
        if (code == 0) != (drawn == 0):
            self.complain(kind, case, path, "info %s, render %s: %s" % (code, drawn, render_err.strip()))
        if code and err.count("\n") != 1:
            self.complain(kind, case, path, "no single sentence: %r" % err)
        tally.cases += 1
        tally.codes[code] += 1
        tally.slowest = max(tally.slowest, seconds, more)
        self.judge(tally, kind, case, path, code, out, err, max(seconds, more))

    def judge(self, tally, kind, case, path, code, out, err, seconds):
        verdict, shown = err.strip().replace("angioscope: ", "", 1), {}
        if code == 0:
            shown = json.loads(out)["input"]
            verdict = "shown: " + "; ".join(shown["warnings"]) if shown["warnings"] else "shown"
            tally.shown += not shown["warnings"]
            tally.warned += bool(shown["warnings"])
        else:
            tally.refused += 1
        found = differences(shown, path, self.scratch) if code == 0 and os.path.isfile(path) else None
        if found is not None:
            tally.compared += 1
            tally.equal += not found
        if found and not shown["warnings"]:
            self.complain(kind, case, path, "shown without a warning, and others read other " + ", ".join(found))
        self.sentences[kind][verdict.replace(os.path.basename(path), "FILE")] += 1
        if self.verbose:
            print("%-40s %-30s %s %.2f s  %s%s" % (kind, str(case)[:30], code, seconds, verdict,
                                                 "" if found is None else "  [equal]" if not found else "  [differs]"), flush=True)

    def table(self):
        head = ["| what | cases | shown | shown with a warning | refused | exit codes | equal to pydicom or dcmtk | slowest, s |",
                "|---|---|---|---|---|---|---|---|"]
        total = Tally()
        for tally in self.tallies.values():
            for name in ("cases", "shown", "warned", "refused", "compared", "equal"):
                setattr(total, name, getattr(total, name) + getattr(tally, name))
            total.codes.update(tally.codes)
            total.slowest = max(total.slowest, tally.slowest)
        return head + [tally.row(kind) for kind, tally in self.tallies.items()] + [total.row("all")]

    def verdicts(self):
        """What the program says of real files, each sentence once."""
        lines = ["| folder | files | verdict |", "|---|---|---|"]
        for kind in REAL:
            for sentence, count in sorted(self.sentences[kind].items(), key=lambda item: (-item[1], item[0])):
                lines.append("| %s | %d | %s |" % (kind, count, sentence.replace("|", "/")))
        return lines


def real_files(data):
    """(folder, name, path) of every file of the real oddities, and these folders as a whole."""
    for folder in REAL:
        top = os.path.join(data, folder)
        for where, folders, names in sorted(os.walk(top)):
            folders.sort()
            for name in sorted(names):
                yield folder, name, os.path.join(where, name)
        yield folder + ", the folder", folder, top


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--data", default="../shared/data")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="")
    parser.add_argument("--table")
    parser.add_argument("--verbose", action="store_true")
    options = parser.parse_args()
    syntaxes = os.path.join(options.data, "transfer-syntaxes")
    originals = [os.path.join(syntaxes, n) for n in sorted(os.listdir(syntaxes)) if "JPEG" in n] if os.path.isdir(syntaxes) else []
    with tempfile.TemporaryDirectory() as scratch, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        trial = Trial(os.path.abspath(options.program), scratch, options.verbose)
        if os.path.isdir(options.data):
            for kind, case, path in real_files(options.data):
                if options.only in kind:
                    trial.try_one(kind, case, path)
        for kind, case, path in damaged_series.make(os.path.join(scratch, "made"), options.seed, originals):
            if options.only in kind:
                trial.try_one(kind, case, path)
    print("\n".join(trial.table()))
    if options.table:
        with open(options.table, "w") as out:
            out.write("\n".join(trial.table() + [""] + trial.verdicts()) + "\n")
    print("%d wrong" % len(trial.wrong))
    return 1 if trial.wrong else 0


if __name__ == "__main__":
    sys.exit(main())
