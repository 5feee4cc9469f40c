# Types command lines and the Tab key into an interactive zsh and compares what stands there then. Usage: zsh -f
# completion.zsh SHARE_FOLDER FOLDER
zmodload zsh/zpty || exit 0
share=$1 folder=$2 failed=0 line=$2/zsh.line
touch $folder/zsh_file.png
mkdir -p $folder/zsh_folder
zpty shell "env TERM=dumb ZDOTDIR=$folder/home zsh -f -i"
# What ^X does: writes the line into a file, under another name first, so that it is whole when it is seen.
zpty -w shell "PS1=; cd $folder; fpath=($share/zsh/site-functions \$fpath); autoload -Uz compinit; compinit -u -D; \
zstyle ':completion:*' list-prompt ''; show() { print -r -- \"\$BUFFER\" >$line.new; mv $line.new $line; BUFFER= }; \
zle -N show; bindkey '^X' show; bindkey '^I' complete-word; LISTMAX=10000"
# expect WHAT IS TYPED, WHAT THEN STANDS THERE
expect() {
    rm -f $line
    zpty -w -n shell "$1"$'\t\x18'
    local waited=0
    until [[ -f $line ]]; do
        zpty -r -t shell ignored
        sleep 0.05
        (( ++waited > 1200 )) && { print "zsh: '$1' is not answered"; exit 1 }
    done
    local found=$(<$line)
    [[ ${found%% } == $2 ]] && return
    print "zsh: '$1' becomes '$found', not '$2'"
    failed=1
}
expect 'angioscope ren' 'angioscope render'
expect 'angioscope render --met' 'angioscope render --method='
expect 'angioscope render --method cp' 'angioscope render --method cpu'
expect 'angioscope render --method=cp' 'angioscope render --method=cpu'
expect 'angioscope render --preset ct-ski' 'angioscope render --preset ct-skin'
expect 'angioscope report -o zsh_fo' 'angioscope report -o zsh_folder/'
expect 'angioscope render zsh_fi' 'angioscope render zsh_file.png'
expect 'angioscope presets sho' 'angioscope presets show'
expect 'angioscope presets show mr' 'angioscope presets show mra'
expect 'angioscope --write-st' 'angioscope --write-state='
expect 'angioscope phantom zsh_fi' 'angioscope phantom zsh_fi'
for list in $folder/options/*; do
    verb=${list:t}
    for name in $(<$list); do
        grep -qF -e "${name}=[" -e "${name}[" -e ",${name}=}" -e ",${name}}" <(sed -n "/^    $verb)/,/^        ;;/p" $share/zsh/site-functions/_angioscope) && continue
        print "zsh: $verb does not offer $name"
        failed=1
    done
done
zpty -d shell
exit $failed
