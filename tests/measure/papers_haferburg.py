#!/usr/bin/python3
"""Samples a pixel with the clip box, the envelope, and skipping inside it, as rows of a Markdown table, beside brute force
and the lower bound (samples that show, before the ray ends). Usage: papers_haferburg.py PROGRAM NAME=PATH[,OPTION...] ..."""
import json, subprocess, sys, tempfile

program = sys.argv[1]
work = tempfile.mkdtemp()


def samples(path, options, *more):
    text = subprocess.run([program, 'render', path, '-q', '-o', work + '/x.pfm', '--backend', 'osmesa', '--json', '-',
                           *options, *more], check=True, capture_output=True, text=True).stdout
    return json.loads(text)['counts']


print('| volume | scene | pixels that meet the box | brute force | box | envelope | between blocks | both | of brute force | '
      'of the lower bound |')
print('|---|---|---|---|---|---|---|---|---|---|')
for argument in sys.argv[2:]:
    name, rest = argument.split('=', 1)
    path, *options = rest.split(',')
    for scene in ('dvr', 'iso'):
        if scene == 'iso' and '--iso' not in options:
            continue
        mode = [*options, '--mode', scene, '--shading', 'none']
        if scene == 'dvr' and '--iso' in mode:
            at = mode.index('--iso')
            del mode[at:at + 2]
        pixels = samples(path, mode, '--method', 'singlepass')['fragments']
        brute = samples(path, mode, '--method', 'singlepass', '--no-termination')['samples']
        box = samples(path, mode, '--method', 'singlepass')['samples']
        kinds = [samples(path, mode, '--method', 'envelope', '--skipping', kind, '--quads', '1000000')['samples']
                 for kind in ('outside', 'between', 'both')]
        bound = samples(path, mode, '--method', 'singlepass', '--count-shown')['samples'] if scene == 'dvr' else 0
        cells = [f'{value / pixels:.1f}' for value in [brute, box, *kinds]]
        over = f'{kinds[-1] / bound:.2f}' if bound else '-'
        print(f'| {name} | {scene} | {pixels} | ' + ' | '.join(cells) + f' | {kinds[-1] / brute:.3f} | {over} |', flush=True)
