# Completes command lines as bash would and compares. Usage: bash completion.bash SHARE_FOLDER FOLDER
source "$1/bash-completion/completions/angioscope"
folder=$2
failed=0
# complete_line WORD...: the answers for the last word, in COMPREPLY.
complete_line() {
    COMP_WORDS=("$@")
    COMP_CWORD=$(($# - 1))
    COMPREPLY=()
    _angioscope "$1" "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD - 1]}"
}
# expect ANSWERS WORD...
expect() {
    local wanted=$1
    shift
    complete_line "$@"
    [[ "${COMPREPLY[*]}" == "$wanted" ]] && return
    echo "bash: '$*' gives '${COMPREPLY[*]}', not '$wanted'"
    failed=1
}
[[ $(complete -p angioscope) == "complete -F _angioscope angioscope" ]] || failed=1
for file in "$folder"/options/*; do
    verb=$(basename "$file")
    complete_line angioscope "$verb" --
    for name in $(cat "$file"); do
        [[ " ${COMPREPLY[*]} " == *" $name "* ]] && continue
        echo "bash: $verb does not offer $name"
        failed=1
    done
done
mkdir -p "a folder" && touch "a file.png"
expect "render report" angioscope re
expect "--version" angioscope --vers
expect "--method --measure" angioscope render --me
expect "cpu" angioscope render --method cp
expect "cpu" angioscope render --method = cp
expect "none phong" angioscope render --shading =
expect "ct-skin ct-skull" angioscope render --preset ct-sk
expect "a folder" angioscope report -o "a f"
expect "a folder a file.png" angioscope render "a f"
expect "list" angioscope presets l
expect "mra" angioscope presets show mr
expect "" angioscope render --step ""
expect "" angioscope phantom ""
expect "--state" angioscope --sta
exit $failed
