#!/usr/bin/python3
"""Imported and exported presets against VTK's own functions: volume properties made at random, with midpoints and
sharpness where the form has them, are imported by the program and evaluated beside vtkPiecewiseFunction and
vtkColorTransferFunction; presets are exported and read back into those as 3D Slicer does. Prints the largest
differences of opacity and colour. Needs python3-vtk9 and python3-numpy. Usage: presets_vs_vtk.py PROGRAM [ROUNDS]"""
import json, os, random, subprocess, sys, tempfile
import xml.etree.ElementTree as tree
import numpy as np
from vtkmodules.vtkCommonDataModel import vtkPiecewiseFunction
from vtkmodules.vtkRenderingCore import vtkColorTransferFunction

program = sys.argv[1]
rounds = int(sys.argv[2]) if len(sys.argv) > 2 else 40
work = tempfile.mkdtemp()
lot = random.Random(5)


def made(curved):
    xs = sorted(lot.sample(range(-1000, 3000), lot.randint(2, 12)))
    opacity = [(x, lot.random(), *((lot.random(), lot.random()) if curved and lot.random() < .5 else (.5, 0))) for x in xs]
    xs = sorted(lot.sample(range(-1000, 3000), lot.randint(2, 12)))
    colour = [(x, lot.random(), lot.random(), lot.random(),
               *((lot.random(), lot.random()) if curved and lot.random() < .5 else (.5, 0))) for x in xs]
    return opacity, colour


def functions(opacity, colour):
    a, c = vtkPiecewiseFunction(), vtkColorTransferFunction()
    for point in opacity: a.AddPoint(*point)
    for point in colour: c.AddRGBPoint(*point)
    return a, c


def write(form, path, opacity, colour):
    def flat(points, n): return ' '.join([str(len(points) * n)] + [repr(v) for p in points for v in p[:n]])
    if form == 'vp':
        open(path, 'w').write('\n'.join(['1', '1', '0.9', '0.1', '0.2', '10', flat(opacity, 2), '4 0 1 255 1', flat(colour, 4)]) + '\n')
    elif form == 'xml':
        node = tree.Element('MRML')
        tree.SubElement(node, 'VolumeProperty', name='made', shade='1', ambient='0.1', diffuse='0.9', specular='0.2',
                        specularPower='10', scalarOpacity=flat(opacity, 2), colorTransfer=flat(colour, 4))
        tree.ElementTree(node).write(path)
    else:
        point = lambda p, **more: dict(x=p[0], midpoint=p[-2], sharpness=p[-1], **more)
        json.dump({'@schema': 'volume-property-schema-v1.0.0.json#', 'volumeProperties': [{'components': [{
            'shade': True, 'scalarOpacityUnitDistance': 2.0,
            'scalarOpacity': {'points': [point(p, y=p[1]) for p in opacity]},
            'rgbTransferFunction': {'points': [point(p, color=p[1:4]) for p in colour]}}]}]}, open(path, 'w'))


def shown(preset, xs):
    """A preset's opacity and colour: linear between its points."""
    points = json.loads(preset)['points']
    hu = [p['hu'] for p in points]
    at = [np.interp(xs, hu, [p['colour'][i] for p in points]) for i in range(3)]
    return np.interp(xs, hu, [p['opacity'] for p in points]), np.stack(at, 1)


def by_vtk(a, c, xs): return np.array([a.GetValue(x) for x in xs]), np.array([c.GetColor(x) for x in xs])


xs = np.linspace(-1200, 3200, 8801) + 0.013
worst = {}
for form in ('vp', 'xml', 'vp.json'):
    for _ in range(rounds):
        opacity, colour = made(form == 'vp.json')
        path, out = os.path.join(work, 'made.' + form), os.path.join(work, 'out.json')
        write(form, path, opacity, colour)
        subprocess.run([program, 'presets', 'import', path, '-o', out, '-q'], check=True)
        a, c = by_vtk(*functions(opacity, colour), xs)
        b, d = shown(open(out).read(), xs)
        # Where a function jumps, a chain of lines is a steep one: its share of the places is told beside the error.
        off = np.maximum(np.abs(a - b), np.abs(c - d).max(1))
        worst.setdefault('import ' + form, []).append((np.percentile(off, 99), off.max()))
for name in subprocess.run([program, 'presets', 'list'], check=True, capture_output=True, text=True).stdout.split('\n')[1:-1]:
    name = name.split()[0]
    path = os.path.join(work, 'out.vp')
    subprocess.run([program, 'presets', 'export', name, '-o', path, '-q'], check=True)
    lines = open(path).read().split('\n')
    a, c = vtkPiecewiseFunction(), vtkColorTransferFunction()
    numbers = [float(v) for v in lines[6].split()][1:]
    a.FillFromDataPointer(len(numbers) // 2, numbers)
    numbers = [float(v) for v in lines[8].split()][1:]
    c.FillFromDataPointer(len(numbers) // 4, numbers)
    text = subprocess.run([program, 'presets', 'show', name], check=True, capture_output=True, text=True).stdout
    if json.loads(text)['unit_distance'] != 1: continue
    (a, c), (b, d) = by_vtk(a, c, xs), shown(text, xs)
    off = np.maximum(np.abs(a - b), np.abs(c - d).max(1))
    worst.setdefault('export vp', []).append((np.percentile(off, 99), off.max()))
for what, values in worst.items():
    print(f'{what:16} {len(values):3} presets: 99 % of places within {max(v[0] for v in values):.2g}, all within '
          f'{max(v[1] for v in values):.2g}')
