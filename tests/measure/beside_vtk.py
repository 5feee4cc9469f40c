"""Angioscope and one of VTK's mappers beside each other: the same series, camera and transfer function for both. What
method_vs_vtk.py and errors_vs_vtk.py share; BENCH is a folder with bench_vtk.py, xrun.sh and tf/. Needs python3-vtk9,
python3-numpy, Xvfb and dcm2niix."""
import json, os, struct, subprocess
import numpy as np


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


def points(bench, look):
    return os.path.join(bench, 'tf', {'mip': 'mip.json', 'tissue': 'tissue.json'}.get(look, 'angio.json'))


def preset(bench, look, work):
    """What we draw with: a projection shows values through a window, where VTK takes the ramp of its points."""
    if look != 'mip':
        return points(bench, look)
    path = os.path.join(work, 'ramp.json')
    made = json.load(open(points(bench, look)))
    made.update(mode='mip', window={'centre': 300, 'width': 600})
    json.dump(made, open(path, 'w'))
    return path


def ours(program, series, preset, look, size):
    """The command that draws a look; method, step and what to write are for the caller to add."""
    return [program, 'render', series, '-q', '--preset', preset, '--zoom', '1.7', '--size', size, '--backend', 'osmesa',
            '--shading', 'phong' if look == 'shaded' else 'none'] + (['--mode', 'mip'] if look == 'mip' else [])


def theirs(bench, volume, points, look, size, step, mapper, script=()):
    """The command that has VTK draw it; `script` goes before bench_vtk.py."""
    return [
        os.path.join(bench, 'xrun.sh'), '/usr/bin/python3', *script, os.path.join(bench, 'bench_vtk.py'), volume, '--mapper', mapper,
        '--size', size, '--tf', points, '--shade', str(int(look == 'shaded')), '--step', str(step)
    ] + (['--mode', 'mip'] if look == 'mip' else [])
