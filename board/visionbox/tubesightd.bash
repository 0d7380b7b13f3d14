# bash completion for tubesightd(1). tests/checks/manual.py holds it to `tubesightd --help`.

_tubesightd() {
  local cur=${COMP_WORDS[COMP_CWORD]}
  compopt -o filenames 2> /dev/null
  case $cur in
    -*) mapfile -t COMPREPLY < <(compgen -W "-h --help --version --check --dark" -- "$cur") ;;
    *) mapfile -t COMPREPLY < <(compgen -d -- "$cur"; compgen -f -X "!*.toml" -- "$cur") ;;
  esac
}

complete -F _tubesightd tubesightd
