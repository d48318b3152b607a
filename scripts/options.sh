# shellcheck shell=bash
# What scripts/run, scripts/verify, scripts/bench and scripts/seismpm share: refusing an unknown option. To be sourced.

# As what the script was started: by seismpm under another name.
called_as=${SEISMPM_COMMAND:-${0##*/}}
unset SEISMPM_COMMAND

# The word most like $1 of those that follow, if one is like it: letters changed, added, left out or exchanged
# with their neighbour, up to a third of them.
nearest() {
  local wrong=$1
  shift
  printf '%s\n' "$@" | awk -v a="${wrong#"${wrong%%[!-]*}"}" '
    function least(x, y) { return x < y ? x : y }
    {
      b = $0; sub(/^-+/, "", b); m = length(a); n = length(b)
      for (i = 0; i <= m; i++) d[i, 0] = i
      for (j = 0; j <= n; j++) d[0, j] = j
      for (i = 1; i <= m; i++)
        for (j = 1; j <= n; j++) {
          x = substr(a, i, 1); y = substr(b, j, 1)
          d[i, j] = least(least(d[i - 1, j], d[i, j - 1]) + 1, d[i - 1, j - 1] + (x != y))
          if (i > 1 && j > 1 && x == substr(b, j - 1, 1) && y == substr(a, i - 1, 1))
            d[i, j] = least(d[i, j], d[i - 2, j - 2] + 1)
        }
      away = m > 2 && (index(a, b) == 1 || index(b, a) == 1) ? 1 : d[m, n]
      if (3 * away <= (m > n ? m : n) && (best == "" || away < distance)) { best = $0; distance = away }
    }
    END { print best }'
}

# refuse MESSAGE...: ends with 64, a wrong command line.
refuse() {
  echo "$called_as: $*; see --help" >&2
  exit 64
}

# unknown_option OPTION THOSE_THAT_THERE_ARE...
unknown_option() {
  local like
  like=$(nearest "$@")
  [ -z "$like" ] || like="; did you mean '$like'?"
  refuse "$1: there is no such option$like"
}
