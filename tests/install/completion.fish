# Asks fish what it would offer and compares. Usage: fish --no-config completion.fish SHARE_FOLDER FOLDER
source $argv[1]/fish/vendor_completions.d/angioscope.fish
set -g failed 0
for file in $argv[2]/options/*
    set -l verb (basename $file)
    set -l offered (complete -C "angioscope $verb --" | cut -f 1)
    for name in (cat $file)
        if not contains -- $name $offered
            echo "fish: $verb does not offer $name"
            set failed 1
        end
    end
end
# expect LINE ANSWER...
function expect
    set -l found (complete -C $argv[1] | cut -f 1 | sort | string join -- ' ')
    set -l wanted (string join -- ' ' $argv[2..-1])
    if test "$found" != "$wanted"
        echo "fish: '$argv[1]' gives '$found', not '$wanted'"
        set failed 1
    end
end
mkdir -p fish_folder
touch fish_file.png
expect 'angioscope re' render report
expect 'angioscope --vers' --version
expect 'angioscope render --me' --measure --method
expect 'angioscope render --method cp' cpu
expect 'angioscope render --shading=' --shading=none --shading=phong
expect 'angioscope render --preset ct-sk' ct-skin ct-skull
expect 'angioscope report -o fish_fo' fish_folder/
expect 'angioscope render fish_fi' fish_file.png
expect 'angioscope presets l' list
expect 'angioscope presets show mr' mra
expect 'angioscope phantom fish_fi'
expect 'angioscope --sta' --state
exit $failed
