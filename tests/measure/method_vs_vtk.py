#!/usr/bin/python3
"""A method against one of VTK's mappers on the same machine: a series, the same orbit and transfer function, in turns in one
run; medians over the orbit and the ratio. Needs python3-vtk9, python3-numpy, Xvfb and a folder with bench_vtk.py, xrun.sh
and tf/. Usage: method_vs_vtk.py PROGRAM SERIES BENCH [ROUNDS] [METHOD] [gpu|cpu] [SIDE] [STEPS] [LOOKS], the last two lists
like 0.5,1 and plain,shaded,mip,tissue."""
import json, os, statistics, struct, subprocess, sys, tempfile
import numpy as np

program, phantom, bench = sys.argv[1:4]
rounds = int(sys.argv[4]) if len(sys.argv) > 4 else 2
method = sys.argv[5] if len(sys.argv) > 5 else 'slicing'
mapper = sys.argv[6] if len(sys.argv) > 6 else 'gpu'
side = sys.argv[7] if len(sys.argv) > 7 else '512'
size = f'{side}x{side}'
steps = [float(x) for x in (sys.argv[8] if len(sys.argv) > 8 else '0.5,1').split(',')]
looks = (sys.argv[9] if len(sys.argv) > 9 else 'plain,shaded').split(',')
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


def points(look):
    return os.path.join(bench, 'tf', {'mip': 'mip.json', 'tissue': 'tissue.json'}.get(look, 'angio.json'))


def preset(look):
    """What we draw with: a projection shows values through a window, where VTK takes the ramp of its points."""
    if look != 'mip':
        return points(look)
    path = os.path.join(work, 'ramp.json')
    made = json.load(open(points(look)))
    made.update(mode='mip', window={'centre': 300, 'width': 600})
    json.dump(made, open(path, 'w'))
    return path


def ours(step, look):
    text = subprocess.run(
        [program, 'render', phantom, '-q', '-o', os.path.join(work, 'x.png'), '--preset', preset(look), '--method', method,
         '--view', '0,20', '--zoom', '1.7', '--step', str(step), '--shading', 'phong' if look == 'shaded' else 'none',
         '--backend', 'osmesa', '--size', size, '--repeat', str(frames), '--orbit', '360', '--json', '-'] +
        (['--mode', 'mip'] if look == 'mip' else []), check=True, capture_output=True, text=True).stdout
    return json.loads(text)['time_ms']['frame_median']


def theirs(step, look):
    text = subprocess.run(
        [os.path.join(bench, 'xrun.sh'), '/usr/bin/python3', os.path.join(bench, 'bench_vtk.py'), volume, '--mapper', mapper, '--size', size,
         '--tf', points(look), '--shade', str(int(look == 'shaded')), '--step', str(step), '--frames', str(frames)] +
        (['--mode', 'mip'] if look == 'mip' else []), check=True, capture_output=True, text=True).stdout
    return float(text.split('\t')[8])


with tempfile.TemporaryDirectory() as work:
    volume = metaimage(phantom, work)
    for step in steps:
        for look in looks:
            a, b = [], []
            for _ in range(rounds):
                a.append(ours(step, look))
                b.append(theirs(step, look))
            x, y = statistics.median(a), statistics.median(b)
            print(f'step {step:g} voxel, {look:6}: {method} {x:.0f} ms, VTK {mapper} {y:.0f} ms, ratio {x / y:.2f}; in turns '
                  f'{" ".join(f"{p / q:.2f}" for p, q in zip(a, b))}', flush=True)
