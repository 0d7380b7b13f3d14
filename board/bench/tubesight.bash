# bash completion for tubesight(1). tests/checks/manual.py holds it to `tubesight --help`.

# Folders, and files that end as told: _tubesight_files .y4m .y4m.xz
_tubesight_files() {
  local suffix
  compopt -o filenames 2> /dev/null
  mapfile -t COMPREPLY < <(
    compgen -d -- "$cur"
    for suffix in "$@"; do compgen -f -X "!*$suffix" -- "$cur"; done
  )
}

_tubesight_words() { mapfile -t COMPREPLY < <(compgen -W "$*" -- "$cur"); }

_tubesight() {
  local cur=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}
  local command=${COMP_WORDS[1]} options taking i position=0
  COMPREPLY=()
  if [ "$COMP_CWORD" -eq 1 ]; then
    case $cur in
      -*) _tubesight_words -h --help -V --version ;;
      *) _tubesight_words new replay pose look calibrate budget simulate campaign devices journal ;;
    esac
    return
  fi

  # Flags, and options that take a value.
  case $command in
    new)
      options="-h --help -q --quiet -v --verbose"
      taking="--from --camera --efl-mm --pixel-um --scan --lattice --pitch-mm --bore-mm --weld --tool-mm"
      taking+=" --tool-deg --at"
      ;;
    replay)
      options="-h --help -q --quiet -v --verbose --overlay-estimates --ignore-scan-flag --must-track"
      taking="--fields --centers --overlay --poses --pairs --replies --summary --from --to --every"
      taking+=" --scalar"
      ;;
    pose)
      options="-h --help -q --quiet -v --verbose --only-start --average --total --ignore-scan-flag"
      taking="--frames --start --csv --covariance --overlay --correct --limit-mm --method --edge"
      ;;
    look)
      options="-h --help -q --quiet -v --verbose"
      taking="--csv --overlay"
      ;;
    calibrate)
      options="-h --help -q --quiet -v --verbose --level --tool-known --free-efl --opencv --type --ignore-scan-flag"
      taking="--write-points --residuals --sheet --touches --base --arm --picture --export --out --dock --check"
      taking+=" --dock-height-mm --dock-offset-mm --heading-deg --start --points --guidetube-mm"
      taking+=" --rows --columns --spacing-mm --row-spacing-mm --dot-mm --lattice --dots --paper"
      ;;
    budget)
      options="-h --help -q --quiet -v --verbose"
      taking="--robots --seed --height-mm --plot"
      ;;
    simulate)
      options="-h --help -q --quiet -v --verbose --window-only"
      taking="--out --seed"
      ;;
    campaign)
      options="-h --help -q --quiet -v --verbose --lamps --sizes --reduce --without-margin-check"
      taking="--moves --fields --hours --seed --first-move --jobs --resume --report --merge"
      taking+=" --replay-move --out"
      ;;
    devices)
      options="-h --help --network"
      taking=""
      ;;
    journal)
      options="-h --help -q --quiet -v --verbose --accept-unsigned --accept-broken"
      taking="--key --second-key --at-least --csv --jsonl --jobs --mirrored --hold --clock-doubt"
      ;;
    *) return ;;
  esac

  case $command$previous in
    new--from) _tubesight_files .y4m .y4m.xz .png .pgm && return ;;
    new--camera) _tubesight_files .toml .yaml .yml && return ;;
    new--scan) _tubesight_words even-first odd-first progressive && return ;;
    new--lattice) _tubesight_words square triangular && return ;;
    new--weld) _tubesight_words flush fillet && return ;;
    calibrate--lattice) _tubesight_words square staggered && return ;;
    calibrate--dots) _tubesight_words dark bright && return ;;
    calibrate--paper) _tubesight_words A4 A3 A2 letter tabloid && return ;;
    replay--scalar) _tubesight_words fixed float double && return ;;
    pose--method)
      _tubesight_words rims centers tangent-points tangent-lines ellipse-centers && return
      ;;
    pose--edge) _tubesight_words step mid-level moment && return ;;
    replay--overlay) _tubesight_files .y4m .mp4 .mkv .mov && return ;;
    replay--summary) _tubesight_files .json && return ;;
    journal--key | journal--second-key) _tubesight_files .pub && return ;;
    journal--jsonl) _tubesight_files .jsonl && return ;;
    pose--overlay | look--overlay | calibrate--picture | budget--plot) _tubesight_files .png && return ;;
    replay--fields | replay--centers | replay--poses | replay--pairs | replay--replies | pose--csv | pose--covariance | look--csv | \
      campaign--resume | campaign--report | campaign--merge | calibrate--touches | \
      calibrate--residuals)
      _tubesight_files .csv && return
      ;;
    journal--csv | journal--jobs) _tubesight_files .csv && return ;;
    campaign--out) _tubesight_files .toml .csv && return ;;
    calibrate--export) _tubesight_files .yaml && return ;;
    calibrate--out | calibrate--sheet | calibrate--base | calibrate--arm) _tubesight_files .toml && return ;;
    simulate--out | calibrate--write-points) _tubesight_files "" && return ;;
  esac
  case " $taking " in
    *" $previous "*) return ;; # a number, a tube: nothing to offer
  esac
  case $cur in
    -*)
      _tubesight_words "$options" "$taking"
      return
      ;;
  esac

  # The arguments before this one, without options and their values.
  for ((i = 2; i < COMP_CWORD; i++)); do
    case " $taking " in
      *" ${COMP_WORDS[i]} "*) ((i++)) ;;
      *) [[ ${COMP_WORDS[i]} == -* ]] || ((position++)) ;;
    esac
  done
  case $command$position in
    calibrate0) _tubesight_words camera tool base zones links import template ;;
    calibrate1)
      case ${COMP_WORDS[2]} in
        template) _tubesight_files .svg .pdf ;;
        base | zones | links) _tubesight_files .csv ;;
        import) _tubesight_files .yaml .yml ;;
        *) _tubesight_files .toml ;;
      esac
      ;;
    journal0) _tubesight_words check export copy reconcile ;;
    journal*) _tubesight_files .db ;;
    new0 | replay0 | pose0 | budget0 | simulate0) _tubesight_files .toml ;;
    replay1) _tubesight_files .y4m .y4m.xz .mp4 .mkv .mov .avi ;;
    pose* | look*)
      _tubesight_files .png .pgm .jpg .jpeg .tif .tiff .bmp .y4m .y4m.xz .mp4 .mkv .mov .avi
      ;;
    campaign*) _tubesight_files .csv ;; # more of --merge
  esac
}

complete -F _tubesight tubesight
