#!/usr/bin/env bash
# usage: tests/cohort/engines.sh PROGRAM [PERSONS] [--kills N] [--alone N] [ENGINE...]
#
# Makes a BIDS data set of virtual persons and computes it by one process on one core and by every engine (parallel,
# snakemake, slurm), N workers (default 1) killed on the way, and compares the bytes of all results. With --alone the
# one process computes N persons only, after the engine: those whose workers were killed, the one who fails and others.
# Slurm runs as one node on loopback that this script starts and stops. An engine that is not installed is skipped, and
# the script says so.
#
#   tests/cohort/engines.sh build/release/bin/myoid 1000 --kills 40 --alone 50 snakemake
#
# prints the figures of docs/data/timings.txt.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
export MYOID; MYOID=$(realpath "$1")
shift
persons=6 kills=1 alone=
case ${1:-} in [0-9]*) persons=$1; shift ;; esac
while [ $# -gt 0 ]; do
  case $1 in
    --kills) kills=$2; shift 2 ;;
    --alone) alone=$2; shift 2 ;;
    *) break ;;
  esac
done
[ $# -gt 0 ] || set -- parallel snakemake slurm
declare -A needs=([parallel]=parallel [snakemake]=snakemake [slurm]=slurmctld)
installed=0
for engine in "$@"; do
  if command -v "${needs[$engine]:-$engine}" >/dev/null; then installed=1; else echo "$engine: not installed"; fi
done
[ $installed -eq 1 ] || { echo "skipped: none of $* is installed"; exit 77; }
work=$(mktemp -d)
trap 'stop_slurm; rm -rf "$work"' EXIT
cores=$(nproc)

stop_slurm() {
  local name
  for name in slurmd slurmctld munged; do
    [ -f "$work/$name.pid" ] && kill "$(cat "$work/$name.pid")" 2>/dev/null || true
    rm -f "$work/$name.pid"
  done
}

say() { printf '%s\n' "$*"; }
seconds() { date +%s.%N; }
# The largest memory of a command's processes goes to $work/memory [MB].
measured() {
  python3 -c 'import resource, subprocess, sys
code = subprocess.call(sys.argv[2:])
open(sys.argv[1], "w").write(str(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss // 1000))
sys.exit(code)' "$work/memory" "$@"
}
took() { awk -v a="$1" -v b="$2" 'BEGIN { printf "%.1f s", b - a }'; }

cat >"$work/protocol.toml" <<'TOML'
level = "L1"
[[trial]]
name = "mvc"
kind = "mvc"
direction = "both"
[[trial]]
name = "lift"
kind = "eccentric"
held_mass_kg = 1.0
TOML
"$MYOID" twin --protocol "$work/protocol.toml" --subjects "$persons" --out "$work/people" >/dev/null 2>&1
python3 "$here/make_bids.py" "$work/people" "$work/data"
rm -rf "$work/people"
# Without the longest stage of so short a recording.
sed -i 's/^\[identify\]/&\nnext_movements = 0/' "$work/data/code/study.toml"
last=$(printf 'sub-%03d' "$persons")
rm "$work/data/$last/motion/${last}_task-lift_tracksys-omc_motion.tsv"  # one person fails, and stops nobody

# Files hold the folder's name, so that one process and every engine use one folder.
run_alone() {  # run_alone [PERSON...]
  local begin code=0; begin=$(seconds)
  measured "$MYOID" cohort "$work/data" --out "$work/out" --jobs 1 --threads 1 --quiet \
    ${1:+--person "$@"} >/dev/null 2>&1 || code=$?
  say "one process on one core: ${alone:-$persons} persons in $(took "$begin" "$(seconds)"), at most" \
    "$(cat "$work/memory") MB"
  [ "$code" -eq 5 ] || { say "FAILED: exit code $code, expected 5: one person fails"; exit 1; }
  mv "$work/out" "$work/reference"
}
if [ -z "$alone" ]; then
  run_alone
  grep -q "^$last,.*failed" "$work/reference/persons.csv" || { say "FAILED: $last is not named"; exit 1; }
fi

ended() { find "$work/out/persons" -name outcome.json 2>/dev/null | wc -l; }

# Kills running persons by chance, the first once two persons are done, the last before the end; nobody twice.
kill_workers() {
  local i wanted deadline victim person running
  : >"$work/killed"
  for i in $(seq 0 $((kills - 1))); do
    wanted=$((2 + i * (persons - 2) / kills)) deadline=$((SECONDS + 300))
    until [ "$(ended)" -ge $wanted ]; do
      [ $SECONDS -lt $deadline ] || return 0
      sleep 0.05
    done
    for _ in $(seq 200); do
      running=$(pgrep -f -- "^$MYOID cohort $work/data .*--out $work/out .*--person" | shuf -n 1 || true)
      person=$(tr '\0' '\n' 2>/dev/null <"/proc/${running:-none}/cmdline" | grep '^sub-' || true)
      victim=${person:+$running}
      if [ -n "$victim" ] && ! grep -qx "$person" "$work/killed" && kill -9 "$victim" 2>/dev/null; then
        echo "$person" >>"$work/killed"
        break
      fi
      sleep 0.05
    done
  done
}

compare() {  # compare ENGINE BEGIN
  local engine=$1 time person count=0; time=$(took "$2" "$(seconds)")
  say "$engine, $cores cores: $persons persons in $time, $(wc -l <"$work/killed") workers killed," \
    "$(($(du -sb "$work/out/persons" | cut -f 1) / persons / 1000)) kB and" \
    "$(($(find "$work/out/persons" -type f | wc -l) / persons)) files a person"
  [ "$(ended)" -eq "$persons" ] || { say "FAILED: $(ended) persons have an outcome"; exit 1; }
  if [ -z "$alone" ]; then
    rm -rf "$work/out/workflow"
    diff -r "$work/reference" "$work/out" >"$work/differences" ||
      { say "FAILED: $engine differs from one core:"; head -20 "$work/differences"; exit 1; }
    say "  the same bytes as on one core"
  else
    local begin; begin=$(seconds)
    measured sh "$work/out/workflow/group.sh" >/dev/null 2>&1 || true
    say "  the group again: $(took "$begin" "$(seconds)"), $(cat "$work/memory") MB, page" \
      "$(stat -c %s "$work/out/report.html") bytes"
    mv "$work/out" "$work/engine"
    # shellcheck disable=SC2046
    run_alone $({ cat "$work/killed"; echo "$last"; seq -f 'sub-%03g' 1 $((persons / alone)) "$persons"; } |
      awk '!seen[$0]++' | head -n "$alone")
    for person in "$work"/reference/persons/*; do
      diff -r "$person" "$work/engine/persons/${person##*/}" || { say "FAILED: ${person##*/} differs"; exit 1; }
      count=$((count + 1))
    done
    [ $count -eq "$alone" ] || { say "FAILED: $count persons are compared"; exit 1; }
    say "  $count persons, all that were killed among them: the same bytes as on one core"
    rm -rf "$work/engine" "$work/reference"
  fi
  rm -rf "$work/out"
}

write_workflow() { "$MYOID" cohort "$work/data" --out "$work/out" --workflow "$1" >/dev/null; }

run_parallel() {
  command -v parallel >/dev/null || { say "parallel: skipped, not installed"; return; }
  local begin; begin=$(seconds)
  write_workflow parallel
  kill_workers & local killer=$!
  sh "$work/out/workflow/run.sh" --will-cite >/dev/null 2>&1 || [ $? -eq 5 ]
  wait $killer
  compare parallel "$begin"
}

run_snakemake() {
  command -v snakemake >/dev/null || { say "snakemake: skipped, not installed"; return; }
  local begin; begin=$(seconds)
  write_workflow snakemake
  kill_workers & local killer=$!
  (cd "$work" && snakemake --snakefile "$work/out/workflow/Snakefile" --cores "$cores" --keep-going) \
    >"$work/snakemake.log" 2>&1 || { say "FAILED: snakemake:"; tail -20 "$work/snakemake.log"; exit 1; }
  wait $killer
  compare snakemake "$begin"
}

start_slurm() {
  local host; host=$(hostname -s)
  export SLURM_CONF="$work/slurm.conf"
  mkdir -p "$work/spool" "$work/state" "$work/munge"
  chmod 755 "$work"
  chmod 700 "$work/munge"
  dd if=/dev/urandom of="$work/munge/key" bs=128 count=1 2>/dev/null
  chmod 600 "$work/munge/key"
  munged --force --key-file="$work/munge/key" --socket="$work/munge.socket" --pid-file="$work/munged.pid" \
    --seed-file="$work/munge/seed" --log-file="$work/munge/log" || return 1
  cat >"$SLURM_CONF" <<CONF
ClusterName=loopback
SlurmctldHost=$host(127.0.0.1)
SlurmUser=$(id -un)
AuthType=auth/munge
AuthInfo=socket=$work/munge.socket
CredType=cred/munge
SlurmctldPort=26817
SlurmdPort=26818
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
SlurmdSpoolDir=$work/spool
StateSaveLocation=$work/state
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
SwitchType=switch/none
ReturnToService=2
SchedulerParameters=batch_sched_delay=0,sched_interval=1
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
NodeName=$host NodeAddr=127.0.0.1 CPUs=$cores State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
CONF
  slurmctld && slurmd || return 1
  local deadline=$((SECONDS + 30))
  until sinfo -h -o %t 2>/dev/null | grep -q idle; do
    [ $SECONDS -lt $deadline ] || return 1
    sleep 0.2
  done
}

run_slurm() {
  local tool
  for tool in slurmctld slurmd munged sbatch; do
    command -v $tool >/dev/null || { say "slurm: skipped, $tool is not installed"; return; }
  done
  start_slurm || {
    say "slurm: skipped, it does not start on loopback here:"
    tail -n 3 "$work"/*.log "$work/munge/log" || true
    return
  }
  local begin deadline; begin=$(seconds)
  write_workflow slurm
  kill_workers & local killer=$!
  sh "$work/out/workflow/submit.sh" >/dev/null
  deadline=$((SECONDS + 240 + 20 * persons))  # a limit, not a measure
  while squeue -h | grep -q .; do
    [ $SECONDS -lt $deadline ] || { say "FAILED: slurm does not end:"; squeue; exit 1; }
    sleep 0.5
  done
  wait $killer
  stop_slurm
  compare slurm "$begin"
}

for engine in "$@"; do
  case $engine in
    parallel|snakemake|slurm) "run_$engine" ;;
    *) say "there is no engine '$engine'; there are parallel, snakemake, slurm"; exit 2 ;;
  esac
done
