#!/bin/sh
# Makes a synthetic head CT angiogram as a DICOM series and renders it. Usage: demo.sh PROGRAM FOLDER
set -eu
program=$1
folder=$2
mkdir -p "$folder"
if [ ! -f "$folder/phantom/truth.json" ]; then
    echo "Making a synthetic head CT angiogram in $folder/phantom ..."
    "$program" phantom -o "$folder/phantom"
fi
"$program" info "$folder/phantom"
picture() {
    name=$1
    shift
    "$program" render "$folder/phantom" -o "$folder/$name.png" --size 768x768 --annotate --quiet "$@"
}
echo "Rendering ..."
# The front of the skull is clipped away: aneurysm of the left and stenosis of the right middle cerebral artery.
picture vessels --preset cta-head --view 10,18 --zoom 2.2 --clip 0%,100%,36%,100%,0%,100%
picture skull --preset cta-head --view 30,20 --zoom 1.7
picture bone --preset ct-bone --view 40,10 --zoom 1.5
picture mip --preset ct-mip --mode mip --clip 0%,100%,0%,100%,35%,60% --view superior --zoom 1.3
picture xray --preset ct-xray --view left --zoom 1.3
echo "The pictures:"
for name in vessels skull bone mip xray; do echo "  $(pwd)/$folder/$name.png"; done
