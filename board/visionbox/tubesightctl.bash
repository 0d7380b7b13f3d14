# bash completion for tubesightctl(1). tests/checks/manual.py holds it to `tubesightctl --help`.

_tubesightctl() {
  local cur=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command="" options i
  COMPREPLY=()
  if [ "$previous" = --socket ]; then
    compopt -o filenames 2> /dev/null
    mapfile -t COMPREPLY < <(compgen -f -- "$cur")
    return
  fi
  for ((i = 1; i < COMP_CWORD; i++)); do
    case ${COMP_WORDS[i]} in
      --socket) ((i++)) ;;
      -*) ;;
      *) command=${command:-${COMP_WORDS[i]}} ;;
    esac
  done
  case $command in
    "") options="-h --help --version --socket" ;;
    status | self-test) options="-h --help --json" ;;
    start) options="-h --help --confirm --field" ;;
    pick) options="-h --help --field" ;;
    *) options="-h --help" ;;
  esac
  case $cur in
    -*) mapfile -t COMPREPLY < <(compgen -W "$options" -- "$cur") ;;
    *)
      [ -n "$command" ] ||
        mapfile -t COMPREPLY < <(compgen -W "status start pick lamp record self-test page-password
          page-certificate" -- "$cur")
      ;;
  esac
}

complete -F _tubesightctl tubesightctl
