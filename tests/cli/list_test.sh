#!/usr/bin/env bash
# `list` and `help` know every command and every name.
#
# list_test.sh WELKIN
source "$(dirname -- "${BASH_SOURCE[0]}")/lib.sh"

must synth axes card.exr --size 16
for what in brdfs conventions curves filters formats layouts lobes luts maps methods parameterizations parameters; do matches . list $what; done
for command in info convert sample importance diff synth plot lut list help; do
  matches "^Usage: welkin $command" help $command
  matches "^Usage: welkin $command" $command --help
  matches "^  $command " --help
done
matches '^Usage: welkin plot density' help plot density
matches '^Usage: welkin plot lobe' help plot lobe
matches '^Usage: welkin plot fresnel' help plot fresnel
for name in $("$welkin" list lobes | cut -d ' ' -f 1 | grep -v '^table,'); do must plot lobe --lobe "$name"; done
matches '^ggx,f0=' list brdfs
matches '^welkin [0-9]+\.[0-9]+\.[0-9]+$' --version
for format in $("$welkin" list formats | grep -v -e 'read only' -e '^env$' -e '^glb$'); do must convert card.exr "listed.$format"; done

finish
