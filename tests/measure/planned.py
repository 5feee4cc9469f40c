#!/usr/bin/python3
"""Brute force against what the plan makes of it: time, samples and difference of pictures, as rows of a Markdown table.
Brute force is the single pass: every sample of every ray, nothing skipped, no ray ended, every part of the plan forced
in. Usage: planned.py PROGRAM PHANTOM DATA [FRAMES]; DATA holds chest-contrast-ct and volumes/ as the notes name them."""
import gzip, json, os, statistics, subprocess, sys, tempfile

program, phantom, data = sys.argv[1:4]
frames = sys.argv[4] if len(sys.argv) > 4 else '5'
chest, volumes = os.path.join(data, 'chest-contrast-ct'), os.path.join(data, 'volumes')
raw = {'aneurism': '256x256x256', 'engine': '256x256x128'}
scenes = [
    ('phantom', '--preset cta-head --view 30,20'),
    ('phantom', '--preset cta-head --shading none --view 0,20 --zoom 1.7'),
    ('phantom', '--preset ct-bone --view 40,10'),
    ('phantom', '--preset ct-mip --mode mip --view superior'),
    ('phantom', '--mode iso --iso 250 --preset ct-bone --view left'),
    ('phantom', '--preset ct-xray --view left'),
    ('phantom', '--preset cta-head --projection parallel --clip 0%,100%,40%,100%,0%,100%'),
    ('chest', '--preset cta-thorax --view 20,10'),
    ('chest', '--preset ct-lung --mode minip --clip 20%,80%,20%,80%,10%,90%'),
    ('chest', '--preset ct-bone --view posterior --zoom 2'),
    ('avm', '--preset cta-head --view 20,10'),
    ('aneurism', '--view 20,10'),
    ('aneurism', '--mode mip --view left'),
    ('engine', '--view 30,30 --shading phong'),
]


def run(path, options, extra, out):
    text = subprocess.run([program, 'render', *path, *options.split(), '--size', '512x512', '--background', '0,0,0,0', '-q', '-o', out,
                           *extra, '--repeat', frames, '--orbit', '12', '--json', '-'], check=True, capture_output=True, text=True).stdout
    return json.loads(text)


with tempfile.TemporaryDirectory() as work:
    def path_of(name):
        if name == 'phantom':
            return [phantom]
        if name == 'chest':
            return [chest]
        if name == 'avm':
            return [os.path.join(volumes, 'prism_AVM.nii.gz')]
        file = os.path.join(work, name + '.raw')
        if not os.path.exists(file):
            open(file, 'wb').write(gzip.open(os.path.join(volumes, f'{name}_{raw[name]}_uint8.raw.gz')).read())
        return [file, '--raw-dims', raw[name], '--raw-type', 'u8']
    print('| scene | planned | brute force, ms | planned, ms | ratio | samples, share | largest difference, levels |')
    print('|---|---|---|---|---|---|---|')
    ratios = []
    for name, options in scenes:
        path, a, b = path_of(name), os.path.join(work, 'a.exr'), os.path.join(work, 'b.exr')
        brute = run(path, options, ['--method', 'singlepass', '--no-skip', '--no-termination', '--force', 'all'], a)
        planned = run(path, options, [], b)
        check = json.loads(subprocess.run([program, 'check', a, b, '--threshold', '255', '--json'], capture_output=True, text=True).stdout)
        x, y = brute['time_ms']['frame_median'], planned['time_ms']['frame_median']
        ratios.append(y / x)
        print(f"| {name} `{options}` | {planned['plan']['method']} | {x:.0f} | {y:.0f} | {y / x:.2f} | "
              f"{planned['counts']['samples'] / brute['counts']['samples']:.3f} | {check['max']:.2g} |", flush=True)
    print(f'\nmedian ratio {statistics.median(ratios):.2f} over {len(ratios)} scenes')
