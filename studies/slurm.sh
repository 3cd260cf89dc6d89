#!/bin/sh
# A study on a Slurm cluster: one rank a node, a thread a core, and as many jobs one after another
# as it takes.
#   sbatch studies/slurm.sh studies/planet-crack.toml --out /scratch/planet-crack.h5
#SBATCH --job-name=gearpod
#SBATCH --nodes=2
#SBATCH --ntasks-per-node=1
#SBATCH --cpus-per-task=64
#SBATCH --time=01:00:00
#SBATCH --signal=USR1@120
#SBATCH --open-mode=append
#SBATCH --requeue
set -u

# Two minutes before its end the queue sends SIGUSR1 to all ranks: they finish their batches, save and
# exit with 4. The next job goes on where this one ended, on as many nodes as it gets.
srun --mpi=pmix --cpu-bind=cores "${GEARPOD:-build/gearpod}" run "$@" --resume
code=$?
if [ "$code" -eq 4 ]; then
    scontrol requeue "$SLURM_JOB_ID"
fi
exit "$code"
