#!/usr/bin/env bash
# Studies of virtual persons in worlds that are other than the identification believes, as one table
# in Markdown.
#   tests/coverage/worlds.sh MYOID OUT [PERSONS] ...
# MYOID: the program. OUT: a folder; each world has a folder of its own there, and a world whose
# summary.csv exists is not run again. PERSONS: 40 by default. Further options go to `twin-study`.
set -euo pipefail
[ $# -ge 2 ] || { sed -n '2,6s/^# \{0,1\}//p' "$0"; exit 2; }
myoid=$1
out=$2
shift 2
persons=40
if [ $# -gt 0 ] && [[ $1 != -* ]]; then persons=$1; shift; fi
protocols=$(cd "$(dirname "$0")/../../examples/protocols" && pwd)

# Name | protocol | settings of [truth]. The protocol no_maximum is the rich one without its maximal
# contractions.
worlds='as fitted|rich|
three trials only|three_trials|
literature 2 sd off|rich|offset=2
tendon strain 8 %|rich|tendon_strain=[0.08,0.08]
Millard'"'"'s curves|rich|curves=millard
moment arms 15 %|rich|moment_arm_sd=0.15 moment_arm_slope_sd=0.1
EMG exponent 0.6|rich|emg_exponent=0.6
cross-talk 15 %|rich|crosstalk=0.15
gain drift 20 %|rich|emg_gain_drift=0.2
torque 5 %, 1.5 N m|rich|torque_scale=1.05 torque_offset_nm=1.5
EMG that is noise|rich|emg_noise=true
no maximal contraction|no_maximum|'

mkdir -p "$out"
awk -v RS= -v ORS='\n\n' '!/kind = "mvc"/' "$protocols/rich.toml" > "$out/no_maximum.toml"
echo "| world | persons | F_max: covered [%] | error [%] | half width [%] | l_m⁰: covered [%] | error [%] | half width [%] | F_max and l_m⁰ identified, within 15 % | all parameters identified, within 15 % |"
echo "| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |"
while IFS='|' read -r name protocol settings <&3; do
  folder=$out/$(echo "$name" | tr -cs 'A-Za-z0-9' '_' | sed 's/_$//')
  if [ ! -f "$folder/summary.csv" ]; then
    read -ra truth <<< "$settings"
    [ ${#truth[@]} -eq 0 ] || truth=(--truth "${truth[@]}")
    # Code 5: some persons' runs failed; the count below says how many remain.
    file=$protocols/$protocol.toml
    [ -f "$file" ] || file=$out/$protocol.toml
    "$myoid" twin-study --protocol "$file" --level L1 --subjects "$persons" \
      "${truth[@]}" "$@" --out "$folder" > "$folder.txt" || [ $? -eq 5 ]
  fi
  awk -F, -v name="$name" '
    function share(x) { return x == "" ? "–" : sprintf("%.0f", 100 * x) }
    function of(n, all) { return all > 0 ? sprintf("%d of %d", n, all) : "none" }
    NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i; next }
    $column["method"] != "torque" || ($column["muscle"] != "all" && $column["muscle"] != "subject") { next }
    {
      called = $column["identified"]; right = $column["identified_within_15"]
      all_called += called; all_right += right
      p = $column["parameter"]
      if (p != "max_isometric_force" && p != "optimal_fiber_length") next
      two_called += called; two_right += right
      count[p] = $column["count"]
      cells[p] = share($column["coverage"]) " | " sprintf("%.1f", 100 * $column["median_error"]) " | " sprintf("%.1f", 100 * $column["half_width"])
    }
    END {
      printf "| %s | %d | %s | %s | %s | %s |\n", name, count["max_isometric_force"] / 4,
        cells["max_isometric_force"], cells["optimal_fiber_length"],
        of(two_right, two_called), of(all_right, all_called)
    }' "$folder/summary.csv"
done 3<<< "$worlds"
