# Shared by the texts.sh of bench/peers and bench/trade: works in a folder of its own, which it
# leaves nothing of, and stops at the first thing that is not as it should be. Paths of arguments
# must be absolute before.
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
cd "$here"

fail() {
  echo "FAILED: $*" >&2
  exit 1
}
