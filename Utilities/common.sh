# shellcheck shell=bash
# SPDX-FileCopyrightText: Copyright (c) Schlieren contributors
# SPDX-License-Identifier: BSD-3-Clause
#
# What the scripts of this folder share. To be sourced by bash:
#
#   . "$(dirname "${BASH_SOURCE[0]}")/common.sh"
#
#   say TEXT...              a line about what happens now, with the seconds since the script began
#   die TEXT...              an error message, then exit 1
#   install_dependencies     installs what is missing (Utilities/install-dependencies) and meanwhile builds the tracer of
#                            the preset release, which takes no more than a compiler, CMake and ninja
#   quietly LOG COMMAND...   output goes to the file LOG; its last lines are shown when COMMAND fails
#   build_plugin [PRESET [TARGET]]
#                            configures and builds a CMake preset (release), all of it or one target,
#                            telling how far it is; sets and exports SCHLIEREN_PLUGIN, the file that pvpython's LoadPlugin
#                            takes
#   with_display COMMAND...  runs COMMAND where it can render (Utilities/with-display)
#
#   SCHLIEREN_ROOT           the top folder of the sources
#   SCHLIEREN_CMAKE          more options for the configuration of build_plugin, an array
#   SCHLIEREN_JOBS           how many jobs to build and test with; default: the processors we may use

SCHLIEREN_ROOT=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd -P)
SCHLIEREN_CMAKE=()
SCHLIEREN_JOBS=${SCHLIEREN_JOBS:-$(nproc)}

say()
{
  printf '[%4d s] %s\n' "$SECONDS" "$*"
}

die()
{
  printf 'error: %s\n' "$*" >&2
  exit 1
}

install_dependencies()
{
  local build=$SCHLIEREN_ROOT/build/release tracer=
  _install()
  {
    "$SCHLIEREN_ROOT/Utilities/install-dependencies" "$@" ||
      die "Some packages are missing and could not be installed; see above."
  }
  # Packages are installed one after the other, which leaves processors idle. Where somebody has built the plugin
  # before, there is nothing to gain.
  if [[ ! -e $build/CMakeCache.txt && -n $("$SCHLIEREN_ROOT/Utilities/install-dependencies" --missing) ]]; then
    _install --compiler
    if (cd "$SCHLIEREN_ROOT" && quietly "$build/configure.log" cmake --preset release \
      "${SCHLIEREN_CMAKE[@]}" -DSCHLIEREN_CORE_ONLY=ON); then
      say "Building the tracer meanwhile"
      # ninja itself, which ends its compilers when it receives a signal.
      ninja -C "$build" -j "$SCHLIEREN_JOBS" SchlierenCore >"$build/tracer.log" 2>&1 </dev/null &
      tracer=$!
      # shellcheck disable=SC2064 # this process, not one that is started later
      trap "kill $tracer 2>/dev/null || true" EXIT
    fi
  fi
  _install
  say "All packages are there"
  if [[ -n $tracer ]]; then
    # What it could not build, the build of the plugin says.
    wait "$tracer" || true
    trap - EXIT
    say "Built the tracer"
  fi
}

quietly()
{
  local log=$1
  shift
  mkdir -p "$(dirname "$log")"
  if ! "$@" >"$log" 2>&1 </dev/null; then
    printf 'failed: %s\n' "$*" >&2
    tail -n 60 "$log" >&2
    printf 'The full output is in %s\n' "$log" >&2
    return 1
  fi
}

# Shows ninja's "[12/80]" as a line for every further tenth of the build; keeps all output in LOG.
_with_progress()
{
  local log=$1 line built total tenth shown=0
  shift
  "$@" 2>&1 </dev/null | tee "$log" | while IFS= read -r line; do
    if [[ $line =~ ^\[([0-9]+)/([0-9]+)\] ]]; then
      built=${BASH_REMATCH[1]} total=${BASH_REMATCH[2]}
      tenth=$((total > 0 ? built * 10 / total : 10))
      if ((tenth > shown)); then
        say "  built $built of $total"
        shown=$tenth
      fi
    fi
  done
  return "${PIPESTATUS[0]}"
}

build_plugin()
{
  local preset=${1:-release} target=${2:-all} log
  local build=$SCHLIEREN_ROOT/build/$preset
  mkdir -p "$build"
  say "Configuring (preset $preset)"
  log=$build/configure.log
  (cd "$SCHLIEREN_ROOT" && quietly "$log" cmake --preset "$preset" "${SCHLIEREN_CMAKE[@]}") || return 1
  say "Building with $SCHLIEREN_JOBS jobs"
  log=$build/build.log
  if ! _with_progress "$log" cmake --build "$build" --target "$target" --parallel "$SCHLIEREN_JOBS"; then
    grep -E -A 12 'FAILED|error' "$log" | head -n 80 >&2
    printf 'The build failed. Its full output is in %s\n' "$log" >&2
    return 1
  fi
  # The build leaves the name of the file here: its folder differs from system to system.
  SCHLIEREN_PLUGIN=
  if [[ -f $build/plugin-file.txt ]]; then
    SCHLIEREN_PLUGIN=$(<"$build/plugin-file.txt")
    export SCHLIEREN_PLUGIN
    say "Built $SCHLIEREN_PLUGIN"
  fi
}

with_display()
{
  "$SCHLIEREN_ROOT/Utilities/with-display" "$@"
}
