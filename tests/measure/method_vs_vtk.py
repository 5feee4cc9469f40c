#!/usr/bin/python3
"""A method against one of VTK's mappers on the same machine: a series, the same orbit and transfer function, in turns in one
run; medians over the orbit and the ratio. Needs python3-vtk9, python3-numpy, Xvfb and a folder with bench_vtk.py, xrun.sh
and tf/. Usage: method_vs_vtk.py PROGRAM SERIES BENCH [ROUNDS] [METHOD] [gpu|cpu] [SIDE]"""
import json, os, statistics, struct, subprocess, sys, tempfile
import numpy as np

program, phantom, bench = sys.argv[1:4]
rounds = int(sys.argv[4]) if len(sys.argv) > 4 else 2
method = sys.argv[5] if len(sys.argv) > 5 else 'slicing'
mapper = sys.argv[6] if len(sys.argv) > 6 else 'gpu'
side = sys.argv[7] if len(sys.argv) > 7 else '512'
size = f'{side}x{side}'
frames = 12


def metaimage(folder, work):
    """The series as a MetaImage in HU, rows and slices as they lie in the patient; VTK reads that without a guess."""
    subprocess.run(['dcm2niix', '-b', 'n', '-z', 'n', '-f', 'phantom', '-o', work, folder], check=True,
                   capture_output=True)
    name = os.path.join(work, 'phantom.nii')
    head = open(name, 'rb').read(352)
    dims = struct.unpack('<8h', head[40:56])[1:4]
    spacing = struct.unpack('<8f', head[76:108])[1:4]
    slope, intercept = struct.unpack('<2f', head[112:120])
    data = np.fromfile(name, '<i2', offset=352).reshape(dims[::-1]).astype(np.float32)
    data = np.round(data * (slope or 1) + intercept).astype('<i2')[:, ::-1, :]  # dcm2niix turns the rows over
    data.tofile(os.path.join(work, 'phantom.raw'))
    path = os.path.join(work, 'phantom.mhd')
    open(path, 'w').write(
        f'ObjectType = Image\nNDims = 3\nDimSize = {dims[0]} {dims[1]} {dims[2]}\nElementSpacing = '
        f'{spacing[0]} {spacing[1]} {spacing[2]}\nElementType = MET_SHORT\nElementDataFile = phantom.raw\n')
    return path


def ours(step, shaded):
    text = subprocess.run(
        [program, 'render', phantom, '-q', '-o', os.path.join(work, 'x.png'), '--preset',
         os.path.join(bench, 'tf', 'angio.json'), '--method', method, '--view', '0,20', '--zoom', '1.7', '--step', str(step),
         '--shading', 'phong' if shaded else 'none', '--backend', 'osmesa', '--size', size, '--repeat', str(frames), '--orbit', '360',
         '--json', '-'], check=True, capture_output=True, text=True).stdout
    return json.loads(text)['time_ms']['frame_median']


def theirs(step, shaded):
    text = subprocess.run(
        [os.path.join(bench, 'xrun.sh'), '/usr/bin/python3', os.path.join(bench, 'bench_vtk.py'), volume, '--mapper', mapper, '--size', size,
         '--tf', os.path.join(bench, 'tf', 'angio.json'), '--shade', str(int(shaded)), '--step', str(step), '--frames',
         str(frames)], check=True, capture_output=True, text=True).stdout
    return float(text.split('\t')[8])


with tempfile.TemporaryDirectory() as work:
    volume = metaimage(phantom, work)
    for step in (0.5, 1):
        for shaded in (False, True):
            a, b = [], []
            for _ in range(rounds):
                a.append(ours(step, shaded))
                b.append(theirs(step, shaded))
            x, y = statistics.median(a), statistics.median(b)
            print(f'step {step} voxel, {"shaded" if shaded else "plain":6}: {method} {x:.0f} ms, VTK {mapper} {y:.0f} ms, ratio '
                  f'{x / y:.2f}', flush=True)
