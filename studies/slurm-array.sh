#!/bin/sh
# A study too large for one job as an array of jobs, each a part of its gearboxes on a node of its own,
# and a last job that merges them.
#   sbatch --array=1-40 studies/slurm-array.sh studies/planet-crack.toml /scratch/planet-crack
# leaves /scratch/planet-crack.h5; its parts stay beside it as /scratch/planet-crack.1.h5 and so on. Further
# arguments go to `run` (--set, --instances, --seed).
#SBATCH --job-name=gearpod
#SBATCH --nodes=1
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=64
#SBATCH --time=01:00:00
#SBATCH --signal=B:USR1@120
#SBATCH --open-mode=append
#SBATCH --requeue
set -u

program="${GEARPOD:-build/gearpod}"
study=$1
out=$2
shift 2

# The first job asks for the merge, which waits for all of them.
if [ "$SLURM_ARRAY_TASK_ID" -eq "$SLURM_ARRAY_TASK_MIN" ] && [ "${SLURM_RESTART_COUNT:-0}" -eq 0 ]; then
    sbatch --job-name=gearpod-merge --dependency="afterok:$SLURM_ARRAY_JOB_ID" \
        --cpus-per-task="$SLURM_CPUS_PER_TASK" --output="$out.merge.txt" \
        --wrap "'$program' merge $(seq -f "'$out.%g.h5'" -s ' ' "$SLURM_ARRAY_TASK_COUNT") --out '$out.h5'"
fi

# Two minutes before its end the queue sends SIGUSR1: the part saves, exits with 4 and goes on in the
# next job.
"$program" run "$study" --part "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" \
    --out "$out.$SLURM_ARRAY_TASK_ID.h5" --resume --progress json "$@" &
part=$!
trap 'kill -USR1 "$part"' USR1
while :; do
    wait "$part"
    code=$?
    kill -0 "$part" 2>/dev/null || break
done
if [ "$code" -eq 4 ]; then
    scontrol requeue "${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID"
fi
exit "$code"
