#!/bin/sh
# run.sh samples C3D_SAMPLES FOLDER | run.sh same MYOID FOLDER: see c3d_by_the_guide.py
set -eu
here="$(cd "$(dirname "$0")" && pwd)"
reader="$here/c3d_by_the_guide.py"
if [ "$1" = samples ]; then
  rm -rf "$3/samples"
  "$2" "$3/samples"
  exec python3 "$reader" samples "$3/samples"
fi
data="${MYOID_DATA:-$here/../../../shared/data}/c3d"
[ -d "$data" ] || { echo "no folder $data: nothing to compare" >&2; exit 77; }
# Of every processor and kind, small enough for a reader in Python. Files whose header and parameters disagree are
# mended by ours and not by the other.
for file in sample01/Eb015pi.c3d sample01/Eb015pr.c3d sample01/Eb015vi.c3d sample01/Eb015vr.c3d sample01/Eb015si.c3d \
            sample01/Eb015sr.c3d sample08/TESTAPI.c3d sample08/TESTDPI.c3d; do
  [ -f "$data/$file" ] || { echo "no file $data/$file" >&2; exit 77; }
  rm -f "$3/again.c3d"
  "$2" convert "$data/$file" "$3/again.c3d" >/dev/null 2>&1
  python3 "$reader" same "$data/$file" "$3/again.c3d"
done
